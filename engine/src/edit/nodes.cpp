// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "toile/curve/crossing.h"

namespace toile::detail {

namespace {

/// Without controls or shared points nearby, a carried end takes this part of the curve along.
constexpr double kCarriedPart = 0.4;

std::uint64_t hashOf(const ModelPoint& point) {
  std::uint64_t hash = point.at.index();
  const auto mix = [&](std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  };
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) {
    mix(vertex->index());
  } else if (const auto* on = std::get_if<ModelPoint::OnEdge>(&point.at)) {
    mix(on->tail.index());
    mix(on->head.index());
    mix(std::bit_cast<std::uint64_t>(on->t));
  } else {
    const auto& in = std::get<SurfacePoint::InFace>(point.at);
    mix(in.face.index());
    for (Eigen::Index k = 0; k < 3; ++k) mix(std::bit_cast<std::uint64_t>(in.barycentric[k]));
  }
  return hash;
}

/// Data points of a curve that other curves have too.
std::vector<bool> sharedData(const Sketch& sketch, const std::string& id, const WorkCurve& curve) {
  const DataPoints points(sketch.design());
  std::vector<bool> shared;
  for (const SurfacePoint& point : curve.data) {
    const auto curves = points.curvesAt(toModelPoint(sketch.mesh(), point));
    shared.push_back(std::any_of(curves.begin(), curves.end(), [&](std::size_t c) {
      return sketch.design().curves[c].id != id;
    }));
  }
  return shared;
}

/// Makes every place where the changed curve meets another now a data point of both. A point that
/// is there already is kept: third lines may share it.
Result<void> shareMeetings(Sketch& sketch, WorkCurve& curve, const std::string& otherId) {
  const Mesh& mesh = sketch.mesh();
  if (const Result<void> linked = linkAll(sketch.linker(), curve); !linked) return linked;
  Result<WorkCurve> other = sketch.load(otherId);
  if (!other) return other.error();
  const SurfacePath path = pathOf(curve), otherPath = pathOf(*other);
  if (!isValid(mesh, path) || !isValid(mesh, otherPath)) return {};
  const auto meetings = findMeetings(mesh, path, otherPath);
  for (const PathMeeting& meeting : meetings) {
    const std::size_t before = curve.data.size(), beforeOther = other->data.size();
    const std::size_t mine = insertData(mesh, curve, meeting.a);
    const std::size_t theirs = insertData(mesh, *other, meeting.b);
    // One point for both; the shift is rounding.
    const SurfacePoint own = curve.data[mine], shared = other->data[theirs];
    if (own == shared) continue;
    if (other->data.size() > beforeOther && nudgeData(mesh, *other, theirs, own)) continue;
    if (curve.data.size() > before && nudgeData(mesh, curve, mine, shared)) continue;
    const Result<void> replaced = replaceData(sketch.linker(), mesh, *other, theirs, own);
    if (!replaced) return replaced;
  }
  if (!meetings.empty()) sketch.store(otherId, *other);
  return {};
}

}  // namespace

DataPoints::DataPoints(const Design& design) : design_(design) {
  for (std::size_t c = 0; c < design.curves.size(); ++c) {
    const auto& data = design.curves[c].dataPoints;
    for (std::size_t i = 0; i < data.size(); ++i) places_.emplace(hashOf(data[i]), std::pair{c, i});
  }
}

std::vector<std::size_t> DataPoints::curvesAt(const ModelPoint& point) const {
  std::vector<std::size_t> curves;
  const auto [from, to] = places_.equal_range(hashOf(point));
  for (auto it = from; it != to; ++it) {
    const auto& [c, i] = it->second;
    if (design_.curves[c].dataPoints[i] == point) curves.push_back(c);
  }
  std::sort(curves.begin(), curves.end());
  curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
  return curves;
}

std::vector<Knot> knotsAround(const WorkCurve& curve, std::size_t data, const SurfacePoint& to,
                              const std::vector<bool>& isHeld) {
  const std::size_t n = curve.data.size();
  const auto reach =
      static_cast<std::size_t>(std::max(1.0, std::ceil(kCarriedPart * static_cast<double>(n))));
  std::size_t first = data, last = data;
  while (first > 0 && data - first < reach) {
    --first;
    if (curve.isControl[first] || isHeld[first]) break;
  }
  while (last + 1 < n && last - data < reach) {
    ++last;
    if (curve.isControl[last] || isHeld[last]) break;
  }
  std::vector<Knot> knots;
  if (first < data) knots.push_back({first, std::nullopt});
  knots.push_back({data, to});
  if (last > data) knots.push_back({last, std::nullopt});
  return knots;
}

Result<void> followNodes(Sketch& sketch, const std::string& id, WorkCurve& curve,
                         const std::vector<MovedNode>& moved) {
  const Mesh& mesh = sketch.mesh();
  Reshaper reshaper(*sketch.model().index, sketch.linker());
  std::set<std::string> touched;
  for (const MovedNode& node : moved) {
    if (node.from == node.to) continue;
    const ModelPoint was = toModelPoint(mesh, node.from);
    std::vector<std::string> through;
    for (const StylingCurve& other : sketch.design().curves) {
      const auto& data = other.dataPoints;
      if (other.id != id && std::find(data.begin(), data.end(), was) != data.end()) {
        through.push_back(other.id);
      }
    }
    touched.insert(through.begin(), through.end());
    for (const std::string& otherId : through) {
      Result<WorkCurve> other = sketch.load(otherId);
      if (!other) return other.error();
      const auto found = std::find(other->data.begin(), other->data.end(), node.from);
      if (found == other->data.end()) continue;
      auto at = static_cast<std::size_t>(found - other->data.begin());
      const bool isEnd = !other->closed && (at == 0 || at + 1 == other->data.size());
      if ((isEnd || node.isDragged) && otherId != node.rail) {
        std::size_t turned = 0;
        if (other->closed) {  // so that the surroundings do not wrap
          turned = (at + other->data.size() / 2) % other->data.size();
          rotate(*other, turned);
          at = (at + other->data.size() - turned) % other->data.size();
        }
        const std::vector<Knot> knots =
            knotsAround(*other, at, node.to, sharedData(sketch, otherId, *other));
        const auto end = [&](const Knot& knot) {
          const bool isOwnEnd =
              !other->closed && (knot.data == 0 || knot.data + 1 == other->data.size());
          return isOwnEnd ? StretchEnd::Place : StretchEnd::Tangent;
        };
        if (knots.size() < 2) continue;
        Result<Reshaper::Reshaped> made =
            reshaper.reshape(*other, knots, end(knots.front()), end(knots.back()));
        if (!made) return made.error().during("curve \"" + otherId + "\"");
        if (other->closed) {
          rotate(made->curve, made->newIndex[(other->data.size() - turned) % other->data.size()]);
        }
        sketch.store(otherId, made->curve);
      }
    }
  }
  for (const std::string& otherId : touched) {
    const Result<void> shared = shareMeetings(sketch, curve, otherId);
    if (!shared) return shared.error().during("curve \"" + otherId + "\"");
  }
  return {};
}

}  // namespace toile::detail
