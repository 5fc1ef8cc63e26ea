// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/pdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "io/pdf_canvas.h"
#include "io/pdf_tiles.h"
#include "io/pdf_update.h"

namespace toile {
namespace {

using Eigen::Vector2d;

/// A page, and the part of it that home printers reach.
struct Page {
  const char* name;
  double width, height;  ///< mm
  double tileWidth, tileHeight;
};
constexpr double kPrinterMarginMm = 10;

Page pageOf(PdfPaper paper) {
  const auto whole = [](const char* name, double width, double height) {
    return Page{name, width, height, width - 2 * kPrinterMarginMm, height - 2 * kPrinterMarginMm};
  };
  const Page both{"A4 or Letter", 210, 297, kTileWidthMm, kTileHeightMm};
  switch (paper) {
    case PdfPaper::A4OrLetter:
    case PdfPaper::OneSheet:
      break;
    case PdfPaper::A4:
      return whole("A4", 210, 297);
    case PdfPaper::Letter:
      return whole("Letter", 215.9, 279.4);
    case PdfPaper::A3:
      return whole("A3", 297, 420);
    case PdfPaper::A0:
      return whole("A0", 841, 1189);
  }
  return both;
}

constexpr double kMostPageMm = 5080;  ///< 200 inches, the limit of PDF viewers
constexpr double kInchMm = 25.4;
constexpr double kBleedMm = 4;  ///< drawn beyond a tile's frame, so that a bad cut leaves no gap
constexpr double kGrey = 0.55;
const Pen kFrame{0.2, {}};
const Pen kSquare{0.35, {}};

Points2 rectangle(const Vector2d& corner, double width, double height) {
  return {corner, corner + Vector2d(width, 0), corner + Vector2d(width, height),
          corner + Vector2d(0, height)};
}

class Writer {
 public:
  Writer(const SheetDrawing& sheet, const PdfOptions& options)
      : options_(options),
        page_(pageOf(options.paper)),
        corner_(0.5 * (page_.width - page_.tileWidth), 0.5 * (page_.height - page_.tileHeight)),
        sheet_(sheet) {
    for (const PieceDrawing& piece : sheet.pieces) {
      Points2 cut;
      for (const SheetLine& line : piece.lines)
        if (line.role == SheetRole::Cut)
          cut.insert(cut.end(), line.points.begin(), line.points.end());
      boxes_.push_back(boxOf(cut));
    }
  }

  Result<std::string> write() {
    canvas_.setTitle(sheet_.heading);
    if (!sheet_.date.empty()) canvas_.setDate(sheet_.date);
    if (options_.paper != PdfPaper::OneSheet) {
      writeTiles();
    } else if (auto whole = writeWholeSheet(); !whole) {
      return whole.error();
    }
    Result<std::string> bytes = canvas_.finish();
    if (!bytes) return bytes;
    return withoutPrintScaling(*std::move(bytes));
  }

 private:
  void drawPieces() {
    drawPiece(sheet_.around);
    for (const PieceDrawing& piece : sheet_.pieces) drawPiece(piece);
  }

