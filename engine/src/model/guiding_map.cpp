// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/model/guiding_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "model/conformal_map.h"
#include "model/face_regions.h"
#include "model/rigid_relaxation.h"
#include "model/untangle.h"
#include "toile/core/nearest_name.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBetweenChartsMm = 60;
constexpr std::uint32_t kNone = ~0U;

double crossProduct(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vector2d mirroredPlace(const Vector2d& p) {
  return {-p.x(), p.y()};
}

/// How a chart looks, what it is called and which chart mirrors it.
struct ChartFacts {
  std::vector<FaceId> faces;
  double area = 0;
  Vector3d looks = Vector3d::Zero();   ///< mean normal
  Vector3d centre = Vector3d::Zero();  ///< of area
  std::uint32_t mirror = kNone;        ///< chart of its mirrored faces, maybe itself
};

std::vector<ChartFacts> factsOf(const ReferenceModel& model, std::size_t count,
                                const FaceData<std::uint32_t>& chartOf,
                                const FaceData<FaceId>& mirrored) {
  const Mesh& mesh = *model.mesh;
  std::vector<ChartFacts> facts(count);
  std::vector<char> isMirrored(count, mirrored.empty() ? 0 : 1);
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const FaceId f(i);
    ChartFacts& chart = facts[chartOf[f]];
    chart.faces.push_back(f);
    chart.area += mesh.area(f);
    chart.looks += mesh.area(f) * mesh.normal(f);
    for (const VertexId v : mesh.vertices(f)) chart.centre += mesh.area(f) / 3 * mesh.position(v);
    if (mirrored.empty()) continue;
    const std::uint32_t other = chartOf[mirrored[f]];
    if (chart.mirror == kNone) chart.mirror = other;
    if (chart.mirror != other) isMirrored[chartOf[f]] = 0;
  }
  for (std::size_t c = 0; c < count; ++c) {
    ChartFacts& chart = facts[c];
    if (chart.area > 0) {
      chart.looks /= chart.area;
      chart.centre /= chart.area;
    } else if (!chart.faces.empty()) {
      chart.centre = mesh.position(mesh.vertices(chart.faces.front())[0]);
    }
    if (isMirrored[c] == 0) chart.mirror = kNone;
  }
  for (ChartFacts& chart : facts)
    if (chart.mirror != kNone && facts[chart.mirror].mirror == kNone) chart.mirror = kNone;
  return facts;
}

MapSide sideOf(const ChartFacts& chart) {
  constexpr double kBackward = 0.05;  // off zero, so that what looks sidewards counts as front
  return chart.looks.y() > kBackward ? MapSide::Back : MapSide::Front;
}

std::string wordFor(const ChartFacts& chart) {
  Eigen::Index axis = 0;
  chart.looks.cwiseAbs().maxCoeff(&axis);
  // A body's charts look forwards and backwards first of all.
  if (std::abs(chart.looks.y()) > 0.8 * std::abs(chart.looks[axis])) axis = 1;
  const bool positive = chart.looks[axis] > 0;
  if (axis == 0) return positive ? "left" : "right";
  if (axis == 1) return positive ? "back" : "front";
  return positive ? "top" : "bottom";
}

std::vector<MapChart> nameCharts(const std::vector<ChartFacts>& facts) {
  std::vector<MapChart> charts;
  for (std::size_t c = 0; c < facts.size(); ++c) {
    const ChartFacts& chart = facts[c];
    std::string name = wordFor(chart);
    const bool isPaired = chart.mirror != kNone && chart.mirror != c;
    if (isPaired && name != "left" && name != "right")
      name += chart.centre.x() > 0 ? "-left" : "-right";
    std::string unique = name;
    const auto isTaken = [&](const MapChart& other) { return other.name == unique; };
    for (int n = 2; std::any_of(charts.begin(), charts.end(), isTaken); ++n)
      unique = fmt::format("{}-{}", name, n);
    charts.push_back({unique, sideOf(chart)});
  }
  return charts;
}

