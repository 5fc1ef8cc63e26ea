// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "design/section_loop.h"
#include "design/single_places.h"
#include "design/smooth_points.h"
#include "model/mirror.h"
#include "toile/curve/geodesic.h"
#include "toile/design/design.h"

namespace toile {

namespace {

/// Data points closer to their neighbour are dropped, in mm: far below what cutting tells apart.
constexpr double kSamePoint = 1e-6;

/// A curve on the surface before it gets its name.
struct Way {
  std::vector<SurfacePoint> dataPoints;
  SurfacePath path;
};

bool holdsModelPoints(const Design& design) {
  const auto isModelPoint = [](const Place& place) {
    bool found = false;
    detail::forEachOfKind<ModelPoint>(place, [&](const ModelPoint&) { found = true; });
    detail::forEachOfKind<OnSection>(place, [&](const OnSection& on) {
      found = found || std::holds_alternative<ModelPoint>(on.plane.through);
    });
    return found;
  };
  for (const StylingCurve& curve : design.curves) {
    if (!curve.dataPoints.empty() || std::holds_alternative<AlongVertices>(curve.way)) return true;
    const auto* smooth = std::get_if<SmoothWay>(&curve.way);
    const auto* shortest = std::get_if<ShortestWay>(&curve.way);
    const auto* section = std::get_if<AlongSection>(&curve.way);
    if (section && std::holds_alternative<ModelPoint>(section->plane.through)) return true;
    if (smooth && std::any_of(smooth->controls.begin(), smooth->controls.end(), isModelPoint)) {
      return true;
    }
    if (shortest &&
        std::any_of(shortest->controls.begin(), shortest->controls.end(), isModelPoint)) {
      return true;
    }
  }
  return std::any_of(design.pieces.begin(), design.pieces.end(),
                     [&](const PieceRecord& piece) { return isModelPoint(piece.anchor); });
}

Result<void> checkConnectivity(const Design& design, const ReferenceModel& model) {
  if (design.models.empty() || !holdsModelPoints(design)) return {};
  const ModelReference& drawnOn = design.models.front();
  if (!drawnOn.connectivityHash || *drawnOn.connectivityHash == model.mesh->connectivityHash()) {
    return {};
  }
  return Error{
      ErrorCode::ModelMismatch,
      fmt::format("the design \"{}\" was drawn on \"{}\", and the model \"{}\" has another "
                  "connectivity; use a model fitted with the same template",
                  design.name, drawnOn.reference, model.name),
      {}};
}

class CurvePlacer {
 public:
  CurvePlacer(const Design& design, const ReferenceModel& model, GeodesicLinker& linker)
      : design_(design), model_(model), linker_(linker), state_(design.curves.size()) {}

  Result<std::vector<PlacedCurve>> placeAll() {
    for (std::size_t i = 0; i < design_.curves.size(); ++i) {
      if (const Result<void> done = place(i); !done) return done.error();
    }
    // Curves that others hang on were placed before them; the result has the design's order.
    std::vector<PlacedCurve> ordered;
    for (const StylingCurve& curve : design_.curves) ordered.push_back(*findPlaced(curve.id));
    return ordered;
  }

  Result<std::vector<PlacedCurve>> placeSome(std::span<const std::string> ids) {
    std::vector<PlacedCurve> ordered;
    for (const std::string& id : ids) {
      if (const Result<void> done = placeById(id); !done) return done.error();
      ordered.push_back(*findPlaced(id));
    }
    return ordered;
  }

 private:
  enum class State { Untouched, Started, Placed };

  const PlacedCurve* findPlaced(const std::string& id) const {
    const auto found = std::find_if(placed_.begin(), placed_.end(),
                                    [&](const PlacedCurve& curve) { return curve.id == id; });
    return found == placed_.end() ? nullptr : &*found;
  }

  Result<void> place(std::size_t index) {
    const StylingCurve& curve = design_.curves[index];
    if (state_[index] == State::Placed) return {};
    if (state_[index] == State::Started) return circle(curve.id);
    state_[index] = State::Started;
    started_.push_back(curve.id);
    const Result<void> needed = placeNeeded(curve);
    if (!needed) return needed;
    started_.pop_back();

    const auto failed = [&](const Error& error) {
      Error named = error.during(fmt::format("curve \"{}\"", curve.id));
      named.where.insert(named.where.begin(), Element::curve(curve.id));
      return named;
    };
    Result<Way> way = findWay(curve);
    if (!way) return failed(way.error());
    if (!isValid(*model_.mesh, way->path)) {
      return failed({ErrorCode::CurveInvalid, "it has no length; move its points apart", {}});
    }
    placed_.push_back({curve.id, curve.kind, std::move(way->dataPoints), std::move(way->path)});
    state_[index] = State::Placed;
    return {};
  }

