// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/model/guiding_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "model/conformal_map.h"
#include "support/meshes.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double flatArea(const std::array<Vector2d, 3>& t) {
  const Vector2d a = t[1] - t[0];
  const Vector2d b = t[2] - t[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

std::vector<double> areasOf(const Mesh& mesh, const GuidingMap& map, bool flat) {
  std::vector<double> areas(map.charts.size(), 0);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    areas[map.chartOf[FaceId(f)]] += flat ? flatArea(map.corners[FaceId(f)]) : mesh.area(FaceId(f));
  return areas;
}

/// A closed body: a tube along z with the mirror plane x = 0, faces at +-y.
ReferenceModel standingTube() {
  const Mesh mesh = test::transformed(test::closedCylinder(100, 800, 32, 40),
                                      Vector3d(1.4, 1, 1).asDiagonal(), Vector3d::Zero());
  ReferenceModel model = makeReferenceModel("tube", mesh);
  auto partner = findSymmetryPairing(mesh, Vector3d::UnitX(), 0, 1e-6);
  EXPECT_TRUE(partner);
  model.symmetry = Symmetry{Vector3d::UnitX(), 0, std::move(*partner)};
  return model;
}

// A half tube unrolls: the conformal map is the isometry, up to the size of the triangles.
TEST(ConformalMap, UnrollsAHalfCylinder) {
  const Mesh mesh = test::halfCylinder(80, 300, 24, 20);
  detail::ConformalPatch patch;
  patch.positions = mesh.positions();
  for (const Triangle& t : mesh.triangles())
    patch.triangles.push_back({t[0].index(), t[1].index(), t[2].index()});
  for (const Vector3d& p : mesh.positions()) patch.start.emplace_back(-p.x(), p.z());
  const std::vector<Vector2d> places = detail::conformalMap(patch);
  ASSERT_EQ(places.size(), mesh.vertexCount());
  double least = 1e300;
  double most = 0;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const Vector2d d = places[mesh.tail(EdgeId(e)).index()] - places[mesh.head(EdgeId(e)).index()];
    const double ratio = d.norm() / mesh.length(EdgeId(e));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_LT(most / least, 1 + 1e-4);
}

TEST(GuidingMap, PartsABodyIntoFrontAndBack) {
  const ReferenceModel model = standingTube();
  const GuidingMap map = makeGuidingMap(model);
  // The ends are sharp turns with much area: charts of their own.
  std::set<std::string> names;
  for (const MapChart& chart : map.charts) names.insert(chart.name);
  EXPECT_EQ(names, (std::set<std::string>{"front", "back", "top", "bottom"}));
  for (std::size_t f = 0; f < model.mesh->faceCount(); ++f) {
    const double y = model.mesh->normal(FaceId(f)).y();
    if (std::abs(y) < 0.3) continue;
    EXPECT_EQ(map.charts[map.chartOf[FaceId(f)]].name, y < 0 ? "front" : "back");
  }
}

TEST(GuidingMap, IsAsLargeAsTheModelUprightAndNotMirrored) {
  const ReferenceModel model = standingTube();
  const GuidingMap map = makeGuidingMap(model);
  const std::vector<double> flat = areasOf(*model.mesh, map, true);
  const std::vector<double> solid = areasOf(*model.mesh, map, false);
  for (std::size_t c = 0; c < map.charts.size(); ++c)
    EXPECT_NEAR(flat[c], solid[c], 1e-6 * solid[c]) << map.charts[c].name;
  double correlation = 0;
  for (std::size_t f = 0; f < model.mesh->faceCount(); ++f) {
    const std::array<Vector2d, 3>& corners = map.corners[FaceId(f)];
    EXPECT_GT(flatArea(corners), 0) << "face " << f;
    const MapChart& chart = map.charts[map.chartOf[FaceId(f)]];
    const double across = chart.side == MapSide::Back ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = model.mesh->position(model.mesh->vertices(FaceId(f))[k]);
      const bool isSide = chart.name == "front" || chart.name == "back";
      if (isSide && std::abs(p.x()) > 60) {
        EXPECT_GT(across * p.x() * corners[k].x(), 0);
      }
      correlation += (p.z() - 400) * (corners[k].y() - 400);
    }
  }
  EXPECT_GT(correlation, 0);
}

TEST(GuidingMap, MirroredFacesLieAtMirroredPlacesBitForBit) {
  const ReferenceModel model = standingTube();
  const GuidingMap map = makeGuidingMap(model);
  const Mesh& mesh = *model.mesh;
  std::size_t compared = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    // The face of the mirrored corners.
    std::vector<FaceId> around = mesh.facesAround(model.symmetry->partner[t[0]]);
    for (const FaceId g : around) {
      std::array<std::size_t, 3> at{};
      bool isImage = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle& u = mesh.vertices(g);
        const auto found = std::find(u.begin(), u.end(), model.symmetry->partner[t[k]]);
        isImage = isImage && found != u.end();
        at[k] = static_cast<std::size_t>(found - u.begin());
      }
      if (!isImage) continue;
      ++compared;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d& p = map.corners[FaceId(f)][k];
        EXPECT_EQ(map.corners[g][at[k]], Vector2d(-p.x(), p.y()));
      }
    }
  }
  EXPECT_EQ(compared, mesh.faceCount());
}

