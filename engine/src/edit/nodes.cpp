// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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
    for (const std::string& otherId : through) {
      Result<WorkCurve> other = sketch.load(otherId);
      if (!other) return other.error();
      const auto found = std::find(other->data.begin(), other->data.end(), node.from);
      if (found == other->data.end()) continue;
      auto at = static_cast<std::size_t>(found - other->data.begin());
      const bool isEnd = !other->closed && (at == 0 || at + 1 == other->data.size());
      if (isEnd || node.isDragged) {
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
        continue;
      }
      if (const Result<void> linked = linkAll(sketch.linker(), curve); !linked) return linked;
      if (!isValid(mesh, pathOf(curve)) || !isValid(mesh, pathOf(*other))) continue;
      // A crossing: where the changed curve crosses the other now, nearest to the old place.
      const SurfacePath path = pathOf(curve), otherPath = pathOf(*other);
      std::optional<PathMeeting> nearest;
      double least = std::numeric_limits<double>::infinity();
      for (const PathMeeting& meeting : findMeetings(mesh, path, otherPath)) {
        const double distance = (position(mesh, meeting.point) - position(mesh, node.from)).norm();
        if (distance < least) {
          least = distance;
          nearest = meeting;
        }
      }
      if (!nearest) continue;
      const std::size_t mine = insertData(mesh, curve, nearest->a);
      const std::size_t theirs = insertData(mesh, *other, nearest->b);
      // One point for both; the shift is rounding.
      const SurfacePoint shared = other->data[theirs];
      if (!(curve.data[mine] == shared)) {
        const Result<void> replaced = replaceData(sketch.linker(), mesh, curve, mine, shared);
        if (!replaced) return replaced;
      }
      sketch.store(otherId, *other);
    }
  }
  return {};
}

}  // namespace toile::detail
