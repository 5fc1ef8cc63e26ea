// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "design/section_loop.h"
#include "design/single_places.h"
#include "edit/middle_line.h"
#include "edit/square_join.h"
#include "model/mirror.h"

namespace toile::detail {

namespace {

/// Control points are found among the data points within this, mm.
constexpr double kSameControl = 1e-6;

template <class Visit>
void visitPlaces(StylingCurve& curve, const Visit& visit) {
  if (auto* smooth = std::get_if<SmoothWay>(&curve.way)) {
    for (Place& place : smooth->controls) visit(place);
  }
  if (auto* shortest = std::get_if<ShortestWay>(&curve.way)) {
    for (Place& place : shortest->controls) visit(place);
  }
}

}  // namespace

Sketch::Sketch(const Document& document)
    : design_(*document.design), model_(document.model), linker_(document.model->mesh) {}

Result<std::size_t> Sketch::indexOf(const std::string& id) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < design_.curves.size(); ++i) {
    if (design_.curves[i].id == id) return i;
    known.push_back(design_.curves[i].id);
  }
  return nameNotFound("curve", id, known);
}

StylingCurve& Sketch::edit(const std::string& id) {
  const Result<std::size_t> index = indexOf(id);
  TOILE_ASSERT(index.hasValue());
  return design_.curves[*index];
}

Result<Sketch::Target> Sketch::targetOf(const std::string& id) const {
  Target target{id, false};
  for (std::size_t round = 0; round <= design_.curves.size(); ++round) {
    const Result<std::size_t> index = indexOf(target.id);
    if (!index) return index.error();
    const StylingCurve& curve = design_.curves[*index];
    if (!curve.mirrorOf || !curve.dataPoints.empty()) return target;
    target = {*curve.mirrorOf, !target.isMirrored};
  }
  return Error{ErrorCode::CurveInvalid,
               fmt::format("the curves mirror each other in a circle from \"{}\"", id),
               {Element::curve(id)}};
}

Result<SurfacePoint> Sketch::forTarget(const Target& target, const SurfacePoint& point) const {
  if (!isValid(mesh(), point)) {
    return Error{ErrorCode::CurveInvalid, "the point does not lie on the model", {}};
  }
  if (!target.isMirrored) return point;
  return mirrored(*model_, point);
}

std::vector<std::string> Sketch::imagesOf(const std::string& id) const {
  std::vector<std::string> images;
  for (const StylingCurve& curve : design_.curves) {
    if (curve.mirrorOf == id && curve.dataPoints.empty()) images.push_back(curve.id);
  }
  return images;
}

Result<std::vector<SurfacePoint>> Sketch::controlPlaces(const StylingCurve& curve) {
  std::vector<SurfacePoint> places;
  if (const auto* view = std::get_if<ViewWay>(&curve.way)) {
    for (const Eigen::Vector2d& control : view->controls) {
      const Ray ray = rayThrough(view->view, control);
      const auto hit = model_->index->firstVisibleHit(ray.origin, ray.direction);
      if (hit) places.push_back(hit->point);
    }
    return places;
  }
  const std::vector<Place>* controls = nullptr;
  if (const auto* smooth = std::get_if<SmoothWay>(&curve.way)) controls = &smooth->controls;
  if (const auto* shortest = std::get_if<ShortestWay>(&curve.way)) controls = &shortest->controls;
  if (controls == nullptr) return places;
  std::vector<PlacedCurve> hungOn;
  for (const Place& place : *controls) {
    std::vector<std::string> ids;
    forEachOfKind<OnStylingCurve>(place, [&](const OnStylingCurve& on) { ids.push_back(on.id); });
    if (!ids.empty()) {
      Result<std::vector<PlacedCurve>> placed = placeCurves(design_, *model_, ids, linker_);
      if (!placed) return placed.error();
      std::move(placed->begin(), placed->end(), std::back_inserter(hungOn));
    }
    Result<SurfacePoint> point = resolvePlace(place, *model_, hungOn);
    if (!point) return point.error();
    places.push_back(*std::move(point));
  }
  return places;
}

