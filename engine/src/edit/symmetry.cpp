// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/symmetry.h"

#include <fmt/format.h>

#include <algorithm>

#include "edit/middle_line.h"
#include "edit/parts.h"
#include "edit/reshape.h"
#include "edit/square_join.h"
#include "model/mirror.h"
#include "toile/curve/subdivision.h"
#include "toile/curve/tracking.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;
using Eigen::Vector3d;

namespace {

/// The stretch at a middle end that is drawn anew, as part of the half.
constexpr double kJoinPart = 0.3;

std::string mirroredId(const std::string& id) {
  if (id.ends_with("_l")) return id.substr(0, id.size() - 2) + "_r";
  if (id.ends_with("_r")) return id.substr(0, id.size() - 2) + "_l";
  return id + "-mirror";
}

Error noSymmetry(const std::string& curve) {
  return {ErrorCode::CurveInvalid,
          "the model has no symmetry; give it a mirror plane or a pairing",
          {Element::curve(curve)}};
}

StylingCurve imageOf(const StylingCurve& original) {
  StylingCurve image = original;
  std::swap(image.left, image.right);
  image.dataPoints.clear();
  image.way = SmoothWay{};
  image.mirrorOf = original.id;
  return image;
}

/// The mirror image of a curve on the surface, data point by data point.
Result<WorkCurve> imageOf(Sketch& sketch, const WorkCurve& original) {
  WorkCurve image = original;
  for (SurfacePoint& point : image.data) {
    const Result<SurfacePoint> mirrored = detail::mirrored(sketch.model(), point);
    if (!mirrored) return mirrored.error();
    point = *mirrored;
  }
  image.links.clear();
  if (const Result<void> linked = detail::linkAll(sketch.linker(), image); !linked) {
    return linked.error();
  }
  return image;
}

/// Draws the stretch before the end of a half anew, so that it meets its mirror image smoothly: the
/// end slides along the middle line to where a symmetric arc from the stretch's start meets it, and
/// the stretch runs as if the image's points were its next control points.
Result<void> squareEnd(Sketch& sketch, const detail::MiddleLine& middle, const std::string& id,
                       WorkCurve& half) {
  const Mesh& mesh = sketch.mesh();
  const double all = detail::arcsOf(mesh, half)[half.linkCount()];
  const std::size_t from = detail::insertData(mesh, half, (1 - kJoinPart) * all);
  const auto arcs = detail::arcsOf(mesh, half);
  const SurfacePoint outer =
      detail::pointAtArc(mesh, half, arcs, std::max(0.0, 1 - 2 * kJoinPart) * all);
  const Vector3d start = position(mesh, half.data[from]);
  std::vector<Vector3d> row{position(mesh, outer), start, Vector3d::Zero()};
  for (const SurfacePoint& point : {half.data[from], outer}) {
    const Result<SurfacePoint> image = detail::mirrored(sketch.model(), point);
    if (!image) return image.error();
    row.push_back(position(mesh, *image));
  }
  // A symmetric arc leaves the straight line half way to the level of the stretch's start.
  const SurfacePoint end =
      middle.nearest(mesh, 0.5 * position(mesh, half.data.back()) + 0.25 * (start + row[3]));
  row[2] = position(mesh, end);
  const std::vector<Vector3d> fine = subdivide<3>(row, false);
  WorkCurve made;
  for (std::size_t i = 0; i <= from; ++i) {
    made.push(half.data[i], half.isControl[i], half.isCorner[i]);
    if (i < from) made.links.push_back(half.links[i]);
  }
  SurfaceTracker tracker(sketch.model().mesh, half.data[from]);
  for (std::size_t k = 9; k < 16; ++k) {
    const SurfacePoint& point = tracker.moveTo(fine[k]);
    if ((position(mesh, point) - position(mesh, made.data.back())).norm() >
            detail::kSameDataPoint &&
        (position(mesh, point) - row[2]).norm() > detail::kSameDataPoint) {
      made.push(point, false);
    }
  }
  made.push(end, true);
  if (const Result<void> linked = detail::linkAll(sketch.linker(), made); !linked) return linked;
  detail::reverse(made);
  detail::beginSquare(sketch, id, made);
  detail::reverse(made);
  half = std::move(made);
  return {};
}

}  // namespace

Result<Edited> mirrorCurves(const Document& document, std::span<const std::string> curves,
                            bool linked) {
  Sketch sketch(document);
  Edited edited;
  for (const std::string& id : curves) {
    const Result<std::size_t> index = sketch.indexOf(id);
    if (!index) return index.error();
    if (!sketch.model().symmetry) return noSymmetry(id);
    StylingCurve image = imageOf(sketch.design().curves[*index]);
    image.id = sketch.freeId(mirroredId(id));
    if (linked) {
      const Result<std::string> added = sketch.add(image);
      if (!added) return added.error();
      if (const Result<WorkCurve> work = sketch.load(*added); !work) return work.error();
      edited.curves.push_back(*added);
      continue;
    }
    // A curve of its own: the images of the data points, and which of them are controls.
    const Result<WorkCurve> original = sketch.load(id);
    if (!original) return original.error();
    Result<WorkCurve> work = imageOf(sketch, *original);
    if (!work) return work.error().during("curve \"" + id + "\"");
    const Result<std::string> added = sketch.add(image);
    if (!added) return added.error();
    sketch.store(*added, *work);
    edited.curves.push_back(*added);
  }
  edited.document = sketch.document();
  return edited;
}

