// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "support/drawn_curves.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/curve/geodesic.h"
#include "toile/cut/cut.h"

namespace toile {
namespace {

using test::drawn;

constexpr std::int64_t kUnit = std::int64_t{1} << 26;

/// Weights of a refined vertex in a model face as whole numbers; fails if they are none.
std::array<std::int64_t, 3> wholeWeights(const Mesh& mesh, const SurfacePoint& point, FaceId face) {
  const Eigen::Vector3d weights = barycentricIn(mesh, point, face) * static_cast<double>(kUnit);
  std::array<std::int64_t, 3> whole{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    EXPECT_EQ(weight, std::round(weight));
    whole[k] = static_cast<std::int64_t>(weight);
  }
  EXPECT_EQ(whole[0] + whole[1] + whole[2], kUnit);
  return whole;
}

/// The refinement covers each face of the mesh exactly, turns nothing over and changes no topology.
void expectRefines(const Mesh& mesh, const RefinedMesh& refined) {
  const Mesh& fine = refined.mesh;
  ASSERT_EQ(refined.onModel.size(), fine.vertexCount());
  ASSERT_EQ(refined.sourceFace.size(), fine.faceCount());
  ASSERT_EQ(refined.cutEdge.size(), fine.edgeCount());
  EXPECT_EQ(fine.eulerCharacteristic(), mesh.eulerCharacteristic());
  EXPECT_EQ(fine.componentCount(), mesh.componentCount());
  EXPECT_EQ(fine.boundaryLoops().size(), mesh.boundaryLoops().size());

  std::vector<std::int64_t> covered(mesh.faceCount(), 0);
  for (std::size_t f = 0; f < fine.faceCount(); ++f) {
    const FaceId source = refined.sourceFace[FaceId(f)];
    const Triangle& corners = fine.vertices(FaceId(f));
    std::array<std::array<std::int64_t, 3>, 3> w{};
    for (std::size_t k = 0; k < 3; ++k) {
      w[k] = wholeWeights(mesh, refined.onModel[corners[k]], source);
    }
    const std::int64_t area =
        (w[1][1] - w[0][1]) * (w[2][2] - w[0][2]) - (w[1][2] - w[0][2]) * (w[2][1] - w[0][1]);
    ASSERT_GT(area, 0) << "face " << f << " of source " << source.index();
    covered[source.index()] += area;
    if (mesh.area(source) < 1e-6) continue;
    const Eigen::Vector3d normal =
        (fine.position(corners[1]) - fine.position(corners[0]))
            .cross(fine.position(corners[2]) - fine.position(corners[0]));
    ASSERT_GT(normal.dot(mesh.normal(source)), 0) << "face " << f << " of " << source.index();
  }
  for (std::size_t f = 0; f < covered.size(); ++f) {
    ASSERT_EQ(covered[f], kUnit * kUnit) << "source face " << f;
  }
  for (std::size_t v = 0; v < fine.vertexCount(); ++v) {
    const Eigen::Vector3d onModel = position(mesh, refined.onModel[VertexId(v)]);
    ASSERT_LT((fine.position(VertexId(v)) - onModel).norm(), 1e-11 + 1e-14 * onModel.norm());
  }
}

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const double squared = (b - a).squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
  return (a + t * (b - a) - p).norm();
}

/// Largest distance of a curve's points and segment middles from the edges of the cut.
double distanceToCut(const Mesh& mesh, const SurfacePath& path, const RefinedMesh& refined) {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> edges;
  for (std::size_t i = 0; i < refined.mesh.edgeCount(); ++i) {
    const EdgeId e(i);
    if (!refined.cutEdge[e].isValid()) continue;
    edges.emplace_back(refined.mesh.position(refined.mesh.tail(e)),
                       refined.mesh.position(refined.mesh.head(e)));
  }
  double largest = 0;
  for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
    const Eigen::Vector3d a = position(mesh, path.points[i]);
    const Eigen::Vector3d b = position(mesh, path.points[(i + 1) % path.points.size()]);
    if (a == b) continue;
    for (const Eigen::Vector3d& p : {a, Eigen::Vector3d((a + b) / 2)}) {
      double nearest = 1e300;
      for (const auto& [c, d] : edges) nearest = std::min(nearest, distanceToSegment(p, c, d));
      largest = std::max(largest, nearest);
    }
  }
  return largest;
}

