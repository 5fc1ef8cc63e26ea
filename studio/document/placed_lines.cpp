// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/placed_lines.h"

#include <algorithm>
#include <map>
#include <set>

namespace toile::studio {

using Eigen::Vector3d;

namespace {

/// Whether a way names other curves, so that it changes with them.
bool hangsOnCurves(const CurveWay& way) {
  const auto single = [](const auto& place) {
    return std::holds_alternative<OnStylingCurve>(place);
  };
  const auto any = [&](const std::vector<Place>& places) {
    return std::ranges::any_of(places, [&](const Place& place) {
      if (const auto* pair = std::get_if<BetweenPlaces>(&place)) {
        return std::ranges::any_of(pair->ends, single);
      }
      return single(place);
    });
  };
  if (const auto* smooth = std::get_if<SmoothWay>(&way)) return any(smooth->controls);
  if (const auto* shortest = std::get_if<ShortestWay>(&way)) return any(shortest->controls);
  return false;
}

}  // namespace

PlacedLine makePlacedLine(const Mesh& mesh, StylingCurve curve, SurfacePath path) {
  PlacedLine line;
  line.curve = std::move(curve);
  const std::size_t count = path.points.size() + (path.closed ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePoint& point = path.points[i % path.points.size()];
    line.points.push_back(position(mesh, point));
    Vector3d normal = Vector3d::Zero();
    for (const FaceId face : facesOf(mesh, point)) normal += mesh.normal(face);
    line.normals.push_back(normal.normalized());
    line.arc.push_back(i == 0 ? 0 : line.arc.back() + (line.points[i] - line.points[i - 1]).norm());
  }
  line.path = std::move(path);
  return line;
}

SurfacePoint pointOnSegment(const Mesh& mesh, const SurfacePath& path, std::size_t segment,
                            double t) {
  const SurfacePoint& a = path.points[segment];
  const SurfacePoint& b = path.points[(segment + 1) % path.points.size()];
  if (t <= 0) return a;
  if (t >= 1) return b;
  const FaceId face = path.faceOfSegment[segment];
  return makeSurfacePoint(
      mesh, face, (1 - t) * barycentricIn(mesh, a, face) + t * barycentricIn(mesh, b, face));
}

const PlacedLine* PlacedLines::find(const std::string& id) const {
  const auto found =
      std::ranges::find_if(lines_, [&](const auto& line) { return line->curve.id == id; });
  return found == lines_.end() ? nullptr : found->get();
}

std::vector<Error> PlacedLines::update(const Document& document) {
  std::vector<Error> errors;
  const bool sameModel = document_.model == document.model;
  if (!sameModel) {
    linker_ = std::make_shared<GeodesicLinker>(document.model->mesh);
    lines_.clear();
  }
  std::set<std::string> changed;
  const auto& curves = document.design->curves;
  for (const StylingCurve& curve : curves) {
    const PlacedLine* known = find(curve.id);
    if (known == nullptr || !(known->curve == curve)) changed.insert(curve.id);
  }
  // What follows others: twins, and ways that name curves, as long as they have no points of their
  // own. A design may hang one on another in any order.
  for (std::size_t before = std::size_t(-1); before != changed.size();) {
    before = changed.size();
    for (const StylingCurve& curve : curves) {
      if (!curve.dataPoints.empty() || changed.contains(curve.id)) continue;
      if (curve.mirrorOf ? changed.contains(*curve.mirrorOf)
                         : !changed.empty() && hangsOnCurves(curve.way)) {
        changed.insert(curve.id);
      }
    }
  }
  // All at once, since many may hang on one; one by one where that fails, to see which does.
  const std::vector<std::string> ids(changed.begin(), changed.end());
  std::map<std::string, SurfacePath> paths;
  if (auto placed = placeCurves(*document.design, *document.model, ids, *linker_)) {
    for (PlacedCurve& curve : *placed) paths[curve.id] = std::move(curve.path);
  } else {
    for (const std::string& id : ids) {
      auto one = placeCurves(*document.design, *document.model, std::span(&id, 1), *linker_);
      if (one) {
        paths[id] = std::move(one->front().path);
      } else {
        errors.push_back(one.error());
      }
    }
  }
  std::vector<std::shared_ptr<const PlacedLine>> lines;
  for (const StylingCurve& curve : curves) {
    if (!changed.contains(curve.id)) {
      lines.push_back(*std::ranges::find_if(
          lines_, [&](const auto& line) { return line->curve.id == curve.id; }));
    } else if (const auto found = paths.find(curve.id); found != paths.end()) {
      PlacedLine line = makePlacedLine(*document.model->mesh, curve, std::move(found->second));
      line.version = ++lastVersion_;
      lines.push_back(std::make_shared<const PlacedLine>(std::move(line)));
    }
  }
  lines_ = std::move(lines);
  document_ = document;
  return errors;
}

}  // namespace toile::studio
