// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/warp/warp.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/dress_block.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/parallel.h"
#include "toile/mesh/mesh_check.h"
#include "toile/mesh/mesh_file.h"
#include "toile/pipeline/carry.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

ReferenceModel builtin(const std::string& reference) {
  Result<ReferenceModel> model = makeBuiltinModel(reference);
  EXPECT_TRUE(model) << model.error();
  return *std::move(model);
}

/// A block with 30 mm of ease, and the body that it was made around.
class DressBlock : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    woman_ = builtin("builtin:body@1?size=EU38F");
    block_ = makeReferenceModel("block", test::dressBlock(woman_, 30));
  }
  static void TearDownTestSuite() {
    woman_ = {};
    block_ = {};
  }

  static WarpGirth girth(const std::string& name, std::optional<Length> ease = std::nullopt) {
    return {name, woman_.curves.at(name), ease};
  }
  static Result<Warp> warpTo(const ReferenceModel& body, const WarpOptions& options) {
    const auto map = Correspondence::onOneConnectivity(woman_.index, body.index);
    EXPECT_TRUE(map) << map.error();
    return warpProduct(block_, woman_, body, *map, options);
  }

  static inline ReferenceModel woman_, block_;
};

double farthest(const Mesh& a, const Mesh& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.vertexCount(); ++v) {
    most = std::max(most, (a.position(VertexId(v)) - b.position(VertexId(v))).norm());
  }
  return most;
}

/// Distances measured by other means than the warp's own: where its line over a girth lies was
/// found on the first body, at other places of the girth than those that were prescribed.
double largestEaseError(const ReferenceModel& before, const ReferenceModel& after,
                        const ReferenceModel& a, const ReferenceModel& b, const WarpGirth& girth) {
  double worst = 0;
  for (int i = 0; i < 211; ++i) {
    const SurfacePoint place = pointAtFraction(*a.mesh, girth.path, (i + 0.37) / 211);
    const SurfacePoint over = before.index->closestPoint(position(*a.mesh, place)).point;
    const double was = a.index->closestPoint(position(*before.mesh, over)).distance;
    const double is = b.index->closestPoint(position(*after.mesh, over)).distance;
    worst = std::max(worst, std::abs(is - (girth.ease ? girth.ease->mm() : was)));
  }
  return worst;
}

/// Whether a point is inside a closed surface, by counting.
bool isInside(const ReferenceModel& body, const Eigen::Vector3d& p) {
  return body.index->rayHits(p, Eigen::Vector3d(0.3, 0.2, 0.93)).size() % 2 == 1;
}

TEST_F(DressBlock, StaysWhereTheBodyIsTheSame) {
  const Result<Warp> warp = warpTo(woman_, {.girths = {girth("waist_girth")}});
  ASSERT_TRUE(warp) << warp.error();
  EXPECT_TRUE(warp->report.isOk());
  EXPECT_LT(farthest(*warp->product.mesh, *block_.mesh), 1e-9);
}

TEST_F(DressBlock, GoesAlongWithARigidMotion) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(300, -120, 45);
  const Result<ReferenceModel> moved =
      withMesh(woman_, "moved", test::transformed(*woman_.mesh, turn, shift));
  ASSERT_TRUE(moved) << moved.error();
  const Result<Warp> warp = warpTo(*moved, {.girths = {girth("hip_girth")}});
  ASSERT_TRUE(warp) << warp.error();
  EXPECT_TRUE(warp->report.isOk());
  EXPECT_LT(farthest(*warp->product.mesh, test::transformed(*block_.mesh, turn, shift)), 1e-7);
}

