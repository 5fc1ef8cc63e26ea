// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace toile {

/// A coordinate pair as it stands in the file: thousandths of a millimetre. One rounding for all
/// entities, so that a point on a vertex has the vertex's digits.
struct DxfPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(const DxfPoint&, const DxfPoint&) = default;
};
[[nodiscard]] DxfPoint toDxf(const Eigen::Vector2d& mm);

/// Group codes and values of DXF R12, CRLF, numbers with three decimals and never "-0.000".
class DxfText {
 public:
  /// In inches numbers have five decimals.
  explicit DxfText(bool inches = false) : inches_(inches) {}

  void group(int code, std::string_view value);
  void group(int code, int value);
  void length(int code, double mm);
  void angle(int code, double radians);  ///< in degrees, 0 <= angle < 360
  void point(int firstCode, const DxfPoint& p);

  void section(std::string_view name);
  void endSection();
  void text(int layer, const DxfPoint& at, double height, std::string_view ascii, double angle = 0);
  void mark(int layer, const DxfPoint& at);  ///< a POINT
  void line(int layer, const DxfPoint& from, const DxfPoint& to);
  /// Consecutive equal points are written once. Nothing is written for fewer than two points.
  void polyline(int layer, const std::vector<DxfPoint>& points, bool closed);
  /// @param colour of the index of AutoCAD; 0 = that of the layer
  void polyline(std::string_view layer, const std::vector<DxfPoint>& points, bool closed,
                int colour);

  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  void number(int code, std::int64_t thousandths, bool isLength = true);

  std::string text_;
  bool inches_ = false;
};

}  // namespace toile