/// The vertices of some faces, ascending, and the faces in those numbers.
struct ChartMesh {
  std::vector<VertexId> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

ChartMesh chartMesh(const Mesh& mesh, const std::vector<FaceId>& faces) {
  ChartMesh chart;
  for (const FaceId f : faces)
    for (const VertexId v : mesh.vertices(f)) chart.vertices.push_back(v);
  std::sort(chart.vertices.begin(), chart.vertices.end());
  chart.vertices.erase(std::unique(chart.vertices.begin(), chart.vertices.end()),
                       chart.vertices.end());
  const auto local = [&](VertexId v) {
    return static_cast<std::uint32_t>(
        std::lower_bound(chart.vertices.begin(), chart.vertices.end(), v) - chart.vertices.begin());
  };
  for (const FaceId f : faces) {
    const Triangle& t = mesh.vertices(f);
    chart.triangles.push_back({local(t[0]), local(t[1]), local(t[2])});
  }
  return chart;
}

class ChartFlattener {
 public:
  ChartFlattener(const ReferenceModel& model, const ChartFacts& facts, MapSide side,
                 bool isSymmetric)
      : model_(model),
        mesh_(*model.mesh),
        facts_(facts),
        isSymmetric_(isSymmetric),
        across_(side == MapSide::Back ? -1 : 1),
        chart_(chartMesh(*model.mesh, facts.faces)) {}