double cutLength(const RefinedMesh& refined) {
  double sum = 0;
  for (const CutEdge& e : refined.cutEdges) sum += e.kind == WireKind::Border ? 0 : e.bodyLength;
  return sum;
}

TEST(Refine, LeavesAMeshWithoutCurvesAsItIs) {
  const Mesh mesh = test::icosphere(100, 2);
  const Result<RefinedMesh> refined = refine(mesh, {});
  ASSERT_TRUE(refined) << refined.error();
  EXPECT_EQ(refined->mesh.triangles(), mesh.triangles());
  EXPECT_EQ(refined->mesh.positions(), mesh.positions());
  EXPECT_TRUE(refined->cutEdges.empty());
}

/// Vertices inside the mesh at which a single edge of the cut ends.
std::size_t looseEnds(const RefinedMesh& refined) {
  std::vector<std::size_t> degree(refined.mesh.vertexCount(), 0);
  for (std::size_t i = 0; i < refined.mesh.edgeCount(); ++i) {
    const EdgeId e(i);
    if (!refined.cutEdge[e].isValid() || refined.mesh.isBorder(e)) continue;
    ++degree[refined.mesh.tail(e).index()];
    ++degree[refined.mesh.head(e).index()];
  }
  std::size_t loose = 0;
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (degree[v] == 1 && !refined.mesh.isBorder(VertexId(v))) ++loose;
  }
  return loose;
}

// A seam ends on another one within the merge distance of a mesh edge, so that its end becomes a
// node of that edge, farther from the other seam than what leads it through a node.
TEST(Refine, KeepsEndsOnTheLinesTheyWereDrawnTo) {
  const Mesh mesh = test::grid(2, 1);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  GeodesicLinker linker(std::make_shared<const Mesh>(mesh));
  for (int trial = 0; trial < 2000; ++trial) {
    const double tilt = std::numbers::pi * (uniform(random) - 0.5) / 2;
    const auto sections = test::planeSections(
        mesh, Eigen::Vector3d(std::sin(tilt), std::cos(tilt), 0), 4 + 2 * uniform(random));
    ASSERT_FALSE(sections.empty());
    const SurfacePath& line = sections.front();
    // Beside the second point, which is inside on a diagonal.
    const double whole = length(mesh, line);
    const double from = length(mesh, {{line.points[0], line.points[1]}, {line.faceOfSegment[0]}});
    const double beside = 2 * kMergeDistanceMm * (2 * uniform(random) - 1);
    const SurfacePoint end = pointAtFraction(mesh, line, (from + beside) / whole);
    const SurfacePoint start =
        makeSurfacePoint(mesh, FaceId(std::size_t{random() % mesh.faceCount()}), {0.3, 0.3, 0.4});
    const Result<SurfacePath> seam = linker.link(start, end);
    ASSERT_TRUE(seam) << seam.error();
    const Result<RefinedMesh> refined = refine(
        mesh,
        std::vector{drawn("line", CurveKind::Seam, line), drawn("seam", CurveKind::Seam, *seam)});
    ASSERT_TRUE(refined) << refined.error();
    expectRefines(mesh, *refined);
    ASSERT_EQ(looseEnds(*refined), 1U) << "trial " << trial;
  }
}

// Two cells of 10 mm: the line from the middle of the left side to the middle of the right one
// crosses both diagonals.
TEST(Refine, PutsALineAcrossAGridOnEdges) {
  const Mesh mesh = test::grid(2, 1);
  const auto sections = test::planeSections(mesh, Eigen::Vector3d::UnitY(), 5);
  ASSERT_EQ(sections.size(), 1U);
  const std::vector<PlacedCurve> curves{drawn("a", CurveKind::Feature, sections[0])};
  const Result<RefinedMesh> refined = refine(mesh, curves);
  ASSERT_TRUE(refined) << refined.error();
  expectRefines(mesh, *refined);
  EXPECT_NEAR(cutLength(*refined), 20, 1e-12);
  // Left, diagonal, middle, diagonal, right: five nodes.
  EXPECT_EQ(refined->mesh.vertexCount(), mesh.vertexCount() + 5);
}

