// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/surface_point.h"

#include <gtest/gtest.h>

#include "support/result_printing.h"

namespace toile {
namespace {

/// A fan of four triangles around vertex 0 in the plane, corners at (+-10, +-10); closed square.
Mesh squareFan() {
  const auto id = [](std::size_t i) { return VertexId(i); };
  return *makeMesh({{0, 0, 0}, {-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}},
                   {Triangle{id(0), id(1), id(2)}, Triangle{id(0), id(2), id(3)},
                    Triangle{id(0), id(3), id(4)}, Triangle{id(0), id(4), id(1)}});
}

SurfacePoint onEdge(const Mesh& mesh, std::size_t a, std::size_t b, double t) {
  return {SurfacePoint::OnEdge{mesh.findEdge(VertexId(a), VertexId(b)), t}};
}

/// Straight from (-5, -5) across two faces to (5, -5) and on to (5, 5): on edges 0-1, 0-2, 0-3.
SurfacePath bentPath(const Mesh& mesh) {
  return {{onEdge(mesh, 0, 1, 0.5), onEdge(mesh, 0, 2, 0.5), onEdge(mesh, 0, 3, 0.5)},
          {FaceId(0), FaceId(1)},
          false};
}

SurfacePath squarePath(const Mesh& mesh) {
  SurfacePath path = bentPath(mesh);
  path.points.push_back(onEdge(mesh, 0, 4, 0.5));
  path.faceOfSegment = {FaceId(0), FaceId(1), FaceId(2), FaceId(3)};
  path.closed = true;
  return path;
}

TEST(SurfacePoint, TakesTheFormOfItsZeroWeights) {
  const Mesh mesh = squareFan();
  EXPECT_EQ(makeSurfacePoint(mesh, FaceId(1), {0, 0, 1}).at,
            decltype(SurfacePoint::at)(VertexId(3)));
  EXPECT_EQ(makeSurfacePoint(mesh, FaceId(1), {0.25, 0.75, 0}), onEdge(mesh, 0, 2, 0.75));
  EXPECT_EQ(makeSurfacePoint(mesh, FaceId(3), {0, 0.75, 0.25}), onEdge(mesh, 1, 4, 0.75));
  const SurfacePoint inside = makeSurfacePoint(mesh, FaceId(2), {2, 1, 1});
  EXPECT_EQ(facesOf(mesh, inside), std::vector<FaceId>{FaceId(2)});
  EXPECT_TRUE(position(mesh, inside).isApprox(Eigen::Vector3d(0, 5, 0)));
}

TEST(SurfacePoint, ClampsWeightsOutsideTheFace) {
  const Mesh mesh = squareFan();
  EXPECT_EQ(makeSurfacePoint(mesh, FaceId(0), {-1e-17, 0.5, 0.5}), onEdge(mesh, 1, 2, 0.5));
}

TEST(SurfacePoint, EveryFaceOfAPointGivesItsPlace) {
  const Mesh mesh = squareFan();
  for (const SurfacePoint& point : {SurfacePoint{VertexId(0)}, onEdge(mesh, 0, 3, 0.3),
                                    makeSurfacePoint(mesh, FaceId(3), {0.2, 0.3, 0.5})}) {
    for (const FaceId face : facesOf(mesh, point)) {
      const SurfacePoint again = makeSurfacePoint(mesh, face, barycentricIn(mesh, point, face));
      EXPECT_TRUE(position(mesh, again).isApprox(position(mesh, point), 1e-15));
    }
  }
  EXPECT_EQ(facesOf(mesh, {VertexId(0)}).size(), 4U);
  EXPECT_EQ(commonFace(mesh, onEdge(mesh, 0, 2, 0.5), onEdge(mesh, 0, 3, 0.5)), FaceId(1));
  EXPECT_FALSE(commonFace(mesh, onEdge(mesh, 1, 2, 0.5), onEdge(mesh, 3, 4, 0.5)).isValid());
}

TEST(SurfacePoint, RefusesHalfValidPoints) {
  const Mesh mesh = squareFan();
  EXPECT_FALSE(isValid(mesh, {VertexId(5)}));
  EXPECT_FALSE(isValid(mesh, {SurfacePoint::OnEdge{EdgeId(0), 1.0}}));
  EXPECT_FALSE(isValid(mesh, {SurfacePoint::OnEdge{EdgeId(8), 0.5}}));
  EXPECT_FALSE(isValid(mesh, {SurfacePoint::InFace{FaceId(0), {0.5, 0.5, 0}}}));
  EXPECT_FALSE(isValid(mesh, {SurfacePoint::InFace{FaceId(0), {0.5, 0.4, 0.2}}}));
  EXPECT_TRUE(isValid(mesh, bentPath(mesh)));
  SurfacePath offFace = bentPath(mesh);
  offFace.faceOfSegment[0] = FaceId(2);
  EXPECT_FALSE(isValid(mesh, offFace));
}

TEST(SurfacePath, FractionsFollowTheArcLength) {
  const Mesh mesh = squareFan();
  const SurfacePath path = bentPath(mesh);
  EXPECT_DOUBLE_EQ(length(mesh, path), 20);
  EXPECT_TRUE(
      position(mesh, pointAtFraction(mesh, path, 0.25)).isApprox(Eigen::Vector3d(0, -5, 0)));
  EXPECT_EQ(pointAtFraction(mesh, path, 0.5), path.points[1]);
  EXPECT_EQ(pointAtFraction(mesh, path, 1), path.points[2]);
  const SurfacePath square = squarePath(mesh);
  EXPECT_DOUBLE_EQ(length(mesh, square), 40);
  EXPECT_TRUE(
      position(mesh, pointAtFraction(mesh, square, 1.125)).isApprox(Eigen::Vector3d(0, -5, 0)));
}

TEST(SurfacePath, PartsAddUpToTheWhole) {
  const Mesh mesh = squareFan();
  const SurfacePath path = bentPath(mesh);
  const SurfacePath part = subPath(mesh, path, 0.25, 0.75);
  EXPECT_TRUE(isValid(mesh, part));
  EXPECT_DOUBLE_EQ(length(mesh, part), 10);
  EXPECT_EQ(part.points.size(), 3U);
  const SurfacePath reversed = subPath(mesh, path, 0.75, 0.25);
  EXPECT_TRUE(isValid(mesh, reversed));
  EXPECT_EQ(reversed.points.front(), part.points.back());

  const SurfacePath square = squarePath(mesh);
  const SurfacePath wrapped = subPath(mesh, square, 0.875, 0.125);
  EXPECT_TRUE(isValid(mesh, wrapped));
  EXPECT_DOUBLE_EQ(length(mesh, wrapped), 10);
  EXPECT_DOUBLE_EQ(length(mesh, subPath(mesh, square, 0.125, 0.875)), 30);
}

}  // namespace
}  // namespace toile