Result<Document> unlinkMirror(const Document& document, const std::string& curve) {
  Sketch sketch(document);
  const Result<std::size_t> index = sketch.indexOf(curve);
  if (!index) return index.error();
  if (!sketch.design().curves[*index].mirrorOf) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("curve \"{}\" is no mirror image", curve),
                 {Element::curve(curve)}};
  }
  Result<WorkCurve> work = sketch.load(curve);
  if (!work) return work.error();
  sketch.store(curve, *work);
  return sketch.document();
}

Result<Edited> makeSymmetric(const Document& document, const std::string& curve, Side kept) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  if (!sketch.model().symmetry) return noSymmetry(curve);
  const detail::MiddleLine middle(sketch.model());
  if (middle.empty()) {
    return Error{ErrorCode::CurveInvalid, "the model has no middle line", {Element::curve(curve)}};
  }
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  const Mesh& mesh = sketch.mesh();
  // The longest run of the curve on the kept side.
  const double sign = (kept == Side::Left) != target->isMirrored ? 1 : -1;
  const SurfacePath path = detail::pathOf(*work);
  const double all = length(mesh, path);
  const double touch = 1e-3 * mesh.meanEdgeLength();
  constexpr int kSteps = 512;
  std::vector<double> sides;
  for (int i = 0; i <= kSteps; ++i) {
    const SurfacePoint p =
        pointAtFraction(mesh, path, i == kSteps && path.closed ? 0 : i / double{kSteps});
    sides.push_back(sign * detail::sideOf(sketch.model(), p));
  }
  const int turns = path.closed ? 2 * kSteps : kSteps;
  int bestFrom = -1, bestTo = -1;
  for (int from = 0; from < turns;) {
    if (sides[static_cast<std::size_t>(from % kSteps)] <= touch) {
      ++from;
      continue;
    }
    int to = from;
    while (to < turns && to - from < kSteps &&
           sides[static_cast<std::size_t>(path.closed ? (to + 1) % kSteps : to + 1)] > touch) {
      ++to;
    }
    if (to - from > bestTo - bestFrom) {
      bestFrom = from;
      bestTo = to;
    }
    from = to + 1;
  }
  if (bestFrom < 0 || bestTo - bestFrom < 4) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("nothing of curve \"{}\" lies on the {} side", curve,
                             kept == Side::Left ? "left" : "right"),
                 {Element::curve(curve)}};
  }
  if (path.closed && bestTo - bestFrom >= kSteps) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("curve \"{}\" does not come to the middle of the model", curve),
                 {Element::curve(curve)}};
  }
  const auto crossesAt = [&](int inside, int outside) {
    double in = inside, out = outside;
    for (int k = 0; k < 40; ++k) {
      const double f = 0.5 * (in + out) / kSteps;
      const SurfacePoint p = pointAtFraction(mesh, path, path.closed ? f : std::clamp(f, 0.0, 1.0));
      (sign * detail::sideOf(sketch.model(), p) > 0 ? in : out) = 0.5 * (in + out);
    }
    return in / kSteps * all;
  };
  // An open curve may also end on this side, away from the middle.
  const bool startsFree = !path.closed && bestFrom == 0;
  const bool endsFree =
      !path.closed && bestTo >= kSteps - 1 && sides[static_cast<std::size_t>(kSteps)] > touch;
  const double from = startsFree ? 0 : crossesAt(bestFrom, bestFrom - 1);
  const double to = endsFree ? all : crossesAt(bestTo, std::min(bestTo + 1, turns));
  if (startsFree && endsFree) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("curve \"{}\" does not come to the middle of the model", curve),
                 {Element::curve(curve)}};
  }
  Result<std::vector<std::string>> ids =
      detail::replaceByParts(sketch, target->id, *work, {{from, to}});
  if (!ids) return ids.error();
  Result<WorkCurve> half = sketch.load(target->id);
  if (!half) return half.error();
  const auto joinEnd = [&] { return squareEnd(sketch, middle, target->id, *half); };
  if (!endsFree) {
    if (const Result<void> done = joinEnd(); !done) return done.error();
  }
  if (!startsFree) {
    detail::reverse(*half);
    if (const Result<void> done = joinEnd(); !done) return done.error();
    detail::reverse(*half);
  }
  sketch.store(target->id, *half);
  if (const auto images = sketch.imagesOf(target->id); !images.empty()) {
    return Edited{sketch.document(), {target->id, images.front()}, {}};
  }
  StylingCurve image = imageOf(sketch.edit(target->id));
  image.id = sketch.freeId(mirroredId(target->id));
  const Result<std::string> added = sketch.add(image);
  if (!added) return added.error();
  return Edited{sketch.document(), {target->id, *added}, {}};
}

}  // namespace toile