TEST(Refine, GivesCrossingCurvesANode) {
  const Mesh mesh = test::grid(1, 1);
  // Both lines cross inside one of the two triangles.
  const auto vertical = test::planeSections(mesh, Eigen::Vector3d::UnitX(), 6);
  const auto horizontal = test::planeSections(mesh, Eigen::Vector3d::UnitY(), 3);
  const std::vector<PlacedCurve> curves{drawn("v", CurveKind::Seam, vertical.at(0)),
                                        drawn("h", CurveKind::Feature, horizontal.at(0))};
  const Result<RefinedMesh> refined = refine(mesh, curves);
  ASSERT_TRUE(refined) << refined.error();
  expectRefines(mesh, *refined);
  EXPECT_NEAR(cutLength(*refined), 20, 1e-6);
  double nearest = 1e300;
  for (const Eigen::Vector3d& p : refined->mesh.positions()) {
    nearest = std::min(nearest, (p - Eigen::Vector3d(6, 3, 0)).norm());
  }
  EXPECT_LT(nearest, 1e-6);  // a lattice part is 1.5e-7 mm here
}

TEST(Refine, MergesWhatIsCloserThanTheMergeDistance) {
  const Mesh mesh = test::icosphere(100, 3);
  const auto one = test::planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.0);
  const auto alone = refine(mesh, std::vector{drawn("a", CurveKind::Seam, one.at(0))});
  ASSERT_TRUE(alone) << alone.error();
  for (const double distance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    const auto other = test::planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.0 + distance);
    const auto both = refine(mesh, std::vector{drawn("a", CurveKind::Seam, one.at(0)),
                                               drawn("b", CurveKind::Seam, other.at(0))});
    ASSERT_TRUE(both) << both.error();
    expectRefines(mesh, *both);
    EXPECT_EQ(both->mesh.vertexCount(), alone->mesh.vertexCount()) << distance;
    EXPECT_EQ(both->cutEdges.size(), alone->cutEdges.size()) << distance;
  }
  const auto apart = test::planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.1);
  const auto both = refine(mesh, std::vector{drawn("a", CurveKind::Seam, one.at(0)),
                                             drawn("b", CurveKind::Seam, apart.at(0))});
  ASSERT_TRUE(both) << both.error();
  EXPECT_GT(both->cutEdges.size(), 3 * alone->cutEdges.size() / 2);
}

TEST(Refine, FollowsMeshEdgesWithoutSplittingThem) {
  const Mesh mesh = test::cube(100, 4);
  std::vector<VertexId> chain{VertexId(0)};
  for (int i = 0; i < 5; ++i) {
    chain.push_back(mesh.to(mesh.outgoing(chain.back())));
    if (chain.back() == chain.front()) break;
  }
  const auto refined =
      refine(mesh, std::vector{drawn("a", CurveKind::Seam, test::edgePath(mesh, chain))});
  ASSERT_TRUE(refined) << refined.error();
  EXPECT_EQ(refined->mesh.triangles(), mesh.triangles());
  EXPECT_LE(refined->cutEdges.size(), chain.size() - 1);
  EXPECT_GE(refined->cutEdges.size(), 1U);
}

TEST(Refine, TheStrongestKindKeepsASharedEdge) {
  const Mesh mesh = test::grid(4, 4);
  const auto section = test::planeSections(mesh, Eigen::Vector3d::UnitX(), 17);
  constexpr std::array kStrongestFirst{CurveKind::Seam, CurveKind::Opening, CurveKind::Dart,
                                       CurveKind::Elastic, CurveKind::Feature};
  for (std::size_t i = 0; i + 1 < kStrongestFirst.size(); ++i) {
    const auto refined =
        refine(mesh, std::vector{drawn("weak", kStrongestFirst[i + 1], section.at(0)),
                                 drawn("strong", kStrongestFirst[i], section.at(0)),
                                 drawn("second", kStrongestFirst[i], section.at(0))});
    ASSERT_TRUE(refined) << refined.error();
    std::size_t ofTheStrong = 0;
    for (const CutEdge& e : refined->cutEdges) {
      if (e.kind == WireKind::Border) continue;
      EXPECT_EQ(e.curve, 1U);
      ++ofTheStrong;
    }
    EXPECT_EQ(ofTheStrong, 8U);  // two per cell
  }
}

TEST(Refine, LeavesMarksAndGuidesOut) {
  const Mesh mesh = test::icosphere(100, 2);
  const auto section = test::planeSections(mesh, Eigen::Vector3d(0.1, 0.2, 1), 3.0);
  for (const CurveKind kind : {CurveKind::Mark, CurveKind::Guide}) {
    const auto refined = refine(mesh, std::vector{drawn("m", kind, section.at(0))});
    ASSERT_TRUE(refined) << refined.error();
    EXPECT_EQ(refined->mesh.faceCount(), mesh.faceCount());
  }
}