  /// Places of the chart's vertices, ascending, some triangles maybe the wrong side up; nothing
  /// where the numbers give out.
  [[nodiscard]] std::vector<Vector2d> flattenRoughly() const {
    const detail::ConformalPatch patch = this->patch();
    std::vector<Vector2d> places = detail::conformalMap(patch);
    if (!places.empty()) detail::relaxRigid(patch, places);
    return places;
  }
  /// The part of the chart's area that lies the wrong side up.
  [[nodiscard]] double turnedShare(const std::vector<Vector2d>& places) const {
    if (places.empty() || !(facts_.area > 0)) return 0;
    double turned = 0;
    for (std::size_t i = 0; i < chart_.triangles.size(); ++i) {
      const auto& t = chart_.triangles[i];
      if (!(crossProduct(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]) > 0))
        turned += mesh_.area(facts_.faces[i]);
    }
    return turned / facts_.area;
  }
  /// The part of its area on the map in which a chart lies on itself.
  [[nodiscard]] double overlap(const std::vector<Vector2d>& places) const {
    if (places.empty()) return 0;
    constexpr double kDots = 20000;
    double area = 0;
    Vector2d low = places.front();
    Vector2d high = low;
    for (const Vector2d& p : places) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    for (const auto& t : chart_.triangles)
      area +=
          0.5 * std::abs(crossProduct(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]));
    const double dot = std::sqrt(area / kDots);
    const Vector2d size = (high - low) / dot;
    constexpr double kMostDots = 4e6;  // of what lies far apart
    if (!(dot > 0) || !(size.x() * size.y() < kMostDots)) return 1;
    const auto columns = static_cast<std::size_t>(size.x()) + 1;
    std::vector<std::uint16_t> layers(columns * (static_cast<std::size_t>(size.y()) + 1), 0);
    for (const auto& t : chart_.triangles) {
      const std::array<Vector2d, 3> p = {(places[t[0]] - low) / dot, (places[t[1]] - low) / dot,
                                         (places[t[2]] - low) / dot};
      const double turn = crossProduct(p[1] - p[0], p[2] - p[0]) < 0 ? -1 : 1;
      const Vector2d first = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
      const Vector2d last = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
      for (auto y = static_cast<std::size_t>(first.y()); static_cast<double>(y) <= last.y(); ++y) {
        for (auto x = static_cast<std::size_t>(first.x()); static_cast<double>(x) <= last.x();
             ++x) {
          const Vector2d at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
          bool isInside = true;
          for (std::size_t k = 0; k < 3; ++k)
            isInside &= turn * crossProduct(p[(k + 1) % 3] - p[k], at - p[k]) > 0;
          if (isInside) ++layers[y * columns + x];
        }
      }
    }
    const auto covered = std::count_if(layers.begin(), layers.end(), [](auto n) { return n > 0; });
    const auto twice = std::count_if(layers.begin(), layers.end(), [](auto n) { return n > 1; });
    return covered > 0 ? static_cast<double>(twice) / static_cast<double>(covered) : 0;
  }
  /// The rough places put right.
  [[nodiscard]] std::vector<Vector2d> flatten(std::vector<Vector2d> rough) const {
    const detail::ConformalPatch patch = this->patch();
    if (rough.empty()) return patch.start;
    detail::untangle(patch, rough);
    if (!rectify(rough)) return patch.start;
    return rough;
  }
  [[nodiscard]] const ChartMesh& mesh() const { return chart_; }

 private:
  [[nodiscard]] detail::ConformalPatch patch() const {
    detail::ConformalPatch patch;
    patch.triangles = chart_.triangles;
    for (const VertexId v : chart_.vertices) patch.positions.push_back(mesh_.position(v));
    if (isSymmetric_) {
      for (const VertexId v : chart_.vertices)
        patch.partner.push_back(static_cast<std::uint32_t>(
            std::lower_bound(chart_.vertices.begin(), chart_.vertices.end(),
                             model_.symmetry->partner[v]) -
            chart_.vertices.begin()));
    }
    patch.start = seen();
    return patch;
  }

  /// The chart as it is seen from where it looks to, about its centre.
  [[nodiscard]] std::vector<Vector2d> seen() const {
    Vector3d right = across_ * Vector3d::UnitX();
    Vector3d up = Vector3d::UnitZ();
    if (!isSymmetric_ && std::abs(facts_.looks.y()) < 0.7 * facts_.looks.norm()) {
      const Vector3d out = facts_.looks.normalized();
      up = std::abs(out.z()) > 0.7 ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
      right = up.cross(out).normalized();
      up = out.cross(right);
    } else if (isSymmetric_ && std::abs(facts_.looks.z()) > std::abs(facts_.looks.y())) {
      up = Vector3d(0, 0, facts_.looks.z() > 0 ? 1 : -1).cross(right);
    }
    std::vector<Vector2d> out;
    for (const VertexId v : chart_.vertices) {
      const Vector3d p = mesh_.position(v) - facts_.centre;
      out.emplace_back(p.dot(right), p.dot(up));
    }
    if (!isSymmetric_) return out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      // The mirrored half of it, so that it is mirrored in a bent posture, too.
      const VertexId v = chart_.vertices[i];
      const VertexId w = model_.symmetry->partner[v];
      if (w == v) out[i].x() = 0;
      if (!(w < v)) continue;
      const auto at = std::lower_bound(chart_.vertices.begin(), chart_.vertices.end(), w);
      out[i] = mirroredPlace(out[static_cast<std::size_t>(at - chart_.vertices.begin())]);
    }
    return out;
  }

  /// As large as on the model, upright, its centre where the model shows it.
  [[nodiscard]] bool rectify(std::vector<Vector2d>& places) const {
    double flat = 0;
    Vector2d up = Vector2d::Zero();
    Vector2d forwards = Vector2d::Zero();
    for (const auto& t : chart_.triangles) {
      flat += 0.5 * crossProduct(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d edge = places[t[(k + 2) % 3]] - places[t[(k + 1) % 3]];
        const Vector2d gradient(-0.5 * edge.y(), 0.5 * edge.x());  // of the corner's weight x area
        const Vector3d& p = mesh_.position(chart_.vertices[t[k]]);
        up += p.z() * gradient;
        forwards -= p.y() * gradient;
      }
    }
    if (!(flat > 0) || !std::isfinite(flat)) return false;
    const double scale = std::sqrt(facts_.area / flat);
    constexpr double kLevel = 0.05;  // of the area: a chart that hardly rises has no up
    if (up.norm() * scale < kLevel * facts_.area) up = forwards;
    Vector2d direction = up.norm() > 0 ? Vector2d(up.normalized()) : Vector2d(0, 1);
    if (isSymmetric_) direction = {0, direction.y() < 0 ? -1.0 : 1.0};
    Vector2d centre = Vector2d::Zero();
    for (Vector2d& p : places) {
      p = scale * Vector2d(crossProduct(p, direction), p.dot(direction));
      if (isSymmetric_ && p.x() == 0) p.x() = 0;  // no -0
    }
    for (std::size_t i = 0; i < chart_.triangles.size(); ++i)
      for (const std::uint32_t v : chart_.triangles[i])
        centre += mesh_.area(facts_.faces[i]) / (3 * facts_.area) * places[v];
    Vector2d shift(across_ * (facts_.centre.x() - middle()) - centre.x(),
                   facts_.centre.z() - centre.y());
    if (isSymmetric_) shift.x() = 0;
    for (Vector2d& p : places) p += shift;
    return true;
  }
  [[nodiscard]] double middle() const {
    return model_.symmetry && std::abs(model_.symmetry->normal.x()) > 0.9
               ? model_.symmetry->offset / model_.symmetry->normal.x()
               : 0.5 * (mesh_.boxMin().x() + mesh_.boxMax().x());
  }

  const ReferenceModel& model_;
  const Mesh& mesh_;
  const ChartFacts& facts_;
  bool isSymmetric_;
  double across_;
  ChartMesh chart_;
};

