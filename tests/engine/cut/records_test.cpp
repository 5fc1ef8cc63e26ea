// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/cut/records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/drawn_curves.h"
#include "support/meshes.h"
#include "support/result_printing.h"

namespace toile {
namespace {

using test::drawn;
using testing::ElementsAre;

/// A strip of cloth 120 x 40 mm, cut across at places along x; records follow as the seams move.
class Strip {
 public:
  Strip() {
    auto model = std::make_shared<ReferenceModel>();
    model->mesh = std::make_shared<const Mesh>(test::grid(12, 4));
    model_ = model;
  }

  [[nodiscard]] const ReferenceModel& model() const { return *model_; }

  [[nodiscard]] CutResult cutAt(const Design& design, const std::vector<double>& places) const {
    std::vector<PlacedCurve> curves;
    for (const double x : places) {
      const auto section = test::planeSections(*model_->mesh, Eigen::Vector3d::UnitX(), x);
      curves.push_back(
          drawn("at" + std::to_string(static_cast<int>(x)), CurveKind::Seam, section.at(0)));
    }
    auto result = cut({std::make_shared<Design>(design), model_}, curves);
    EXPECT_TRUE(result) << result.error();
    return *result;
  }

  [[nodiscard]] double x(const PieceRecord& record) const {
    const auto point = toSurfacePoint(*model_->mesh, std::get<ModelPoint>(record.anchor));
    EXPECT_TRUE(point);
    return position(*model_->mesh, *point).x();
  }

  /// An anchor in the first row of cells.
  static PieceRecord record(std::string id, int column) {
    PieceRecord made;
    made.id = std::move(id);
    made.anchor = ModelPoint{SurfacePoint::InFace{FaceId(static_cast<std::size_t>(2 * column)),
                                                  Eigen::Vector3d(0.3, 0.3, 0.4)}};
    return made;
  }

 private:
  std::shared_ptr<const ReferenceModel> model_;
};

std::vector<std::string> ids(const CutResult& result) {
  std::vector<std::string> found;
  for (const Piece& p : result.pieces) found.push_back(p.id);
  return found;
}

TEST(FollowRecords, TakesThemToTheRegionThatOverlapsMost) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("left", 3), Strip::record("right", 5)};
  const CutResult before = strip.cutAt(design, {43});
  ASSERT_THAT(ids(before), ElementsAre("left", "right"));
  // The seam passes both anchors; by their place alone both would be in the right piece.
  const CutResult after = strip.cutAt(design, {23});
  ASSERT_THAT(ids(after), ElementsAre("left", "piece-1"));
  const auto followed = followRecords(design, before, design, after, strip.model());
  ASSERT_TRUE(followed) << followed.error();
  EXPECT_LT(strip.x(followed->pieces[0]), 23);
  EXPECT_GT(strip.x(followed->pieces[1]), 23);
  EXPECT_THAT(ids(strip.cutAt(*followed, {23})), ElementsAre("left", "right"));
}

TEST(FollowRecords, MovesTheAnchorToTheInmostPoint) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("left", 0), Strip::record("right", 11)};
  const CutResult before = strip.cutAt(design, {43});
  const CutResult after = strip.cutAt(design, {81});
  const auto followed = followRecords(design, before, design, after, strip.model());
  ASSERT_TRUE(followed) << followed.error();
  for (const auto& [r, low, high] : {std::tuple{0, 0.0, 81.0}, std::tuple{1, 81.0, 120.0}}) {
    const auto& record = followed->pieces[static_cast<std::size_t>(r)];
    const auto point = toSurfacePoint(*strip.model().mesh, std::get<ModelPoint>(record.anchor));
    ASSERT_TRUE(point);
    const Eigen::Vector3d p = position(*strip.model().mesh, *point);
    const double depth = std::min({p.x() - low, high - p.x(), p.y(), 40 - p.y()});
    // The middle of a face lies up to two thirds of a cell from the deepest vertex.
    EXPECT_GT(depth, std::min(20.0, (high - low) / 2) - 6.7) << record.id;
  }
}

TEST(FollowRecords, LeavesARecordAloneWhosePieceIsTheSame) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("left", 1), Strip::record("middle", 5), Strip::record("right", 9)};
  const CutResult before = strip.cutAt(design, {33, 71});
  const CutResult after = strip.cutAt(design, {33, 83});
  const auto followed = followRecords(design, before, design, after, strip.model());
  ASSERT_TRUE(followed) << followed.error();
  EXPECT_EQ(followed->pieces[0], design.pieces[0]);
  EXPECT_FALSE(followed->pieces[1] == design.pieces[1]);
  EXPECT_FALSE(followed->pieces[2] == design.pieces[2]);
}

TEST(FollowRecords, GivesADividedPiecesRecordToTheLargerPart) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("whole", 1)};
  const CutResult before = strip.cutAt(design, {});
  const CutResult after = strip.cutAt(design, {37});
  const auto followed = followRecords(design, before, design, after, strip.model());
  ASSERT_TRUE(followed) << followed.error();
  EXPECT_GT(strip.x(followed->pieces[0]), 37);
}

TEST(FollowRecords, KeepsBothRecordsOfJoinedPiecesAndPartsThemAgain) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("left", 1), Strip::record("right", 9)};
  const CutResult before = strip.cutAt(design, {63});
  const CutResult joined = strip.cutAt(design, {});
  const auto one = followRecords(design, before, design, joined, strip.model());
  ASSERT_TRUE(one) << one.error();
  ASSERT_EQ(one->pieces.size(), 2U);
  EXPECT_EQ(one->pieces[1], design.pieces[1]);
  const CutResult both = strip.cutAt(*one, {});
  EXPECT_THAT(both.pieces[0].recordIndices, ElementsAre(0, 1));
  EXPECT_EQ(both.findings.at(0).code, "two-anchors");
}

TEST(FollowRecords, NotesTheBoundingCurvesAgain) {
  const Strip strip;
  Design design;
  design.pieces = {Strip::record("left", 1), Strip::record("right", 9)};
  design.pieces[0].boundary = {"at63", "border"};
  const CutResult before = strip.cutAt(design, {63});
  const CutResult after = strip.cutAt(design, {74});
  const auto followed = followRecords(design, before, design, after, strip.model());
  ASSERT_TRUE(followed) << followed.error();
  EXPECT_THAT(followed->pieces[0].boundary, testing::UnorderedElementsAre("at74", "border"));
  EXPECT_THAT(followed->pieces[1].boundary, testing::IsEmpty());
}

TEST(FollowRecords, LeavesEverythingElseOfTheDesign) {
  const Strip strip;
  Design before;
  before.pieces = {Strip::record("left", 1)};
  Design after = before;
  after.name = "renamed";
  after.pieces.push_back(Strip::record("new", 9));
  const auto followed = followRecords(before, strip.cutAt(before, {}), after,
                                      strip.cutAt(after, {63}), strip.model());
  ASSERT_TRUE(followed) << followed.error();
  Design expected = after;
  expected.pieces[0].anchor = followed->pieces[0].anchor;
  EXPECT_EQ(*followed, expected);
}

TEST(FollowRecords, RefusesACutOfAnotherModel) {
  const Strip strip;
  const Design design;
  const CutResult cut = strip.cutAt(design, {});
  ReferenceModel small;
  small.mesh = std::make_shared<const Mesh>(test::grid(2, 2));
  const auto followed = followRecords(design, cut, design, cut, small);
  ASSERT_FALSE(followed);
  EXPECT_EQ(followed.error().code, ErrorCode::ModelMismatch);
}

}  // namespace
}  // namespace toile
