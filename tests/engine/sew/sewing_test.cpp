// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/sew/sewing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "support/hand_made_pattern.h"
#include "support/sample_designs.h"
#include "toile/core/content_hash.h"
#include "toile/io/dxf.h"
#include "toile/io/sewing_files.h"

namespace toile {
namespace {

TEST(SeamLetters, GoOnAfterZ) {
  EXPECT_EQ(seamLetters(1), "A");
  EXPECT_EQ(seamLetters(26), "Z");
  EXPECT_EQ(seamLetters(27), "AA");
  EXPECT_EQ(seamLetters(0), "");
}

TEST(Sewing, PlansTheOneSeamOfTwoPieces) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SewingPlan plan = planSewing(pattern);
  ASSERT_EQ(plan.edges.size(), 2u);
  EXPECT_EQ(plan.edges[0].code, "1A");
  EXPECT_EQ(plan.edges[1].code, "2A");
  EXPECT_EQ(plan.edges[0].mate, 1u);
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].kind, SewStep::Kind::Flat);
  EXPECT_NEAR(plan.totalLength, 200, 1e-9);
  EXPECT_EQ(edgeCodes(pattern, pattern.pieces[0], pattern.pieces[0].runs[plan.edges[0].runs[0]]),
            "1A-2A");
}

class SleeveSewing : public test::SleevePattern {};

TEST_F(SleeveSewing, SewsEverySeamOnceAndFlatBeforeTube) {
  const SewingPlan plan = planSewing(*pattern_);
  ASSERT_GE(plan.steps.size(), 2u);
  std::set<std::uint32_t> edges;
  for (const SewStep& step : plan.steps) {
    EXPECT_TRUE(edges.insert(step.edgeA).second);
    EXPECT_TRUE(edges.insert(step.edgeB).second);
    EXPECT_EQ(plan.edges[step.edgeA].mate, step.edgeB);
  }
  EXPECT_EQ(edges.size(), plan.edges.size());
  // Two pieces with two seams make a tube: the first is sewn flat, the second closes it.
  EXPECT_EQ(plan.steps.front().kind, SewStep::Kind::Flat);
  EXPECT_EQ(plan.steps.back().kind, SewStep::Kind::Tube);
}

class WetsuitSewing : public test::WetsuitPattern {};

/// A place of the article: the pieces' corners that sewing has joined.
class Joined {
 public:
  using Corner = std::array<std::size_t, 3>;  ///< piece, loop, point

  Corner find(const Corner& corner) const {
    Corner at = corner;
    for (auto next = up_.find(at); next != up_.end(); next = up_.find(at)) at = next->second;
    return at;
  }
  /// @return whether they were apart
  bool join(const Corner& a, const Corner& b) {
    if (find(a) == find(b)) return false;
    up_[find(a)] = find(b);
    return true;
  }

 private:
  std::map<Corner, Corner> up_;
};

/// By the Euler characteristic of what is sewn: two ends that were apart become one where parts are
/// joined (both ends) and where neighbours are closed (one). Whatever changes it makes a tube.
TEST_F(WetsuitSewing, IsFlatUntilTheFirstTube) {
  const SewingPlan plan = planSewing(*pattern_);
  ASSERT_EQ(plan.steps.size() * 2, plan.edges.size());
  const auto ends = [&](std::uint32_t e) {
    const SewEdge& edge = plan.edges[e];
    const PatternPiece& piece = pattern_->pieces[edge.piece];
    const OutlineRun& first = piece.runs[edge.runs.front()];
    const OutlineRun& last = piece.runs[edge.runs.back()];
    const std::size_t count = piece.sewLines[first.loop].size();
    return std::array<Joined::Corner, 2>{
        {{edge.piece, first.loop, first.first},
         {edge.piece, last.loop, (last.first + last.edgeCount) % count}}};
  };
  Joined corners;
  Joined parts;
  std::size_t flat = 0;
  for (const SewStep& step : plan.steps) {
    if (step.kind > SewStep::Kind::Flat) break;
    const auto a = ends(step.edgeA);
    const auto b = ends(step.edgeB);
    const int met = corners.join(a[0], b[1]) + corners.join(a[1], b[0]);
    const bool areTwo =
        parts.join({plan.edges[step.edgeA].piece, 0, 0}, {plan.edges[step.edgeB].piece, 0, 0});
    EXPECT_EQ(met, areTwo ? 2 : 1) << plan.edges[step.edgeA].code;
    ++flat;
  }
  // All pieces but one are joined flat before anything is closed.
  EXPECT_GE(flat, pattern_->pieces.size() - 1);
  for (std::size_t i = flat; i < plan.steps.size(); ++i)
    EXPECT_GT(plan.steps[i].kind, SewStep::Kind::Flat) << "step " << i + 1;
  ASSERT_LT(flat, plan.steps.size());
}

