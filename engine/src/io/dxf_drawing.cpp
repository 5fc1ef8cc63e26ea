// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <iterator>

#include "toile/io/dxf_file.h"

namespace toile {
namespace {

/// Shortest digits that read back bit for bit, without exponent.
std::string digits(double value) {
  if (value == 0) return "0.0";  // never "-0"
  std::array<char, 400> text{};
  const auto [end, problem] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  std::string out(text.data(), end);
  if (out.find('.') == std::string::npos) out += ".0";
  return out;
}

class Writer {
 public:
  std::string write(const DxfDrawing& drawing) {
    begin("HEADER");
    group(0, "ENDSEC");
    begin("BLOCKS");
    for (const DxfBlock& block : drawing.blocks) {
      group(0, "BLOCK");
      group(8, "1");
      group(2, block.name);
      group(70, "0");
      point(10, {0, 0});
      group(3, block.name);
      for (const DxfEntity& entity : block.entities) write(entity);
      group(0, "ENDBLK");
      group(8, "1");
    }
    group(0, "ENDSEC");
    begin("ENTITIES");
    for (const DxfInsert& insert : drawing.inserts) {
      group(0, "INSERT");
      group(8, "1");
      group(2, insert.block);
      point(10, insert.at);
      if (insert.scale != Eigen::Vector2d(1, 1)) {
        group(41, digits(insert.scale.x()));
        group(42, digits(insert.scale.y()));
      }
      if (insert.angle != 0) group(50, digits(insert.angle));
    }
    for (const DxfEntity& entity : drawing.entities) write(entity);
    group(0, "ENDSEC");
    group(0, "EOF");
    return std::move(text_);
  }

 private:
  void group(int code, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "{:3}\r\n{}\r\n", code, value);
  }
  void begin(std::string_view section) {
    group(0, "SECTION");
    group(2, section);
  }
  void point(int code, const Eigen::Vector2d& p) {
    group(code, digits(p.x()));
    group(code + 10, digits(p.y()));
  }

  void write(const DxfEntity& entity) {
    switch (entity.kind) {
      case DxfEntity::Kind::Polyline:
        group(0, "POLYLINE");
        group(8, entity.layer);
        group(66, "1");
        group(70, entity.closed ? "1" : "0");
        for (const Eigen::Vector2d& p : entity.points) {
          group(0, "VERTEX");
          group(8, entity.layer);
          point(10, p);
        }
        group(0, "SEQEND");
        group(8, entity.layer);
        return;
      case DxfEntity::Kind::Line:
        group(0, "LINE");
        group(8, entity.layer);
        point(10, entity.points[0]);
        point(11, entity.points[1]);
        return;
      case DxfEntity::Kind::Point:
        group(0, "POINT");
        group(8, entity.layer);
        point(10, entity.points[0]);
        if (entity.z != 0) group(30, digits(entity.z));
        if (entity.width) group(39, digits(*entity.width));
        if (entity.angle) group(50, digits(*entity.angle));
        return;
      case DxfEntity::Kind::Text:
        group(0, "TEXT");
        group(8, entity.layer);
        point(10, entity.points[0]);
        group(40, digits(entity.height));
        group(1, entity.text);
        if (entity.angle) group(50, digits(*entity.angle));
        return;
    }
  }

  std::string text_;
};

}  // namespace

std::string writeDxf(const DxfDrawing& drawing) {
  return Writer().write(drawing);
}

}  // namespace toile
