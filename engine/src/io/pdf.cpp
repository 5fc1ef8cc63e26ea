// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/pdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "io/file_date.h"
#include "io/pdf_canvas.h"
#include "io/pdf_tiles.h"
#include "io/pdf_update.h"
#include "io/sheet_drawing.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kA4WidthMm = 210;
constexpr double kA4HeightMm = 297;
constexpr double kMostPageMm = 5080;  ///< 200 inches, the limit of PDF viewers
constexpr double kInchMm = 25.4;
constexpr double kBleedMm = 4;  ///< drawn beyond a tile's frame, so that a bad cut leaves no gap
constexpr double kGrey = 0.55;
const LineStyle kFrame{0.2, {}};
const LineStyle kSquare{0.35, {}};

Points2 rectangle(const Vector2d& corner, double width, double height) {
  return {corner, corner + Vector2d(width, 0), corner + Vector2d(width, height),
          corner + Vector2d(0, height)};
}

class Writer {
 public:
  Writer(const Pattern& pattern, const PdfOptions& options)
      : pattern_(pattern),
        design_(*pattern.document.design),
        options_(options),
        sheet_(drawSheet(pattern)) {}

  Result<std::string> write() {
    canvas_.setTitle(title());
    if (const auto date = fileDate(design_))
      canvas_.setDate(fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", date->year, date->month,
                                  date->day, date->hour, date->minute, date->second));
    if (options_.tiled) {
      writeTiles();
    } else if (auto whole = writeWholeSheet(); !whole) {
      return whole.error();
    }
    Result<std::string> bytes = canvas_.finish();
    if (!bytes) return bytes;
    return withoutPrintScaling(*std::move(bytes));
  }

 private:
  [[nodiscard]] std::string title() const {
    const std::string style = design_.order.style.empty() ? design_.name : design_.order.style;
    std::string text = style.empty() ? "Pattern" : style;
    if (!design_.order.size.empty()) text += ", size " + design_.order.size;
    if (!design_.order.customer.empty()) text += ", for " + design_.order.customer;
    if (!design_.order.date.empty()) text += ", " + design_.order.date;
    return text;
  }

  void drawPieces() {
    for (const PieceDrawing& piece : sheet_.pieces) {
      for (const SheetLine& line : piece.lines) canvas_.line(line.points, line.closed, line.style);
      for (const SheetText& text : piece.texts) canvas_.text(text);
    }
  }

  /// A square to measure, with its size along two sides.
  void drawSquare(const Vector2d& corner, double side, const std::string& size) {
    canvas_.line(rectangle(corner, side, side), true, kSquare);
    SheetText text;
    text.size = 4;
    text.text = size;
    text.position = corner + Vector2d(0.5 * side, 2.5);
    canvas_.text(text);
    text.position = corner + Vector2d(side - 2.5, 0.5 * side);
    text.angle = 0.5 * std::numbers::pi;
    canvas_.text(text);
  }

  void drawLines(Vector2d at, double size, double feed, const std::vector<std::string>& lines,
                 double most) {
    for (const std::string& line : lines) {
      canvas_.textFromLeft(at, size, line, false, most);
      at.y() -= feed;
    }
  }

  void drawLegend(Vector2d at) {
    struct Entry {
      SheetRole role;
      LineStyle style;
      const char* text;
    };
    const Entry entries[] = {
        {SheetRole::Cut, {0.6, {}}, "cut here"},
        {SheetRole::Sew, {0.35, {5, 2.5}}, "sew here"},
        {SheetRole::Internal, {0.25, {8, 2, 1.5, 2}}, "feature line, for matching"},
        {SheetRole::Internal, {0.25, {1.5, 1.5}}, "elastic line"},
        {SheetRole::Grain, {0.35, {}}, "grain, arrows at both ends"},
    };
    for (const Entry& entry : entries) {
      canvas_.line({at, at + Vector2d(22, 0)}, false, entry.style);
      if (entry.role == SheetRole::Grain) {
        canvas_.line({at + Vector2d(4, 1.4), at, at + Vector2d(4, -1.4)}, false, entry.style);
        canvas_.line({at + Vector2d(18, 1.4), at + Vector2d(22, 0), at + Vector2d(18, -1.4)}, false,
                     entry.style);
      }
      canvas_.textFromLeft(at + Vector2d(25, -1.2), 3.4, entry.text);
      at.y() -= 7;
    }
    canvas_.line({at, at + Vector2d(0, -4)}, false, {0.5, {}});
    canvas_.textFromLeft(at + Vector2d(4, -3.2), 3.4, "notch; equal numbers meet");
  }

  /// The sheet in small with the grid of tiles, in a box with its upper left corner at `at`.
  /// @return the height used
  double drawMap(const Vector2d& at, double width, double most, const TilePlan& plan) {
    const double gridWidth = plan.columns * kTileWidthMm;
    const double gridHeight = plan.rows * kTileHeightMm;
    const double scale = std::min(width / gridWidth, most / gridHeight);
    const Vector2d corner = at - Vector2d(0, scale * gridHeight);
    const auto small = [&](const Vector2d& p) -> Vector2d {
      return corner + scale * (p - plan.origin);
    };
    for (const PieceDrawing& piece : sheet_.pieces) {
      for (const SheetLine& line : piece.lines) {
        if (line.role != SheetRole::Cut) continue;
        const std::vector<char> keep(line.points.size(), 0);
        Points2 points;
        for (const std::size_t i : simplifiedIndices(line.points, keep, 0.1 / scale))
          points.push_back(small(line.points[i]));
        canvas_.line(points, true, {0.25, {}});
      }
    }
    for (int r = 0; r < plan.rows; ++r) {
      for (int c = 0; c < plan.columns; ++c) {
        const Tile* tile = plan.find(r, c);
        if (tile == nullptr) continue;
        canvas_.line(rectangle(small(tile->box.min), scale * kTileWidthMm, scale * kTileHeightMm),
                     true, {0.12, {}}, kGrey);
        SheetText text;
        text.size = std::min(4.0, scale * kTileWidthMm / 2.2);
        text.text = tile->name();
        text.position =
            small(0.5 * (tile->box.min + tile->box.max)) - Vector2d(0, 0.36 * text.size);
        canvas_.text(text, 0.35);
      }
    }
    return scale * gridHeight;
  }

  void drawPieceList(Vector2d at, double width, double lowest) {
    constexpr double kFeedMm = 4.6;
    const std::size_t count = pattern_.pieces.size();
    const double feed =
        std::min(kFeedMm, (at.y() - lowest) / static_cast<double>(std::max<std::size_t>(count, 1)));
    for (const PatternPiece& piece : pattern_.pieces) {
      canvas_.textFromLeft(at, 0.74 * feed,
                           fmt::format("{}  {}, cut {}", piece.number, piece.name, piece.count),
                           false, width);
      at.y() -= feed;
    }
  }

  void writeCover(const TilePlan& plan, int pages) {
    canvas_.beginPage(kA4WidthMm, kA4HeightMm);
    const double left = 0.5 * (kA4WidthMm - kTileWidthMm);
    const double bottom = 0.5 * (kA4HeightMm - kTileHeightMm);
    canvas_.setShift({left, bottom});
    const double top = kTileHeightMm;
    canvas_.textFromLeft({0, top - 6}, 7, title(), true, kTileWidthMm);
    canvas_.textFromLeft({0, top - 14}, 4.2,
                         "Print at 100 % (\"actual size\"), not \"fit to page\", on A4 or Letter; "
                         "then measure both squares.",
                         false, kTileWidthMm);
    constexpr double kFourInches = 4 * kInchMm;
    const double upper = kFourInches + 6;
    drawSquare({0, 0}, kFourInches, "4 in");
    drawSquare({0, upper}, 100, "100 mm");
    drawLines({5, upper + 90}, 3.6, 5.6,
              {fmt::format("{} pages, {} of them tiles of the pattern.", pages, plan.tiles.size()),
               "Trim each tile along its frame and butt the tiles",
               "together so that the diamonds on the edges close.",
               "There is no overlap; lines run a little beyond the",
               "frame so that no gap is left.", "Tiles that hold nothing are not printed.", "",
               "Every piece lies with the outside of the material up,",
               "arrow of the tile upwards as on the body."},
              84);
    drawLegend({5, 88});
    drawLines(
        {5, 34}, 3.6, 5.6,
        {"Letters beside a seam are the same on both pieces", "that are sewn together there."}, 90);
    const double column = kFourInches + 6;
    const double width = kTileWidthMm - column;
    canvas_.textFromLeft({column, top - 25}, 4.2, "Tiles", true);
    const double mapTop = top - 29;
    const double used = drawMap({column, mapTop}, width, 120, plan);
    const double listTop = mapTop - used - 9;
    canvas_.textFromLeft({column, listTop}, 4.2, "Pieces", true);
    drawPieceList({column, listTop - 6}, width, 0);
  }

  void drawDiamond(const Vector2d& at, const Vector2d& inward, const std::string& text) {
    constexpr double kHalf = 5;
    canvas_.line({at + Vector2d(kHalf, 0), at + Vector2d(0, kHalf), at - Vector2d(kHalf, 0),
                  at - Vector2d(0, kHalf)},
                 true, kFrame);
    SheetText label;
    label.size = 3;
    label.text = text;
    label.position = at + 8.5 * inward - Vector2d(0, 1);
    canvas_.text(label, kGrey);
  }

  void writeTile(const TilePlan& plan, const Tile& tile, int pages) {
    canvas_.beginPage(kA4WidthMm, kA4HeightMm);
    const Vector2d corner(0.5 * (kA4WidthMm - kTileWidthMm), 0.5 * (kA4HeightMm - kTileHeightMm));
    canvas_.setShift(corner - tile.box.min);
    canvas_.beginClip(
        {tile.box.min - Vector2d(1, 1) * kBleedMm, tile.box.max + Vector2d(1, 1) * kBleedMm});
    drawPieces();
    const Vector2d middle = 0.5 * (tile.box.min + tile.box.max);
    const auto mark = [&](const Vector2d& at, const Vector2d& inward, int row, int column) {
      if (plan.find(row, column) == nullptr) return;
      drawDiamond(at, inward, tileName(row, column));
    };
    mark({tile.box.min.x(), middle.y()}, {1, 0}, tile.row, tile.column - 1);
    mark({tile.box.max.x(), middle.y()}, {-1, 0}, tile.row, tile.column + 1);
    mark({middle.x(), tile.box.max.y()}, {0, -1}, tile.row - 1, tile.column);
    mark({middle.x(), tile.box.min.y()}, {0, 1}, tile.row + 1, tile.column);
    canvas_.endClip();
    canvas_.line(rectangle(tile.box.min, kTileWidthMm, kTileHeightMm), true, kFrame);
    // In the margin above the frame: name, arrow up, page, whose pattern it is.
    canvas_.setShift(corner + Vector2d(0, kTileHeightMm));
    canvas_.textFromLeft({0, 6.5}, 6, tile.name(), true);
    canvas_.line({{19, 6}, {19, 13}}, false, kSquare);
    canvas_.line({{17.5, 10.5}, {19, 13}, {20.5, 10.5}}, false, kSquare);
    canvas_.textFromLeft({26, 6.5}, 3.6,
                         fmt::format("page {} of {}   {}", tile.page, pages, title()), false,
                         kTileWidthMm - 26);
    canvas_.setShift(corner);
    canvas_.textFromLeft({0, -9}, 3.6, piecesOn(tile), false, kTileWidthMm);
  }

  /// Names of the pieces that have a part on the tile.
  [[nodiscard]] std::string piecesOn(const Tile& tile) const {
    std::string names;
    for (const PieceDrawing& piece : sheet_.pieces) {
      const auto isHere = [&](const SheetLine& line) {
        if (line.role != SheetRole::Cut) return false;
        for (std::size_t k = 0; k < line.points.size(); ++k)
          if (crosses(tile.box, line.points[k], line.points[(k + 1) % line.points.size()]))
            return true;
        return isInside({line.points}, 0.5 * (tile.box.min + tile.box.max));
      };
      if (!std::any_of(piece.lines.begin(), piece.lines.end(), isHere)) continue;
      names += names.empty() ? piece.name : ", " + piece.name;
    }
    return names;
  }

  void writeTiles() {
    const TilePlan plan = planTiles(sheet_, 2);
    const int pages = 1 + static_cast<int>(plan.tiles.size());
    writeCover(plan, pages);
    for (const Tile& tile : plan.tiles) writeTile(plan, tile, pages);
  }

  /// One page for a plotter or a projector: the sheet, and below it the squares.
  Result<void> writeWholeSheet() {
    constexpr double kAroundMm = 15;
    constexpr double kFootMm = 118;
    constexpr double kFourInches = 4 * kInchMm;
    const Vector2d size = sheet_.box.size();
    const double width = std::max(size.x() + 2 * kAroundMm, 2 * kAroundMm + kFourInches + 230);
    const double height = size.y() + 2 * kAroundMm + kFootMm;
    if (std::max(width, height) > kMostPageMm)
      return Error{
          ErrorCode::Unsupported,
          fmt::format("the sheet is {:.0f} x {:.0f} mm, and a PDF page holds at most {:.0f} "
                      "mm; print tiles, or use the DXF or SVG",
                      width, height, kMostPageMm),
          {}};
    canvas_.beginPage(width, height);
    canvas_.setShift(Vector2d(kAroundMm, kAroundMm + kFootMm) - sheet_.box.min);
    drawPieces();
    canvas_.setShift({kAroundMm, kAroundMm});
    drawSquare({0, 0}, 100, "100 mm");
    drawSquare({108, 0}, kFourInches, "4 in");
    canvas_.textFromLeft({220, 92}, 7, title(), true, width - 2 * kAroundMm - 220);
    drawLines({220, 82}, 4, 6.2,
              {"Plot at 100 %; measure both squares.",
               "Outside of the material up, on the body as it lies here."},
              width - 2 * kAroundMm - 220);
    drawLegend({220, 60});
    return {};
  }

  const Pattern& pattern_;
  const Design& design_;
  PdfOptions options_;
  SheetDrawing sheet_;
  PdfCanvas canvas_;
};

}  // namespace

Result<std::string> writePdf(const Pattern& pattern, const PdfOptions& options) {
  return Writer(pattern, options).write();
}

}  // namespace toile
