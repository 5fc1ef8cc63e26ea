// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/reshape.h"

#include <algorithm>
#include <cmath>

#include "toile/core/assert.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// A way over the surface that is longer than the step in space by this factor left the limb.
constexpr double kJumpRatio = 3;
/// Displacements below this leave a data point where it is, mm.
constexpr double kUnmoved = 1e-9;
/// A gap that has grown beyond this many old ones gets data points.
constexpr double kWideGap = 1.6;
constexpr std::size_t kMaxPerGap = 64;

struct Sample {
  double arc = 0;
  SurfacePoint old;
  std::ptrdiff_t data = -1;  ///< the old data point, -1 = added
};

}  // namespace

Result<Reshaper::Reshaped> Reshaper::reshape(const WorkCurve& old, const std::vector<Knot>& knots,
                                             StretchEnd first, StretchEnd last) {
  const Mesh& mesh = index_.mesh();
  TOILE_ASSERT(knots.size() >= 2);
  const std::vector<double> arcs = arcsOf(mesh, old);
  std::vector<double> knotArcs;
  std::vector<Vector3d> moves;
  for (const Knot& knot : knots) {
    knotArcs.push_back(arcs[knot.data]);
    const Vector3d from = position(mesh, old.data[knot.data]);
    moves.emplace_back(knot.to ? Vector3d(position(mesh, *knot.to) - from) : Vector3d::Zero());
  }
  const Displacement displacement(knotArcs, moves, first, last);

  // The old data points, and more where the displacement draws them apart.
  const std::size_t begin = knots.front().data, end = knots.back().data;
  const double usual = (arcs[end] - arcs[begin]) / static_cast<double>(end - begin);
  const double widest = kWideGap * std::min(usual, (arcs[end] - arcs[begin]) / 8);
  std::vector<Sample> samples;
  for (std::size_t i = begin; i <= end; ++i) {
    samples.push_back({arcs[i], old.data[i], static_cast<std::ptrdiff_t>(i)});
    if (i == end) break;
    const Vector3d a = displacement.at(arcs[i]), b = displacement.at(arcs[i + 1]);
    const double gap =
        (position(mesh, old.data[i + 1]) + b - position(mesh, old.data[i]) - a).norm();
    const double before = arcs[i + 1] - arcs[i];
    if ((b - a).norm() < kUnmoved && a.norm() < kUnmoved) continue;
    if (gap <= widest || (gap <= kWideGap * before && before <= widest)) continue;
    const auto parts = std::min(kMaxPerGap, static_cast<std::size_t>(std::ceil(gap / widest)));
    for (std::size_t k = 1; k < parts; ++k) {
      const double arc = arcs[i] + before * static_cast<double>(k) / static_cast<double>(parts);
      samples.push_back({arc, pointAtArc(mesh, old, arcs, arc), -1});
    }
  }

  Reshaped result;
  result.newIndex.resize(old.data.size());
  WorkCurve& made = result.curve;
  made.closed = old.closed;
  const auto keep = [&](std::size_t i) {
    result.newIndex[i] = made.data.size();
    made.push(old.data[i], old.isControl[i], old.isCorner[i]);
  };
  for (std::size_t i = 0; i < begin; ++i) {
    keep(i);
    made.links.push_back(old.links[i]);
  }
  std::size_t knot = 0;
  std::optional<SurfacePath> guide;  // between the knots around the sample, if it is needed
  std::ptrdiff_t previousUnmoved = -2;
  for (const Sample& sample : samples) {
    const bool isKnot =
        sample.data >= 0 && static_cast<std::size_t>(sample.data) == knots[knot].data;
    const Vector3d move = isKnot ? moves[knot] : displacement.at(sample.arc);
    const bool isUnmoved = sample.data >= 0 && (isKnot ? !knots[knot].to : move.norm() < kUnmoved);
    const Vector3d place = position(mesh, sample.old) + move;
    SurfacePoint point = sample.old;
    if (isKnot && knots[knot].to) point = *knots[knot].to;
    if (!isKnot && !isUnmoved) point = index_.closestPoint(place).point;

    std::optional<SurfacePath> link;
    if (!made.data.empty() && made.links.size() < made.data.size()) {
      const SurfacePoint previous = made.data.back();
      const auto isSame = [&](const SurfacePoint& p) {
        return p == previous ||
               (position(mesh, p) - position(mesh, previous)).norm() < kSameDataPoint;
      };
      const bool wasLinked =
          isUnmoved && previousUnmoved >= 0 && sample.data == previousUnmoved + 1;
      if (wasLinked) {
        link = old.links[static_cast<std::size_t>(previousUnmoved)];
      } else if (!isSame(point)) {
        Result<SurfacePath> found = linker_.link(previous, point);
        const double step = std::max((place - position(mesh, previous)).norm(), kSameDataPoint);
        if (!isKnot && !isUnmoved && (!found || length(mesh, *found) > kJumpRatio * step)) {
          // On another limb: look for it near the way between the knots instead.
          if (!guide) {
            const auto knotPoint = [&](std::size_t k) {
              return knots[k].to ? *knots[k].to : old.data[knots[k].data];
            };
            Result<SurfacePath> way = linker_.link(knotPoint(knot - 1), knotPoint(knot));
            if (!way) return way.error();
            guide = *std::move(way);
          }
          const double t =
              (sample.arc - knotArcs[knot - 1]) / (knotArcs[knot] - knotArcs[knot - 1]);
          point = local_.find(place, pointAtFraction(mesh, *guide, t));
          if (!isSame(point)) found = linker_.link(previous, point);
        }
        if (!isSame(point)) {
          if (!found) return found.error();
          link = *std::move(found);
        }
      }
      if (!link) {
        // Fell on its neighbour: one of the two is enough. A knot replaces what is no knot.
        if (sample.data >= 0) {
          result.newIndex[static_cast<std::size_t>(sample.data)] = made.data.size() - 1;
          const auto i = static_cast<std::size_t>(sample.data);
          made.isControl.back() = made.isControl.back() || old.isControl[i];
        }
        if (isKnot) made.data.back() = point;
        if (isKnot) {
          guide.reset();
          ++knot;
        }
        continue;
      }
      made.links.push_back(*std::move(link));
    }
    if (sample.data >= 0) {
      const auto i = static_cast<std::size_t>(sample.data);
      result.newIndex[i] = made.data.size();
      made.push(point, old.isControl[i], old.isCorner[i]);
    } else {
      made.push(point, false);
    }
    previousUnmoved = isUnmoved ? sample.data : -2;
    if (isKnot) {
      guide.reset();
      ++knot;
    }
    if (knot == knots.size()) break;
  }
  for (std::size_t i = end + 1; i < old.data.size(); ++i) {
    made.links.push_back(old.links[i - 1]);
    keep(i);
  }
  if (old.closed) made.links.push_back(old.links.back());
  // The last knot may have fallen on its neighbour: then what follows is linked anew.
  for (std::size_t i = 0; i < made.links.size(); ++i) {
    const SurfacePath& link = made.links[i];
    if (link.points.front() == made.from(i) && link.points.back() == made.to(i)) continue;
    Result<SurfacePath> again = linker_.link(made.from(i), made.to(i));
    if (!again) return again.error();
    made.links[i] = *std::move(again);
  }
  std::size_t different = made.closed ? 0 : 1;
  for (std::size_t i = 0; i < made.linkCount(); ++i) {
    const double step = (position(mesh, made.to(i)) - position(mesh, made.from(i))).norm();
    if (!(made.from(i) == made.to(i)) && step >= kSameDataPoint) ++different;
  }
  if (different < (made.closed ? 3U : 2U)) {
    return Error{ErrorCode::CurveInvalid, "the curve would shrink to a point", {}};
  }
  return result;
}

}  // namespace toile::detail
