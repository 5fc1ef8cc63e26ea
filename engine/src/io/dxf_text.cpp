// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dxf_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

namespace toile {
namespace {

std::int64_t thousandths(double value) {
  return static_cast<std::int64_t>(std::llround(value * 1000));
}

}  // namespace

DxfPoint toDxf(const Eigen::Vector2d& mm) {
  return {thousandths(mm.x()), thousandths(mm.y())};
}

void DxfText::group(int code, std::string_view value) {
  fmt::format_to(std::back_inserter(text_), "{:3}\r\n{}\r\n", code, value);
}

void DxfText::group(int code, int value) {
  fmt::format_to(std::back_inserter(text_), "{:3}\r\n{}\r\n", code, value);
}

void DxfText::number(int code, std::int64_t value, bool isLength) {
  if (inches_ && isLength) {
    const std::string text = fmt::format("{:.5f}", static_cast<double>(value) / 25400);
    group(code, text == "-0.00000" ? "0.00000" : text);
    return;
  }
  const std::int64_t size = value < 0 ? -value : value;
  fmt::format_to(std::back_inserter(text_), "{:3}\r\n{}{}.{:03}\r\n", code, value < 0 ? "-" : "",
                 size / 1000, size % 1000);
}

void DxfText::length(int code, double mm) {
  number(code, thousandths(mm));
}

void DxfText::angle(int code, double radians) {
  std::int64_t value = thousandths(radians * 180 / std::numbers::pi) % 360000;
  if (value < 0) value += 360000;
  number(code, value, false);
}

void DxfText::point(int firstCode, const DxfPoint& p) {
  number(firstCode, p.x);
  number(firstCode + 10, p.y);
}

void DxfText::section(std::string_view name) {
  group(0, "SECTION");
  group(2, name);
}

void DxfText::endSection() {
  group(0, "ENDSEC");
}

void DxfText::text(int layer, const DxfPoint& at, double height, std::string_view ascii,
                   double radians) {
  group(0, "TEXT");
  group(8, layer);
  point(10, at);
  length(40, height);
  group(1, ascii);
  angle(50, radians);
  group(7, "STANDARD");
}

void DxfText::mark(int layer, const DxfPoint& at) {
  group(0, "POINT");
  group(8, layer);
  point(10, at);
}

void DxfText::line(int layer, const DxfPoint& from, const DxfPoint& to) {
  group(0, "LINE");
  group(8, layer);
  point(10, from);
  point(11, to);
}

void DxfText::polyline(int layer, const std::vector<DxfPoint>& points, bool closed) {
  polyline(std::to_string(layer), points, closed, 0);
}

void DxfText::polyline(std::string_view layer, const std::vector<DxfPoint>& points, bool closed,
                       int colour) {
  std::vector<DxfPoint> distinct;
  for (const DxfPoint& p : points)
    if (distinct.empty() || distinct.back() != p) distinct.push_back(p);
  while (closed && distinct.size() > 1 && distinct.back() == distinct.front()) distinct.pop_back();
  if (distinct.size() < 2) return;
  group(0, "POLYLINE");
  group(8, layer);
  if (colour > 0) group(62, colour);
  group(66, 1);
  group(70, closed ? 1 : 0);
  for (const DxfPoint& p : distinct) {
    group(0, "VERTEX");
    group(8, layer);
    point(10, p);
  }
  group(0, "SEQEND");
  group(8, layer);
}

}  // namespace toile
