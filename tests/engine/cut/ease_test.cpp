// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/drawn_curves.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "toile/cut/cut.h"
#include "toile/unfold/unfold.h"

namespace toile {
namespace {

/// A tube of radius 80 and height 200 around z, in two halves of different cloth.
class EaseOfATube : public testing::Test {
 protected:
  static constexpr int kSegments = 32, kRows = 10;

  EaseOfATube() : model_(std::make_shared<ReferenceModel>()) {
    model_->mesh = std::make_shared<const Mesh>(test::cylinder(80, 200, kSegments, kRows));
    design_.fabrics.resize(2);
    design_.fabrics[0].id = "first";
    design_.fabrics[1].id = "second";
    for (const char* id : {"a", "b"}) {
      PieceRecord record;
      record.id = id;
      const std::size_t half = model_->mesh->faceCount() / 2;
      // Faces come row by row, two per segment.
      const FaceId face(half + (id[0] == 'a' ? 4 : kSegments + 4));
      record.anchor = ModelPoint{SurfacePoint::InFace{face, Eigen::Vector3d(0.25, 0.25, 0.5)}};
      record.fabric = id[0] == 'a' ? "first" : "second";
      design_.pieces.push_back(record);
    }
  }

  [[nodiscard]] Result<CutResult> cutIt() const {
    std::vector<PlacedCurve> seams;
    for (const int column : {0, kSegments / 2}) {
      std::vector<VertexId> way;
      for (int row = 0; row <= kRows; ++row) {
        way.emplace_back(static_cast<std::size_t>(row * kSegments + column));
      }
      seams.push_back(test::drawn(column == 0 ? "front" : "back", CurveKind::Seam,
                                  test::edgePath(*model_->mesh, way)));
    }
    return cut({std::make_shared<const Design>(design_), model_}, seams);
  }

  static double ratio(const Piece& piece, const std::string& curve) {
    double target = 0, body = 0;
    for (const Wire& wire : piece.wires) {
      if (wire.curve != curve) continue;
      for (const double length : wire.targetLength) target += length;
      for (const double length : wire.bodyLength) body += length;
    }
    return target / body;
  }

  static void expectEqualMates(const CutResult& result) {
    ASSERT_EQ(result.mates.size(), 2U);
    for (const SeamMates& mates : result.mates) {
      std::vector<double> back = result.pieces[mates.pieceB].wires[mates.wireB].targetLength;
      std::reverse(back.begin(), back.end());
      EXPECT_EQ(result.pieces[mates.pieceA].wires[mates.wireA].targetLength, back);
    }
  }

  std::shared_ptr<ReferenceModel> model_;
  Design design_;
};

TEST_F(EaseOfATube, NoneLeavesTheBodysLengthsBitForBit) {
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  ASSERT_EQ(result->pieces[0].id, "a");
  for (const Piece& piece : result->pieces) {
    EXPECT_TRUE(piece.targetSides.empty());
    for (const Wire& wire : piece.wires) EXPECT_EQ(wire.targetLength, wire.bodyLength);
  }
}

TEST_F(EaseOfATube, ActsByDirectionAndSeamsTakeTheMean) {
  design_.fabrics[0].ease.girth = Ratio::percent(-10);
  design_.fabrics[0].ease.length = Ratio::percent(2);
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  const Piece& a = result->pieces[0];
  const Piece& b = result->pieces[1];
  EXPECT_NEAR(ratio(a, "border"), 0.9, 1e-12);
  EXPECT_NEAR(ratio(b, "border"), 1, 1e-15);
  EXPECT_NEAR(ratio(a, "front"), 1.01, 1e-12);
  expectEqualMates(*result);
  const Result<FlatPiece> flat = unfold(a);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LT(flat->meanAreaError, 0.01) << "ease is no strain: only the seams' mean is";
}

// Where all cloth wants the same, it is cut smaller without any strain.
TEST_F(EaseOfATube, TheSameOnBothSidesUnrollsWithoutStrain) {
  for (Fabric& fabric : design_.fabrics) {
    fabric.ease.girth = Ratio::percent(-10);
    fabric.ease.length = Ratio::percent(-3);
  }
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  const Result<FlatPiece> flat = unfold(result->pieces[0]);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_LT(flat->maxAreaError, 1e-6);
  EXPECT_NEAR(ratio(result->pieces[0], "front"), 0.97, 1e-12);
}

TEST_F(EaseOfATube, ThePieceCountsBeforeItsFabric) {
  design_.fabrics[0].ease.girth = Ratio::percent(-10);
  design_.pieces[0].ease = Ease{Ratio::percent(5), Ratio::percent(5), "z", {}};
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  EXPECT_NEAR(ratio(result->pieces[0], "border"), 1.05, 1e-12);
}

TEST_F(EaseOfATube, DirectionsAreAxesOrCurvesOfTheModel) {
  std::vector<VertexId> way;
  for (int column = 0; column < kSegments; ++column) {
    way.emplace_back(static_cast<std::size_t>(5 * kSegments + column));
  }
  model_->curves["waist"] = test::edgePath(*model_->mesh, way, true);
  // Along the waist the length is what was the girth along z; its polygon's chords turn a little.
  design_.pieces[0].ease = Ease{Ratio::percent(2), Ratio::percent(-10), "waist", {}};
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  EXPECT_NEAR(ratio(result->pieces[0], "border"), 0.9, 1e-3);
  EXPECT_NEAR(ratio(result->pieces[0], "front"), 1.01, 1e-3);

  design_.pieces[0].ease->along = "waste";
  const Result<CutResult> refused = cutIt();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NameNotFound);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("waist"));
}

TEST_F(EaseOfATube, ThicknessCountsLengthsWithinTheCloth) {
  design_.fabrics[0].thickness = Length::mm(4);
  design_.fabrics[0].thicknessOffset = Ratio::percent(50);
  const Result<CutResult> result = cutIt();
  ASSERT_TRUE(result) << result.error();
  EXPECT_NEAR(ratio(result->pieces[0], "border"), 82.0 / 80, 2e-3);
  EXPECT_NEAR(ratio(result->pieces[0], "front"), 1, 1e-3);
  EXPECT_NEAR(ratio(result->pieces[1], "border"), 1, 1e-15);
  expectEqualMates(*result);
}

TEST(AreaOf, IsHerons) {
  EXPECT_DOUBLE_EQ(areaOf({3, 4, 5}), 6);
  EXPECT_EQ(areaOf({1, 1, 2}), 0);
  EXPECT_NEAR(areaOf({1e-9, 1, 1}), 0.5e-9, 1e-24);
}

}  // namespace
}  // namespace toile