TEST(GuidingMap, PartsAtTheModelsOwnCurves) {
  ReferenceModel model = standingTube();
  const std::array<std::string, 1> none{"waist"};
  const auto refused = makeGuidingMap(model, none);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NameNotFound);
  // A ring of vertices at z = 400: 32 a row, 20 rows up.
  SurfacePath ring;
  ring.closed = true;
  for (std::size_t i = 0; i < 32; ++i) {
    const VertexId v(20 * 32 + i);
    const VertexId next(20 * 32 + (i + 1) % 32);
    ASSERT_NEAR(model.mesh->position(v).z(), 400, 1e-9);
    ring.points.push_back({v});
    ring.faceOfSegment.push_back(commonFace(*model.mesh, {v}, {next}));
  }
  model.curves["waist"] = ring;
  const auto map = makeGuidingMap(model, none);
  ASSERT_TRUE(map) << map.error();
  for (std::size_t f = 0; f < model.mesh->faceCount(); ++f) {
    double z = 0;
    for (const VertexId v : model.mesh->vertices(FaceId(f))) z += model.mesh->position(v).z() / 3;
    for (std::size_t g = 0; g < f; g += 7) {
      if (map->chartOf[FaceId(f)] != map->chartOf[FaceId(g)]) continue;
      double other = 0;
      for (const VertexId v : model.mesh->vertices(FaceId(g)))
        other += model.mesh->position(v).z() / 3;
      ASSERT_EQ(z < 400, other < 400) << f << " and " << g;
    }
  }
}

TEST(GuidingMap, ReadsBackBitForBit) {
  const ReferenceModel model = standingTube();
  const GuidingMap map = makeGuidingMap(model);
  const auto again = parseGuidingMap(model, writeGuidingMap(*model.mesh, map), "tube.model.json");
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(*again, map);
}

TEST(GuidingMap, RefusesWhatDoesNotFit) {
  const ReferenceModel model = makeReferenceModel("grid", test::grid(1, 1));
  const auto code = [&](const std::string& text) {
    const auto map = parseGuidingMap(model, text, "x.json");
    return map ? ErrorCode::Cancelled : map.error().code;
  };
  const std::string places = R"("places":[[0,0],[1,0],[0,1],[1,1]])";
  EXPECT_EQ(code("{}"), ErrorCode::FileFormat);
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[]}})"), ErrorCode::FileFormat);
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[{"name":"a","side":"front","faces":[0],)"
                 R"("places":[[0,0],[1,0],[0,1]]}]}})"),
            ErrorCode::FileFormat);  // face 1 is on no chart
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[{"name":"a","side":"front","faces":[0,2],)" + places +
                 "}]}}"),
            ErrorCode::FileFormat);
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[{"name":"a","side":"left","faces":[0,1],)" + places +
                 "}]}}"),
            ErrorCode::FileFormat);
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[{"name":"a","side":"front","faces":[0,1],)"
                 R"("places":[[0,0],[1,0],[0,1],[1,1e300]]}]}})"),
            ErrorCode::FileFormat);
  EXPECT_EQ(code(R"({"guidingMap":{"borders":["waist"]}})"), ErrorCode::NameNotFound);
  EXPECT_EQ(code(R"({"guidingMap":{"charts":[{"name":"a","side":"front","faces":[0,1],)" + places +
                 "}]}}"),
            ErrorCode::Cancelled);  // this one is fine
}

// On another body of the same mesh the charts stay and the places follow the new shape.
TEST(GuidingMap, IsCarriedToAnotherShape) {
  ReferenceModel model = standingTube();
  const GuidingMap map = makeGuidingMap(model);
  model.map = std::make_shared<GuidingMapSlot>(map);
  const Mesh taller =
      test::transformed(*model.mesh, Vector3d(1, 1, 1.25).asDiagonal(), Vector3d::Zero());
  const auto other = withMesh(model, "taller", taller);
  ASSERT_TRUE(other) << other.error();
  const std::shared_ptr<const GuidingMap> carried = guidingMap(*other);
  EXPECT_EQ(carried->charts, map.charts);
  EXPECT_EQ(carried->chartOf, map.chartOf);
  const std::vector<double> flat = areasOf(taller, *carried, true);
  const std::vector<double> solid = areasOf(taller, *carried, false);
  for (std::size_t c = 0; c < map.charts.size(); ++c)
    EXPECT_NEAR(flat[c], solid[c], 1e-6 * solid[c]);
}

}  // namespace
}  // namespace toile
