// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/pdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "finish/polygon.h"
#include "io/pdf_canvas.h"
#include "io/pdf_tiles.h"
#include "io/pdf_update.h"
#include "render/picture.h"
#include "support/hand_made_pattern.h"
#include "support/result_printing.h"
#include "support/run_program.h"

namespace toile {
namespace {

constexpr double kDotsPerMm = 10;  // pdftoppm -r 254

struct SavedPdf {
  explicit SavedPdf(const Pattern& pattern, const PdfOptions& options = {}) {
    const Result<std::string> pdf = writePdf(drawSheet(pattern), options);
    EXPECT_TRUE(pdf) << pdf.error();
    if (pdf) bytes = *pdf;
    path = folder.path() / "pattern.pdf";
    test::writeText(path, bytes);
  }
  std::string run(const std::vector<std::string>& words) const {
    const test::ProgramResult result = test::runProgram(words);
    EXPECT_EQ(result.status, 0) << words[0] << ": " << result.err;
    EXPECT_EQ(result.err, "") << words[0];
    return result.out;
  }
  test::TemporaryFolder folder;
  std::filesystem::path path;
  std::string bytes;
};

/// A page as grey values, from pdftoppm, an independent renderer.
struct Raster {
  Raster(const SavedPdf& pdf, int page) {
    const std::string root = pdf.folder.path() / "page";
    pdf.run({"pdftoppm", "-r", "254", "-gray", "-singlefile", "-f", std::to_string(page), "-l",
             std::to_string(page), pdf.path.string(), root});
    std::istringstream in(test::readText(root + ".pgm"));
    std::string magic;
    int most = 0;
    in >> magic >> width >> height >> most;
    in.get();
    grey.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    in.read(reinterpret_cast<char*>(grey.data()), static_cast<std::streamsize>(grey.size()));
    EXPECT_EQ(magic, "P5");
  }
  /// Darkest value within 0.3 mm of a place, mm from the lower left corner.
  [[nodiscard]] int darkest(double x, double y) const {
    int least = 255;
    for (int dx = -3; dx <= 3; ++dx)
      for (int dy = -3; dy <= 3; ++dy)
        least = std::min(least, at(static_cast<int>(std::lround(x * kDotsPerMm)) + dx,
                                   height - static_cast<int>(std::lround(y * kDotsPerMm)) + dy));
    return least;
  }
  [[nodiscard]] int at(int column, int row) const {
    if (column < 0 || row < 0 || column >= width || row >= height) return 255;
    return grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
  }
  int width = 0, height = 0;
  std::vector<unsigned char> grey;
};

/// Middles of the dark stretches of a row or column of dots, in mm.
std::vector<double> darkPlaces(const std::vector<int>& dots) {
  std::vector<double> places;
  for (std::size_t i = 0; i < dots.size();) {
    if (dots[i] > 128) {
      ++i;
      continue;
    }
    const std::size_t from = i;
    while (i < dots.size() && dots[i] <= 128) ++i;
    places.push_back(0.5 * static_cast<double>(from + i) / kDotsPerMm);
  }
  return places;
}

TEST(Pdf, TestSquareMeasures100Millimetres) {
  const SavedPdf pdf(test::makeTwoPiecePattern());
  const Raster page(pdf, 1);
  EXPECT_NEAR(page.width / kDotsPerMm, 210, 0.2);
  EXPECT_NEAR(page.height / kDotsPerMm, 297, 0.2);
  // Left 10 mm, bottom 28.5 + 101.6 + 6 mm; a row and a column of dots that meet no text.
  const double left = 10;
  const double bottom = 28.5 + 101.6 + 6;
  std::vector<int> row;
  std::vector<int> column;
  for (int i = 0; i < 1150; ++i)
    row.push_back(page.at(i, page.height - static_cast<int>((bottom + 96) * kDotsPerMm)));
  for (int i = 0; i < page.height; ++i)
    column.push_back(page.at(static_cast<int>((left + 2) * kDotsPerMm), page.height - 1 - i));
  const std::vector<double> across = darkPlaces(row);
  ASSERT_EQ(across.size(), 2u);
  EXPECT_NEAR(across[0], left, 0.15);
  EXPECT_NEAR(across[1] - across[0], 100, 0.1);
  std::vector<double> along = darkPlaces(column);
  const auto lower = std::find_if(along.begin(), along.end(),
                                  [&](double y) { return std::abs(y - bottom) < 0.5; });
  ASSERT_NE(lower, along.end());
  ASSERT_NE(lower + 1, along.end());
  EXPECT_NEAR(*(lower + 1) - *lower, 100, 0.1);
}

TEST(Pdf, TilesShowThePiecesInPlaceAndRightSideUp) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedPdf pdf(pattern);
  const SheetDrawing sheet = drawSheet(pattern);
  const TilePlan plan = planTiles(sheet, 2);
  ASSERT_GE(plan.tiles.size(), 4u);
  // Every point of the L's cut line is dark on the tile that holds it.
  const Points2& cut = sheet.pieces[0].lines[0].points;
  std::vector<Raster> pages;
  for (const Tile& tile : plan.tiles) pages.emplace_back(pdf, tile.page);
  int seen = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    for (const double t : {0.25, 0.5, 0.75}) {
      const Eigen::Vector2d p = cut[i] + t * (cut[(i + 1) % cut.size()] - cut[i]);
      for (std::size_t k = 0; k < pages.size(); ++k) {
        const Box2& box = plan.tiles[k].box;
        if ((p - box.min).minCoeff() < 0 || (box.max - p).minCoeff() < 0) continue;
        const Eigen::Vector2d q = p - box.min + Eigen::Vector2d(10, 28.5);
        EXPECT_LT(pages[k].darkest(q.x(), q.y()), 100) << p.transpose();
        ++seen;
      }
    }
  }
  EXPECT_GE(seen, 3 * static_cast<int>(cut.size()));
}

