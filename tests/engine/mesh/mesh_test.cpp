// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/result_printing.h"

namespace toile {
namespace {

Triangle triangle(std::size_t a, std::size_t b, std::size_t c) {
  return {VertexId(a), VertexId(b), VertexId(c)};
}

std::vector<Eigen::Vector3d> cornersOfABox(std::size_t count) {
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < count; ++i) {
    positions.emplace_back(static_cast<double>(i & 1U), static_cast<double>((i >> 1U) & 1U),
                           static_cast<double>(i >> 2U));
  }
  return positions;
}

Result<Mesh> tetrahedron() {
  return makeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                  {triangle(0, 2, 1), triangle(0, 1, 3), triangle(1, 2, 3), triangle(2, 0, 3)});
}

TEST(Mesh, CountsAndTurnsAroundATetrahedron) {
  const Result<Mesh> mesh = tetrahedron();
  ASSERT_TRUE(mesh) << mesh.error();
  EXPECT_EQ(mesh->edgeCount(), 6U);
  EXPECT_EQ(mesh->eulerCharacteristic(), 2);
  EXPECT_EQ(mesh->componentCount(), 1U);
  EXPECT_TRUE(mesh->boundaryLoops().empty());
  for (std::size_t i = 0; i < mesh->halfedgeCount(); ++i) {
    const HalfedgeId h(i);
    EXPECT_EQ(mesh->opposite(mesh->opposite(h)), h);
    EXPECT_EQ(mesh->from(mesh->opposite(h)), mesh->to(h));
    EXPECT_EQ(mesh->findEdge(mesh->to(h), mesh->from(h)), mesh->edge(h));
    EXPECT_EQ(mesh->previous(mesh->next(h)), h);
  }
  for (std::size_t v = 0; v < 4; ++v) EXPECT_EQ(mesh->facesAround(VertexId(v)).size(), 3U);
}

TEST(Mesh, EdgesRunFromTheSmallerVertex) {
  const Result<Mesh> mesh = tetrahedron();
  for (std::size_t i = 0; i < mesh->edgeCount(); ++i) {
    const EdgeId e(i);
    EXPECT_LT(mesh->tail(e), mesh->head(e));
    EXPECT_EQ(mesh->from(mesh->halfedge(e)), mesh->tail(e));
  }
  EXPECT_FALSE(mesh->findEdge(VertexId(0), VertexId(0)).isValid());
}

TEST(Mesh, WalksTheBorderWithTheSurfaceOnTheLeft) {
  // A square of two triangles: one loop, counter-clockwise.
  const Result<Mesh> mesh = makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                     {triangle(0, 1, 2), triangle(0, 2, 3)});
  ASSERT_TRUE(mesh);
  const auto loops = mesh->boundaryLoops();
  ASSERT_EQ(loops.size(), 1U);
  ASSERT_EQ(loops[0].size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(mesh->from(loops[0][k]), VertexId(k));
  EXPECT_EQ(mesh->facesAround(VertexId(0)), (std::vector<FaceId>{FaceId(0), FaceId(1)}));
  EXPECT_EQ(mesh->eulerCharacteristic(), 1);
}

TEST(Mesh, RefusesAnEdgeWithThreeFacesAndNamesIt) {
  const Result<Mesh> mesh =
      makeMesh(cornersOfABox(5), {triangle(0, 1, 2), triangle(1, 0, 3), triangle(0, 1, 4)});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::NotManifold);
  EXPECT_EQ(mesh.error().where,
            (std::vector<Element>{Element::vertex(VertexId(0)), Element::vertex(VertexId(1))}));
}

TEST(Mesh, RefusesABowTieAndNamesItsVertex) {
  const Result<Mesh> mesh = makeMesh(cornersOfABox(5), {triangle(0, 1, 2), triangle(0, 3, 4)});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::NotManifold);
  EXPECT_EQ(mesh.error().where, std::vector<Element>{Element::vertex(VertexId(0))});
}

TEST(Mesh, RefusesNeighboursThatAreOrientedAgainstEachOther) {
  const Result<Mesh> mesh = makeMesh(cornersOfABox(4), {triangle(0, 1, 2), triangle(0, 1, 3)});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::NotOrientable);
}

TEST(Mesh, RefusesBadInputWithItsElement) {
  const auto code = [](const Result<Mesh>& mesh) { return mesh.error().code; };
  EXPECT_EQ(code(makeMesh({}, {})), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(makeMesh(cornersOfABox(3), {triangle(0, 1, 3)})), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(makeMesh(cornersOfABox(4), {triangle(0, 1, 2)})), ErrorCode::InvalidArgument);
  EXPECT_EQ(code(makeMesh(cornersOfABox(2), {triangle(0, 1, 1)})), ErrorCode::DegenerateFace);
  auto positions = cornersOfABox(3);
  positions[1].x() = std::numeric_limits<double>::quiet_NaN();
  const Result<Mesh> mesh = makeMesh(positions, {triangle(0, 1, 2)});
  EXPECT_EQ(mesh.error().where, std::vector<Element>{Element::vertex(VertexId(1))});
}

TEST(Mesh, ConnectivityHashIgnoresPositionsAndSeesTheOrder) {
  const Result<Mesh> mesh = tetrahedron();
  auto positions = mesh->positions();
  for (auto& p : positions) p *= 2;
  EXPECT_EQ(mesh->withPositions(positions).connectivityHash(), mesh->connectivityHash());
  const Result<Mesh> other = makeMesh(
      positions, {triangle(2, 1, 0), triangle(0, 1, 3), triangle(1, 2, 3), triangle(2, 0, 3)});
  ASSERT_TRUE(other);
  EXPECT_NE(other->connectivityHash(), mesh->connectivityHash());
}

}  // namespace
}  // namespace toile
