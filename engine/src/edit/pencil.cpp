// SPDX-License-Identifier: GPL-3.0-or-later
// Curves drawn on the view: strokes, and control points in the view plane.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edit/parts.h"
#include "edit/reshape.h"
#include "toile/curve/crossing.h"
#include "toile/edit/draw.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kFine = std::size_t{1} << kSubdivisionRounds;

/// One run of a drawing, on the surface.
struct DrawnRun {
  WorkCurve curve;
  bool isWhole = false;
};

struct Drawn {
  std::vector<DrawnRun> runs;
  std::vector<Finding> findings;
};

Result<Drawn> put(Sketch& sketch, const ViewWay& way, bool closed) {
  const std::size_t needed = closed ? 3 : 2;
  if (way.controls.size() < needed) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("{} drawn points are too few; {} curve needs {}", way.controls.size(),
                             closed ? "a closed" : "an open", needed),
                 {}};
  }
  for (std::size_t i = 0; i < way.controls.size(); ++i) {
    const Eigen::Vector2d& next = way.controls[(i + 1) % way.controls.size()];
    if (!way.controls[i].allFinite()) {
      return Error{ErrorCode::InvalidArgument, "a drawn point is no finite number", {}};
    }
    if ((closed || i + 1 < way.controls.size()) && (way.controls[i] - next).norm() < 1e-9) {
      return Error{ErrorCode::CurveInvalid,
                   fmt::format("drawn points {} and {} are the same place; remove one", i + 1,
                               (i + 1) % way.controls.size() + 1),
                   {}};
    }
  }
  std::vector<Eigen::Vector2d> row =
      subdivideWithCorners<2>(way.controls, closed, way.corners, way.rule);
  if (closed) row.push_back(row.front());
  ViewProjection projection = projectRunsFromView(*sketch.model().index, way.view, row);
  if (projection.runs.empty()) {
    return Error{ErrorCode::LeavesSilhouette,
                 "nothing of the drawing lies on the model; draw within its outline",
                 {}};
  }
  Drawn drawn;
  for (const ViewCut& cut : projection.cuts) {
    const bool isOutline = cut.reason == ViewCut::Reason::Silhouette;
    drawn.findings.push_back(
        {isOutline ? "cut-at-silhouette" : "cut-at-other-part",
         fmt::format(
             "the drawing {} at ({:.1f}, {:.1f}) mm in the view and was cut there",
             isOutline ? "crosses the outline of the model" : "passes to another part of the model",
             cut.where.x(), cut.where.y()),
         {}});
  }
  // A closed drawing that was cut: the last run goes on in the first.
  const bool isCut = !projection.cuts.empty();
  if (closed && isCut && projection.runs.size() > 1 && projection.runs.front().from == 0 &&
      projection.runs.back().to == static_cast<double>(row.size() - 1)) {
    ViewRun& last = projection.runs.back();
    const ViewRun& first = projection.runs.front();
    last.points.insert(last.points.end(), first.points.begin() + 1, first.points.end());
    last.to += first.to;
    projection.runs.erase(projection.runs.begin());
  }
  for (const ViewRun& run : projection.runs) {
    Result<WorkCurve> curve =
        detail::makeWorkCurve(sketch.linker(), sketch.mesh(), run.points, closed && !isCut);
    if (!curve) continue;  // a run of one place
    // Controls are the drawn ones among the run.
    std::size_t at = 0;
    for (std::size_t c = 0; c < way.controls.size(); ++c) {
      const auto index = static_cast<double>(c * kFine);
      if (index < run.from || index > run.to) continue;
      const Ray ray = rayThrough(way.view, way.controls[c]);
      const auto hit = sketch.model().index->firstVisibleHit(ray.origin, ray.direction);
      if (!hit) continue;
      for (std::size_t i = at; i < curve->data.size(); ++i) {
        if ((position(sketch.mesh(), curve->data[i]) - hit->position).norm() > 1e-6) continue;
        curve->isControl[i] = true;
        curve->isCorner[i] =
            std::find(way.corners.begin(), way.corners.end(), c) != way.corners.end();
        at = i;
        break;
      }
    }
    detail::markEnds(*curve);
    drawn.runs.push_back({*std::move(curve), !isCut});
  }
  if (drawn.runs.empty()) {
    return Error{ErrorCode::CurveInvalid, "the drawing is one place on the model only", {}};
  }
  return drawn;
}

