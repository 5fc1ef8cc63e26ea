// SPDX-License-Identifier: GPL-3.0-or-later
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>

#include "finish/polygon.h"
#include "io/dxf_groups.h"
#include "toile/io/dxf_file.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kChordErrorMm = 0.02;
constexpr int kInchInsUnits = 1;
constexpr int kMmInsUnits = 4;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Points of an arc after its first, within the chord error; `sweep` is signed.
void addArcPoints(std::vector<Vector2d>& points, const Vector2d& centre, double radius, double from,
                  double sweep) {
  const double step = 2 * std::acos(1 - std::min(kChordErrorMm / std::max(radius, 1e-9), 0.5));
  const int chords = std::clamp(static_cast<int>(std::ceil(std::abs(sweep) / step)), 1, 4096);
  for (int i = 1; i <= chords; ++i) {
    const double a = from + sweep * i / chords;
    points.emplace_back(centre + radius * Vector2d(std::cos(a), std::sin(a)));
  }
}

class Reader : public DL_CreationAdapter {
 public:
  DxfDrawing drawing;
  std::optional<int> insUnits;
  std::size_t curves = 0;  ///< arcs, circles and bulges that became chords

  void processCodeValuePair(unsigned int code, const std::string& value) override {
    // The parser hands an entity over when it meets the next one.
    if (code == 0) {
      last_ = std::move(current_);
      current_.clear();
    } else if (code < 1000) {
      current_.emplace(code, value);
    }
  }
  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") insUnits = value;
  }
  void addBlock(const DL_BlockData& data) override {
    endLine();
    const std::string name = lower(data.name);
    isLayoutBlock_ = name.starts_with("*") || name.starts_with("$");
    inBlock_ = true;
    if (!isLayoutBlock_) drawing.blocks.push_back({data.name, {}});
  }
  void endBlock() override {
    endLine();
    inBlock_ = isLayoutBlock_ = false;
  }
  void addInsert(const DL_InsertData& data) override {
    endLine();
    if (inBlock_) return;
    drawing.inserts.push_back({data.name, {data.ipx, data.ipy}, {data.sx, data.sy}, data.angle});
  }
  void addPolyline(const DL_PolylineData& data) override {
    endLine();
    hasLine_ = true;
    line_ = {};
    line_.layer = layer();
    line_.closed = (data.flags & 1) != 0;
    bulge_ = 0;
  }
  void addVertex(const DL_VertexData& data) override {
    if (!hasLine_) return;
    const Vector2d p(data.x, data.y);
    if (!line_.points.empty()) bend(line_.points.back(), p);
    line_.points.push_back(p);
    bulge_ = data.bulge;
  }
  void endSequence() override { endLine(); }
  void endEntity() override {}
  void addLine(const DL_LineData& data) override {
    DxfEntity entity = start(DxfEntity::Kind::Line);
    entity.points = {{data.x1, data.y1}, {data.x2, data.y2}};
    add(std::move(entity));
  }
  void addPoint(const DL_PointData& data) override {
    DxfEntity entity = start(DxfEntity::Kind::Point);
    entity.points = {{data.x, data.y}};
    entity.z = data.z;
    entity.width = number(39);
    entity.angle = number(50);
    add(std::move(entity));
  }
  void addText(const DL_TextData& data) override {
    DxfEntity entity = start(DxfEntity::Kind::Text);
    entity.points = {{data.ipx, data.ipy}};
    entity.text = data.text;
    entity.height = number(40).value_or(0);  // the parser's own default is another
    if (const auto angle = number(50); angle && *angle != 0) entity.angle = angle;
    add(std::move(entity));
  }
  void addArc(const DL_ArcData& data) override {
    DxfEntity entity = start(DxfEntity::Kind::Polyline);
    constexpr double kDegree = std::numbers::pi / 180;
    const double from = data.angle1 * kDegree;
    double sweep = (data.angle2 - data.angle1) * kDegree;
    while (sweep <= 0) sweep += 2 * std::numbers::pi;
    const Vector2d centre(data.cx, data.cy);
    entity.points = {centre + data.radius * Vector2d(std::cos(from), std::sin(from))};
    addArcPoints(entity.points, centre, data.radius, from, sweep);
    ++curves;
    add(std::move(entity));
  }
  void addCircle(const DL_CircleData& data) override {
    DxfEntity entity = start(DxfEntity::Kind::Polyline);
    addArcPoints(entity.points, {data.cx, data.cy}, data.radius, 0, 2 * std::numbers::pi);
    entity.closed = true;
    ++curves;
    add(std::move(entity));
  }
  void endLine() {
    if (!hasLine_) return;
    hasLine_ = false;
    if (line_.closed && bulge_ != 0 && line_.points.size() > 1) {
      bend(line_.points.back(), line_.points.front());
      bulge_ = 0;
    }
    if (line_.points.size() < 2) return;
    push(std::move(line_));
  }

 private:
  [[nodiscard]] std::string layer() const { return attributes.getLayer(); }
  [[nodiscard]] std::optional<double> number(unsigned int code) const {
    const auto found = last_.find(code);
    return found == last_.end() ? std::nullopt : parseDouble(trimmed(found->second));
  }
  DxfEntity start(DxfEntity::Kind kind) {
    endLine();
    DxfEntity entity;
    entity.kind = kind;
    entity.layer = layer();
    return entity;
  }
  void add(DxfEntity entity) { push(std::move(entity)); }
  void push(DxfEntity entity) {
    if (isLayoutBlock_) return;
    (inBlock_ ? drawing.blocks.back().entities : drawing.entities).push_back(std::move(entity));
  }
  /// A bulge is the tangent of a quarter of the arc's angle, positive to the left.
  void bend(const Vector2d& a, const Vector2d& b) {
    const double bulge = bulge_;
    const Vector2d chord = b - a;
    if (bulge == 0 || chord.norm() <= 0) return;
    const double sweep = 4 * std::atan(bulge);
    const double radius = chord.norm() / (2 * std::sin(std::abs(sweep) / 2));
    const Vector2d left(-chord.y(), chord.x());
    const Vector2d centre = 0.5 * (a + b) + left * ((1 - bulge * bulge) / (4 * bulge));
    const Vector2d from = a - centre;
    std::vector<Vector2d> points;
    addArcPoints(points, centre, radius, std::atan2(from.y(), from.x()), sweep);
    points.pop_back();  // b itself
    line_.points.insert(line_.points.end(), points.begin(), points.end());
    ++curves;
  }

  std::map<unsigned int, std::string> current_, last_;
  bool inBlock_ = false, isLayoutBlock_ = false, hasLine_ = false;
  DxfEntity line_;
  double bulge_ = 0;
};