TEST_F(DressBlock, KeepsItsEaseAtTheGirthsOfTwoOtherBodies) {
  const WarpOptions options{
      .girths = {girth("bust_girth"), girth("waist_girth"), girth("hip_girth")}};
  for (const std::string name : {"builtin:body@1?size=EU46F", "builtin:body@1?size=EU54M"}) {
    const ReferenceModel body = builtin(name);
    const Result<Warp> warp = warpTo(body, options);
    ASSERT_TRUE(warp) << warp.error();
    for (const Finding& reason : warp->report.reasons) ADD_FAILURE() << name << reason.message;
    for (const WarpGirth& each : options.girths) {
      EXPECT_LT(largestEaseError(block_, warp->product, woman_, body, each), 1)
          << name << " " << each.name;
    }
    const Mesh& mesh = *warp->product.mesh;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
      ASSERT_FALSE(isInside(body, mesh.position(VertexId(v)))) << name << " v" << v;
    }
    EXPECT_TRUE(findCrossingFaces(mesh).empty()) << name;
    // Around a larger body it is larger by about as much, not stretched with it.
    for (const WarpedGirth& each : warp->report.girths) {
      const double more = each.bodyAfter - each.bodyBefore;
      EXPECT_GT(more, 60) << name << " " << each.name;
      EXPECT_NEAR(each.productAfter - each.productBefore, more, 0.25 * more + 5)
          << name << " " << each.name;
    }
  }
}

TEST_F(DressBlock, TakesAnEaseThatIsGiven) {
  const ReferenceModel body = builtin("builtin:body@1?size=EU44F");
  const WarpGirth waist = girth("waist_girth", Length::mm(60)), hip = girth("hip_girth");
  const Result<Warp> warp = warpTo(body, {.girths = {waist, hip}});
  ASSERT_TRUE(warp) << warp.error();
  EXPECT_TRUE(warp->report.isOk());
  EXPECT_LT(largestEaseError(block_, warp->product, woman_, body, waist), 1);
  EXPECT_LT(largestEaseError(block_, warp->product, woman_, body, hip), 1);
}

TEST_F(DressBlock, KeepsRigidPartsRigid) {
  std::vector<VertexId> band;
  for (std::size_t v = 0; v < 4 * 72; ++v) band.emplace_back(v);
  const Result<Warp> warp =
      warpTo(builtin("builtin:body@1?size=EU42F"), {.girths = {}, .rigid = {band}});
  ASSERT_TRUE(warp) << warp.error();
  EXPECT_GT(farthest(*warp->product.mesh, *block_.mesh), 5);
  const auto apart = [&](const ReferenceModel& model, std::size_t i, std::size_t j) {
    return (model.mesh->position(VertexId(i)) - model.mesh->position(VertexId(j))).norm();
  };
  for (std::size_t i = 0; i < band.size(); i += 7) {
    for (std::size_t j = 0; j < i; j += 5) {
      EXPECT_NEAR(apart(warp->product, i, j), apart(block_, i, j), 1e-9);
    }
  }
  EXPECT_EQ(warp->report.folds, 0U);
}

// But for where along a girth its samples lie, 3 mm and more apart. Between the breasts the body's
// nearest point is on either of them.
TEST_F(DressBlock, StaysSymmetricOnSymmetricBodies) {
  const Result<Warp> warp =
      warpTo(builtin("builtin:body@1?size=EU46F"), {.girths = {girth("waist_girth")}});
  ASSERT_TRUE(warp) << warp.error();
  const Mesh& mesh = *warp->product.mesh;
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const std::size_t row = v / 72, column = v % 72;
    const Eigen::Vector3d& p = mesh.position(VertexId(v));
    const Eigen::Vector3d& q = mesh.position(VertexId(row * 72 + (108 - column) % 72));
    ASSERT_LT((p - Eigen::Vector3d(-q.x(), q.y(), q.z())).norm(), row < 30 ? 0.15 : 1) << "v" << v;
  }
}

