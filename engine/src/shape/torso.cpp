// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "model/mirror.h"
#include "model/vertex_path.h"
#include "shape/level_path.h"
#include "shape/parameters.h"
#include "shape/shape_model.h"
#include "shape/torso_mesh.h"
#include "toile/core/assert.h"

// Names, curves and measures of builtin:torso@1. Curves are found once, on the torso as it is
// generated, and keep their places in the triangles whatever the parameters are.
namespace toile {
namespace {

using Eigen::Vector3d;

// Heights on the generated torso, mm.
constexpr double kHip = 900, kHighHip = 990, kWaist = 1085, kUnderbust = 1152, kBust = 1212;
constexpr double kNeck = 1400, kHeight = 750;
constexpr double kSideY = -24;  ///< of the vertical plane through shoulder tips and sides

struct Names {
  std::map<std::string, SurfacePath> curves;
  std::map<std::string, SurfacePoint> landmarks;
};

/// Finds curves on the left half and adds their mirror images.
class NameFinder {
 public:
  explicit NameFinder(const TorsoMesh& torso) : torso_(torso), mesh_(torso.mesh) {}

  Names find() {
    addGirth("hip", kHip);
    addGirth("high_hip", kHighHip);
    addGirth("waist", kWaist);
    addGirth("underbust", kUnderbust);
    addGirth("bust", kBust);
    const VertexField neckBase = addNeck();
    const VertexField arm = addArmhole();
    addSideAndShoulder(neckBase, arm);
    addCentre("centre_front", torso_.frontColumn, neckBase, "neck_front");
    addCentre("centre_back", torso_.backColumn, neckBase, "neck_back");
    addPeaks();
    names_.landmarks["crotch"] = {torso_.frontColumn.back()};
    return std::move(names_);
  }

 private:
  [[nodiscard]] bool isOnPlane(EdgeId edge) const {
    return torso_.partner[mesh_.tail(edge)] == mesh_.tail(edge) &&
           torso_.partner[mesh_.head(edge)] == mesh_.head(edge);
  }
  /// The halfedge of a mid-line edge whose face lies on the left.
  [[nodiscard]] HalfedgeId leftOf(EdgeId edge) const {
    const HalfedgeId h = mesh_.halfedge(edge);
    const bool isLeft = mesh_.position(mesh_.to(mesh_.next(h))).x() > 0;
    return isLeft ? h : mesh_.opposite(h);
  }
  /// The first edge of a column on which the field changes its sign.
  [[nodiscard]] EdgeId crossing(const std::vector<VertexId>& column,
                                const VertexField& field) const {
    for (std::size_t i = 0; i + 1 < column.size(); ++i) {
      const EdgeId edge = mesh_.findEdge(column[i], column[i + 1]);
      if (crosses(mesh_, field, edge)) return edge;
    }
    return {};
  }
  /// From the front mid-line over the left to the back.
  [[nodiscard]] SurfacePath leftHalf(const VertexField& field) const {
    const EdgeId start = crossing(torso_.frontColumn, field);
    TOILE_ASSERT(start.isValid());
    return levelPath(mesh_, field, leftOf(start), [&](EdgeId e) { return isOnPlane(e); });
  }
  /// Closed: over the left to the back and over the right to the front again.
  void addClosed(const std::string& name, const SurfacePath& left) {
    const SurfacePath right = detail::mirrored(mesh_, torso_.partner, left);
    SurfacePath whole = left;
    whole.closed = true;
    for (std::size_t i = right.points.size() - 1; i > 0; --i) {
      if (i + 1 < right.points.size()) whole.points.push_back(right.points[i]);
      whole.faceOfSegment.push_back(right.faceOfSegment[i - 1]);
    }
    names_.curves[name] = std::move(whole);
  }
  void addPair(const std::string& name, const SurfacePath& left) {
    names_.curves[name + "_l"] = left;
    names_.curves[name + "_r"] = detail::mirrored(mesh_, torso_.partner, left);
  }
  void addPair(const std::string& name, const SurfacePoint& left) {
    names_.landmarks[name + "_l"] = left;
    names_.landmarks[name + "_r"] = detail::mirrored(mesh_, torso_.partner, left);
  }
  /// The point of the path that goes farthest in a direction.
  [[nodiscard]] SurfacePoint farthest(const SurfacePath& path, const Vector3d& direction) const {
    return *std::max_element(
        path.points.begin(), path.points.end(), [&](const auto& a, const auto& b) {
          return position(mesh_, a).dot(direction) < position(mesh_, b).dot(direction);
        });
  }

