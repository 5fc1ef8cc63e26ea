// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/marker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "finish/polygon.h"
#include "layout/clearance.h"
#include "support/run_program.h"
#include "support/sample_designs.h"
#include "toile/core/file.h"
#include "toile/io/dxf.h"
#include "toile/io/hpgl.h"
#include "toile/io/pdf.h"
#include "toile/io/svg.h"

namespace toile::test {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;

class WetsuitMarker : public WetsuitPattern {
 protected:
  static std::vector<Marker> markers(MarkerOptions options) {
    options.nest.effort = 0;
    Result<std::vector<Marker>> made = makeMarkers({&*pattern_, 1}, options);
    EXPECT_TRUE(made) << made.error();
    return made ? *std::move(made) : std::vector<Marker>();
  }
  static double areaOf(const Pattern& pattern, const std::string& fabric) {
    double area = 0;
    for (const PatternPiece& piece : pattern.pieces) {
      const Fabric* own =
          fabricOf(*pattern.document.design, recordOf(*pattern.document.design, piece.id));
      if ((own == nullptr ? "" : own->id) == fabric)
        area += piece.count * signedArea(positions(piece.cutLines.front()));
    }
    return area;
  }
};

MarkerOptions folded() {
  MarkerOptions options;
  options.fold = true;
  return options;
}

MarkerOptions inPairs() {
  MarkerOptions options;
  options.pairs = true;
  return options;
}

const Points2& cutLineOf(const PieceDrawing& piece) {
  return std::find_if(piece.lines.begin(), piece.lines.end(),
                      [](const SheetLine& line) { return line.role == SheetRole::Cut; })
      ->points;
}

std::set<std::string> edgesOf(const SheetDrawing& sheet) {
  std::set<std::string> edges;
  for (const PieceDrawing& piece : sheet.pieces)
    for (const SheetLine& line : piece.lines)
      if (!line.edge.empty()) edges.insert(line.edge);
  return edges;
}

// What hangs on the bundle of cut pieces must agree with the sewing sheet.
TEST_F(WetsuitMarker, HasTheNumbersAndEdgeCodesOfThePattern) {
  std::set<std::string> edges;
  std::set<std::pair<std::string, int>> numbers;
  for (const Marker& marker : markers({})) {
    edges.merge(edgesOf(marker.sheet));
    for (const PieceDrawing& piece : marker.sheet.pieces) numbers.emplace(piece.id, piece.number);
    EXPECT_TRUE(marker.findings.empty());
  }
  EXPECT_EQ(edges, edgesOf(drawSheet(*pattern_)));
  EXPECT_EQ(numbers.size(), pattern_->pieces.size());
  for (const PatternPiece& piece : pattern_->pieces)
    EXPECT_TRUE(numbers.contains({piece.id, piece.number}));
}

TEST_F(WetsuitMarker, OnFoldedClothGivesEveryPieceOnce) {
  std::size_t halves = 0;
  std::size_t pieces = 0;
  for (const Marker& marker : markers(folded())) {
    EXPECT_TRUE(marker.folded);
    EXPECT_TRUE(marker.findings.empty());
    // Two layers.
    const double wanted = areaOf(*pattern_, marker.fabric);
    EXPECT_NEAR(2 * marker.nesting.area, wanted, 1e-4 * wanted) << marker.fabric;
    pieces += marker.nesting.places.size();
    for (const PieceDrawing& piece : marker.sheet.pieces) {
      const bool isHalf = std::any_of(piece.lines.begin(), piece.lines.end(),
                                      [](const SheetLine& line) { return line.kind == "fold"; });
      const Box2 box = boxOf(cutLineOf(piece));
      EXPECT_GT(signedArea(cutLineOf(piece)), 0);
      EXPECT_LE(box.max.y(), 0.5 * marker.width + 2e-3);
      if (!isHalf) continue;
      ++halves;
      EXPECT_NEAR(box.min.y(), 0, 2e-3) << piece.name;
      // The whole lower edge of the half lies on the fold.
      double onFold = 0;
      const Points2& cut = cutLineOf(piece);
      for (std::size_t k = 0; k < cut.size(); ++k) {
        const Vector2d& next = cut[(k + 1) % cut.size()];
        if (std::max(cut[k].y(), next.y()) < 0.01) onFold += (next - cut[k]).norm();
      }
      EXPECT_GT(onFold, 20) << piece.name;
    }
  }
  EXPECT_EQ(halves, 2u);  // front and collar
  EXPECT_EQ(2 * pieces - halves, pattern_->pieces.size());
}

TEST_F(WetsuitMarker, TurnedOverCopiesAreMirroredButTheirTextsAreNot) {
  const std::vector<Marker> made = markers(inPairs());
  std::size_t turned = 0;
  for (const Marker& marker : made) {
    for (std::size_t i = 0; i < marker.sheet.pieces.size(); ++i) {
      const PieceDrawing& piece = marker.sheet.pieces[i];
      EXPECT_GT(signedArea(cutLineOf(piece)), 0) << piece.name;
      if (!marker.nesting.places[i].mirrored) continue;
      ++turned;
      const Points2& cut = cutLineOf(piece);
      for (const SheetLine& line : piece.lines) {
        if (line.role != SheetRole::Drill && line.role != SheetRole::Internal) continue;
        const EdgeGrid grid({cut});
        for (const Vector2d& p : line.points)
          EXPECT_TRUE(isInside({cut}, p) || grid.nearest(p).distance < 3) << piece.name;
      }
      // Sew lines by run lie within the cut line, and together they are as long as before.
      double sewn = 0;
      double wanted = 0;
      for (const SheetLine& line : piece.lines) {
        if (line.role != SheetRole::Sew) continue;
        for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
          sewn += (line.points[k + 1] - line.points[k]).norm();
      }
      for (const PatternPiece& source : pattern_->pieces)
        if (source.id == piece.id)
          for (const Outline& loop : source.sewLines)
            for (std::size_t k = 0; k < loop.size(); ++k)
              wanted += (loop[(k + 1) % loop.size()].position - loop[k].position).norm();
      EXPECT_NEAR(sewn, wanted, 1e-6 * wanted) << piece.name;
    }
  }
  EXPECT_EQ(turned, pattern_->pieces.size());
}

TEST_F(WetsuitMarker, IsReadByIndependentProgramsInEveryFormat) {
  const std::vector<Marker> made = markers({});
  const Marker& marker = made.front();
  const SheetDrawing& sheet = marker.sheet;
  TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  double perimeter = 0;
  for (const PieceDrawing& piece : sheet.pieces) {
    const Points2& cut = cutLineOf(piece);
    for (std::size_t k = 0; k < cut.size(); ++k)
      perimeter += (cut[(k + 1) % cut.size()] - cut[k]).norm();
  }

  // DXF: the cut lines as GDAL measures them.
  writeText(path("m.dxf"), writeLaserDxf(sheet));
  const ProgramResult gdal =
      runProgram({"ogrinfo", "-ro", "-q", "-al", path("m.dxf"), "-dialect", "SQLITE", "-sql",
                  // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one long query
                  "SELECT SUM(ST_Length(geometry)) AS len FROM entities WHERE Layer = 'CUT' AND "
                  "ST_IsClosed(geometry) = 1"});
  ASSERT_EQ(gdal.status, 0) << gdal.err;
  const std::size_t at = gdal.out.find("len (Real) = ");
  ASSERT_NE(at, std::string::npos) << gdal.out;
  EXPECT_NEAR(std::stod(gdal.out.substr(at + 13)), perimeter,
              0.02 * static_cast<double>(sheet.pieces.size()));

  // HPGL: X runs along the roll, whichever side is longer.
  const Result<std::string> plot = writeHpgl(sheet);
  ASSERT_TRUE(plot) << plot.error();
  writeText(path("m.plt"), *plot);
  runProgram({"hp2xx", "-q", "-t", "-m", "eps", "-f", path("m.eps"), path("m.plt")});
  std::istringstream box(readText(path("m.eps")));
  std::string word;
  while (box >> word && word != "%%BoundingBox:") {
  }
  double left = 0;
  double bottom = 0;
  double right = 0;
  double top = 0;
  box >> left >> bottom >> right >> top;
  constexpr double kMmPerPoint = 25.4 / 72;
  EXPECT_NEAR((top - bottom) * kMmPerPoint, marker.width, 2);
  EXPECT_NEAR((right - left) * kMmPerPoint, sheet.max.x() - sheet.min.x(), 15);

  // PDF: one page of the marker's size, with its figures as text.
  const Result<std::string> pdf = writePdf(sheet, {.paper = PdfPaper::OneSheet});
  ASSERT_TRUE(pdf) << pdf.error();
  writeText(path("m.pdf"), *pdf);
  const ProgramResult text = runProgram({"pdftotext", path("m.pdf"), "-"});
  EXPECT_THAT(text.out, HasSubstr("% used"));
  EXPECT_THAT(writeSvg(sheet), HasSubstr("data-kind=\"edge\""));
}

TEST(Marker, DrawsAHideWithItsFaultsAndRefusesToFoldIt) {
  const Result<Pattern> pattern = makePattern(sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  MarkerOptions options;
  options.nest.effort = 0;
  options.hide.hide = {{0, 100}, {700, 0}, {1800, 50}, {1700, 1300}, {200, 1200}};
  options.hide.faults = {{{300, 300}, {400, 300}, {350, 380}}};
  const Result<std::vector<Marker>> made = makeMarkers({&*pattern, 1}, options);
  ASSERT_TRUE(made) << made.error();
  std::map<std::string, int> kinds;
  for (const SheetLine& line : made->front().sheet.around.lines) ++kinds[line.kind];
  EXPECT_EQ(kinds["hide"], 1);
  EXPECT_EQ(kinds["fault"], 1);
  EXPECT_EQ(kinds["edge"], 0);
  for (const PieceDrawing& piece : made->front().sheet.pieces)
    EXPECT_GT(distanceBetween(cutLineOf(piece), options.hide.faults.front()), 0);
  options.fold = true;
  EXPECT_EQ(makeMarkers({&*pattern, 1}, options).error().code, ErrorCode::InvalidArgument);
}

TEST(Marker, OnFoldedClothTellsWhatItGivesTwice) {
  const Result<Pattern> pattern = makePattern(sleeveDocument());
  ASSERT_TRUE(pattern) << pattern.error();
  MarkerOptions options;
  options.nest.effort = 0;
  options.fold = true;
  const Result<std::vector<Marker>> made = makeMarkers({&*pattern, 1}, options);
  ASSERT_TRUE(made) << made.error();
  // Upper and under sleeve are no mirror images of each other.
  ASSERT_EQ(made->front().findings.size(), 2u);
  EXPECT_EQ(made->front().findings.front().code, "cut-double");
}

}  // namespace
}  // namespace toile::test