TEST_F(DressBlock, IsTheSameForAnyNumberOfThreads) {
  const ReferenceModel body = builtin("builtin:body@1?size=EU42F");
  std::vector<std::string> texts;
  for (const std::size_t threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    const Result<Warp> warp = warpTo(body, {.girths = {girth("hip_girth")}});
    ASSERT_TRUE(warp) << warp.error();
    texts.push_back(writePly(*warp->product.mesh) + writeWarpReport(*warp));
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST_F(DressBlock, SaysWhenGirthsContradictEachOther) {
  const Result<Warp> warp = warpTo(
      builtin("builtin:body@1?size=EU42F"),
      {.girths = {girth("waist_girth", Length::mm(20)), girth("waist_girth", Length::mm(40))}});
  ASSERT_TRUE(warp) << warp.error();
  ASSERT_FALSE(warp->report.isOk());
  EXPECT_EQ(warp->report.reasons.front().code, "warp-ease");
  const auto json = nlohmann::json::parse(writeWarpReport(*warp));
  EXPECT_EQ(json["format"], "toile-warp");
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["girths"].size(), 2U);
}

TEST_F(DressBlock, IsRefusedWhereItDoesNotStandAroundTheBody) {
  const ReferenceModel body = builtin("builtin:body@1?size=EU42F");
  const auto map = Correspondence::onOneConnectivity(woman_.index, body.index);
  const auto refusal = [&](const Mesh& mesh, const WarpOptions& options = {}) {
    const Result<Warp> warp =
        warpProduct(makeReferenceModel("block", mesh), woman_, body, *map, options);
    return warp ? Error{} : warp.error();
  };
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const auto away = refusal(test::transformed(*block_.mesh, one, {1500, 0, 0}));
  EXPECT_EQ(away.code, ErrorCode::InvalidArgument);
  EXPECT_NE(away.message.find("mm away"), std::string::npos) << away.message;
  const auto metres = refusal(test::transformed(*block_.mesh, one / 1000, {0, 0, 0}));
  EXPECT_EQ(metres.code, ErrorCode::UnitsMissing) << metres.message;
  const auto inside = refusal(test::dressBlock(woman_, -35));
  EXPECT_EQ(inside.code, ErrorCode::InvalidArgument);
  EXPECT_NE(inside.message.find("inside"), std::string::npos) << inside.message;
  EXPECT_FALSE(inside.where.empty());
  const std::vector<VertexId> part{VertexId(0U), VertexId(1U), VertexId(2U)};
  EXPECT_EQ(refusal(*block_.mesh, {.girths = {}, .rigid = {part, part}}).where,
            std::vector<Element>{Element::vertex(VertexId(0U))});
}

TEST(Last, GoesFromFootToFoot) {
  TOILE_TEST_DATA_OR_SKIP(last, "lasts/last_female_average_flat_l.ply");
  const auto read = [](const std::filesystem::path& file) {
    return readModel(file, FileUnit::Millimetre).value();
  };
  const std::filesystem::path feet = test::testDataFolder() / "feet";
  const ReferenceModel product = read(last), own = read(feet / "foot_female_average_l.ply");
  // The ball girth and the instep, level cuts across the foot's length, 220 mm.
  WarpOptions options;
  for (const auto& [name, y] : {std::pair{"ball", -150.0}, {"instep", -110.0}}) {
    options.girths.push_back(
        {name, own.index->planeSection(Eigen::Vector3d::UnitY(), y).front(), std::nullopt});
  }
  for (const std::string name : {"foot_male_average_l", "foot_male_wide_l", "foot_child_10y_l"}) {
    const ReferenceModel foot = read(feet / (name + ".ply"));
    const Result<MappedModels> mapped = mapToModel(own, foot);
    ASSERT_TRUE(mapped) << mapped.error();
    const Result<Warp> warp = warpProduct(product, own, foot, mapped->map, options);
    ASSERT_TRUE(warp) << warp.error();
    for (const Finding& reason : warp->report.reasons) ADD_FAILURE() << name << reason.message;
    for (const WarpGirth& girth : options.girths) {
      EXPECT_LT(largestEaseError(product, warp->product, own, foot, girth), 1)
          << name << " " << girth.name;
    }
  }
}

}  // namespace
}  // namespace toile