struct ChartBox {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = -min;
  [[nodiscard]] bool overlaps(const ChartBox& other) const {
    return (min - other.max).maxCoeff() < kBetweenChartsMm &&
           (other.min - max).maxCoeff() < kBetweenChartsMm;
  }
};

/// Moves charts outwards until their boxes are apart: the largest stays, mirrored ones part
/// alike.
class ChartSpreader {
 public:
  ChartSpreader(GuidingMap& map, const std::vector<ChartFacts>& facts) : map_(map), facts_(facts) {
    for (const ChartFacts& chart : facts) {
      ChartBox box;
      for (const FaceId f : chart.faces) {
        for (const Vector2d& p : map.corners[f]) {
          box.min = box.min.cwiseMin(p);
          box.max = box.max.cwiseMax(p);
        }
      }
      boxes_.push_back(box);
    }
  }
  void spread(MapSide side) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t c = 0; c < facts_.size(); ++c) {
      const bool isSecond = facts_[c].mirror != kNone && facts_[c].mirror < c;
      if (map_.charts[c].side == side && !isSecond && !facts_[c].faces.empty()) order.push_back(c);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(facts_[a].mirror != a, -facts_[a].area) <
             std::pair(facts_[b].mirror != b, -facts_[b].area);
    });
    std::vector<std::uint32_t> settled;
    for (const std::uint32_t c : order) {
      const std::uint32_t mirror = facts_[c].mirror;
      if (mirror == c) {
        // Across the axis it can only move along it.
        const double centre = 0.5 * (boxes_[c].min.y() + boxes_[c].max.y());
        const double up = centre < middleHeight(settled) ? -1 : 1;
        while (const auto by = shiftAway(c, 1, up, settled)) move(c, {0, up * *by});
        settled.push_back(c);
        continue;
      }
      const double middle = 0.5 * (boxes_[c].min.x() + boxes_[c].max.x());
      const double way = middle < 0 ? -1 : 1;
      double moved = 0;
      while (const auto by = shiftAway(c, 0, way, settled)) {
        move(c, {way * *by, 0});
        moved += *by;
      }
      settled.push_back(c);
      if (mirror == kNone) continue;
      settled.push_back(mirror);
      for (const FaceId f : facts_[mirror].faces) {
        for (Vector2d& p : map_.corners[f]) p.x() -= way * moved;
      }
      boxes_[mirror].min = mirroredPlace({boxes_[c].max.x(), boxes_[c].min.y()});
      boxes_[mirror].max = mirroredPlace({boxes_[c].min.x(), boxes_[c].max.y()});
    }
  }

 private:
  [[nodiscard]] double middleHeight(const std::vector<std::uint32_t>& settled) const {
    if (settled.empty()) return 0;
    const ChartBox& first = boxes_[settled.front()];
    return 0.5 * (first.min.y() + first.max.y());
  }
  std::optional<double> shiftAway(std::uint32_t c, int axis, double way,
                                  const std::vector<std::uint32_t>& settled) const {
    double by = 0;
    // Half of a mirrored pair keeps clear of the axis, and so of its other half.
    if (facts_[c].mirror != kNone && facts_[c].mirror != c) {
      const double inner = way < 0 ? -boxes_[c].max.x() : boxes_[c].min.x();
      by = std::max(by, 0.5 * kBetweenChartsMm - inner);
    }
    for (const std::uint32_t s : settled) {
      if (!boxes_[c].overlaps(boxes_[s])) continue;
      by = std::max(by, kBetweenChartsMm + (way < 0 ? boxes_[c].max[axis] - boxes_[s].min[axis]
                                                    : boxes_[s].max[axis] - boxes_[c].min[axis]));
    }
    if (by > 1e-9) return by;
    return std::nullopt;
  }
  void move(std::uint32_t c, const Vector2d& by) {
    for (const FaceId f : facts_[c].faces)
      for (Vector2d& p : map_.corners[f]) p += by;
    boxes_[c].min += by;
    boxes_[c].max += by;
  }

  GuidingMap& map_;
  const std::vector<ChartFacts>& facts_;
  std::vector<ChartBox> boxes_;
};

