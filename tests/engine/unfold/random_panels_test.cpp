// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>

#include "support/arap.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "support/test_data.h"

namespace toile {
namespace {

using Eigen::Vector3d;

constexpr std::array kBodies = {"female_average",
                                "male_average",
                                "female_tall_slim",
                                "male_heavy",
                                "child_10y",
                                "elderly",
                                "female_average_arms_raised",
                                "male_average_knee_bent",
                                "female_tall_slim_cycling"};

struct Surface {
  std::vector<Vector3d> positions;
  std::vector<std::array<std::size_t, 3>> faces;
};

/// The part where normal . x <= offset. Vertices nearer to the plane than a fifth of an edge are
/// pulled onto it first, so that no slivers come.
void clip(Surface& surface, const Vector3d& normal, double offset) {
  std::vector<double> side(surface.positions.size());
  for (std::size_t v = 0; v < side.size(); ++v) {
    side[v] = normal.dot(surface.positions[v]) - offset;
  }
  for (const auto& face : surface.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % 3];
      if (side[a] * side[b] >= 0) continue;
      const double t = side[a] / (side[a] - side[b]);
      const std::size_t near = t < 0.2 ? a : t > 0.8 ? b : face.size();
      if (near != a && near != b) continue;
      surface.positions[near] +=
          (t < 0.2 ? t : 1 - t) * (surface.positions[near == a ? b : a] - surface.positions[near]);
      side[near] = 0;
    }
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> cut;
  const auto onEdge = [&](std::size_t a, std::size_t b) {
    const auto [entry, isNew] = cut.try_emplace(std::minmax(a, b), surface.positions.size());
    if (isNew) {
      const double t = side[a] / (side[a] - side[b]);
      surface.positions.emplace_back((1 - t) * surface.positions[a] + t * surface.positions[b]);
    }
    return entry->second;
  };
  std::vector<std::array<std::size_t, 3>> kept;
  for (const auto& face : surface.faces) {
    std::vector<std::size_t> polygon;
    bool hasInside = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % 3];
      hasInside = hasInside || side[a] < 0;
      if (side[a] <= 0) polygon.push_back(a);
      if (side[a] * side[b] < 0) polygon.push_back(onEdge(a, b));
    }
    if (!hasInside) continue;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      kept.push_back({polygon[0], polygon[k], polygon[k + 1]});
    }
  }
  surface.faces = std::move(kept);
}

/// The connected part with the face nearest to a point, as a mesh; nothing unless it is a disk.
std::optional<Mesh> partAround(const Surface& surface, const Vector3d& point) {
  if (surface.faces.size() < 60) return std::nullopt;
  std::vector<std::size_t> root(surface.positions.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto rootOf = [&](std::size_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::size_t nearest = surface.faces.front()[0];
  for (const auto& face : surface.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      root[rootOf(face[k])] = rootOf(face[0]);
      if ((surface.positions[face[k]] - point).norm() <
          (surface.positions[nearest] - point).norm()) {
        nearest = face[k];
      }
    }
  }
  std::map<std::size_t, std::size_t> number;
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  for (const auto& face : surface.faces) {
    if (rootOf(face[0]) != rootOf(nearest)) continue;
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [entry, isNew] = number.try_emplace(face[k], positions.size());
      if (isNew) positions.push_back(surface.positions[face[k]]);
      triangle[k] = VertexId(entry->second);
    }
    triangles.push_back(triangle);
  }
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  if (!mesh || mesh->eulerCharacteristic() != 1 || mesh->boundaryLoops().size() != 1 ||
      mesh->faceCount() < 60) {
    return std::nullopt;
  }
  return *std::move(mesh);
}