Result<WorkCurve> Sketch::load(const std::string& id) {
  const Result<std::size_t> index = indexOf(id);
  if (!index) return index.error();
  const StylingCurve& curve = design_.curves[*index];
  const auto failed = [&](const Error& error) {
    Error named = error.during(fmt::format("curve \"{}\"", id));
    named.where.insert(named.where.begin(), Element::curve(id));
    return named;
  };
  std::vector<SurfacePoint> points;
  if (curve.dataPoints.empty()) {
    Result<std::vector<PlacedCurve>> placed =
        placeCurves(design_, *model_, std::span(&id, 1), linker_);
    if (!placed) return placed.error();
    points = std::move(placed->front().dataPoints);
  } else {
    for (const ModelPoint& stored : curve.dataPoints) {
      const Result<SurfacePoint> point = toSurfacePoint(mesh(), stored);
      if (!point) return failed(point.error());
      points.push_back(*point);
    }
  }
  Result<WorkCurve> work = makeWorkCurve(linker_, mesh(), points, curve.closed);
  if (!work) return failed(work.error());

  // Controls among the data points, in order; those that are not found there are forgotten.
  std::vector<std::size_t> corners;
  if (const auto* smooth = std::get_if<SmoothWay>(&curve.way)) corners = smooth->corners;
  if (const auto* view = std::get_if<ViewWay>(&curve.way)) corners = view->corners;
  if (curve.mirrorOf && curve.dataPoints.empty()) {
    const Result<WorkCurve> original = load(*curve.mirrorOf);
    if (original && original->data.size() == work->data.size()) {
      work->isControl = original->isControl;
      work->isCorner = original->isCorner;
    }
    return work;
  }
  const Result<std::vector<SurfacePoint>> controls = controlPlaces(curve);
  if (!controls) return failed(controls.error());
  std::size_t from = 0;
  for (std::size_t c = 0; c < controls->size(); ++c) {
    for (std::size_t i = from; i < work->data.size(); ++i) {
      const bool isHere =
          work->data[i] == (*controls)[c] ||
          (position(mesh(), work->data[i]) - position(mesh(), (*controls)[c])).norm() <
              kSameControl;
      if (!isHere) continue;
      work->isControl[i] = true;
      work->isCorner[i] = std::find(corners.begin(), corners.end(), c) != corners.end();
      from = i + 1;
      break;
    }
  }
  return work;
}

void Sketch::keepSquare(const std::string& id, WorkCurve& curve) {
  const StylingCurve& old = edit(id);
  if (curve.closed || old.closed || old.dataPoints.size() < 2 || imagesOf(id).empty()) return;
  // Whether the old curve begins so, from whichever end: an edit may have reversed it.
  const auto wasSquare = [&](std::size_t end, std::size_t next) {
    const Result<SurfacePoint> a = toSurfacePoint(mesh(), old.dataPoints[end]);
    const Result<SurfacePoint> b = toSurfacePoint(mesh(), old.dataPoints[next]);
    if (!a || !b || !isOnMiddle(*model_, *a)) return false;
    const Result<WorkCurve> first =
        makeWorkCurve(linker_, mesh(), std::vector<SurfacePoint>{*a, *b}, false);
    return first && beginsSquare(*this, *first);
  };
  const std::size_t n = old.dataPoints.size();
  bool atStart = wasSquare(0, 1), atEnd = wasSquare(n - 1, n - 2);
  if (atStart != atEnd) {
    const Result<SurfacePoint> a = toSurfacePoint(mesh(), old.dataPoints[0]);
    const bool isTurned = a && *a == curve.data.back();
    if (isTurned) std::swap(atStart, atEnd);
  }
  if (atStart) beginSquare(*this, id, curve);
  if (!atEnd) return;
  reverse(curve);
  beginSquare(*this, id, curve);
  reverse(curve);
}

