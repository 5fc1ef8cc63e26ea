// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/dxf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "finish/polygon.h"
#include "support/hand_made_pattern.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "support/test_data.h"
#include "toile/core/file.h"
#include "toile/io/dxf.h"
#include "toile/io/pdf.h"
#include "toile/io/svg.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;

double lengthOf(const Outline& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (loop[(i + 1) % loop.size()].position - loop[i].position).norm();
  return length;
}

DxfDrawing read(const std::string& text, std::optional<FileUnit> unit = std::nullopt) {
  Result<DxfDrawing> drawing = readDxf(text, unit);
  EXPECT_TRUE(drawing) << drawing.error();
  return drawing ? *std::move(drawing) : DxfDrawing();
}

/// A file from lines of "code value"; \n parts groups.
std::string groups(const std::string& lines) {
  std::string text;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    const std::size_t blank = line.find(' ');
    text += line.substr(0, blank) + "\r\n" +
            (blank == std::string::npos ? "" : line.substr(blank + 1)) + "\r\n";
  }
  return text;
}

std::string fileOf(const std::string& block, const std::string& entities = "") {
  return groups(
      "0 SECTION\n2 BLOCKS\n0 BLOCK\n8 1\n2 P_M\n70 0\n10 0\n20 0\n" + block +
      "0 ENDBLK\n8 1\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n0 INSERT\n8 1\n2 P_M\n10 0\n20 0\n" +
      entities + "0 ENDSEC\n0 EOF\n");
}

constexpr const char* kSquare =
    "0 POLYLINE\n8 1\n66 1\n70 1\n0 VERTEX\n8 1\n10 0\n20 0\n0 VERTEX\n8 1\n10 0\n20 200\n"
    "0 VERTEX\n8 1\n10 300\n20 200\n0 VERTEX\n8 1\n10 300\n20 0\n0 SEQEND\n";
constexpr const char* kMetric = "0 TEXT\n8 1\n10 0\n20 0\n40 5\n1 UNITS: METRIC\n";

class SampleDxf : public testing::TestWithParam<const char*> {};

/// The samples lie beside the test data.
std::string sample(const std::string& name) {
  return "../samples/dxf/" + name;
}

TEST_P(SampleDxf, HasTheLengthsAreasAndCountsThatAnyReaderMustFind) {
  TOILE_TEST_DATA_OR_SKIP(path, sample(GetParam()));
  TOILE_TEST_DATA_OR_SKIP(table, sample("expected.json"));
  const DxfDrawing drawing = read(*readFile(path));
  EXPECT_TRUE(drawing.findings.empty());
  const auto expected = nlohmann::json::parse(*readFile(table))[GetParam()];
  const bool inches = expected["units"] == "inch";
  EXPECT_EQ(drawing.unit, inches ? FileUnit::Inch : FileUnit::Millimetre);
  const double mm = inches ? 25.4 : 1;
  std::vector<std::optional<std::string>> sizes{std::nullopt};
  if (expected.contains("sizes")) sizes = {"S", "M", "L"};
  std::size_t seen = 0;
  for (const auto& size : sizes) {
    const Result<Pattern> pattern = patternFrom(drawing, "sample", size);
    ASSERT_TRUE(pattern) << pattern.error();
    for (const PatternPiece& piece : pattern->pieces) {
      ASSERT_TRUE(expected["pieces"].contains(piece.id)) << piece.id;
      ++seen;
      const auto& told = expected["pieces"][piece.id];
      const Outline& cut = piece.cutLines.front();
      if (inches) {
        EXPECT_NEAR(signedArea(positions(cut)) / (mm * mm), told["layer1_area_in2"], 1e-6);
      } else {
        EXPECT_NEAR(signedArea(positions(cut)), told["layer1_area_mm2"], 0.06);
        EXPECT_NEAR(signedArea(positions(piece.sewLines.front())), told["layer14_area_mm2"], 0.06);
        EXPECT_NEAR(lengthOf(cut), told["layer1_perimeter_mm"], 0.006);
        EXPECT_NEAR(lengthOf(piece.sewLines.front()), told["layer14_perimeter_mm"], 0.006);
        EXPECT_EQ(piece.notches.size(), told["notches"].get<std::size_t>());
        EXPECT_EQ(cut.size(), told["layer1_vertices"].get<std::size_t>());
        // Every notch points into the piece.
        for (const Notch& notch : piece.notches)
          EXPECT_TRUE(isInside(positions(piece.cutLines),
                               notch.position + 0.5 * notch.depth * notch.direction));
      }
      const Box2 box = boxOf(positions(cut));
      const auto& wanted = told["bbox_layer1"];
      EXPECT_NEAR(box.min.x(), mm * wanted[0].get<double>(), 0.006);
      EXPECT_NEAR(box.min.y(), mm * wanted[1].get<double>(), 0.006);
      EXPECT_NEAR(box.max.x(), mm * wanted[2].get<double>(), 0.006);
      EXPECT_NEAR(box.max.y(), mm * wanted[3].get<double>(), 0.006);
    }
  }
  EXPECT_EQ(seen, expected["pieces"].size());
}