  Error circle(const std::string& id) const {
    std::string names;
    std::vector<Element> where;
    const auto first = std::find(started_.begin(), started_.end(), id);
    for (auto at = first; at != started_.end(); ++at) {
      names += "\"" + *at + "\" hangs on ";
      where.push_back(Element::curve(*at));
    }
    return {ErrorCode::CurveInvalid,
            fmt::format("the curves hang on each other in a circle: {}\"{}\"; place a point of one "
                        "of them in another way",
                        names, id),
            where};
  }

  /// Places the curves that this one names, unless it is on the model already.
  Result<void> placeNeeded(const StylingCurve& curve) {
    if (!curve.dataPoints.empty()) return {};
    std::vector<std::string> needed;
    if (curve.mirrorOf) {
      needed.push_back(*curve.mirrorOf);
    } else {
      const auto gather = [&](const std::vector<Place>& controls) {
        for (const Place& place : controls) {
          detail::forEachOfKind<OnStylingCurve>(
              place, [&](const OnStylingCurve& on) { needed.push_back(on.id); });
        }
      };
      if (const auto* smooth = std::get_if<SmoothWay>(&curve.way)) gather(smooth->controls);
      if (const auto* shortest = std::get_if<ShortestWay>(&curve.way)) gather(shortest->controls);
    }
    for (const std::string& id : needed) {
      const Result<void> done = placeById(id);
      if (done) continue;
      if (done.error().code != ErrorCode::NameNotFound || !done.error().where.empty()) return done;
      Error error = done.error().during(fmt::format("curve \"{}\"", curve.id));
      error.where = {Element::curve(curve.id)};
      return error;
    }
    return {};
  }

  Result<void> placeById(const std::string& id) {
    const auto found = std::find_if(design_.curves.begin(), design_.curves.end(),
                                    [&](const StylingCurve& c) { return c.id == id; });
    if (found != design_.curves.end()) {
      return place(static_cast<std::size_t>(found - design_.curves.begin()));
    }
    std::vector<std::string> known;
    for (const StylingCurve& c : design_.curves) known.push_back(c.id);
    return detail::nameNotFound("curve", id, known);
  }

  Result<Way> findWay(const StylingCurve& curve) {
    if (!curve.dataPoints.empty()) {
      std::vector<SurfacePoint> points;
      for (const ModelPoint& stored : curve.dataPoints) {
        const Result<SurfacePoint> point = toSurfacePoint(*model_.mesh, stored);
        if (!point) return point.error();
        points.push_back(*point);
      }
      return link(std::move(points), curve.closed);
    }
    if (curve.mirrorOf) return mirrorImage(*findPlaced(*curve.mirrorOf));
    return std::visit([&](const auto& way) { return follow(way, curve.closed); }, curve.way);
  }

  /// Drops points that lie on their neighbour, except the last one of an open row, and links.
  Result<Way> link(std::vector<SurfacePoint> points, bool closed) {
    const Mesh& mesh = *model_.mesh;
    const auto isSame = [&](const SurfacePoint& a, const SurfacePoint& b) {
      return a == b || (position(mesh, a) - position(mesh, b)).norm() < kSamePoint;
    };
    std::vector<SurfacePoint> kept;
    for (const SurfacePoint& point : points) {
      if (kept.empty() || !isSame(kept.back(), point)) kept.push_back(point);
    }
    if (closed) {
      while (kept.size() > 1 && isSame(kept.front(), kept.back())) kept.pop_back();
    } else if (!kept.empty()) {
      kept.back() = points.back();
    }
    Result<SurfacePath> path = linker_.linkAll(kept, closed);
    if (!path) return path.error();
    return Way{std::move(kept), *std::move(path)};
  }

  /// With a pairing the very same way; else the images of the data points, linked.
  Result<Way> mirrorImage(const PlacedCurve& original) {
    std::vector<SurfacePoint> points;
    for (const SurfacePoint& point : original.dataPoints) {
      Result<SurfacePoint> image = detail::mirrored(model_, point);
      if (!image) return image.error();
      points.push_back(*std::move(image));
    }
    const auto& partner = model_.symmetry->partner;
    if (partner.empty()) return link(std::move(points), original.path.closed);
    return Way{std::move(points), detail::mirrored(*model_.mesh, partner, original.path)};
  }

  Result<std::vector<SurfacePoint>> resolve(const std::vector<Place>& controls, bool closed) {
    const std::size_t needed = closed ? 3 : 2;
    if (controls.size() < needed) {
      return Error{ErrorCode::CurveInvalid,
                   fmt::format("{} control points are too few; {} curve needs {}", controls.size(),
                               closed ? "a closed" : "an open", needed),
                   {}};
    }
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < controls.size(); ++i) {
      const Result<SurfacePoint> point = resolvePlace(controls[i], model_, placed_);
      if (!point) return point.error().during(fmt::format("control point {}", i + 1));
      points.push_back(*point);
    }
    return points;
  }