  void addGirth(const std::string& name, double height) {
    const SurfacePath left = leftHalf(planeField(mesh_, Vector3d::UnitZ(), {0, 0, height}));
    addClosed(name + "_girth", left);
    names_.landmarks[name + "_front"] = left.points.front();
    names_.landmarks[name + "_back"] = left.points.back();
    addPair(name + "_side", farthest(left, Vector3d::UnitX()));
  }

  VertexField addNeck() {
    const Vector3d up = Vector3d(0, -36, 97).normalized();
    const Vector3d middle(0, -20, kNeck + 4);
    const VertexField field = planeField(mesh_, up, middle);
    const SurfacePath left = leftHalf(field);
    addClosed("neck_base", left);
    names_.landmarks["neck_front"] = left.points.front();
    names_.landmarks["neck_back"] = left.points.back();
    addClosed("neck_girth", leftHalf(planeField(mesh_, up, middle + 30 * up)));
    return field;
  }

  VertexField addArmhole() {
    VertexField field = planeField(mesh_, Vector3d(1, 0, -0.08).normalized(), {150, 0, 1312});
    // The hips are as wide as the plane is far out, but are no arms.
    for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) {
      double& value = field[VertexId(v)];
      if (mesh_.position(VertexId(v)).z() < kBust) value = -std::abs(value);
    }
    // From the tip of the shoulder over the front.
    VertexId top;
    for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) {
      const Vector3d& here = mesh_.position(VertexId(v));
      const bool isTop = !top.isValid() || here.z() > mesh_.position(top).z();
      if (field[VertexId(v)] > 0 && isTop) top = VertexId(v);
    }
    HalfedgeId into = mesh_.outgoing(top);
    while (!crosses(mesh_, field, mesh_.edge(into))) into = mesh_.opposite(mesh_.previous(into));
    const SurfacePath loop = levelPath(mesh_, field, into, [](EdgeId) { return false; });
    TOILE_ASSERT(loop.closed);
    addPair("armhole", loop);
    addPair("armpit", farthest(loop, -Vector3d::UnitZ()));
    addPair("armpit_front", farthest(loop, Vector3d(0, -1, -0.5)));
    addPair("armpit_back", farthest(loop, Vector3d(0, 1, -0.5)));
    return field;
  }

  /// The section y = kSideY from the neck over shoulder, arm stump and side down to the crotch.
  void addSideAndShoulder(const VertexField& neckBase, const VertexField& arm) {
    const VertexField plane = planeField(mesh_, Vector3d::UnitY(), {0, kSideY, 0});
    EdgeId start = crossing(torso_.frontColumn, plane);
    const auto isAtTop = [&](EdgeId e) {
      return e.isValid() && mesh_.position(mesh_.tail(e)).z() > kNeck;
    };
    if (!isAtTop(start)) start = crossing(torso_.backColumn, plane);
    TOILE_ASSERT(isAtTop(start));
    const SurfacePath whole =
        levelPath(mesh_, plane, leftOf(start), [&](EdgeId e) { return isOnPlane(e); });
    const std::vector<SurfacePath> body = splitBySign(mesh_, whole, neckBase);
    TOILE_ASSERT(body.size() == 2);
    const std::vector<SurfacePath> parts = splitBySign(mesh_, body[1], arm);
    TOILE_ASSERT(parts.size() == 3);  // shoulder, arm, side
    addPair("shoulder", parts[0]);
    addPair("side", parts[2]);
    addPair("neck_side", parts[0].points.front());
    addPair("shoulder", parts[0].points.back());
  }

  void addCentre(const std::string& name, const std::vector<VertexId>& column,
                 const VertexField& neckBase, const std::string& landmark) {
    const std::vector<SurfacePath> parts =
        splitBySign(mesh_, vertexPath(mesh_, column, false), neckBase);
    TOILE_ASSERT(parts.size() == 2);
    SurfacePath path = parts[1];
    path.points.front() = names_.landmarks.at(landmark);
    names_.curves[name] = std::move(path);
  }

