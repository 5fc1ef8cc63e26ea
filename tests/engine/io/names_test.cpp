// SPDX-License-Identifier: GPL-3.0-or-later
// Names that people give must reach no cutter as something else than a name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/hand_made_pattern.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "toile/io/dxf.h"
#include "toile/io/dxf_file.h"
#include "toile/io/hpgl.h"
#include "toile/io/nested.h"
#include "toile/io/pdf.h"
#include "toile/io/sewing_files.h"
#include "toile/io/svg.h"

namespace toile {
namespace {

using testing::HasSubstr;

class Names : public testing::TestWithParam<std::string> {
 protected:
  /// Both pieces and the seam have the name.
  static Pattern pattern() {
    Pattern pattern = test::makeTwoPiecePattern();
    Design design = *pattern.document.design;
    for (StylingCurve& curve : design.curves) curve.name = GetParam();
    design.name = design.order.style = GetParam();
    pattern.document.design = std::make_shared<const Design>(design);
    for (PatternPiece& piece : pattern.pieces) {
      piece.name = piece.label[0] = GetParam();
      for (InternalLine& line : piece.internalLines) line.name = GetParam();
    }
    return pattern;
  }
};

TEST_P(Names, DxfHasTwoBlocksOfPlainNames) {
  const DxfFile dxf = writeDxf(pattern());
  for (const char c : dxf.text) ASSERT_TRUE(c == '\r' || c == '\n' || (c >= 0x20 && c < 0x7f));
  const Result<DxfDrawing> drawing = readDxf(dxf.text);
  ASSERT_TRUE(drawing) << drawing.error();
  ASSERT_EQ(drawing->blocks.size(), 2u);
  EXPECT_NE(drawing->blocks[0].name, drawing->blocks[1].name);
  for (const DxfBlock& block : drawing->blocks) {
    EXPECT_LE(block.name.size(), 31u);
    EXPECT_EQ(block.name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"),
              std::string::npos);
  }
  EXPECT_FALSE(dxf.findings.empty());  // the substitution is told
}

TEST(DxfNames, AreTheIdsWhereNothingOfANameIsAscii) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.pieces[0].name = "\xe5\x89\x8d\xe7\x89\x87";
  pattern.pieces[1].name = "\xe5\x90\x8e\xe7\x89\x87";
  pattern.pieces[1].id = "--";  // an id may have no letter either
  EXPECT_THAT(dxfBlockNames(pattern), testing::ElementsAre("ELL_M", "PIECE-2_M"));
  std::vector<std::string> told;
  for (const Finding& finding : writeDxf(pattern).findings)
    if (finding.code == "dxf-name-changed") told.push_back(finding.message);
  EXPECT_THAT(told, testing::ElementsAre(
                        testing::AllOf(HasSubstr(pattern.pieces[0].name), HasSubstr(" ELL:")),
                        testing::AllOf(HasSubstr(pattern.pieces[1].name), HasSubstr(" PIECE-2:"))));
}

TEST(DxfNames, OfPlainPiecesAreKeptWithoutAWord) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.pieces[0].name = "front left";
  pattern.pieces[1].name = "Back-2";
  EXPECT_THAT(dxfBlockNames(pattern), testing::ElementsAre("FRONT_LEFT_M", "BACK-2_M"));
  EXPECT_TRUE(writeDxf(pattern).findings.empty());
}

TEST(DxfNames, OfTwoSizesDiffer) {
  std::array<Pattern, 3> patterns;
  std::vector<NestedSize> sizes;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    patterns[i] = test::makeTwoPiecePattern();
    Design design = *patterns[i].document.design;
    design.order.size = std::array{"\xe5\xa4\xa7", "\xe5\xb0\x8f", "42"}[i];
    patterns[i].document.design = std::make_shared<const Design>(design);
    sizes.push_back({design.order.size, &patterns[i], i == 0});
  }
  const DxfFile dxf = writeNestedDxf(sizes);
  const Result<DxfDrawing> drawing = readDxf(dxf.text);
  ASSERT_TRUE(drawing) << drawing.error();
  std::set<std::string> names;
  for (const DxfBlock& block : drawing->blocks) names.insert(block.name);
  EXPECT_THAT(names, testing::ElementsAre("ELL_42", "ELL_ONE", "ELL_ONE-2", "PANEL_42", "PANEL_ONE",
                                          "PANEL_ONE-2"));
  std::size_t told = 0;
  for (const Finding& finding : dxf.findings)
    if (finding.code == "dxf-size-changed") ++told;
  EXPECT_EQ(told, 2u);
}

TEST_P(Names, XmlJsonAndTablesStayWellFormed) {
  const Pattern named = pattern();
  test::TemporaryFolder folder;
  test::writeText(folder.path() / "pattern.svg", writeSvg(drawSheet(named)));
  const test::ProgramResult parsed = test::runProgram(
      {"/usr/bin/python3", "-c", "import sys, xml.etree.ElementTree as E; E.parse(sys.argv[1])",
       (folder.path() / "pattern.svg").string()});
  EXPECT_EQ(parsed.status, 0) << parsed.err;
  const auto json = nlohmann::json::parse(writeSeamsJson(named), nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["pieces"].size(), 2u);
  // Every row of the table has the columns of its head.
  test::writeText(folder.path() / "lengths.csv", writeLengthsCsv(named));
  const test::ProgramResult rows = test::runProgram(
      {"/usr/bin/python3", "-c",
       "import csv, sys; f = open(sys.argv[1], encoding='utf-8', newline=''); f.readline(); "
       "print({len(r) for r in csv.reader(f)})",
       (folder.path() / "lengths.csv").string()});
  EXPECT_EQ(rows.out, "{12}\n") << rows.err;
  const std::string page = writeSewingHtml(named, "");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_TRUE(writePdf(drawSheet(named)));
  EXPECT_TRUE(writeSewingPdf(named, ""));
  const Result<std::string> plot = writeHpgl(drawSheet(named));
  ASSERT_TRUE(plot);
  for (const char c : *plot) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7f));
}

INSTANTIATE_TEST_SUITE_P(OfPeople, Names,
                         testing::Values("5\" \"front\", <script>left</script> & 'right';PU0,0;",
                                         "\xc3\x84rmel \xc3\xbc"
                                         "ber dem Stra\xc3\x9f"
                                         "enrand",
                                         "\xe5\x89\x8d\xe7\x89\x87", std::string(200, 'w'),
                                         "line\nbreak\r\n  0\r\nEOF\r\n", "*MODEL_SPACE"),
                         [](const auto& each) { return "Number" + std::to_string(each.index); });

}  // namespace
}  // namespace toile