  Result<Way> follow(const SmoothWay& way, bool closed) {
    Result<std::vector<SurfacePoint>> controls = resolve(way.controls, closed);
    if (!controls) return controls.error();
    const Mesh& mesh = *model_.mesh;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < controls->size(); ++i) {
      const std::size_t next = (i + 1) % controls->size();
      if ((position(mesh, (*controls)[i]) - position(mesh, (*controls)[next])).norm() <
          kSamePoint) {
        return Error{ErrorCode::CurveInvalid,
                     fmt::format("control points {} and {} are the same place; remove one or move "
                                 "it away",
                                 i + 1, next + 1),
                     {}};
      }
    }
    Result<std::vector<SurfacePoint>> data =
        detail::smoothPoints(*model_.index, linker_, *controls, closed, way.rule, way.corners);
    if (!data) return data.error();
    return link(*std::move(data), closed);
  }

  Result<Way> follow(const ViewWay& way, bool closed) {
    const std::size_t needed = closed ? 3 : 2;
    if (way.controls.size() < needed) {
      return Error{ErrorCode::CurveInvalid,
                   fmt::format("{} drawn points are too few; {} curve needs {}",
                               way.controls.size(), closed ? "a closed" : "an open", needed),
                   {}};
    }
    std::vector<Eigen::Vector2d> row =
        subdivideWithCorners<2>(way.controls, closed, way.corners, way.rule);
    // The projection also looks for a jump on the way back to the start.
    if (closed) row.push_back(row.front());
    Result<std::vector<SurfacePoint>> points = projectFromView(*model_.index, way.view, row);
    if (!points) return points.error();
    return link(*std::move(points), closed);
  }

  Result<Way> follow(const AlongModelCurve& way, bool closed) {
    const auto found = model_.curves.find(way.name);
    if (found == model_.curves.end()) {
      std::vector<std::string> known;
      for (const auto& entry : model_.curves) known.push_back(entry.first);
      return detail::nameNotFound("model curve", way.name, known);
    }
    const auto isFraction = [](double f) { return f >= 0 && f <= 1; };
    if (!isFraction(way.from) || !isFraction(way.to) || way.from == way.to) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("a stretch of a model curve runs from one fraction (0 to 1) to "
                               "another, not from {} to {}",
                               way.from, way.to),
                   {}};
    }
    const SurfacePath& whole = found->second;
    if (whole.closed && way.from == 0 && way.to == 1) return Way{whole.points, whole};
    if (closed) {
      return Error{ErrorCode::CurveInvalid,
                   fmt::format("it is marked closed, but its stretch of \"{}\" is open; take the "
                               "whole of a closed curve, from 0 to 1",
                               way.name),
                   {}};
    }
    SurfacePath part = subPath(*model_.mesh, whole, way.from, way.to);
    std::vector<SurfacePoint> points = part.points;
    return Way{std::move(points), std::move(part)};
  }

  Result<Way> follow(const AlongVertices& way, bool closed) {
    std::vector<SurfacePoint> points;
    for (const VertexId v : way.vertices) {
      const Result<SurfacePoint> point = toSurfacePoint(*model_.mesh, ModelPoint{v});
      if (!point) return point.error();
      points.push_back(*point);
    }
    return link(std::move(points), closed);
  }

  Result<Way> follow(const AlongSection& way, bool closed) {
    Result<SurfacePath> loop = detail::sectionLoop(way.plane, model_);
    if (!loop) return loop.error();
    if (closed && !loop->closed) {
      return Error{ErrorCode::CurveInvalid,
                   "it is marked closed, but its section ends at the border of the model",
                   {}};
    }
    std::vector<SurfacePoint> points = loop->points;
    return Way{std::move(points), *std::move(loop)};
  }

  Result<Way> follow(const ShortestWay& way, bool closed) {
    Result<std::vector<SurfacePoint>> points = resolve(way.controls, closed);
    if (!points) return points.error();
    return link(*std::move(points), closed);
  }

  const Design& design_;
  const ReferenceModel& model_;
  GeodesicLinker& linker_;
  std::vector<State> state_;
  std::vector<std::string> started_;  ///< the chain of curves that wait for each other
  std::vector<PlacedCurve> placed_;
};

}  // namespace

Result<std::vector<PlacedCurve>> placeCurves(const Design& design, const ReferenceModel& model) {
  if (const Result<void> fits = checkConnectivity(design, model); !fits) return fits.error();
  for (std::size_t i = 0; i < design.curves.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (design.curves[i].id == design.curves[j].id) {
        return Error{ErrorCode::CurveInvalid,
                     fmt::format("two curves have the id \"{}\"; rename one", design.curves[i].id),
                     {Element::curve(design.curves[i].id)}};
      }
    }
  }
  GeodesicLinker linker(model.mesh);
  return CurvePlacer(design, model, linker).placeAll();
}

Result<std::vector<PlacedCurve>> placeCurves(const Design& design, const ReferenceModel& model,
                                             std::span<const std::string> ids,
                                             GeodesicLinker& linker) {
  if (const Result<void> fits = checkConnectivity(design, model); !fits) return fits.error();
  return CurvePlacer(design, model, linker).placeSome(ids);
}

}  // namespace toile