std::uint32_t countOf(const detail::FaceRegions& regions) {
  std::uint32_t count = 0;
  for (const std::uint32_t r : regions.values()) count = std::max(count, r + 1);
  return count;
}

/// Its places are those of an earlier chart, mirrored; or it has none.
bool isCopied(const std::vector<ChartFacts>& facts, std::size_t c) {
  return (facts[c].mirror != kNone && facts[c].mirror < c) || facts[c].faces.empty();
}

using RoughPlaces = std::vector<std::vector<Vector2d>>;

/// Charts and their rough places to a map.
GuidingMap finishMap(const ReferenceModel& model, std::vector<MapChart> charts,
                     FaceData<std::uint32_t> chartOf, const std::vector<ChartFacts>& facts,
                     const FaceData<FaceId>& mirrored, RoughPlaces rough) {
  const Mesh& mesh = *model.mesh;
  GuidingMap map;
  map.charts = std::move(charts);
  map.chartOf = std::move(chartOf);
  map.corners = FaceData<std::array<Vector2d, 3>>(
      mesh.faceCount(), {Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()});
  parallelFor(facts.size(), [&](std::size_t c) {
    if (isCopied(facts, c)) return;
    const ChartFlattener flattener(model, facts[c], map.charts[c].side, facts[c].mirror == c);
    const std::vector<Vector2d> places = flattener.flatten(std::move(rough[c]));
    for (std::size_t i = 0; i < facts[c].faces.size(); ++i) {
      const auto& t = flattener.mesh().triangles[i];
      map.corners[facts[c].faces[i]] = {places[t[0]], places[t[1]], places[t[2]]};
    }
  });
  for (std::size_t c = 0; c < facts.size(); ++c) {
    if (!isCopied(facts, c)) continue;
    for (const FaceId f : facts[c].faces) {
      const FaceId image = mirrored[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId partner = model.symmetry->partner[mesh.vertices(f)[k]];
        const Triangle& t = mesh.vertices(image);
        const auto at =
            static_cast<std::size_t>(std::find(t.begin(), t.end(), partner) - t.begin());
        map.corners[f][k] = mirroredPlace(map.corners[image][at]);
      }
    }
  }
  ChartSpreader spreader(map, facts);
  spreader.spread(MapSide::Front);
  spreader.spread(MapSide::Back);
  return map;
}

/// Rough places of all charts but those that mirror an earlier one.
RoughPlaces flattenRoughly(const ReferenceModel& model, const std::vector<MapChart>& charts,
                           const std::vector<ChartFacts>& facts) {
  RoughPlaces rough(facts.size());
  parallelFor(facts.size(), [&](std::size_t c) {
    if (isCopied(facts, c)) return;
    rough[c] =
        ChartFlattener(model, facts[c], charts[c].side, facts[c].mirror == c).flattenRoughly();
  });
  return rough;
}

