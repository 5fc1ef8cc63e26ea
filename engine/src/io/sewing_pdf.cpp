// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "io/file_date.h"
#include "io/pdf_canvas.h"
#include "io/sewing_sheet.h"
#include "toile/io/sewing_files.h"
#include "toile/io/sheet_drawing.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kWidthMm = 210;
constexpr double kHeightMm = 297;
constexpr double kMarginMm = 15;
constexpr double kInnerMm = kWidthMm - 2 * kMarginMm;
constexpr double kTextMm = 3.4;
constexpr double kFeedMm = 5;
constexpr double kGrey = 0.55;
constexpr Ink kShadow{0, 0, 0, 0.13};

/// A column of a table: where it begins and how wide its text may be, mm.
struct Column {
  const char* head;
  double at, width;
};

class Writer {
 public:
  Writer(const Pattern& pattern, const SewingSheet& sheet) : pattern_(pattern), sheet_(sheet) {}

  Result<std::string> write(std::string_view cover) {
    canvas_.setTitle("Sewing: " + sheet_.title);
    if (const auto date = fileDate(*pattern_.document.design))
      canvas_.setDate(fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", date->year, date->month,
                                  date->day, date->hour, date->minute, date->second));
    beginPage();
    canvas_.textFromLeft({0, y_ - 6}, 7, sheet_.title, true, kInnerMm);
    y_ -= 14;
    if (!cover.empty()) {
      const double height = canvas_.image(cover, {0, y_}, kInnerMm, 115);
      y_ -= height + 8;
    }
    addSummary();
    addFabrics();
    addPieces();
    addSteps();
    addContract();
    return canvas_.finish();
  }

 private:
  void beginPage() {
    canvas_.beginPage(kWidthMm, kHeightMm);
    canvas_.setShift({kMarginMm, kMarginMm});
    ++page_;
    canvas_.textFromLeft({0, -6}, 3, fmt::format("{}   sewing sheet, page {}", sheet_.title, page_),
                         false, kInnerMm);
    y_ = kHeightMm - 2 * kMarginMm;
  }
  /// @return whether a new page began
  bool makeRoom(double height) {
    if (y_ >= height) return false;
    beginPage();
    return true;
  }
  void heading(const std::string& text, double withBelow) {
    makeRoom(14 + withBelow);
    y_ -= 10;
    canvas_.textFromLeft({0, y_}, 4.6, text, true, kInnerMm);
    y_ -= 7;
  }
  void row(std::span<const Column> columns, const std::vector<std::string>& cells, bool bold) {
    if (makeRoom(kFeedMm) && !bold) head(columns);
    y_ -= kFeedMm;
    for (std::size_t i = 0; i < columns.size(); ++i) cell(columns[i], cells[i], bold);
    canvas_.line({{0, y_ - 1.4}, {kInnerMm, y_ - 1.4}}, false, {bold ? 0.3 : 0.1, {}}, kGrey);
  }
  /// What would get too small to read in one line takes two.
  void cell(const Column& column, const std::string& text, bool bold) {
    constexpr double kMostShrink = 1.5;
    constexpr double kSmallMm = 2.3;
    const std::size_t before = text.rfind(' ', text.size() / 2);
    const std::size_t after = text.find(' ', text.size() / 2);
    const bool isFirst =
        before != std::string::npos &&
        (after == std::string::npos || text.size() / 2 - before < after - text.size() / 2);
    const std::size_t blank = isFirst ? before : after;
    if (blank == std::string::npos || estimatedWidth(text, kTextMm) < kMostShrink * column.width) {
      canvas_.textFromLeft({column.at, y_}, kTextMm, text, bold, column.width);
      return;
    }
    canvas_.textFromLeft({column.at, y_ + 1.8}, kSmallMm, text.substr(0, blank), bold,
                         column.width);
    canvas_.textFromLeft({column.at, y_ - 0.6}, kSmallMm, text.substr(blank + 1), bold,
                         column.width);
  }
  void head(std::span<const Column> columns) {
    std::vector<std::string> cells;
    for (const Column& column : columns) cells.emplace_back(column.head);
    row(columns, cells, true);
  }

  void addSummary() {
    int cut = 0;
    for (const PatternPiece& piece : pattern_.pieces) cut += piece.count;
    for (const std::string& line :
         {fmt::format("{} pieces to cut, {} seams, {:.2f} m of seam in all", cut,
                      sheet_.plan.steps.size(), sheet_.plan.totalLength / 1000),
          fmt::format("Sewing takes about {} (an estimate)",
                      describeMinutes(sheet_.plan.minutes))}) {
      makeRoom(6);
      y_ -= 6;
      canvas_.textFromLeft({0, y_}, 4, line, false, kInnerMm);
    }
  }

  void addFabrics() {
    heading("Fabrics", 2 * kFeedMm);
    constexpr Column kColumns[] = {{"Fabric", 0, 90}, {"Pieces", 95, 20}, {"Area cut", 120, 40}};
    head(kColumns);
    for (const FabricUse& use : sheet_.fabrics)
      row(kColumns,
          {use.name.empty() ? "not named" : use.name, std::to_string(use.pieces),
           fmt::format("{:.3f} m\u00b2", use.area / 1e6)},
          false);
  }

  /// What figures from one side share: below the piece the model, above it shades and lines.
  struct Figure {
    std::size_t below = 0, above = 0;
  };
  Figure recordFigure(const BodyView& view, double scale) {
    const Box2 box{Vector2d::Zero(), scale * view.size};
    Figure figure;
    figure.below = canvas_.record(box, [&] {
      canvas_.fill(scaled(view.body, scale), {0.91, 0.91, 0.9});
    });
    figure.above = canvas_.record(box, [&] {
      canvas_.fill(scaled(view.shade, scale), kShadow);
      canvas_.fill(scaled(view.deepShade, scale), kShadow);
      for (const std::vector<Points2>& loops : view.pieces)
        for (const Points2& loop : scaled(loops, scale)) canvas_.line(loop, true, {0.08, {}}, 0.45);
    });
    return figure;
  }
  static std::vector<Points2> scaled(std::vector<Points2> loops, double scale,
                                     const Vector2d& shift = Vector2d::Zero()) {
    for (Points2& loop : loops)
      for (Vector2d& p : loop) p = shift + scale * p;
    return loops;
  }

  /// The model in small with one piece filled.
  void drawFigure(std::size_t piece, const Vector2d& corner, double width, double height) {
    const std::size_t side = sheet_.body.viewOf[piece];
    const BodyView& view = sheet_.body.views[side];
    const double scale = std::min(width / view.size.x(), height / view.size.y());
    const Vector2d at = corner + 0.5 * (Vector2d(width, height) - scale * view.size);
    if (!figures_.contains(side)) figures_[side] = recordFigure(view, scale);
    const std::vector<Points2> own = scaled(view.pieces[piece], scale, at);
    canvas_.place(figures_[side].below, at);
    canvas_.fill(own, {0.93, 0.66, 0.25});
    canvas_.place(figures_[side].above, at);
    for (const Points2& loop : own) canvas_.line(loop, true, {0.25, {}}, 0.15);
  }

  void addPieces() {
    constexpr int kColumns = 4;
    constexpr double kCellWidth = kInnerMm / kColumns;
    constexpr double kFigureMm = 40;
    constexpr double kCellHeight = kFigureMm + 22;
    heading("Pieces and where they sit", kCellHeight + 5);
    for (std::size_t i = 0; i < pattern_.pieces.size(); ++i) {
      const int column = static_cast<int>(i) % kColumns;
      if (column == 0) {
        makeRoom(kCellHeight);
        y_ -= kCellHeight;
      }
      const PatternPiece& piece = pattern_.pieces[i];
      const double x = column * kCellWidth;
      constexpr double kWide = kCellWidth - 4;
      drawFigure(i, {x, y_ + 20}, kWide, kFigureMm);
      canvas_.textFromLeft({x, y_ + 14}, 3.4, fmt::format("{}  {}", piece.number, piece.name), true,
                           kWide);
      canvas_.textFromLeft(
          {x, y_ + 10}, 3,
          fmt::format("cut {}{}", piece.count, piece.fabric.empty() ? "" : ", " + piece.fabric),
          false, kWide);
      canvas_.textFromLeft(
          {x, y_ + 6}, 3,
          fmt::format("{:.0f} cm\u00b2, {:.0f} mm round", sheet_.area[i] / 100, sheet_.length[i]),
          false, kWide);
      canvas_.textFromLeft(
          {x, y_ + 2}, 3,
          fmt::format("seen from {}", sheet_.body.views[sheet_.body.viewOf[i]].from), false, kWide);
    }
  }

  void addSteps() {
    heading("Order of sewing", 3 * kFeedMm);
    constexpr Column kColumns[] = {
        {"", 0, 4},         {"", 6, 6},       {"Edges", 14, 24},       {"Seam", 40, 36},
        {"Pieces", 78, 42}, {"How", 122, 24}, {"Lengths mm", 148, 24}, {"min", 174, 6}};
    head(kColumns);
    for (std::size_t s = 0; s < sheet_.plan.steps.size(); ++s) {
      const SewStep& step = sheet_.plan.steps[s];
      const SewEdge& a = sheet_.plan.edges[step.edgeA];
      const SewEdge& b = sheet_.plan.edges[step.edgeB];
      const std::string pieces = a.piece == b.piece ? pattern_.pieces[a.piece].name
                                                    : pattern_.pieces[a.piece].name + " to " +
                                                          pattern_.pieces[b.piece].name;
      row(kColumns,
          {"", std::to_string(s + 1), fmt::format("{} + {}", a.code, b.code),
           curveName(pattern_, a.curve), pieces, describe(step.kind),
           fmt::format("{:.1f} + {:.1f}", a.length, b.length), fmt::format("{:.0f}", step.minutes)},
          false);
      // To tick off.
      canvas_.line({{0, y_ - 0.4}, {3, y_ - 0.4}, {3, y_ + 2.6}, {0, y_ + 2.6}}, true, {0.2, {}});
    }
  }

  void addContract() {
    heading("Length contract, mm", 4 * kFeedMm);
    canvas_.textFromLeft({0, y_}, 3, "inputs " + sheet_.inputs, false, kInnerMm);
    y_ -= 2;
    constexpr Column kColumns[] = {{"Piece", 0, 40},     {"Edge", 42, 14},  {"Line", 58, 40},
                                   {"Rule", 100, 10},    {"Body", 112, 15}, {"Wanted", 128, 15},
                                   {"Pattern", 144, 15}, {"Mate", 160, 10}, {"Diff.", 171, 9}};
    head(kColumns);
    for (const LengthLine& line : sheet_.contract) {
      const bool isFree = line.rule == LengthRule::Free;
      const auto length = [](double mm) { return fmt::format("{:.1f}", mm); };
      const double difference = std::abs(line.difference) < 5e-4 ? 0 : line.difference;
      row(kColumns,
          {line.piece, line.edge, line.name, std::string(toString(line.rule)),
           isFree ? "" : length(line.body), isFree ? "" : length(line.target), length(line.pattern),
           line.matePiece.empty() ? "" : length(line.mate),
           isFree ? "" : fmt::format("{:.3f}", difference)},
          false);
    }
  }

  const Pattern& pattern_;
  const SewingSheet& sheet_;
  PdfCanvas canvas_;
  std::map<std::size_t, Figure> figures_;  ///< by the side they are seen from
  double y_ = 0;
  int page_ = 0;
};

}  // namespace

Result<std::string> writeSewingPdf(const Pattern& pattern, const SewingSheet& sheet,
                                   std::string_view coverPng) {
  return Writer(pattern, sheet).write(coverPng);
}

Result<std::string> writeSewingPdf(const Pattern& pattern, std::string_view coverPng) {
  return writeSewingPdf(pattern, sewingSheet(pattern), coverPng);
}

}  // namespace toile
