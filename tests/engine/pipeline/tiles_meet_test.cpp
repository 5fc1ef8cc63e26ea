// SPDX-License-Identifier: GPL-3.0-or-later
// The printed wetsuit as it is glued together: what leaves one tile comes in on the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "io/pdf_tiles.h"
#include "support/run_program.h"
#include "support/sample_designs.h"
#include "toile/io/pdf.h"

namespace toile::test {
namespace {

constexpr int kDotsPerMm = 5;  // pdftoppm -r 127
constexpr double kMarginMm = 10;
constexpr TileSize kA4Tile{190, 277, 0};

/// A page in grey, from poppler.
struct Page {
  explicit Page(const std::string& file) {
    std::istringstream in(readText(file));
    std::string magic;
    int most = 0;
    in >> magic >> width >> height >> most;
    in.get();
    EXPECT_EQ(magic, "P5");
    grey.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    in.read(reinterpret_cast<char*>(grey.data()), static_cast<std::streamsize>(grey.size()));
  }
  [[nodiscard]] int at(int column, int row) const {
    if (column < 0 || row < 0 || column >= width || row >= height) return 255;
    return grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
  }
  /// Within a dot of the place, which is all that the rounding of a grid of dots can move.
  [[nodiscard]] int darkest(int column, int row) const {
    int least = 255;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) least = std::min(least, at(column + dx, row + dy));
    return least;
  }
  int width = 0, height = 0;
  std::vector<unsigned char> grey;
};

struct Seen {
  int dark = 0;    ///< dots of `from` beside the edge
  int missed = 0;  ///< of them, those that `to` does not have
};

/// Compares what two pages show of a box of the sheet.
Seen compare(const Page& from, const Tile& fromTile, const Page& to, const Tile& toTile,
             const Box2& box) {
  constexpr int kDark = 100;
  constexpr int kDarkBeside = 190;  // a thin line, halved between two dots
  const auto dots = [](double mm) { return static_cast<int>(std::lround(mm * kDotsPerMm)); };
  const Eigen::Vector2d size = box.size();
  const auto corner = [&](const Page& page, const Tile& tile) {
    const Eigen::Vector2d p = box.min - tile.box.min + Eigen::Vector2d(kMarginMm, kMarginMm);
    return std::pair{dots(p.x()), page.height - dots(p.y())};
  };
  const auto [fromX, fromY] = corner(from, fromTile);
  const auto [toX, toY] = corner(to, toTile);
  Seen seen;
  for (int x = 0; x < dots(size.x()); ++x) {
    for (int y = 0; y < dots(size.y()); ++y) {
      if (from.at(fromX + x, fromY - y) > kDark) continue;
      ++seen.dark;
      if (to.darkest(toX + x, toY - y) > kDarkBeside) ++seen.missed;
    }
  }
  return seen;
}

class WetsuitTiles : public WetsuitPattern {};

TEST_F(WetsuitTiles, GoOnAcrossEveryEdge) {
  const SheetDrawing sheet = drawSheet(*pattern_);
  const Result<std::string> pdf = writePdf(sheet, {.paper = PdfPaper::A4});
  ASSERT_TRUE(pdf) << pdf.error();
  const TemporaryFolder folder;
  const std::string file = folder.path() / "a4.pdf";
  writeText(file, *pdf);
  ASSERT_EQ(runProgram({"pdftoppm", "-r", "127", "-gray", file, folder.path() / "p"}).status, 0);

  const TilePlan plan = planTiles(sheet, 2, kA4Tile);
  std::map<int, Page> pages;
  for (const Tile& tile : plan.tiles) {
    std::string number = std::to_string(tile.page);
    if (number.size() < 2) number.insert(0, "0");
    pages.emplace(tile.page, folder.path() / ("p-" + number + ".pgm"));
  }
  // Lines are drawn 4 mm beyond the frame. Near the corners frames end and begin.
  constexpr double kBesideMm = 3;
  constexpr double kFromCornerMm = 1;
  int edges = 0;
  int dark = 0;
  for (const Tile& tile : plan.tiles) {
    const auto check = [&](const Tile* next, const Box2& strip) {
      if (next == nullptr) return;
      ++edges;
      const Page& a = pages.at(tile.page);
      const Page& b = pages.at(next->page);
      const Seen there = compare(a, tile, b, *next, strip);
      const Seen back = compare(b, *next, a, tile, strip);
      dark += there.dark;
      EXPECT_EQ(there.missed, 0) << tile.name() << " is not continued by " << next->name();
      EXPECT_EQ(back.missed, 0) << next->name() << " is not continued by " << tile.name();
    };
    const Eigen::Vector2d& low = tile.box.min;
    const Eigen::Vector2d& high = tile.box.max;
    check(plan.find(tile.row, tile.column + 1), {{high.x() - kBesideMm, low.y() + kFromCornerMm},
                                                 {high.x() + kBesideMm, high.y() - kFromCornerMm}});
    check(plan.find(tile.row + 1, tile.column), {{low.x() + kFromCornerMm, low.y() - kBesideMm},
                                                 {high.x() - kFromCornerMm, low.y() + kBesideMm}});
  }
  EXPECT_GE(plan.tiles.size(), 40u);
  EXPECT_GE(edges, 40);
  EXPECT_GE(dark, 10000);  // the edges' own frames and diamonds are among them
}

}  // namespace
}  // namespace toile::test