TEST(Pdf, PagesAreA4AndTextIsSearchableWithEmbeddedFonts) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.pieces[0].label[0] = "Ärmel links";
  const SavedPdf pdf(pattern);
  const std::string info = pdf.run({"pdfinfo", "-f", "1", "-l", "9", "-box", pdf.path.string()});
  std::istringstream lines(info);
  int boxes = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("MediaBox") == std::string::npos) continue;
    ++boxes;
    EXPECT_NE(line.find("595.28"), std::string::npos) << line;
    EXPECT_NE(line.find("841.89"), std::string::npos) << line;
  }
  EXPECT_EQ(boxes, 5);
  EXPECT_NE(info.find("Title:           two pieces, size M"), std::string::npos) << info;
  EXPECT_EQ(info.find("CreationDate"), std::string::npos) << info;
  const std::string text = pdf.run({"pdftotext", pdf.path.string(), "-"});
  for (const char* words : {"Ärmel links", "Piece 1 of 2, cut 2", "Waist line", "side to panel",
                            "100 mm", "4 in", "Print at 100 %"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  const std::string fonts = pdf.run({"pdffonts", pdf.path.string()});
  EXPECT_NE(fonts.find("DejaVuSans"), std::string::npos);
  EXPECT_EQ(fonts.find(" no  "), std::string::npos) << fonts;
}

TEST(Pdf, TellsViewersNotToScale) {
  const SavedPdf pdf(test::makeTwoPiecePattern());
  EXPECT_NE(pdf.bytes.find("/PrintScaling /None"), std::string::npos);
  // The last cross-reference table names the place of the new catalog, and readers follow it.
  const std::size_t start = pdf.bytes.rfind("startxref");
  const std::size_t table = std::stoul(pdf.bytes.substr(start + 10));
  EXPECT_EQ(pdf.bytes.substr(table, 5), "xref\n");
  const std::size_t entry = pdf.bytes.find('\n', table + 5) + 1;
  const std::size_t catalog = std::stoul(pdf.bytes.substr(entry, 10));
  EXPECT_NE(pdf.bytes.substr(catalog, 40).find(" 0 obj\n<< /Type /Catalog"), std::string::npos);
  EXPECT_NE(pdf.run({"pdfinfo", pdf.path.string()}).find("Pages:           5"), std::string::npos);
}

TEST(Pdf, UpdateLeavesOtherFilesAlone) {
  EXPECT_EQ(withoutPrintScaling("no pdf"), "no pdf");
  EXPECT_EQ(withoutPrintScaling("startxref\n999\n%%EOF"), "startxref\n999\n%%EOF");
  EXPECT_EQ(withoutPrintScaling(""), "");
  const std::string once = SavedPdf(test::makeTwoPiecePattern()).bytes;
  EXPECT_EQ(withoutPrintScaling(once), once);
}

TEST(Pdf, ShowsAPictureAsItsPngHasIt) {
  // 20 x 10 dots, black where column and row are both in the upper left quarter.
  Picture picture(20, 10);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) picture.at(x, y) = x < 10 && y < 5 ? 0U : 0xFFFFFFU;
  const Result<std::string> png = encodePng(picture);
  ASSERT_TRUE(png);
  PdfCanvas canvas;
  canvas.beginPage(210, 297);
  EXPECT_NEAR(canvas.image(*png, {10, 200}, 100, 90), 50, 1e-9);
  // A second one, of other dots, stands for itself.
  picture.at(19, 9) = 0;
  const Result<std::string> second = encodePng(picture);
  EXPECT_NEAR(canvas.image(*second, {10, 100}, 100, 40), 40, 1e-9);
  EXPECT_EQ(canvas.image("no picture", {10, 40}, 100, 40), 0);
  EXPECT_EQ(canvas.image(png->substr(0, 50), {10, 40}, 100, 40), 0);
  SavedPdf pdf(test::makeTwoPiecePattern());
  const Result<std::string> bytes = canvas.finish();
  ASSERT_TRUE(bytes) << bytes.error();
  test::writeText(pdf.path, *bytes);
  const Raster page(pdf, 1);
  EXPECT_LT(page.darkest(35, 190), 60);   // in the black quarter
  EXPECT_LT(page.darkest(55, 179), 60);   // and near its corner
  EXPECT_GT(page.darkest(85, 190), 200);  // right of it
  EXPECT_GT(page.darkest(35, 160), 200);  // below it
  EXPECT_LT(page.darkest(20, 90), 60);    // the second one
  EXPECT_LT(page.darkest(88, 62), 60);    // and its last dot
  EXPECT_GT(page.darkest(35, 70), 200);
  EXPECT_NE(pdf.run({"pdfimages", "-list", pdf.path.string()}).find("20    10  rgb"),
            std::string::npos);
}