TEST(Refine, NamesACurveThatIsNotOnTheMesh) {
  const Mesh mesh = test::grid(2, 2);
  SurfacePath path;
  path.points = {{VertexId(0)}, {VertexId(900)}};
  path.faceOfSegment = {FaceId(0)};
  const auto refined = refine(mesh, std::vector{drawn("stray", CurveKind::Seam, path)});
  ASSERT_FALSE(refined);
  EXPECT_EQ(refined.error().code, ErrorCode::CurveInvalid);
  ASSERT_EQ(refined.error().where.size(), 1U);
  EXPECT_EQ(refined.error().where[0], Element::curve("stray"));
}

TEST(Refine, DoesNotDependOnTheOrderOfCurves) {
  const Mesh mesh = test::icosphere(100, 2);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<PlacedCurve> curves = test::randomCurves(mesh, 6, random);
    const auto forward = refine(mesh, curves);
    std::reverse(curves.begin(), curves.end());
    const auto backward = refine(mesh, curves);
    ASSERT_TRUE(forward && backward);
    EXPECT_EQ(forward->mesh.triangles(), backward->mesh.triangles());
    EXPECT_EQ(forward->mesh.positions(), backward->mesh.positions());
  }
}

TEST(Refine, SurvivesRandomCurves) {
  const std::array meshes{test::icosphere(50, 2), test::grid(6, 5), test::cube(60, 1),
                          test::torus(60, 20, 16, 9), test::cylinder(30, 80, 12, 5)};
  constexpr std::uint64_t kSeed = 20261122;
  std::cout << "seed " << kSeed << "\n";
  std::mt19937_64 random(kSeed);
  double largestDistance = 0;
  std::size_t trialsWithCut = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Mesh& mesh = meshes[static_cast<std::size_t>(trial) % meshes.size()];
    const auto curves = test::randomCurves(mesh, 1 + trial % 9, random);
    const auto refined = refine(mesh, curves);
    ASSERT_TRUE(refined) << refined.error() << " in trial " << trial;
    expectRefines(mesh, *refined);
    if (testing::Test::HasFatalFailure()) FAIL() << "in trial " << trial;
    trialsWithCut += refined->mesh.faceCount() > mesh.faceCount() ? 1 : 0;
    if (trial % 5 == 0) {
      for (const PlacedCurve& c : curves) {
        largestDistance = std::max(largestDistance, distanceToCut(mesh, c.path, *refined));
      }
    }
  }
  EXPECT_GT(trialsWithCut, 800U);
  // A curve is led through a node beside it, and the parts again: a few merge distances.
  EXPECT_LT(largestDistance, 5 * kMergeDistanceMm);
  std::cout << trialsWithCut << " trials cut faces; largest distance of a curve from its edges "
            << largestDistance << " mm\n";
}

// Scans have faces without area and parts smaller than the merge distance: cutting them is exact in
// whole numbers all the same.
TEST(Refine, SurvivesFacesWithoutArea) {
  const auto scaled = [](const Mesh& mesh, double x, double y, double z) {
    return test::transformed(mesh, Eigen::Vector3d(x, y, z).asDiagonal(), Eigen::Vector3d::Zero());
  };
  const Mesh sphere = test::icosphere(50, 2);
  const Mesh cloth = test::irregularGrid(6, 5);
  const std::array meshes{scaled(sphere, 1e-3, 1e-3, 1e-3), scaled(sphere, 1, 1, 1e-4),
                          scaled(cloth, 1, 0, 1),           scaled(cloth, 1, 3e-3, 1),
                          scaled(sphere, 1, 0, 0),          scaled(sphere, 0, 0, 0)};
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 120; ++trial) {
    const Mesh& mesh = meshes[static_cast<std::size_t>(trial) % meshes.size()];
    const auto refined = refine(mesh, test::randomCurves(mesh, 1 + trial % 9, random));
    ASSERT_TRUE(refined) << refined.error() << " in trial " << trial;
    expectRefines(mesh, *refined);
    if (testing::Test::HasFatalFailure()) FAIL() << "in trial " << trial;
  }
}

}  // namespace
}  // namespace toile