void Sketch::store(const std::string& id, WorkCurve curve) {
  keepSquare(id, curve);
  settle(linker_, mesh(), curve);
  StylingCurve& styling = edit(id);
  styling.closed = curve.closed;
  styling.mirrorOf.reset();
  styling.dataPoints.clear();
  SmoothWay way;
  for (std::size_t i = 0; i < curve.data.size(); ++i) {
    styling.dataPoints.push_back(toModelPoint(mesh(), curve.data[i]));
    if (!curve.isControl[i]) continue;
    if (curve.isCorner[i]) way.corners.push_back(way.controls.size());
    way.controls.emplace_back(styling.dataPoints.back());
  }
  styling.way = std::move(way);
}

std::string Sketch::freeId(const std::string& stem) const {
  for (std::size_t n = 1;; ++n) {
    std::string id = n == 1 ? stem : fmt::format("{}-{}", stem, n);
    if (!indexOf(id)) return id;
  }
}

Result<std::string> Sketch::add(StylingCurve curve) {
  if (curve.id.empty()) {
    curve.id = freeId("line");
  } else if (indexOf(curve.id)) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("there is a curve \"{}\" already; choose another id", curve.id),
                 {Element::curve(curve.id)}};
  }
  const bool isAllowed = std::all_of(curve.id.begin(), curve.id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '-';
  });
  if (!isAllowed) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("the id \"{}\" may hold letters, digits, _ and - only", curve.id),
                 {}};
  }
  design_.curves.push_back(std::move(curve));
  return design_.curves.back().id;
}

std::string Sketch::addBeside(const std::string& id, const std::string& newId) {
  const Result<std::size_t> index = indexOf(id);
  TOILE_ASSERT(index.hasValue());
  StylingCurve copy = design_.curves[*index];
  copy.id = newId.empty() || indexOf(newId) ? freeId(id + "-2") : newId;
  copy.mirrorOf.reset();
  design_.curves.insert(design_.curves.begin() + static_cast<std::ptrdiff_t>(*index) + 1, copy);
  return copy.id;
}

Result<void> Sketch::remove(const std::string& id) {
  const Result<std::size_t> index = indexOf(id);
  if (!index) return index.error();
  for (const std::string& image : imagesOf(id)) {
    const Result<WorkCurve> own = load(image);
    if (!own) return own.error();
    store(image, *own);
  }
  for (StylingCurve& curve : design_.curves) {
    if (curve.mirrorOf == id) curve.mirrorOf.reset();
  }
  const Result<void> moved = moveHangers(id, [](double) { return std::nullopt; });
  if (!moved) return moved;
  design_.curves.erase(design_.curves.begin() + static_cast<std::ptrdiff_t>(*index));
  for (PieceRecord& piece : design_.pieces) {
    if (std::find(piece.boundary.begin(), piece.boundary.end(), id) != piece.boundary.end()) {
      piece.boundary.clear();
    }
  }
  return {};
}

Result<void> Sketch::moveHangers(const std::string& id, const Moving& moving) {
  std::optional<std::vector<PlacedCurve>> placed;
  Result<void> failed;
  const auto move = [&](Place& place) {
    auto* on = std::get_if<OnStylingCurve>(&place);
    if (on == nullptr || on->id != id || !failed) return;
    if (const auto moved = moving(on->fraction)) {
      on->id = moved->id;
      on->fraction = moved->fraction;
      return;
    }
    if (!placed) {
      Result<std::vector<PlacedCurve>> found =
          placeCurves(design_, *model_, std::span(&id, 1), linker_);
      if (!found) {
        failed = found.error();
        return;
      }
      placed = *std::move(found);
    }
    const Result<SurfacePoint> point = resolvePlace(place, *model_, *placed);
    if (point) {
      place = toModelPoint(mesh(), *point);
    } else {
      failed = point.error();
    }
  };
  for (StylingCurve& curve : design_.curves) visitPlaces(curve, move);
  for (PieceRecord& piece : design_.pieces) move(piece.anchor);
  return failed;
}

Document Sketch::document() const {
  return {std::make_shared<const Design>(design_), model_};
}

Result<double> checkedFraction(double fraction) {
  if (fraction >= 0 && fraction <= 1) return fraction;
  return Error{ErrorCode::InvalidArgument,
               fmt::format("a fraction of a curve must be from 0 to 1, not {}", fraction),
               {}};
}

}  // namespace toile::detail