Result<ViewWay> fit(const View& view, std::span<const StrokeSample> stroke,
                    const PencilOptions& options, bool& closed) {
  StrokeOptions fitting;
  fitting.tolerance = options.tolerance ? options.tolerance->mm() : view.height / 400;
  fitting.closed = options.closed;
  Result<FittedStroke> fitted = fitStroke(stroke, fitting);
  if (!fitted) return fitted.error();
  ViewWay way;
  way.view = view;
  way.controls = fitted->controls;
  way.corners = fitted->corners;
  closed = fitted->closed;
  return way;
}

Result<Edited> addDrawn(const Document& document, const ViewWay& way, bool closed,
                        const NewCurve& curve) {
  Sketch sketch(document);
  Result<Drawn> drawn = put(sketch, way, closed);
  if (!drawn) return drawn.error();
  Edited edited;
  edited.findings = drawn->findings;
  for (const DrawnRun& run : drawn->runs) {
    StylingCurve made;
    made.id = edited.curves.empty() ? curve.id : sketch.freeId(edited.curves.front());
    made.name = curve.name;
    made.kind = curve.kind;
    const Result<std::string> id = sketch.add(made);
    if (!id) return id.error();
    sketch.store(*id, run.curve);
    if (run.isWhole) sketch.edit(*id).way = way;  // as drawn, to be drawn again elsewhere
    edited.curves.push_back(*id);
  }
  for (Finding& finding : edited.findings) {
    finding.where.push_back(Element::curve(edited.curves.front()));
  }
  edited.document = sketch.document();
  return edited;
}

/// The longest run of a stroke that is meant for one curve.
Result<DrawnRun> oneRun(Sketch& sketch, const View& view, std::span<const StrokeSample> stroke,
                        PencilOptions options, std::vector<Finding>& findings) {
  options.closed = false;
  bool closed = false;
  Result<ViewWay> way = fit(view, stroke, options, closed);
  if (!way) return way.error();
  Result<Drawn> drawn = put(sketch, *way, false);
  if (!drawn) return drawn.error();
  findings = drawn->findings;
  return *std::max_element(drawn->runs.begin(), drawn->runs.end(),
                           [](const DrawnRun& a, const DrawnRun& b) {
                             return a.curve.data.size() < b.curve.data.size();
                           });
}

Result<WorkCurve> ofTarget(Sketch& sketch, const Sketch::Target& target, WorkCurve run) {
  if (!target.isMirrored) return run;
  for (SurfacePoint& point : run.data) {
    const Result<SurfacePoint> image = sketch.forTarget(target, point);
    if (!image) return image.error();
    point = *image;
  }
  for (SurfacePath& link : run.links) link.points.clear();
  if (const Result<void> linked = detail::linkAll(sketch.linker(), run); !linked) {
    return linked.error();
  }
  return run;
}

}  // namespace

Result<Edited> drawInView(const Document& document, const ViewWay& way, bool closed,
                          const NewCurve& curve) {
  return addDrawn(document, way, closed, curve);
}

Result<Edited> drawStroke(const Document& document, const View& view,
                          std::span<const StrokeSample> stroke, const NewCurve& curve,
                          const PencilOptions& options) {
  bool closed = false;
  const Result<ViewWay> way = fit(view, stroke, options, closed);
  if (!way) return way.error();
  return addDrawn(document, *way, closed, curve);
}

Result<Edited> continueStroke(const Document& document, const std::string& curve, const View& view,
                              std::span<const StrokeSample> stroke, const PencilOptions& options) {
  Sketch sketch(document);
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Edited edited;
  Result<DrawnRun> run = oneRun(sketch, view, stroke, options, edited.findings);
  if (!run) return run.error();
  Result<WorkCurve> added = ofTarget(sketch, *target, std::move(run->curve));
  if (!added) return added.error();
  // As a curve of its own that is joined.
  StylingCurve piece;
  piece.id = sketch.freeId("continued");
  const Result<std::string> id = sketch.add(piece);
  if (!id) return id.error();
  sketch.store(*id, *added);
  Result<Document> joined = joinCurves(sketch.document(), target->id, *id);
  if (!joined) return joined.error();
  edited.document = *std::move(joined);
  edited.curves = {target->id};
  return edited;
}

