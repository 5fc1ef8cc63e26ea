// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "support/test_data.h"

namespace toile {
namespace {

/// Faces of both with the vertices of both, not joined.
Mesh together(const Mesh& a, const Mesh& b) {
  std::vector<Eigen::Vector3d> positions = a.positions();
  std::vector<Triangle> triangles = a.triangles();
  const std::size_t base = positions.size();
  positions.insert(positions.end(), b.positions().begin(), b.positions().end());
  for (const auto& [u, v, w] : b.triangles()) {
    triangles.push_back(
        {VertexId(u.index() + base), VertexId(v.index() + base), VertexId(w.index() + base)});
  }
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  EXPECT_TRUE(mesh) << mesh.error();
  return std::move(*mesh);
}

Mesh shifted(const Mesh& mesh, const Eigen::Vector3d& by) {
  return test::transformed(mesh, Eigen::Matrix3d::Identity(), by);
}

TEST(FindCrossingFaces, NamesThePairsThatCross) {
  const Mesh floor = test::grid(1, 1, 100);  // two faces
  const Eigen::AngleAxisd upright(0.5 * std::acos(-1.0), Eigen::Vector3d::UnitX());
  // A wall that stands through the first corner of the floor.
  const Mesh wall = test::transformed(floor, upright.toRotationMatrix(), {-50, 20, -50});
  const auto pairs = findCrossingFaces(together(floor, wall));
  ASSERT_FALSE(pairs.empty());
  for (const auto& [f, g] : pairs) {
    EXPECT_LT(f.index(), 2U);
    EXPECT_GE(g.index(), 2U);
  }
  EXPECT_TRUE(findCrossingFaces(test::torus(100, 40, 24, 16)).empty());
}

TEST(FindCrossingFaces, PassesOverFacesWithoutArea) {
  std::vector<Eigen::Vector3d> positions = test::grid(2, 2).positions();
  const Mesh grid = test::grid(2, 2);
  positions[4] = positions[1];
  EXPECT_TRUE(findCrossingFaces(grid.withPositions(positions)).size() < 20);
}

TEST(CheckMesh, FindsBordersThatAreNotJoinedAndRepairsThem) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "split.obj";
  test::writeText(path,
                  writeObj(together(test::grid(4, 4), shifted(test::grid(4, 4), {40, 0, 0}))));
  const Result<MeshCheck> check = checkMesh(path);
  ASSERT_TRUE(check) << check.error();
  EXPECT_FALSE(check->refusal);
  const auto finding =
      std::find_if(check->findings.begin(), check->findings.end(),
                   [](const Finding& f) { return f.code == "borders-not-joined"; });
  ASSERT_NE(finding, check->findings.end());
  EXPECT_EQ(finding->where.size(), 10U) << "five vertices on each side";
  const Result<MeshFile> repaired = repairMesh(path);
  ASSERT_TRUE(repaired) << repaired.error();
  EXPECT_EQ(repaired->mesh.componentCount(), 1U);
  EXPECT_EQ(repaired->mesh.vertexCount(), 45U);
  EXPECT_EQ(repaired->mesh.boundaryLoops().size(), 1U);
}

TEST(CheckMesh, TellsCrossingSurfacesAndRefusals) {
  TOILE_TEST_DATA_OR_SKIP(path, "dirty/expected.json");
  const std::filesystem::path folder = path.parent_path();
  const ReadMeshOptions mm{.unit = FileUnit::Millimetre};
  for (const char* file : {"self_intersecting.obj", "self_intersecting_one.obj"}) {
    const Result<MeshCheck> check = checkMesh(folder / file, mm);
    ASSERT_TRUE(check) << check.error();
    ASSERT_FALSE(check->findings.empty());
    EXPECT_EQ(check->findings.back().code, "faces-cross") << file;
  }
  const Result<MeshCheck> fin = checkMesh(folder / "nonmanifold_edge.obj", mm);
  ASSERT_TRUE(fin) << fin.error();
  ASSERT_TRUE(fin->refusal);
  EXPECT_EQ(fin->refusal->code, ErrorCode::NotManifold);
  EXPECT_FALSE(checkMesh(folder / "empty.obj", mm));
  const Result<MeshCheck> good = checkMesh(folder / "sphere_binary.stl", mm);
  ASSERT_TRUE(good) << good.error();
  EXPECT_TRUE(good->findings.empty());
  EXPECT_EQ(good->facts.back(), "closed, 1 part, 0 handles");
}

// The data's own checks say 0 crossing pairs for the bodies.
TEST(CheckMesh, FindsNothingWrongWithABody) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/female_average.ply");
  const Result<MeshCheck> check = checkMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(check) << check.error();
  EXPECT_TRUE(check->findings.empty());
}

}  // namespace
}  // namespace toile