  /// The vertex of the left half within some heights that goes farthest in a direction.
  [[nodiscard]] VertexId peak(const Vector3d& direction, double lowest, double highest) const {
    VertexId best;
    for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) {
      const Vector3d& here = mesh_.position(VertexId(v));
      if (here.x() < 20 || here.z() < lowest || here.z() > highest) continue;
      const bool isFarther =
          !best.isValid() || here.dot(direction) > mesh_.position(best).dot(direction);
      if (isFarther) best = VertexId(v);
    }
    return best;
  }
  void addPeaks() {
    addPair("bust_point", SurfacePoint{peak(-Vector3d::UnitY(), kUnderbust, kNeck)});
    addPair("buttock", SurfacePoint{peak(Vector3d::UnitY(), 0, kWaist)});
    addPair("arm_tip", SurfacePoint{peak(Vector3d::UnitX(), kBust, kNeck)});
    names_.landmarks["crown"] = {torso_.frontColumn.front()};
  }

  const TorsoMesh& torso_;
  const Mesh& mesh_;
  Names names_;
};

struct GeneratedTorso {
  TorsoMesh torso = makeTorsoMesh();
  Names names = NameFinder(torso).find();
};
const GeneratedTorso& generatedTorso() {
  static const GeneratedTorso generated;
  return generated;
}

/// Widths of the torso by height, from factors at hip, waist and bust; steady at these heights, so
/// that a girth answers to its own factor.
double widthFactor(const std::array<double, 3>& factors, double height) {
  struct Knot {
    double height, factor;
  };
  const auto faded = [](double factor, double part) { return 1 + part * (factor - 1); };
  const std::array<Knot, 5> knots{Knot{kHip, factors[0]}, Knot{kWaist, factors[1]},
                                  Knot{kBust, factors[2]}, Knot{1312, faded(factors[2], 0.8)},
                                  Knot{kNeck, faded(factors[2], 0.4)}};
  if (height <= knots.front().height) return knots.front().factor;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (height > knots[i].height) continue;
    const double x = (height - knots[i - 1].height) / (knots[i].height - knots[i - 1].height);
    return knots[i - 1].factor + (knots[i].factor - knots[i - 1].factor) * x * x * (3 - 2 * x);
  }
  return knots.back().factor;
}

Mesh shaped(const Mesh& mesh, const std::array<double, 3>& factors, double heightFactor) {
  constexpr double kAxisY = -40;
  std::vector<Vector3d> positions = mesh.positions();
  for (Vector3d& place : positions) {
    const double width = widthFactor(factors, place.z());
    place = {width * place.x(), kAxisY + width * (place.y() - kAxisY), heightFactor * place.z()};
  }
  return mesh.withPositions(std::move(positions));
}

ReferenceModel makeTorso(const ParameterValues& values) {
  constexpr int kCorrections = 8;  // each makes the error of the girths about 50 times smaller
  const GeneratedTorso& generated = generatedTorso();
  const Mesh& base = generated.torso.mesh;
  const double baseHeight = base.boxMax().z() - base.boxMin().z();
  const std::array<std::string, 3> levels{"hip", "waist", "bust"};
  std::array<double, 3> factors{1, 1, 1};
  Mesh mesh = base;
  for (int i = 0; i < kCorrections; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      factors[k] *= values.at(levels[k] + "-girth") /
                    length(mesh, generated.names.curves.at(levels[k] + "_girth"));
    }
    mesh = shaped(base, factors, values.at("height") / baseHeight);
  }
  ReferenceModel model = makeReferenceModel("torso", std::move(mesh));
  model.curves = generated.names.curves;
  model.landmarks = generated.names.landmarks;
  Symmetry symmetry;
  symmetry.partner = generated.torso.partner;
  model.symmetry = std::move(symmetry);
  return model;
}

const std::vector<ShapeParameter>& torsoParameters() {
  using Kind = ShapeParameter::Kind;
  static const std::vector<ShapeParameter> parameters{
      {"height", Kind::Length, kHeight, 600, 900},
      {"bust-girth", Kind::Length, 900, 750, 1200},
      {"waist-girth", Kind::Length, 700, 560, 1100},
      {"hip-girth", Kind::Length, 960, 780, 1250},
  };
  return parameters;
}

}  // namespace

const BuiltinShape& torso() {
  static const BuiltinShape shape{"torso@1", [](std::string_view query) -> Result<ReferenceModel> {
                                    const Result<ParameterValues> values =
                                        parseParameters(query, torsoParameters());
                                    if (!values) return values.error();
                                    return makeTorso(*values);
                                  }};
  return shape;
}

}  // namespace toile
