// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/batch/grade.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "support/run_program.h"
#include "support/sample_designs.h"
#include "toile/io/nested.h"

namespace toile {
namespace {

using testing::HasSubstr;

class Grade : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Result<Document> document = openDocument(test::exampleDesign("wetsuit-full.toile"));
    ASSERT_TRUE(document) << document.error();
    document_ = *document;
    std::vector<BodySize> sizes;
    for (const char* name : {"EU36F", "EU40F", "EU44F"}) {
      sizes.push_back(*findSize(standardSizes(), name));
    }
    Result<std::vector<GradedSize>> graded = gradeDesign(document_, sizes, "EU40F");
    ASSERT_TRUE(graded) << graded.error();
    graded_ = *std::move(graded);
  }
  static void TearDownTestSuite() {
    graded_.clear();
    document_ = {};
  }
  static double girth(const GradedSize& size, const char* curve) {
    const ReferenceModel& model = *size.pattern->document.model;
    return length(*model.mesh, model.curves.at(curve));
  }
  static inline Document document_;
  static inline std::vector<GradedSize> graded_;
};

TEST_F(Grade, EverySizeHasEveryPieceAndGrowsWithTheBody) {
  ASSERT_EQ(graded_.size(), 3U);
  for (const GradedSize& size : graded_) {
    EXPECT_EQ(size.pattern->pieces.size(), 20U) << size.name;
    EXPECT_TRUE(size.pattern->isComplete()) << size.name;
    EXPECT_EQ(size.isBase, size.name == "EU40F");
    EXPECT_EQ(size.pattern->document.design->order.size, size.name);
  }
  EXPECT_LT(girth(graded_[0], "hip_girth") + 50, girth(graded_[1], "hip_girth"));
  EXPECT_LT(girth(graded_[1], "hip_girth") + 50, girth(graded_[2], "hip_girth"));
}

TEST_F(Grade, SizesOfAPieceLieOnEachOtherAndPiecesApart) {
  struct Box {
    Eigen::Vector2d min{1e9, 1e9}, max{-1e9, -1e9};
  };
  std::map<std::string, Box> boxes;
  std::map<std::string, std::vector<Eigen::Vector2d>> middles;
  for (const GradedSize& size : graded_) {
    for (std::size_t p = 0; p < size.pattern->pieces.size(); ++p) {
      const PatternPiece& piece = size.pattern->pieces[p];
      Box& box = boxes[piece.id];
      Eigen::Vector2d middle(0, 0);
      for (const OutlinePoint& point : piece.cutLines.front()) {
        const Eigen::Vector2d at = size.nest.placements[p].apply(point.position);
        box.min = box.min.cwiseMin(at);
        box.max = box.max.cwiseMax(at);
        middle += at / static_cast<double>(piece.cutLines.front().size());
      }
      middles[piece.id].push_back(middle);
    }
  }
  ASSERT_EQ(boxes.size(), 20U);
  for (const auto& [id, places] : middles) {
    for (const Eigen::Vector2d& place : places) {
      EXPECT_LT((place - places.front()).norm(), 60) << id;
    }
  }
  for (const auto& [a, boxA] : boxes) {
    for (const auto& [b, boxB] : boxes) {
      if (a >= b) continue;
      const bool isApart = (boxA.min.array() > boxB.max.array()).any() ||
                           (boxB.min.array() > boxA.max.array()).any();
      EXPECT_TRUE(isApart) << a << " and " << b;
    }
  }
}

TEST_F(Grade, WritesOneDrawingAndOneDxfWithAllSizes) {
  const test::TemporaryFolder folder;
  const Result<std::vector<Finding>> findings = writeGrading(graded_, folder.path());
  ASSERT_TRUE(findings) << findings.error();
  const std::string svg = test::readText(folder.path() / "nested.svg");
  EXPECT_THAT(svg, HasSubstr("data-size=\"EU36F\" data-base=\"no\""));
  EXPECT_THAT(svg, HasSubstr("data-size=\"EU40F\" data-base=\"yes\""));
  EXPECT_THAT(svg, HasSubstr("EU40F (base size)"));
  const std::string dxf = test::readText(folder.path() / "nested.dxf");
  EXPECT_THAT(dxf, HasSubstr("Sample Size:EU40F"));
  std::set<std::string> blocks;
  std::size_t count = 0;
  for (std::size_t at = dxf.find("BLOCK\r\n"); at != std::string::npos;
       at = dxf.find("  0\r\nBLOCK\r\n", at + 1)) {
    ++count;
  }
  EXPECT_GE(count, 60U);
  for (const GradedSize& size : graded_) {
    EXPECT_THAT(dxf, HasSubstr("Size:" + size.name + "\r\n"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / size.name / "pattern.dxf"));
  }
  const std::string table = test::readText(folder.path() / "grade.csv");
  EXPECT_THAT(table, HasSubstr("piece,line,EU36F_mm,EU40F_base_mm,EU44F_mm\n"));
}

TEST_F(Grade, OneSizeIsTheOrdinaryPattern) {
  NestedSize size{"EU40F", graded_[1].pattern.get(), true};
  EXPECT_EQ(writeNestedDxf({&size, 1}).text, writeDxf(*graded_[1].pattern).text);
}

TEST_F(Grade, BaseSizeMustBeOneOfTheSizes) {
  const std::vector<BodySize> sizes = {*findSize(standardSizes(), "EU40F")};
  const auto refused = gradeDesign(document_, sizes, "EU4OF");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NameNotFound);
  EXPECT_THAT(refused.error().message, HasSubstr("did you mean \"EU40F\""));
}

}  // namespace
}  // namespace toile