  void drawPiece(const PieceDrawing& piece) {
    for (const SheetLine& line : piece.lines)
      if (line.pen.width > 0) canvas_.line(line.points, line.closed, line.pen);
    for (const SheetText& text : piece.texts) canvas_.text(text);
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
      Pen pen;
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
      canvas_.line({at, at + Vector2d(22, 0)}, false, entry.pen);
      if (entry.role == SheetRole::Grain) {
        canvas_.line({at + Vector2d(4, 1.4), at, at + Vector2d(4, -1.4)}, false, entry.pen);
        canvas_.line({at + Vector2d(18, 1.4), at + Vector2d(22, 0), at + Vector2d(18, -1.4)}, false,
                     entry.pen);
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
    const double gridWidth = plan.columns * plan.step().x() + plan.size.overlap;
    const double gridHeight = plan.rows * plan.step().y() + plan.size.overlap;
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
        canvas_.line(
            rectangle(small(tile->box.min), scale * plan.step().x(), scale * plan.step().y()), true,
            {0.12, {}}, kGrey);
        SheetText text;
        text.size = std::min(4.0, scale * plan.step().x() / 2.2);
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
    const std::size_t count = sheet_.pieces.size();
    const double feed =
        std::min(kFeedMm, (at.y() - lowest) / static_cast<double>(std::max<std::size_t>(count, 1)));
    for (const PieceDrawing& piece : sheet_.pieces) {
      canvas_.textFromLeft(at, 0.74 * feed,
                           fmt::format("{}  {}, cut {}", piece.number, piece.name, piece.count),
                           false, width);
      at.y() -= feed;
    }
  }

  void writeCover(const TilePlan& plan, int pages) {
    canvas_.beginPage(page_.width, page_.height);
    canvas_.setShift(corner_);
    const double top = page_.tileHeight;
    canvas_.textFromLeft({0, top - 6}, 7, sheet_.heading, true, page_.tileWidth);
    canvas_.textFromLeft(
        {0, top - 14}, 4.2,
        fmt::format("Print at 100 % (\"actual size\"), not \"fit to page\", on {}; "
                    "then measure both squares.",
                    page_.name),
        false, page_.tileWidth);
    constexpr double kFourInches = 4 * kInchMm;
    const double upper = kFourInches + 6;
    drawSquare({0, 0}, kFourInches, "4 in");
    drawSquare({0, upper}, 100, "100 mm");
    drawLines({5, upper + 90}, 3.6, 5.6,
              {fmt::format("{} pages, {} of them tiles of the pattern.", pages, plan.tiles.size()),
               joining_[0], joining_[1], joining_[2], joining_[3],
               "Tiles that hold nothing are not printed.", "",
               "Every piece lies with the outside of the material up,",
               "arrow of the tile upwards as on the body."},
              84);
    drawLegend({5, 88});
    drawLines({5, 34}, 3.6, 5.6,
              {"The code beside a seam says which edges meet: 3C-5C is",
               "edge C of piece 3, sewn to edge C of piece 5."},
              90);
    const double column = kFourInches + 6;
    const double width = page_.tileWidth - column;
    canvas_.textFromLeft({column, top - 25}, 4.2, "Tiles", true);
    const double mapTop = top - 29;
    const double used = drawMap({column, mapTop}, width, 0.5 * page_.tileHeight, plan);
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
    canvas_.beginPage(page_.width, page_.height);
    const Vector2d& corner = corner_;
    canvas_.setShift(corner - tile.box.min);
    const double bleed = plan.size.overlap > 0 ? 0 : kBleedMm;
    canvas_.beginClip(
        {tile.box.min - Vector2d(1, 1) * bleed, tile.box.max + Vector2d(1, 1) * bleed});
    drawPieces();
    // With an overlap the next tile's edge lies within this one, on a dashed line.
    const Vector2d joint = tile.box.max - Vector2d(1, 1) * plan.size.overlap;
    const Vector2d middle = 0.5 * (tile.box.min + joint);
    if (plan.size.overlap > 0) {
      const Pen glue{0.2, {4, 2}};
      if (plan.find(tile.row, tile.column + 1) != nullptr)
        canvas_.line({{joint.x(), tile.box.min.y()}, {joint.x(), tile.box.max.y()}}, false, glue,
                     kGrey);
      if (plan.find(tile.row - 1, tile.column) != nullptr)
        canvas_.line({{tile.box.min.x(), joint.y()}, {tile.box.max.x(), joint.y()}}, false, glue,
                     kGrey);
    }
    const auto mark = [&](const Vector2d& at, const Vector2d& inward, int row, int column) {
      if (plan.find(row, column) == nullptr) return;
      drawDiamond(at, inward, tileName(row, column));
    };
    mark({tile.box.min.x(), middle.y()}, {1, 0}, tile.row, tile.column - 1);
    mark({joint.x(), middle.y()}, {-1, 0}, tile.row, tile.column + 1);
    mark({middle.x(), joint.y()}, {0, -1}, tile.row - 1, tile.column);
    mark({middle.x(), tile.box.min.y()}, {0, 1}, tile.row + 1, tile.column);
    canvas_.endClip();
    canvas_.line(rectangle(tile.box.min, page_.tileWidth, page_.tileHeight), true, kFrame);
    drawCaption(tile, pages);
  }

  /// In the corner of the tile, else at the side, where it meets no text and fewest lines, so that
  /// it stays when the tile is trimmed: name, arrow up, page, whose pattern it is, pieces.
  void drawCaption(const Tile& tile, int pages) {
    constexpr double kInsetMm = 4;
    const Vector2d size(84, 15);
    Box2 best;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    // Corners first. The diamond of the neighbour is in the middle of the side.
    for (const double up : {0.0, 1.0, 0.1, 0.9, 0.2, 0.8, 0.3, 0.7})
      for (const double right : {0.0, 1.0}) {
        const Vector2d room = tile.box.size() - size - Vector2d(2, 2) * kInsetMm;
        const Vector2d low =
            tile.box.min + Vector2d(kInsetMm + right * room.x(), kInsetMm + up * room.y());
        const Box2 box{low, low + size};
        const std::size_t count = clutterIn(box);
        if (count >= fewest) continue;
        fewest = count;
        best = box;
      }
    canvas_.setShift(corner_ - tile.box.min + best.min);
    canvas_.textFromLeft({0, 8}, 7, tile.name(), true);
    canvas_.line({{22, 8}, {22, 14}}, false, kSquare);
    canvas_.line({{20.5, 11.5}, {22, 14}, {23.5, 11.5}}, false, kSquare);
    canvas_.textFromLeft({27, 8}, 3.2, fmt::format("page {} of {}", tile.page, pages), false,
                         size.x() - 27);
    canvas_.textFromLeft({0, 3.6}, 2.8, sheet_.heading, false, size.x());
    canvas_.textFromLeft({0, 0}, 2.8, piecesOn(tile), false, size.x());
  }

  static bool meets(const Box2& a, const Box2& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
  }

  /// How many stretches of lines a box meets; a text counts as very many.
  [[nodiscard]] std::size_t clutterIn(const Box2& box) const {
    constexpr std::size_t kText = 1000;
    std::size_t count = 0;
    for (std::size_t i = 0; i < sheet_.pieces.size(); ++i) {
      if (!meets(boxes_[i], box)) continue;
      const PieceDrawing& piece = sheet_.pieces[i];
      for (const SheetLine& line : piece.lines)
        for (std::size_t k = 0; k + (line.closed ? 0 : 1) < line.points.size(); ++k)
          if (crosses(box, line.points[k], line.points[(k + 1) % line.points.size()])) ++count;
      for (const SheetText& text : piece.texts) {
        const Vector2d along(std::cos(text.angle), std::sin(text.angle));
        const Vector2d half = 0.5 * estimatedWidth(text.text, text.size) * along;
        const Vector2d middle = text.position + 0.35 * text.size * Vector2d(-along.y(), along.x());
        const Vector2d room = Vector2d::Constant(0.5 * text.size);
        if (crosses({box.min - room, box.max + room}, middle - half, middle + half)) count += kText;
      }
    }
    return count;
  }

  /// Names of the pieces that have a part on the tile.
  [[nodiscard]] std::string piecesOn(const Tile& tile) const {
    std::string names;
    for (std::size_t i = 0; i < sheet_.pieces.size(); ++i) {
      if (!meets(boxes_[i], tile.box)) continue;
      const PieceDrawing& piece = sheet_.pieces[i];
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
    const TilePlan plan =
        planTiles(sheet_, 2, {page_.tileWidth, page_.tileHeight, options_.overlap});
    if (options_.overlap > 0)
      joining_ = {
          "Trim each tile at its left and lower edge, glue it",
          fmt::format("{:.3g} mm over the next one, up to the dashed line,", options_.overlap),
          "so that the diamonds on the edges close.", ""};
    const int pages = 1 + static_cast<int>(plan.tiles.size());
    writeCover(plan, pages);
    for (const Tile& tile : plan.tiles) writeTile(plan, tile, pages);
  }

  /// One page for a plotter or a projector: the sheet, and below it the squares.
  Result<void> writeWholeSheet() {
    constexpr double kAroundMm = 15;
    constexpr double kFootMm = 118;
    constexpr double kFourInches = 4 * kInchMm;
    const Vector2d size = sheet_.max - sheet_.min;
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
    canvas_.setShift(Vector2d(kAroundMm, kAroundMm + kFootMm) - sheet_.min);
    drawPieces();
    canvas_.setShift({kAroundMm, kAroundMm});
    drawSquare({0, 0}, 100, "100 mm");
    drawSquare({108, 0}, kFourInches, "4 in");
    canvas_.textFromLeft({220, 92}, 7, sheet_.heading, true, width - 2 * kAroundMm - 220);
    drawLines({220, 82}, 4, 6.2,
              {"Plot at 100 %; measure both squares.",
               sheet_.isMarker ? "A marker: the roll runs to the right."
                               : "Outside of the material up, on the body as it lies here."},
              width - 2 * kAroundMm - 220);
    drawLegend({220, 60});
    return {};
  }

  PdfOptions options_;
  Page page_;
  Vector2d corner_;  ///< of the tile on its page
  std::array<std::string, 4> joining_{"Trim each tile along its frame and butt the tiles",
                                      "together so that the diamonds on the edges close.",
                                      "There is no overlap; lines run a little beyond the",
                                      "frame so that no gap is left."};
  const SheetDrawing& sheet_;
  std::vector<Box2> boxes_;  ///< of the pieces
  PdfCanvas canvas_;
};

}  // namespace

Result<PdfPaper> parsePdfPaper(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, PdfPaper>, 6> kNames{
      {{"a4-letter", PdfPaper::A4OrLetter},
       {"a4", PdfPaper::A4},
       {"letter", PdfPaper::Letter},
       {"a3", PdfPaper::A3},
       {"a0", PdfPaper::A0},
       {"one", PdfPaper::OneSheet}}};
  for (const auto& [name, paper] : kNames)
    if (name == text) return paper;
  return Error{ErrorCode::InvalidArgument,
               fmt::format("\"{}\" is no paper; give a4-letter, a4, letter, a3, a0 or one", text),
               {}};
}

Result<std::string> writePdf(const SheetDrawing& sheet, const PdfOptions& options) {
  if (!(options.overlap >= 0 && options.overlap <= 30))
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("an overlap of {} mm; give 0 to 30 mm", options.overlap),
                 {}};
  return Writer(sheet, options).write();
}

}  // namespace toile