/// The longer side of the largest piece, in the file's unit.
double largestExtent(const DxfDrawing& drawing) {
  double largest = 0;
  for (const DxfBlock& block : drawing.blocks) {
    Points2 points;
    for (const DxfEntity& entity : block.entities)
      if (entity.layer == "1" && entity.kind != DxfEntity::Kind::Text)
        points.insert(points.end(), entity.points.begin(), entity.points.end());
    largest = std::max(largest, boxOf(points).size().maxCoeff());
  }
  return largest;
}

void chooseUnit(DxfDrawing& drawing, std::optional<int> insUnits, std::optional<FileUnit> asked) {
  std::optional<std::string> told = dxfText(drawing.entities, "units");
  for (const DxfBlock& block : drawing.blocks)
    if (!told) told = dxfText(block.entities, "units");
  const double largest = largestExtent(drawing);
  constexpr double kSmallestMm = 20;
  constexpr double kLargestMm = 4000;
  if (asked) {
    drawing.unit = *asked;
    return;
  }
  if (told && lower(*told) == "metric") {
    drawing.unit = FileUnit::Millimetre;
  } else if (told && lower(*told) == "english") {
    drawing.unit = FileUnit::Inch;
  } else if (insUnits == kInchInsUnits) {
    drawing.unit = FileUnit::Inch;
  } else if (insUnits == kMmInsUnits) {
    drawing.unit = FileUnit::Millimetre;
  } else {
    // A garment's largest piece measures 0.1 to 2.5 m.
    drawing.unit = largest > 0 && largest < 90 ? FileUnit::Inch : FileUnit::Millimetre;
    drawing.findings.push_back(
        {"dxf-unit-guessed",
         fmt::format("the DXF does not say its unit; from the size of its largest piece, {:.4g}, "
                     "it is taken for {}; say --units otherwise",
                     largest, drawing.unit == FileUnit::Inch ? "inches" : "millimetres"),
         {}});
    return;
  }
  const double mm = largest * millimetresPer(drawing.unit);
  if (largest > 0 && (mm < kSmallestMm || mm > kLargestMm))
    drawing.findings.push_back(
        {"dxf-unit-doubtful",
         fmt::format("by the unit that the DXF says its largest piece would measure {:.4g} mm; say "
                     "--units if it is another",
                     mm),
         {}});
}

}  // namespace

std::optional<std::string> dxfText(const std::vector<DxfEntity>& entities, std::string_view key) {
  for (const DxfEntity& entity : entities) {
    if (entity.kind != DxfEntity::Kind::Text) continue;
    const std::size_t colon = entity.text.find(':');
    if (colon == std::string::npos) continue;
    const std::string_view text(entity.text);
    if (lower(trimmed(text.substr(0, colon))) != lower(key)) continue;
    return std::string(trimmed(text.substr(colon + 1)));
  }
  return std::nullopt;
}

Result<DxfDrawing> readDxf(std::string_view text, std::optional<FileUnit> unit) {
  if (text.size() > kMostDxfBytes)
    return Error{ErrorCode::Unsupported,
                 fmt::format("the file has {} MB; at most {} MB are read, and a pattern has a few: "
                             "export only the pieces",
                             text.size() >> 20, kMostDxfBytes >> 20),
                 {}};
  const Result<DxfGroups> groups = checkDxfGroups(text);
  if (!groups) return groups.error();
  Reader reader;
  // The parser tells the groups that it has no fields for (39, 50 of a POINT) only when it reads a
  // C stream.
  std::string content = groups->text;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
      fmemopen(content.data(), content.size(), "r"), &std::fclose);
  if (!stream) return Error{ErrorCode::FileUnreadable, "no memory is left to read the DXF", {}};
  DL_Dxf parser;
  while (parser.readDxfGroups(stream.get(), &reader)) continue;
  reader.endLine();
  DxfDrawing drawing = std::move(reader.drawing);
  chooseUnit(drawing, reader.insUnits, unit);
  for (const auto& [entity, count] : groups->leftOut)
    drawing.findings.push_back(
        {"dxf-entity-left-out",
         fmt::format("{} {} in the DXF {} left out: no pattern is drawn with {}", count, entity,
                     count == 1 ? "is" : "are", count == 1 ? "it" : "them"),
         {}});
  if (reader.curves > 0)
    drawing.findings.push_back({"dxf-curves-to-chords",
                                fmt::format("{} arcs in the DXF became chords, {} mm off at most",
                                            reader.curves, kChordErrorMm),
                                {}});
  return drawing;
}

}  // namespace toile
