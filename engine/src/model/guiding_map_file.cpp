// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/names.h"
#include "toile/model/guiding_map.h"

namespace toile {
namespace {

using detail::Json;
using Eigen::Vector2d;

constexpr std::uint32_t kNone = ~0U;
/// Larger than any product; beyond it lengths lose their digits.
constexpr double kLargestPlaceMm = 1e6;

/// The vertices that the faces of a chart use, ascending.
std::vector<VertexId> verticesOf(const Mesh& mesh, const std::vector<FaceId>& faces) {
  std::vector<VertexId> out;
  for (const FaceId f : faces)
    for (const VertexId v : mesh.vertices(f)) out.push_back(v);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

class MapReader {
 public:
  MapReader(const ReferenceModel& model, const std::string& file)
      : model_(model), mesh_(*model.mesh), file_(file) {}

  Result<GuidingMap> read(const Json& json) {
    const auto map = json.is_object() ? json.find("guidingMap") : json.end();
    if (map == json.end() || !map->is_object())
      return fail("\"guidingMap\" with an object { } is missing");
    if (const auto borders = map->find("borders"); borders != map->end())
      return readBorders(*borders);
    const auto charts = map->find("charts");
    if (charts == map->end() || !charts->is_array() || charts->empty())
      return fail("\"guidingMap\" has neither \"charts\" nor \"borders\"");
    map_.chartOf = FaceData<std::uint32_t>(mesh_.faceCount(), kNone);
    map_.corners = FaceData<std::array<Vector2d, 3>>(
        mesh_.faceCount(), {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()});
    for (const Json& chart : *charts)
      if (const Result<void> done = readChart(chart); !done) return done.error();
    for (std::size_t f = 0; f < mesh_.faceCount(); ++f)
      if (map_.chartOf[FaceId(f)] == kNone)
        return fail(fmt::format("triangle {} is on no chart; each has to be on one", f));
    return std::move(map_);
  }

 private:
  Error fail(std::string_view what) const {
    return {ErrorCode::FileFormat, fmt::format("{}: guiding map: {}", file_, what), {}};
  }

  Result<GuidingMap> readBorders(const Json& borders) const {
    std::vector<std::string> names;
    if (!borders.is_array()) return fail("\"borders\" is no list of curves");
    for (const Json& name : borders) {
      if (!name.is_string()) return fail("\"borders\" is no list of curves");
      names.push_back(name.get<std::string>());
    }
    Result<GuidingMap> made = makeGuidingMap(model_, names);
    if (!made) return made.error().during(file_);
    return made;
  }

  Result<void> readChart(const Json& json) {
    const std::size_t number = map_.charts.size();
    const auto text = [&](const char* key) {
      const auto value = json.is_object() ? json.find(key) : json.end();
      return value != json.end() && value->is_string() ? value->get<std::string>() : std::string();
    };
    MapChart chart;
    chart.name = text("name");
    if (chart.name.empty()) return fail(fmt::format("chart {} has no \"name\"", number));
    for (const MapChart& other : map_.charts)
      if (other.name == chart.name)
        return fail(fmt::format("two charts are called \"{}\"", chart.name));
    const std::string side = text("side");
    if (side != "front" && side != "back")
      return fail(
          fmt::format("chart \"{}\": \"side\" is neither \"front\" nor \"back\"", chart.name));
    chart.side = side == "back" ? MapSide::Back : MapSide::Front;
    const auto list = json.find("faces");
    if (list == json.end() || !list->is_array() || list->empty())
      return fail(fmt::format("chart \"{}\" has no \"faces\"", chart.name));
    std::vector<FaceId> faces;
    for (const Json& item : *list) {
      if (!item.is_number_unsigned() || item.get<std::uint64_t>() >= mesh_.faceCount())
        return fail(fmt::format("chart \"{}\": {} is no triangle of the model", chart.name,
                                item.dump(-1, ' ', true, Json::error_handler_t::replace)));
      const FaceId f(item.get<std::uint64_t>());
      if (map_.chartOf[f] != kNone)
        return fail(fmt::format("triangle {} is on two charts", f.index()));
      map_.chartOf[f] = static_cast<std::uint32_t>(number);
      faces.push_back(f);
    }
    map_.charts.push_back(chart);
    return readPlaces(json, chart.name, faces);
  }

  Result<void> readPlaces(const Json& json, const std::string& name,
                          const std::vector<FaceId>& faces) {
    const std::vector<VertexId> vertices = verticesOf(mesh_, faces);
    const auto places = json.find("places");
    if (places == json.end() || !places->is_array() || places->size() != vertices.size())
      return fail(fmt::format("chart \"{}\": \"places\" needs a place for each of its {} vertices",
                              name, vertices.size()));
    std::vector<Vector2d> at;
    for (const Json& place : *places) {
      const bool isPlace =
          place.is_array() && place.size() == 2 && place[0].is_number() && place[1].is_number();
      const Vector2d p = isPlace ? Vector2d(place[0].get<double>(), place[1].get<double>())
                                 : Vector2d::Constant(2 * kLargestPlaceMm);
      if (!(p.cwiseAbs().maxCoeff() <= kLargestPlaceMm))
        return fail(fmt::format("chart \"{}\": a place is [x, y] in mm, at most 1 km away", name));
      at.push_back(p);
    }
    for (const FaceId f : faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), mesh_.vertices(f)[k]);
        map_.corners[f][k] = at[static_cast<std::size_t>(found - vertices.begin())];
      }
    }
    return {};
  }

  const ReferenceModel& model_;
  const Mesh& mesh_;
  const std::string& file_;
  GuidingMap map_;
};

}  // namespace

namespace detail {

Result<GuidingMap> readGuidingMap(const ReferenceModel& model, const Json& json,
                                  const std::string& file) {
  return MapReader(model, file).read(json);
}

}  // namespace detail

Result<GuidingMap> parseGuidingMap(const ReferenceModel& model, std::string_view json,
                                   const std::string& file) {
  const Result<Json> parsed = detail::parseJson(json, file);
  if (!parsed) return parsed.error();
  return detail::readGuidingMap(model, *parsed, file);
}

std::string writeGuidingMap(const Mesh& mesh, const GuidingMap& map) {
  nlohmann::ordered_json charts = nlohmann::ordered_json::array();
  for (std::uint32_t c = 0; c < map.charts.size(); ++c) {
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
      if (map.chartOf[FaceId(f)] == c) faces.push_back(FaceId(f));
    if (faces.empty()) continue;
    const std::vector<VertexId> vertices = verticesOf(mesh, faces);
    std::vector<Vector2d> places(vertices.size());
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (const FaceId f : faces) {
      numbers.push_back(f.index());
      for (std::size_t k = 0; k < 3; ++k) {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), mesh.vertices(f)[k]);
        places[static_cast<std::size_t>(found - vertices.begin())] = map.corners[f][k];
      }
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Vector2d& p : places) list.push_back({p.x(), p.y()});
    charts.push_back({{"name", map.charts[c].name},
                      {"side", map.charts[c].side == MapSide::Back ? "back" : "front"},
                      {"faces", std::move(numbers)},
                      {"places", std::move(list)}});
  }
  const nlohmann::ordered_json whole = {{"guidingMap", {{"charts", std::move(charts)}}}};
  return whole.dump() + "\n";
}

}  // namespace toile