TEST_F(SleeveSewing, ContractKeepsBodyTargetPatternAndMate) {
  const std::vector<LengthLine> lines = lengthContract(*pattern_);
  std::size_t sewn = 0;
  for (const LengthLine& line : lines) {
    if (line.rule != LengthRule::Keep) continue;
    EXPECT_NEAR(line.pattern, line.target, kSmoothingMm + 1e-6) << line.piece << " " << line.curve;
    EXPECT_GT(line.body, 0);
    if (line.matePiece.empty()) continue;
    ++sewn;
    EXPECT_NEAR(line.pattern, line.mate, kSmoothingMm + 1e-6);
    EXPECT_DOUBLE_EQ(line.difference, line.pattern - line.mate);
  }
  EXPECT_EQ(sewn, planSewing(*pattern_).edges.size());
}

TEST_F(SleeveSewing, HashChangesWithDesignAndModel) {
  const Document& document = pattern_->document;
  const ContentHash hash = inputsHash(document);
  EXPECT_EQ(inputsHash(document), hash);
  Design changed = *document.design;
  changed.finish.allowance = Length::mm(11);
  EXPECT_NE(inputsHash(test::withDesign(document, changed)), hash);
  auto model = std::make_shared<ReferenceModel>(*document.model);
  std::vector<Eigen::Vector3d> positions(model->mesh->positions().begin(),
                                         model->mesh->positions().end());
  positions.front().x() += 1e-9;
  model->mesh = std::make_shared<const Mesh>(
      *makeMesh(positions, {model->mesh->triangles().begin(), model->mesh->triangles().end()}));
  EXPECT_NE(inputsHash({document.design, model}), hash);
}

TEST_F(SleeveSewing, CheckFindsADamagedCuttingFile) {
  const std::string seams = writeSeamsJson(*pattern_);
  const Result<DxfDrawing> drawing = readDxf(writeDxf(*pattern_).text);
  ASSERT_TRUE(drawing);
  Result<SewingCheck> check = checkSewing(seams, *drawing);
  ASSERT_TRUE(check) << check.error();
  EXPECT_TRUE(check->findings.empty());
  EXPECT_EQ(check->seams.size(), planSewing(*pattern_).steps.size());

  // A piece that somebody scaled by 1 % no longer fits.
  DxfDrawing scaled = *drawing;
  for (DxfEntity& entity : scaled.blocks[0].entities)
    for (Eigen::Vector2d& p : entity.points) p *= 1.01;
  check = checkSewing(seams, scaled);
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->findings.empty());

  // A notch that was moved.
  auto json = nlohmann::json::parse(seams);
  bool moved = false;
  for (auto& edge : json["edges"])
    if (!moved && !edge["notches"].empty()) {
      edge["notches"][0]["at"] = edge["notches"][0]["at"].get<double>() + 3;
      moved = true;
    }
  ASSERT_TRUE(moved);
  check = checkSewing(json.dump(), *drawing);
  ASSERT_TRUE(check);
  ASSERT_EQ(check->findings.size(), 1u);
  EXPECT_EQ(check->findings[0].code, "notches-differ");

  for (const std::string bad : {"", "[", "{}", "{\"format\":\"toile-seams\",\"version\":1}",
                                "{\"format\":\"toile-seams\",\"version\":99}"}) {
    const Result<SewingCheck> refused = checkSewing(bad, *drawing);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::FileFormat);
  }
}

}  // namespace
}  // namespace toile