TEST(Pdf, WholeSheetIsOnePage) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedPdf pdf(pattern, {.paper = PdfPaper::OneSheet});
  const Raster page(pdf, 1);
  const SheetDrawing sheet = drawSheet(pattern);
  const Points2& cut = sheet.pieces[0].lines[0].points;
  for (const Eigen::Vector2d& p : cut) EXPECT_LT(page.darkest(p.x() + 15, p.y() + 15 + 118), 100);
  EXPECT_NEAR(page.height / kDotsPerMm, pattern.layout.max.y() + 30 + 118, 0.2);
}

TEST(Pdf, RefusesAPageBeyondWhatViewersHold) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.layout.placements[1].offset.x() += 6000;
  const Result<std::string> pdf = writePdf(drawSheet(pattern), {.paper = PdfPaper::OneSheet});
  ASSERT_FALSE(pdf);
  EXPECT_EQ(pdf.error().code, ErrorCode::Unsupported);
}

TEST(Pdf, IsTheSameEveryTimeAndDatedByTheEpoch) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedPdf first(pattern);
  EXPECT_EQ(first.bytes, SavedPdf(pattern).bytes);
  setenv("SOURCE_DATE_EPOCH", "1767225600", 1);
  const SavedPdf dated(pattern);
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_NE(dated.bytes.find("/CreationDate (20260101000000"), std::string::npos);
}

TEST(PdfTiles, AreNamedByRowAndColumn) {
  EXPECT_EQ(tileName(0, 0), "A1");
  EXPECT_EQ(tileName(1, 9), "B10");
  EXPECT_EQ(tileName(25, 0), "Z1");
  EXPECT_EQ(tileName(26, 0), "AA1");
}

TEST(PdfTiles, ThatHoldNothingAreLeftOut) {
  SheetDrawing sheet;
  const auto add = [&](Points2 points) {
    SheetLine line;
    line.points = std::move(points);
    line.closed = true;
    PieceDrawing piece;
    piece.lines.push_back(std::move(line));
    sheet.pieces.push_back(std::move(piece));
  };
  add({{0, 0}, {700, 0}, {700, 900}, {0, 900}});
  add({{1000, 1200}, {1100, 1200}, {1100, 1300}, {1000, 1300}});
  sheet.max = {1100, 1300};
  const TilePlan plan = planTiles(sheet, 2);
  EXPECT_EQ(plan.columns, 6);
  EXPECT_EQ(plan.rows, 6);
  // Tiles inside the large piece count, since it is glued together from them.
  EXPECT_LT(plan.tiles.size(), 24u);
  double area = 0;
  for (const Tile& tile : plan.tiles)
    area += std::max(0.0, std::min(tile.box.max.x(), 700.0) - std::max(tile.box.min.x(), 0.0)) *
            std::max(0.0, std::min(tile.box.max.y(), 900.0) - std::max(tile.box.min.y(), 0.0));
  EXPECT_NEAR(area, 700 * 900, 1e-6);
  EXPECT_EQ(plan.tiles.front().page, 2);
}

}  // namespace
}  // namespace toile
