// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "support/meshes.h"

namespace toile {
namespace {

using std::numbers::pi;

struct Expected {
  std::size_t faces;
  std::int64_t euler;
  std::size_t loops;
};

void expectShape(const Mesh& mesh, const Expected& expected) {
  EXPECT_EQ(mesh.faceCount(), expected.faces);
  EXPECT_EQ(mesh.eulerCharacteristic(), expected.euler);
  EXPECT_EQ(mesh.boundaryLoops().size(), expected.loops);
  EXPECT_EQ(mesh.componentCount(), 1U);
}

double signedVolume(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles()) {
    six += mesh.position(a).dot(mesh.position(b).cross(mesh.position(c)));
  }
  return six / 6;
}

double totalArea(const Mesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) area += mesh.area(FaceId(f));
  return area;
}

TEST(MadeUpMeshes, HaveTheTopologyTheyPromise) {
  expectShape(test::grid(4, 3), {24, 1, 1});
  expectShape(test::irregularGrid(6, 6), {72, 1, 1});
  expectShape(test::saddle(8), {128, 1, 1});
  expectShape(test::coneStrip(50, 150, 12, 4, 0.4), {96, 1, 1});
  expectShape(test::cylinder(50, 200, 16, 5), {160, 0, 2});
  expectShape(test::halfCylinder(50, 200, 16, 5), {160, 1, 1});
  expectShape(test::closedCylinder(50, 200, 16, 5), {192, 2, 0});
  expectShape(test::cube(100, 4), {192, 2, 0});
  expectShape(test::icosphere(100, 2), {320, 2, 0});
  expectShape(test::torus(100, 30, 20, 12), {480, 0, 0});
  expectShape(test::trousers(16, 12), {2 * 2 * 16 * 12 + 2 * 16 * 8, -1, 3});
  const Mesh cap = test::sphereCap(100, 3, 0.3);
  EXPECT_EQ(cap.eulerCharacteristic(), 1);
}

TEST(MadeUpMeshes, AreAsLargeAsTheyShouldBeAndOutsideOut) {
  EXPECT_NEAR(totalArea(test::irregularGrid(6, 5, 10)), 3000, 1e-9);
  EXPECT_NEAR(signedVolume(test::cube(100, 4)), 1e6, 1e-6);
  EXPECT_NEAR(signedVolume(test::icosphere(10, 4)) / (4.0 / 3 * pi * 1000), 1, 0.01);
  EXPECT_NEAR(signedVolume(test::torus(100, 30, 60, 40)) / (2 * pi * pi * 100 * 900), 1, 0.01);
  EXPECT_NEAR(totalArea(test::halfCylinder(80, 300, 24, 10)), 300 * 24 * 160 * std::sin(pi / 48),
              1e-6);
  EXPECT_GT(test::grid(2, 2).normal(FaceId(0)).z(), 0.999);
  const Mesh leg = test::trousers();
  EXPECT_GT(leg.normal(FaceId(0)).dot(leg.position(leg.vertices(FaceId(0))[0]) -
                                      Eigen::Vector3d(110, 0, 0)),
            0);
}

}  // namespace
}  // namespace toile
