// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "design/read_records.h"
#include "design/read_values.h"

namespace toile::detail {

ModelPoint readModelPoint(const JsonPlace& at) {
  constexpr double kWeightSumTolerance = 1e-9;
  JsonObject object(at);
  ModelPoint point;
  if (const auto vertex = object.find("vertex")) {
    point.at = VertexId(vertex->index());
  } else if (const auto edge = object.find("edge")) {
    ModelPoint::OnEdge onEdge;
    const std::vector<JsonPlace> ends = edge->items(2);
    if (ends.size() == 2) {
      onEdge.tail = VertexId(ends[0].index());
      onEdge.head = VertexId(ends[1].index());
      if (onEdge.tail >= onEdge.head) edge->fail("the smaller vertex number comes first");
    }
    const JsonPlace t = object.need("t");
    onEdge.t = t.number();
    if (!(onEdge.t > 0 && onEdge.t < 1)) t.fail("must be above 0 and below 1");
    point.at = onEdge;
  } else if (const auto face = object.find("face")) {
    const JsonPlace weights = object.need("weights");
    const SurfacePoint::InFace inFace{FaceId(face->index()), weights.vector<3>()};
    if (!(inFace.barycentric.minCoeff() > 0) ||
        !(std::abs(inFace.barycentric.sum() - 1) <= kWeightSumTolerance)) {
      weights.fail("must each be above 0 and add up to 1");
    }
    point.at = inFace;
  } else {
    at.fail("a point of the model has \"vertex\", \"edge\" or \"face\"");
  }
  object.refuseUnknown();
  return point;
}

SectionPlane readPlane(const JsonPlace& at) {
  JsonObject object(at);
  SectionPlane plane;
  plane.normal = readDirection(object.need("normal"));
  if (const auto through = object.find("through")) {
    if (object.has("offset") || object.has("point")) {
      at.fail("a section has one of \"through\", \"point\", \"offset\"");
    }
    plane.through = AtLandmark{readName(*through)};
  } else if (const auto point = object.find("point")) {
    if (object.has("offset")) at.fail("a section has one of \"through\", \"point\", \"offset\"");
    plane.through = readModelPoint(*point);
  } else {
    plane.through = readLength(object.need("offset"));
  }
  plane.unknown = object.unknown();
  return plane;
}

namespace {

SinglePlace readSinglePlace(const JsonPlace& at) {
  JsonObject object(at);
  if (const auto landmark = object.find("landmark")) {
    const std::string name = readName(*landmark);
    return AtLandmark{name, object.unknown()};
  }
  if (const auto curve = object.find("curve")) {
    const std::string name = readName(*curve);
    const double fraction = object.need("at").numberIn(0, 1);
    return OnModelCurve{name, fraction, object.unknown()};
  }
  if (const auto line = object.find("line")) {
    const std::string id = readId(*line);
    const double fraction = object.need("at").numberIn(0, 1);
    return OnStylingCurve{id, fraction, object.unknown()};
  }
  if (const auto section = object.find("section")) {
    const SectionPlane plane = readPlane(*section);
    const Eigen::Vector3d direction = readDirection(object.need("direction"));
    return OnSection{plane, direction, object.unknown()};
  }
  if (const auto near = object.find("near")) {
    const Eigen::Vector3d position = near->vector<3>();
    return NearPosition{position, object.unknown()};
  }
  if (object.has("between")) at.fail("the ends of \"between\" are no \"between\" themselves");
  if (!object.has("vertex") && !object.has("edge") && !object.has("face")) {
    at.fail(
        "a place has one of \"landmark\", \"curve\", \"line\", \"between\", \"section\", \"near\", "
        "\"vertex\", \"edge\", \"face\"");
  }
  return readModelPoint(at);
}

}  // namespace

Place readPlace(const JsonPlace& at) {
  JsonObject object(at);
  const auto between = object.find("between");
  if (!between) {
    return std::visit([](const auto& place) { return Place(place); }, readSinglePlace(at));
  }
  BetweenPlaces place;
  const std::vector<JsonPlace> ends = between->items(2);
  for (std::size_t i = 0; i < ends.size(); ++i) place.ends[i] = readSinglePlace(ends[i]);
  place.fraction = object.need("at").numberIn(0, 1);
  place.unknown = object.unknown();
  return place;
}

std::vector<Place> readPlaces(const JsonPlace& at) {
  std::vector<Place> out;
  for (const JsonPlace& item : at.items()) out.push_back(readPlace(item));
  return out;
}

}  // namespace toile::detail
