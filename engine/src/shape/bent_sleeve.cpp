// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/vertex_path.h"
#include "shape/parameters.h"
#include "shape/shape_model.h"
#include "toile/core/assert.h"
#include "toile/core/units.h"

// A left sleeve: an open tube that hangs down from the armhole and bends forward at the elbow.
// Rings stand square on a centre line in the plane x = 0, which is the mirror plane.
namespace toile {
namespace {

constexpr std::size_t kAround = 36;  // even, so that front and back columns lie in the plane
constexpr std::size_t kRows = 60;    // rows of cells; kRows + 1 rings
constexpr std::size_t kUpperArmRow = 10;
constexpr std::size_t kElbowRow = 33;
constexpr std::size_t kForearmRow = 46;
constexpr double kBendZone = 0.3;  // of the length, centred on the elbow
constexpr int kStepsPerRow = 16;   // of integrating the centre line

std::size_t vertex(std::size_t ring, std::size_t column) {
  return ring * kAround + column % kAround;
}

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Girth of a ring: cosine-blended between armhole, elbow and wrist.
double girth(const ParameterValues& values, std::size_t ring) {
  const auto blend = [](double a, double b, double x) {
    return a + (b - a) * (0.5 * x + 0.5 * smoothStep(x));
  };
  const double elbow = values.at("elbow-girth");
  if (ring <= kElbowRow) {
    return blend(values.at("armhole-girth"), elbow,
                 static_cast<double>(ring) / static_cast<double>(kElbowRow));
  }
  return blend(elbow, values.at("wrist-girth"),
               static_cast<double>(ring - kElbowRow) / static_cast<double>(kRows - kElbowRow));
}

std::vector<Eigen::Vector3d> sleevePositions(const ParameterValues& values) {
  const double length = values.at("length");
  const double bend = values.at("bend");
  const double elbow = static_cast<double>(kElbowRow) / static_cast<double>(kRows);
  const auto angle = [&](double s) { return bend * smoothStep((s - elbow) / kBendZone + 0.5); };
  const double pi = std::numbers::pi;
  // The polygon of a ring, not its circle, has the girth asked for.
  const double perimeterOfUnitRing = 2.0 * kAround * std::sin(pi / kAround);

  std::vector<Eigen::Vector3d> positions((kRows + 1) * kAround);
  Eigen::Vector3d centre(0, 0, length);
  for (std::size_t ring = 0; ring <= kRows; ++ring) {
    const double s = static_cast<double>(ring) / static_cast<double>(kRows);
    const Eigen::Vector3d front(0, -std::cos(angle(s)), std::sin(angle(s)));
    const double radius = girth(values, ring) / perimeterOfUnitRing;
    for (std::size_t column = 0; column <= kAround / 2; ++column) {
      const double turn = 2 * pi * static_cast<double>(column) / kAround;
      const bool isOnPlane = column == 0 || column == kAround / 2;
      Eigen::Vector3d place = centre + radius * std::cos(turn) * front;
      place.x() = isOnPlane ? 0 : radius * std::sin(turn);
      positions[vertex(ring, column)] = place;
      place.x() = -place.x();
      if (!isOnPlane) positions[vertex(ring, kAround - column)] = place;
    }
    const double step = length / static_cast<double>(kRows) / kStepsPerRow;
    for (int i = 0; i < kStepsPerRow; ++i) {
      const double middle = s + (i + 0.5) / kStepsPerRow / static_cast<double>(kRows);
      centre += step * Eigen::Vector3d(0, -std::sin(angle(middle)), -std::cos(angle(middle)));
    }
  }
  return positions;
}

std::vector<Triangle> sleeveTriangles() {
  std::vector<Triangle> triangles;
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t column = 0; column < kAround; ++column) {
      const VertexId a(vertex(row, column)), b(vertex(row, column + 1));
      const VertexId c(vertex(row + 1, column)), d(vertex(row + 1, column + 1));
      // Diagonals of the two halves mirror each other.
      if (column < kAround / 2) {
        triangles.push_back({a, c, d});
        triangles.push_back({a, d, b});
      } else {
        triangles.push_back({a, c, b});
        triangles.push_back({b, c, d});
      }
    }
  }
  return triangles;
}

ReferenceModel makeBentSleeve(const ParameterValues& values) {
  Result<Mesh> mesh = makeMesh(sleevePositions(values), sleeveTriangles());
  TOILE_ASSERT(mesh.hasValue());
  ReferenceModel model = makeReferenceModel("bent-sleeve", std::move(*mesh));

  Symmetry symmetry;
  symmetry.partner = VertexData<VertexId>((kRows + 1) * kAround);
  for (std::size_t ring = 0; ring <= kRows; ++ring) {
    for (std::size_t column = 0; column < kAround; ++column) {
      symmetry.partner[VertexId(vertex(ring, column))] = VertexId(vertex(ring, kAround - column));
    }
  }
  model.symmetry = std::move(symmetry);

  // Rings run from the front over the outer side to the back and along the inner side.
  const auto addRing = [&](const std::string& name, std::size_t ring) {
    std::vector<VertexId> vertices;
    for (std::size_t i = 0; i < kAround; ++i) vertices.emplace_back(vertex(ring, i));
    model.curves.emplace(name, vertexPath(*model.mesh, vertices, true));
  };
  addRing("armhole", 0);
  addRing("upperarm_girth", kUpperArmRow);
  addRing("elbow_girth", kElbowRow);
  addRing("forearm_girth", kForearmRow);
  addRing("wrist_girth", kRows);
  const auto addColumn = [&](const std::string& name, std::size_t column) {
    std::vector<VertexId> vertices;
    for (std::size_t i = 0; i <= kRows; ++i) vertices.emplace_back(vertex(i, column));
    model.curves.emplace(name, vertexPath(*model.mesh, vertices, false));
  };
  constexpr std::size_t kFront = 0, kOuter = kAround / 4, kBack = kAround / 2,
                        kInner = 3 * kAround / 4;
  addColumn("arm_front", kFront);
  addColumn("arm_outer", kOuter);
  addColumn("arm_back", kBack);
  addColumn("underarm", kInner);

  const auto addLandmark = [&](const std::string& name, std::size_t ring, std::size_t column) {
    model.landmarks.emplace(name, SurfacePoint{VertexId(vertex(ring, column))});
  };
  addLandmark("shoulder", 0, kOuter);
  addLandmark("armpit", 0, kInner);
  addLandmark("elbow_inner", kElbowRow, kFront);
  addLandmark("elbow_outer", kElbowRow, kBack);
  addLandmark("wrist_thumb", kRows, kFront);
  addLandmark("wrist_little", kRows, kBack);
  return model;
}

const std::vector<ShapeParameter>& sleeveParameters() {
  using Kind = ShapeParameter::Kind;
  static const std::vector<ShapeParameter> parameters{
      {"length", Kind::Length, 600, 400, 900},
      {"armhole-girth", Kind::Length, 400, 250, 600},
      {"elbow-girth", Kind::Length, 300, 180, 380},
      {"wrist-girth", Kind::Length, 210, 120, 380},
      {"bend", Kind::Angle, Angle::degrees(35).radians(), 0, Angle::degrees(50).radians()},
  };
  return parameters;
}

}  // namespace

const BuiltinShape& bentSleeve() {
  static const BuiltinShape shape{
      "bent-sleeve@1", [](std::string_view query) -> Result<ReferenceModel> {
        const Result<ParameterValues> values = parseParameters(query, sleeveParameters());
        if (!values) return values.error();
        return makeBentSleeve(*values);
      }};
  return shape;
}

}  // namespace toile
