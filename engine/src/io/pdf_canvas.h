// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "finish/polygon.h"
#include "toile/io/sheet_drawing.h"

namespace toile {

/// A colour to fill with, each 0..1.
struct Ink {
  double red = 0, green = 0, blue = 0, opacity = 1;
};

/// A PDF in memory, drawn in millimetres with y up; lines and text stay vectors, fonts are
/// embedded.
class PdfCanvas {
 public:
  PdfCanvas();
  ~PdfCanvas();
  PdfCanvas(const PdfCanvas&) = delete;
  PdfCanvas& operator=(const PdfCanvas&) = delete;

  void setTitle(const std::string& utf8);
  /// "2026-01-31T00:00:00Z"; a document without has no date, not the clock's.
  void setDate(const std::string& iso);

  /// Begins a page; what follows is drawn at p + shift from its lower left corner.
  void beginPage(double widthMm, double heightMm);
  void setShift(const Eigen::Vector2d& shift) { shift_ = shift; }
  /// Only inside that box (in drawing coordinates) until endClip(); lines outside are left out.
  void beginClip(const Box2& box);
  void endClip();

  void line(const Points2& points, bool closed, const Pen& pen, double grey = 0);
  void text(const SheetText& text, double grey = 0);
  /// Left-aligned; @return the width in mm. A text wider than `most` is set smaller to fit it.
  double textFromLeft(const Eigen::Vector2d& baseline, double size, const std::string& utf8,
                      bool bold = false, double most = 1e9);

  /// Polygons by the even-odd rule, without a rim.
  void fill(const std::vector<Points2>& loops, const Ink& ink);
  /// Keeps what `draw` draws into the box, to be placed as often as wanted: the file holds it once.
  /// @return its number, for place()
  std::size_t record(const Box2& box, const std::function<void()>& draw);
  void place(std::size_t recorded, const Eigen::Vector2d& shift);
  /// A PNG of 8-bit red, green and blue with its upper left corner there, as large as fits.
  /// @return the height used, mm; 0 where the bytes are no picture
  double image(std::string_view png, const Eigen::Vector2d& upperLeft, double width,
               double mostHeight);

  /// Ends the document. @return its bytes, or an Error where the library reports one.
  Result<std::string> finish();

 private:
  struct State;
  [[nodiscard]] Eigen::Vector2d toPage(const Eigen::Vector2d& p) const;
  void drawText(const Eigen::Vector2d& at, double angle, double size, bool bold, double grey,
                const std::string& utf8, double alignment);

  std::unique_ptr<State> state_;
  Eigen::Vector2d shift_{0, 0};
  double pageHeight_ = 0;
  bool hasPage_ = false;
  bool hasDate_ = false;
  bool isClipped_ = false;
  Box2 clip_;
};

}  // namespace toile