/// A four-sided panel of random size, place and direction; nothing where that is no disk, or goes
/// around a hand or a head and has faces turned away from its middle.
std::optional<Mesh> randomPanel(const Mesh& body, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
  };
  // By area: hands and heads have most of the faces.
  FaceId face(random() % body.faceCount());
  while (body.area(face) < uniform(0, 400)) face = FaceId(random() % body.faceCount());
  const Vector3d centre = body.position(body.vertices(face)[0]);
  const Vector3d normal = body.normal(face);
  const Vector3d helper = std::abs(normal.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Eigen::AngleAxisd turn(uniform(0, std::numbers::pi), normal);
  const Vector3d u = turn * normal.cross(helper).normalized();
  const Vector3d w = normal.cross(u);
  Surface surface{body.positions(), {}};
  for (const Triangle& t : body.triangles()) {
    if ((body.position(t[0]) - centre).norm() > 500) continue;
    surface.faces.push_back({t[0].index(), t[1].index(), t[2].index()});
  }
  for (const Vector3d& side : {u, Vector3d(-u), w, Vector3d(-w)}) {
    clip(surface, side, side.dot(centre) + uniform(40, 140));
  }
  clip(surface, -normal, -normal.dot(centre) + uniform(60, 120));
  std::optional<Mesh> panel = partAround(surface, centre);
  for (std::size_t f = 0; panel && f < panel->faceCount(); ++f) {
    if (panel->normal(FaceId(f)).dot(normal) < -0.2) return std::nullopt;
  }
  return panel;
}

// Whatever panel is cut from a body: exact lengths, no fold, and no crossing that is not told.
// TOILE_TRIALS takes another number of panels and prints their figures.
TEST(RandomPanels, OfAllBodiesLieFlatExactly) {
  const char* asked = std::getenv("TOILE_TRIALS");
  const std::size_t trials = asked != nullptr ? std::strtoul(asked, nullptr, 10) : 9;
  constexpr unsigned kSeed = 20;
  std::mt19937 random(kSeed);
  std::size_t made = 0;
  for (std::size_t attempt = 0; made < trials && attempt < 60 * trials; ++attempt) {
    const std::string body = kBodies[attempt % kBodies.size()];
    TOILE_TEST_DATA_OR_SKIP(path, "bodies/" + body + ".ply");
    const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
    ASSERT_TRUE(file) << file.error();
    const std::optional<Mesh> panel = randomPanel(file->mesh, random);
    if (!panel) continue;
    ++made;
    SCOPED_TRACE(body + ", attempt " + std::to_string(attempt));
    const Result<FlatPiece> flat = unfold(test::patchOf(*panel));
    ASSERT_TRUE(flat) << flat.error();
    EXPECT_LE(flat->check.maxLengthError, 1e-9);
    EXPECT_EQ(flat->check.flippedFaces, 0U);
    const bool tells = std::any_of(flat->findings.begin(), flat->findings.end(),
                                   [](const Finding& f) { return f.code == "crossings"; });
    EXPECT_EQ(flat->check.crossings > 0, tells);
    // Without lengths to keep cloth lies with less strain; that is the price of exactness.
    const std::vector<Eigen::Vector2d> free = test::arapPlane(*panel, flat->position.values());
    const double freeArea = test::meanAreaError(*panel, free);
    const double lengths = test::meanLengthError(*panel, flat->position.values());
    const double freeLengths = test::meanLengthError(*panel, free);
    EXPECT_LT(freeLengths, 1.15 * lengths) << "cloth without wires lies with less strain";
    if (asked != nullptr) {
      std::printf(
          "  ARAP: area error %6.2f %%, ratio %5.2f; edge lengths %5.2f %% against %5.2f %%, ratio "
          "%4.2f\n",
          100 * freeArea, flat->meanAreaError / freeArea, 100 * lengths, 100 * freeLengths,
          lengths / freeLengths);
      std::printf(
          "%-28s %5zu faces, area error mean %6.2f %% max %7.1f %%, turn %5.1f deg, length "
          "%.0e, %zu crossings, %d steps\n",
          body.c_str(), panel->faceCount(), 100 * flat->meanAreaError, 100 * flat->maxAreaError,
          flat->check.maxTurnError * 180 / std::numbers::pi, flat->check.maxLengthError,
          flat->check.crossings, flat->steps);
    }
  }
  EXPECT_EQ(made, trials);
}

}  // namespace
}  // namespace toile