/// The proposed charts; those that no flat map of them could show are parted further.
GuidingMap mapOf(const ReferenceModel& model, detail::FaceRegions regions) {
  // Of a chart: hands are not worth another one.
  constexpr double kMostTurned = 0.06;
  constexpr double kMostOverlap = 0.1;
  constexpr int kMostPartings = 6;
  const FaceData<FaceId> mirrored = detail::mirroredFaces(model);
  for (int parting = 0;; ++parting) {
    const std::vector<ChartFacts> facts = factsOf(model, countOf(regions), regions, mirrored);
    std::vector<MapChart> charts = nameCharts(facts);
    RoughPlaces rough = flattenRoughly(model, charts, facts);
    std::vector<char> isTangled(facts.size(), 0);
    for (std::size_t c = 0; c < facts.size(); ++c) {
      if (isCopied(facts, c)) continue;
      const ChartFlattener chart(model, facts[c], charts[c].side, facts[c].mirror == c);
      const bool isFit =
          chart.turnedShare(rough[c]) <= kMostTurned && chart.overlap(rough[c]) <= kMostOverlap;
      isTangled[c] = isFit ? 0 : 1;
    }
    if (parting < kMostPartings && std::count(isTangled.begin(), isTangled.end(), 1) > 0) {
      detail::FaceRegions parted = detail::partRegions(model, regions, isTangled, mirrored);
      if (countOf(parted) > countOf(regions)) {
        regions = std::move(parted);
        continue;
      }
    }
    return finishMap(model, std::move(charts), std::move(regions), facts, mirrored,
                     std::move(rough));
  }
}

}  // namespace

Vector2d GuidingMap::place(const Mesh& mesh, const SurfacePoint& point, FaceId face) const {
  const Vector3d weights = barycentricIn(mesh, point, face);
  const std::array<Vector2d, 3>& at = corners[face];
  return weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2];
}

GuidingMapSlot::GuidingMapSlot(GuidingMap given)
    : map_(std::make_shared<const GuidingMap>(std::move(given))), isGiven_(true) {}

std::shared_ptr<const GuidingMap> guidingMap(const ReferenceModel& model) {
  if (!model.map) return std::make_shared<const GuidingMap>(makeGuidingMap(model));
  GuidingMapSlot& slot = *model.map;
  std::call_once(slot.once_, [&] {
    if (!slot.map_) slot.map_ = std::make_shared<const GuidingMap>(makeGuidingMap(model));
  });
  return slot.map_;
}

GuidingMap makeGuidingMap(const ReferenceModel& model) {
  return mapOf(model, detail::partTurnedRegions(model, detail::regionsBySharpTurns(*model.mesh),
                                                detail::mirroredFaces(model)));
}

Result<GuidingMap> makeGuidingMap(const ReferenceModel& model,
                                  std::span<const std::string> borderCurves) {
  std::vector<SurfacePath> borders;
  for (const std::string& name : borderCurves) {
    const auto found = model.curves.find(name);
    if (found == model.curves.end()) {
      std::vector<std::string> known;
      for (const auto& [other, path] : model.curves) known.push_back(other);
      return Error{ErrorCode::NameNotFound,
                   fmt::format("the guiding map's border \"{}\" is no curve of {}{}", name,
                               model.name, suggestion(name, known)),
                   {}};
    }
    borders.push_back(found->second);
  }
  return mapOf(model, detail::partTurnedRegions(model, detail::regionsBetween(*model.mesh, borders),
                                                detail::mirroredFaces(model)));
}

GuidingMap flattenCharts(const ReferenceModel& model, std::vector<MapChart> charts,
                         FaceData<std::uint32_t> chartOf) {
  const FaceData<FaceId> mirrored = detail::mirroredFaces(model);
  const std::vector<ChartFacts> facts = factsOf(model, charts.size(), chartOf, mirrored);
  RoughPlaces rough = flattenRoughly(model, charts, facts);
  return finishMap(model, std::move(charts), std::move(chartOf), facts, mirrored, std::move(rough));
}

GuidingMap carryGuidingMap(const GuidingMap& map, const ReferenceModel& model,
                           const FaceData<FaceId>& sourceFace) {
  FaceData<std::uint32_t> chartOf(model.mesh->faceCount());
  for (std::size_t i = 0; i < chartOf.size(); ++i) {
    const FaceId source = sourceFace[FaceId(i)];
    if (source.isValid()) chartOf[FaceId(i)] = map.chartOf[source];
  }
  return flattenCharts(model, map.charts, detail::mergedParts(*model.mesh, chartOf, 0));
}

}  // namespace toile