Result<Edited> drawOver(const Document& document, const std::string& curve, const View& view,
                        std::span<const StrokeSample> stroke, const PencilOptions& options) {
  Sketch sketch(document);
  const Mesh& mesh = sketch.mesh();
  const auto target = sketch.targetOf(curve);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  Edited edited;
  Result<DrawnRun> run = oneRun(sketch, view, stroke, options, edited.findings);
  if (!run) return run.error();
  Result<WorkCurve> drawn = ofTarget(sketch, *target, std::move(run->curve));
  if (!drawn) return drawn.error();
  const double all = detail::arcsOf(mesh, *work)[work->linkCount()];
  const auto footOf = [&](const SurfacePoint& point) {
    return nearestOnPath(mesh, detail::pathOf(*work), position(mesh, point)).arc;
  };
  double from = footOf(drawn->data.front()), to = footOf(drawn->data.back());
  bool isTurned = !work->closed && from > to;
  if (work->closed) {
    // The side of the loop on which the middle of the stroke lies.
    const double middle = footOf(drawn->data[drawn->data.size() / 2]);
    const auto after = [&](double arc) { return arc < from ? arc + all - from : arc - from; };
    isTurned = after(middle) > after(to);
  }
  if (isTurned) {
    detail::reverse(*drawn);
    std::swap(from, to);
  }
  const double replaced = to >= from ? to - from : to + all - from;
  if (!(replaced > 1e-3)) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("the stroke begins and ends at one place of curve \"{}\"", curve),
                 {Element::curve(curve)}};
  }
  // The stroke is drawn to the curve: its ends go to where they are nearest, its middle stays.
  std::size_t last = detail::insertData(mesh, *work, to);
  const SurfacePoint lastPoint = work->data[last];
  const std::size_t first = detail::insertData(mesh, *work, from);
  last = static_cast<std::size_t>(std::find(work->data.begin(), work->data.end(), lastPoint) -
                                  work->data.begin());
  detail::Reshaper reshaper(*sketch.model().index, sketch.linker());
  if (drawn->data.size() > 2) {
    const std::size_t end = drawn->data.size() - 1;
    std::vector<detail::Knot> knots{{0, work->data[first]}};
    const std::size_t a = std::max<std::size_t>(1, end / 4), b = end - a;
    if (b > a) {
      knots.push_back({a, std::nullopt});
      knots.push_back({b, std::nullopt});
    }
    knots.push_back({end, work->data[last]});
    Result<detail::Reshaper::Reshaped> fitted =
        reshaper.reshape(*drawn, knots, detail::StretchEnd::Place, detail::StretchEnd::Place);
    if (!fitted) return fitted.error();
    drawn = std::move(fitted->curve);
  } else {
    drawn->data = {work->data[first], work->data[last]};
    drawn->links.front().points.clear();
    if (const Result<void> linked = detail::linkAll(sketch.linker(), *drawn); !linked) {
      return linked.error();
    }
  }
  WorkCurve made;
  if (work->closed) {
    made = *drawn;
    detail::append(made, detail::partOf(*work, last, first));
    made.data.pop_back();
    made.isControl.pop_back();
    made.isCorner.pop_back();
    made.closed = true;
    const auto start = std::find(made.data.begin(), made.data.end(), work->data.front());
    if (start != made.data.end()) {
      detail::rotate(made, static_cast<std::size_t>(start - made.data.begin()));
    }
  } else {
    if (first > 0) made = detail::partOf(*work, 0, first);
    if (made.data.empty()) {
      made = *drawn;
    } else {
      detail::append(made, *drawn);
    }
    if (last + 1 < work->data.size()) {
      detail::append(made, detail::partOf(*work, last, work->data.size() - 1));
    }
    detail::markEnds(made);
  }
  sketch.store(target->id, made);
  edited.document = sketch.document();
  edited.curves = {target->id};
  return edited;
}

}  // namespace toile