TEST_P(SampleDxf, ComesBackWithoutLoss) {
  TOILE_TEST_DATA_OR_SKIP(path, sample(GetParam()));
  const DxfDrawing drawing = read(*readFile(path));
  const std::string text = writeDxf(drawing);
  const DxfDrawing again = read(text);
  EXPECT_EQ(again.blocks, drawing.blocks);
  EXPECT_EQ(again.inserts, drawing.inserts);
  EXPECT_EQ(again.entities, drawing.entities);
  EXPECT_EQ(again.unit, drawing.unit);
  EXPECT_EQ(writeDxf(again), text);
  // And an independent reader finds the same in both files.
  test::TemporaryFolder folder;
  test::writeText(folder.path() / "again.dxf", text);
  const auto dump = [](const std::string& file) {
    const test::ProgramResult result = test::runProgram(
        {"/usr/bin/python3", TOILE_SOURCE_DIR "/tests/engine/io/read_dxf.py", file});
    EXPECT_EQ(result.status, 0) << result.err;
    auto json = nlohmann::json::parse(result.out, nullptr, false);
    json.erase("version");  // the header is not the pattern's
    return json;
  };
  EXPECT_EQ(dump(path), dump(folder.path() / "again.dxf"));
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleDxf,
                         testing::Values("tank-two-piece-astm-minimal.dxf",
                                         "tank-two-piece-astm-tables.dxf",
                                         "pocket-strap-aama-nest-inch.dxf"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

TEST(DxfFile, ReadsThatOfCloWithoutTextHeights) {
  TOILE_TEST_DATA_OR_SKIP(path, sample("thirdparty/clo-box.dxf"));
  const DxfDrawing drawing = read(*readFile(path));
  ASSERT_EQ(drawing.blocks.size(), 1u);
  const Result<Pattern> pattern = patternFrom(drawing, "box");
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_EQ(pattern->pieces.size(), 1u);
  EXPECT_EQ(read(writeDxf(drawing)).blocks, drawing.blocks);
}

TEST(DxfFile, JoinsRunsThatMeetHeadToTail) {
  const auto line = [](const char* a, const char* b) {
    return std::string("0 POLYLINE\n8 1\n66 1\n70 0\n0 VERTEX\n8 1\n") + a + "0 VERTEX\n8 1\n" + b +
           "0 SEQEND\n";
  };
  // Out of order, one turned, one of no length, and a gap of 0.3 mm.
  const std::string file =
      fileOf(line("10 0\n20 0\n", "10 0\n20 200\n") + line("10 300\n20 0\n", "10 0\n20 0.3\n") +
                 line("10 5\n20 5\n", "10 5\n20 5\n") + line("10 300\n20 200\n", "10 0\n20 200\n") +
                 line("10 300\n20 200\n", "10 300\n20 0\n"),
             kMetric);
  const Result<Pattern> pattern = patternFrom(read(file), "runs");
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_EQ(pattern->pieces.size(), 1u);
  EXPECT_NEAR(signedArea(positions(pattern->pieces[0].cutLines[0])), 60000, 100);
}

TEST(DxfFile, TurnsBulgesIntoChords) {
  // A square whose upper side is half a circle outwards (bulge 1, clockwise outline).
  std::string block = kSquare;
  block.replace(block.find("10 0\n20 200\n"), 12, "10 0\n20 200\n42 -1\n");
  const DxfDrawing drawing = read(fileOf(block, kMetric));
  ASSERT_EQ(drawing.findings.size(), 1u);
  EXPECT_EQ(drawing.findings[0].code, "dxf-curves-to-chords");
  const Result<Pattern> pattern = patternFrom(drawing, "arc");
  ASSERT_TRUE(pattern);
  const double half = 0.5 * std::numbers::pi * 150 * 150;
  EXPECT_NEAR(signedArea(positions(pattern->pieces[0].cutLines[0])), 60000 + half, 10);
}

TEST(DxfFile, MovesPiecesByTheirInsert) {
  std::string file = fileOf(kSquare, kMetric);
  file.replace(file.rfind("10\r\n0\r\n20\r\n0\r\n", file.find("UNITS") - 40), 14,
               "10\r\n1000\r\n20\r\n50\r\n");
  const Result<Pattern> pattern = patternFrom(read(file), "moved");
  ASSERT_TRUE(pattern);
  EXPECT_NEAR(pattern->layout.min.x(), 1000, 1e-9);
  EXPECT_NEAR(pattern->layout.min.y(), 50, 1e-9);
}

TEST(DxfFile, GuessesTheUnitFromTheSizeAndSaysSo) {
  DxfDrawing drawing = read(fileOf(kSquare));
  EXPECT_EQ(drawing.unit, FileUnit::Millimetre);
  ASSERT_EQ(drawing.findings.size(), 1u);
  EXPECT_EQ(drawing.findings[0].code, "dxf-unit-guessed");
  drawing = read(fileOf(kSquare), FileUnit::Centimetre);
  EXPECT_EQ(drawing.unit, FileUnit::Centimetre);
  EXPECT_TRUE(drawing.findings.empty());
  drawing = read(fileOf(kSquare, "0 TEXT\n8 1\n10 0\n20 0\n1 Units:ENGLISH\n"));
  EXPECT_EQ(drawing.unit, FileUnit::Inch);
  ASSERT_EQ(drawing.findings.size(), 1u);  // 300 inches are no garment
  EXPECT_EQ(drawing.findings[0].code, "dxf-unit-doubtful");
}

TEST(DxfFile, TellsWhatItLeavesOut) {
  const DxfDrawing drawing = read(
      fileOf(std::string(kSquare) + "0 SPLINE\n8 1\n70 0\n72 999999999\n0 HATCH\n8 1\n", kMetric));
  ASSERT_EQ(drawing.findings.size(), 2u);
  EXPECT_THAT(drawing.findings[0].message, HasSubstr("1 HATCH"));
  EXPECT_THAT(drawing.findings[1].message, HasSubstr("1 SPLINE"));
  EXPECT_EQ(drawing.blocks[0].entities.size(), 1u);
}

TEST(DxfFile, LeavesOutAnOutlineThatCrossesItself) {
  const std::string crossed =
      "0 POLYLINE\n8 1\n66 1\n70 1\n0 VERTEX\n8 1\n10 0\n20 0\n0 VERTEX\n8 1\n10 300\n20 200\n"
      "0 VERTEX\n8 1\n10 300\n20 0\n0 VERTEX\n8 1\n10 0\n20 200\n0 VERTEX\n8 1\n10 -50\n20 100\n"
      "0 SEQEND\n";
  const Result<Pattern> pattern = patternFrom(read(fileOf(crossed, kMetric)), "crossed");
  ASSERT_FALSE(pattern);
  EXPECT_THAT(pattern.error().message, HasSubstr("does not cross itself"));
  // Beside one that can be cut it is told.
  const std::string both = groups(
      "0 SECTION\n2 BLOCKS\n0 BLOCK\n8 1\n2 GOOD\n70 0\n10 0\n20 0\n" + std::string(kSquare) +
      "0 ENDBLK\n8 1\n0 BLOCK\n8 1\n2 BAD\n70 0\n10 0\n20 0\n" + crossed +
      "0 ENDBLK\n8 1\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n" + kMetric + "0 ENDSEC\n0 EOF\n");
  const Result<Pattern> one = patternFrom(read(both), "both");
  ASSERT_TRUE(one) << one.error();
  EXPECT_EQ(one->pieces.size(), 1u);
  ASSERT_EQ(one->findings.size(), 1u);
  EXPECT_EQ(one->findings[0].code, "dxf-crossing-outline");
  EXPECT_THAT(one->findings[0].message, HasSubstr("\"BAD\" crosses itself at (150.0, 100.0)"));
}

TEST(DxfFile, RefusesDamage) {
  const std::string whole = fileOf(kSquare, kMetric);
  const auto refusal = [](const std::string& text) {
    const Result<DxfDrawing> drawing = readDxf(text);
    EXPECT_FALSE(drawing) << text.substr(0, 60);
    return drawing ? Error() : drawing.error();
  };
  // Cut off anywhere, it never passes for a whole file.
  for (std::size_t size = 0; size + 6 < whole.size(); ++size) {
    const Error error = refusal(whole.substr(0, size));
    ASSERT_EQ(error.code, ErrorCode::FileFormat) << size;
  }
  EXPECT_THAT(refusal(whole.substr(0, whole.size() / 2)).message, HasSubstr("cut off"));
  std::string broken = whole;
  broken.replace(broken.find("300"), 3, "3x0");
  EXPECT_THAT(refusal(broken).message, HasSubstr("\"3x0\""));
  EXPECT_EQ(refusal(broken).where.front().kind, Element::Kind::Line);
  broken = whole;
  broken.replace(broken.find("300"), 3, "9e9");
  EXPECT_THAT(refusal(broken).message, HasSubstr("no place"));
  EXPECT_THAT(refusal("AutoCAD Binary DXF\r\n").message, HasSubstr("binary"));
  EXPECT_THAT(refusal("AC1027junk").message, HasSubstr("DWG"));
  EXPECT_THAT(refusal("%PDF-1.5\nwhatever\n").message, HasSubstr("line 1"));
  EXPECT_EQ(refusal(std::string(kMostDxfBytes + 1, ' ')).code, ErrorCode::Unsupported);
  const Result<DxfDrawing> empty = readDxf(groups("0 SECTION\n2 ENTITIES\n0 ENDSEC\n0 EOF\n"));
  ASSERT_TRUE(empty);
  EXPECT_EQ(patternFrom(*empty, "empty").error().code, ErrorCode::FileFormat);
}

TEST(DxfFile, NamesTheSizesThatThereAre) {
  TOILE_TEST_DATA_OR_SKIP(path, sample("pocket-strap-aama-nest-inch.dxf"));
  const DxfDrawing drawing = read(*readFile(path));
  const Result<Pattern> pattern = patternFrom(drawing, "nest", "XXL");
  ASSERT_FALSE(pattern);
  EXPECT_EQ(pattern.error().code, ErrorCode::NameNotFound);
  EXPECT_THAT(pattern.error().message, HasSubstr("L, M, S"));
  const Result<Pattern> usual = patternFrom(drawing, "nest");
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->document.design->order.size, "M");
}

TEST(DxfFile, OfOursReadsAsWritten) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const DxfDrawing drawing = read(writeDxf(pattern).text);
  EXPECT_TRUE(drawing.findings.empty());
  const Result<Pattern> again = patternFrom(drawing, "two pieces");
  ASSERT_TRUE(again);
  ASSERT_EQ(again->pieces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(lengthOf(again->pieces[i].cutLines[0]), lengthOf(pattern.pieces[i].cutLines[0]),
                0.01);
    EXPECT_NEAR(lengthOf(again->pieces[i].sewLines[0]), lengthOf(pattern.pieces[i].sewLines[0]),
                0.01);
    EXPECT_EQ(again->pieces[i].notches.size(), pattern.pieces[i].notches.size());
    EXPECT_EQ(again->pieces[i].count, pattern.pieces[i].count);
  }
  // What was read can be drawn.
  EXPECT_THAT(writeSvg(drawSheet(*again)), HasSubstr("data-piece=\"ELL_M\""));
  EXPECT_TRUE(writePdf(drawSheet(*again)));
}

}  // namespace
}  // namespace toile
