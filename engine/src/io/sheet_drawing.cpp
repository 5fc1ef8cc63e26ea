// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/sheet_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "finish/polygon.h"
#include "io/file_date.h"
#include "io/polyline.h"
#include "render/label_fit.h"
#include "toile/core/parallel.h"
#include "toile/sew/sewing.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

const Pen kCutPen{0.6, {}};
const Pen kSewPen{0.35, {5, 2.5}};
const Pen kFeaturePen{0.25, {8, 2, 1.5, 2}};
const Pen kElasticPen{0.25, {1.5, 1.5}};
const Pen kMarkPen{0.25, {}};
const Pen kNotchPen{0.5, {}};
const Pen kGrainPen{0.35, {}};

constexpr double kNameSizeMm = 6;
constexpr double kLabelSizeMm = 4;
constexpr double kEdgeSizeMm = 3.2;
constexpr double kNotchSizeMm = 2.6;
constexpr double kDoubleNotchMm = 8;
constexpr double kLineFeed = 1.35;

const Pen& penOf(CurveKind kind) {
  switch (kind) {
    case CurveKind::Elastic:
      return kElasticPen;
    case CurveKind::Mark:
      return kMarkPen;
    case CurveKind::Guide:
    case CurveKind::Feature:
    case CurveKind::Seam:
    case CurveKind::Opening:
    case CurveKind::Dart:
      break;
  }
  return kFeaturePen;
}

/// Text is never upside down: the angle of a direction or of its opposite.
double readableAngle(const Vector2d& direction) {
  double angle = std::atan2(direction.y(), direction.x());
  if (angle > 0.5 * pi + 1e-9) angle -= pi;
  if (angle < -0.5 * pi + 1e-9) angle += pi;
  return angle;
}

class PieceArtist {
 public:
  PieceArtist(const Pattern& pattern, const PatternPiece& piece, const Placement& placement)
      : pattern_(pattern), piece_(piece), placement_(placement) {
    out_.id = piece_.id;
    out_.name = piece_.name;
    out_.number = piece_.number;
    out_.count = piece_.count;
    out_.fabric = piece_.fabric;
    for (const Outline& loop : piece_.sewLines) sew_.push_back(placed(positions(loop)));
  }

  PieceDrawing draw() {
    for (const Outline& loop : piece_.cutLines) {
      SheetLine line;
      line.points = placed(positions(loop));
      line.closed = true;
      line.pen = kCutPen;
      line.isCut = true;
      out_.lines.push_back(std::move(line));
    }
    drawSewLines();
    drawInternalLines();
    drawNotches();
    drawDrillHoles();
    drawGrain();
    drawFold();
    drawLabel();
    drawEdgeNames();
    return std::move(out_);
  }

 private:
  [[nodiscard]] Points2 placed(Points2 points) const {
    for (Vector2d& p : points) p = placement_.apply(p);
    return points;
  }

  [[nodiscard]] Points2 pointsOf(const OutlineRun& run) const {
    const Points2& loop = sew_[run.loop];
    Points2 points;
    for (std::size_t i = 0; i <= run.edgeCount; ++i)
      points.push_back(loop[(run.first + i) % loop.size()]);
    return points;
  }

  [[nodiscard]] std::string pieceName(const std::string& id) const {
    for (const PatternPiece& piece : pattern_.pieces)
      if (piece.id == id) return piece.name;
    return id;
  }

  [[nodiscard]] std::string curveName(const std::string& id) const {
    for (const StylingCurve& curve : pattern_.document.design->curves)
      if (curve.id == id && !curve.name.empty()) return curve.name;
    return id;
  }

  void drawSewLines() {
    for (const OutlineRun& run : piece_.runs) {
      SheetLine line;
      line.role = SheetRole::Sew;
      line.points = pointsOf(run);
      line.pen = kSewPen;
      if (run.allowance <= 0) line.pen.width = 0;  // it is the cut line, which is drawn
      line.edge = edgeCodes(pattern_, piece_, run);
      line.curve = run.curve;
      line.kind = toString(run.kind);
      line.seam = run.seam;
      line.mate = run.mate;
      line.arcEnds = run.arcEnds;
      out_.lines.push_back(std::move(line));
    }
  }

  void drawInternalLines() {
    for (const InternalLine& internal : piece_.internalLines) {
      if (internal.points.size() < 2) continue;
      SheetLine line;
      line.role = SheetRole::Internal;
      line.points = placed(internal.points);
      line.closed = internal.closed;
      line.pen = penOf(internal.kind);
      line.curve = internal.curve;
      line.kind = toString(internal.kind);
      // The name stands on the line near its left end, off the crossings in the middle.
      Points2 way = line.points;
      if (way.front().x() > way.back().x()) std::reverse(way.begin(), way.end());
      const double length = lengthOf(way);
      const double width = estimatedWidth(internal.name, kEdgeSizeMm);
      if (length > 1.5 * width) {
        const double middle = std::max(0.22 * length, 0.5 * width + 6);
        const Vector2d a = pointAt(way, middle - 0.5 * width);
        const Vector2d b = pointAt(way, middle + 0.5 * width);
        addAlong(a, b, pointAt(way, middle), 1.2, kEdgeSizeMm, internal.name, SheetRole::Internal);
      }
      out_.lines.push_back(std::move(line));
    }
  }

  /// A text along the chord a-b, `clear` above the higher of the chord and `top`.
  void addAlong(const Vector2d& a, const Vector2d& b, const Vector2d& top, double clear,
                double size, const std::string& text, SheetRole role) {
    const double angle = readableAngle(b - a);
    const Vector2d up(-std::sin(angle), std::cos(angle));
    const Vector2d middle = 0.5 * (a + b);
    const double rise = std::max(0.0, (top - middle).dot(up)) + clear;
    out_.texts.push_back({role, middle + rise * up, angle, size, false, text});
  }

  void drawNotches() {
    std::set<std::pair<int, std::string>> numbered;
    for (const Notch& notch : piece_.notches) {
      SheetLine line;
      line.role = SheetRole::Notch;
      const Vector2d at = placement_.apply(notch.position);
      const Vector2d inward = placement_.applyToDirection(notch.direction);
      line.points = notchShape(notch, at, inward);
      line.pen = kNotchPen;
      line.curve = notch.seam;
      line.kind = "notch";
      line.isCut = notch.kind != NotchKind::T;
      line.seam = notch.number;
      out_.lines.push_back(std::move(line));
      // Of a double notch one has the number; the two sides of a dart have one each.
      if (notch.number == 0 || !numbered.emplace(notch.number, sideKey(notch)).second) continue;
      // Beside the notch, within the allowance where there is one.
      const double allowance = (notch.onSewLine - notch.position).norm();
      const double depth = allowance > kNotchSizeMm ? 0.5 * allowance : 0.9 * kNotchSizeMm;
      const Vector2d aside(inward.y(), -inward.x());
      const std::string number = std::to_string(notch.number);
      const double half = 0.5 * std::max(estimatedWidth(number, kNotchSizeMm), kNotchSizeMm);
      const double away = 1 + half + (isDouble(notch) ? kDoubleNotchMm : 0);
      const Vector2d middle = at + depth * inward + away * aside;
      out_.texts.push_back({SheetRole::Notch, middle - Vector2d(0, 0.36 * kNotchSizeMm), 0,
                            kNotchSizeMm, false, number});
    }
  }

  /// The notch as it is cut: a line into the allowance, or its outline from edge to edge.
  static Points2 notchShape(const Notch& notch, const Vector2d& at, const Vector2d& inward) {
    const Vector2d half = 0.5 * notch.width * Vector2d(inward.y(), -inward.x());
    const Vector2d tip = at + notch.depth * inward;
    switch (notch.kind) {
      case NotchKind::Slit:
        break;
      case NotchKind::V:
        return {at - half, tip, at + half};
      case NotchKind::T:
        return {at, tip, tip - half, tip + half};
      case NotchKind::Castle:
        return {at - half, tip - half, tip + half, at + half};
      case NotchKind::Check:
        return {at, tip, at + 2 * half};
      case NotchKind::U: {
        Points2 points;
        constexpr int kSteps = 12;
        for (int i = 0; i <= kSteps; ++i) {
          const double t = pi * i / kSteps;
          points.emplace_back(at - std::cos(t) * half + std::sin(t) * notch.depth * inward);
        }
        return points;
      }
    }
    return {at, tip};
  }

  /// Whether its twin of a double notch stands to the same side as the number.
  [[nodiscard]] bool isDouble(const Notch& notch) const {
    const Vector2d aside(notch.direction.y(), -notch.direction.x());
    return std::any_of(piece_.notches.begin(), piece_.notches.end(), [&](const Notch& other) {
      const double apart = (other.position - notch.position).dot(aside);
      return other.number == notch.number && apart > 1 && apart < 1.5 * kDoubleNotchMm;
    });
  }

  /// Tells apart notches of one number that do not stand side by side.
  [[nodiscard]] std::string sideKey(const Notch& notch) const {
    constexpr double kSideBySideMm = 20;
    for (std::size_t i = 0; i < piece_.notches.size(); ++i)
      if (piece_.notches[i].number == notch.number &&
          (piece_.notches[i].position - notch.position).norm() < kSideBySideMm)
        return std::to_string(i);
    return {};
  }

  void drawGrain() {
    const Vector2d a = placement_.apply(piece_.grain[0]);
    const Vector2d b = placement_.apply(piece_.grain[1]);
    const double length = (b - a).norm();
    if (length <= 0) return;
    const Vector2d along = (b - a) / length;
    const Vector2d aside(-along.y(), along.x());
    const double head = std::min(8.0, 0.2 * length);
    const auto add = [&](Points2 points) {
      SheetLine line;
      line.role = SheetRole::Grain;
      line.points = std::move(points);
      line.pen = kGrainPen;
      line.kind = "grain";
      out_.lines.push_back(std::move(line));
    };
    add({a, b});
    // With a nap the one arrow says which end is up.
    if (!piece_.oneWay)
      add({a + head * along + 0.35 * head * aside, a, a + head * along - 0.35 * head * aside});
    add({b - head * along + 0.35 * head * aside, b, b - head * along - 0.35 * head * aside});
  }

  void drawDrillHoles() {
    constexpr double kRadiusMm = 1;
    constexpr double kArmMm = 2.5;
    for (const Vector2d& hole : piece_.drillHoles) {
      const Vector2d at = placement_.apply(hole);
      SheetLine line;
      line.role = SheetRole::Drill;
      line.pen = kMarkPen;
      line.kind = "drill";
      line.closed = true;
      constexpr int kSteps = 16;
      for (int i = 0; i < kSteps; ++i) {
        const double t = 2 * pi * i / kSteps;
        line.points.emplace_back(at + kRadiusMm * Vector2d(std::cos(t), std::sin(t)));
      }
      out_.lines.push_back(line);
      line.closed = false;
      for (const Vector2d& arm : {Vector2d(kArmMm, 0), Vector2d(0, kArmMm)}) {
        line.points = {at - arm, at + arm};
        out_.lines.push_back(line);
      }
    }
  }

  /// A bent arrow from the line to the edge that lies on the fold.
  void drawFold() {
    if (!piece_.fold) return;
    const Vector2d a = placement_.apply((*piece_.fold)[0]);
    const Vector2d b = placement_.apply((*piece_.fold)[1]);
    const double length = (b - a).norm();
    if (length <= 0) return;
    const Vector2d along = (b - a) / length;
    const Vector2d inward = Vector2d(-along.y(), along.x());
    const double inset = std::min(12.0, 0.1 * length);
    const Vector2d from = a + 0.15 * length * along;
    const Vector2d to = b - 0.15 * length * along;
    SheetLine line;
    line.role = SheetRole::Grain;
    line.pen = kGrainPen;
    line.kind = "fold";
    line.points = {from, from + inset * inward, to + inset * inward, to};
    out_.lines.push_back(line);
    const double head = 0.4 * inset;
    for (const Vector2d& tip : {from, to}) {
      line.points = {tip + head * inward + 0.4 * head * along, tip,
                     tip + head * inward - 0.4 * head * along};
      out_.lines.push_back(line);
    }
    const double angle = readableAngle(along);
    const Vector2d up(-std::sin(angle), std::cos(angle));
    const Vector2d middle = 0.5 * (from + to) + (inset + 2) * inward;
    out_.texts.push_back({SheetRole::Text,
                          up.dot(inward) > 0 ? middle : Vector2d(middle - 0.75 * kLabelSizeMm * up),
                          angle, kLabelSizeMm, false, "place on fold"});
  }

  /// Whether a rectangle lies inside the sew lines, by points along its rim.
  [[nodiscard]] bool holds(const Vector2d& centre, const Vector2d& along, double width,
                           double height) const {
    const Vector2d up(-along.y(), along.x());
    for (int i = 0; i <= 8; ++i) {
      const double t = i / 8.0 - 0.5;
      for (const double side : {-0.5, 0.5}) {
        if (!isInside(sew_, centre + t * width * along + side * height * up)) return false;
        if (!isInside(sew_, centre + side * width * along + t * height * up)) return false;
      }
    }
    return true;
  }

  /// As large as fits, clear of inner lines if there is room beside them. In a narrow piece fewer
  /// lines say less, in the end only the number; nothing ever stands out of the piece.
  void drawLabel() {
    if (piece_.label.empty()) return;
    const std::string number = std::to_string(piece_.number);
    const std::string brief = fmt::format("{}  {}, cut {}", number, piece_.label[0], piece_.count);
    std::vector<std::vector<std::string>> variants{piece_.label, {piece_.label[0]}, {brief}};
    if (piece_.label.size() > 1) variants[1].push_back(piece_.label[1]);
    variants.push_back({number});
    constexpr std::array<double, 4> kWorth{1, 0.8, 0.6, 0.35};
    std::vector<LabelBlock> blocks;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      LabelBlock block{0, 0, kWorth[v]};
      for (std::size_t i = 0; i < variants[v].size(); ++i) {
        const double size = i == 0 ? kNameSizeMm / kLabelSizeMm : 1;
        block.width = std::max(block.width, estimatedWidth(variants[v][i], size));
        block.height += kLineFeed * size;
      }
      blocks.push_back(block);
    }
    // The search has y down.
    const auto flipped = [](Points2 points) {
      for (Vector2d& p : points) p.y() = -p.y();
      return points;
    };
    LabelRoom room;
    for (const Points2& loop : sew_) room.outlines.push_back(flipped(loop));
    for (const SheetLine& line : out_.lines)
      if (line.role == SheetRole::Internal || line.role == SheetRole::Grain)
        room.lines.push_back(flipped(line.points));
    room.wish = flipped({placement_.apply(piece_.labelPosition)}).front();
    constexpr double kLeastReadableMm = 1.8;
    constexpr double kLeastNumberMm = 1;
    std::optional<LabelPlace> place = fitLabel(room, blocks, kLabelSizeMm, kLeastReadableMm);
    std::size_t variant = place ? place->block : variants.size() - 1;
    if (!place) place = fitLabel(room, std::span(blocks).last(1), kLabelSizeMm, kLeastNumberMm);
    if (!place) return;
    const std::vector<std::string>& lines = variants[variant];
    const double angle = -place->angle;
    const Vector2d middle(place->middle.x(), -place->middle.y());
    const Vector2d down(std::sin(angle), -std::cos(angle));
    double below = -0.5 * blocks[variant].height * place->size;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double size = place->size * (i == 0 ? kNameSizeMm / kLabelSizeMm : 1);
      below += kLineFeed * size;
      out_.texts.push_back(
          {SheetRole::Text, middle + (below - 0.3 * size) * down, angle, size, i == 0, lines[i]});
    }
  }

  /// Beside each seam: its letter, its curve and the piece sewn on.
  void drawEdgeNames() {
    const std::vector<OutlineRun>& runs = piece_.runs;
    std::vector<char> done(runs.size(), 0);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (done[r] != 0) continue;
      done[r] = 1;
      if (runs[r].seam == 0 && runs[r].kind != WireKind::Opening) continue;
      // Runs of one seam that only feature lines part have one name.
      Points2 points = pointsOf(runs[r]);
      for (std::size_t next = r + 1; next < runs.size() && runs[next].loop == runs[r].loop &&
                                     runs[next].seam == runs[r].seam &&
                                     runs[next].curve == runs[r].curve && !sewCorner(runs[next]);
           ++next) {
        done[next] = 1;
        const Points2 more = pointsOf(runs[next]);
        points.insert(points.end(), more.begin() + 1, more.end());
      }
      const std::string code = edgeCodes(pattern_, piece_, runs[r]);
      const std::string name = curveName(runs[r].curve);
      const bool isOwn = runs[r].mate == piece_.id;
      const std::string mate =
          runs[r].mate.empty() || isOwn ? "" : " to " + pieceName(runs[r].mate);
      const double length = lengthOf(points);
      std::vector<std::string> texts{name};
      if (!code.empty()) texts = {code + "  " + name + mate, code + "  " + name, code};
      // Rather less text clear of notches than more across one.
      const auto place = [&](bool acrossNotches) {
        return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
          const double width = estimatedWidth(text, kEdgeSizeMm);
          if (text.empty() || width > 0.8 * length) return false;
          const std::optional<double> free = freeMiddle(points, length, width);
          if (!free && !acrossNotches) return false;
          return placeEdgeName(points, free.value_or(0.5 * length), width, text);
        });
      };
      if (!place(false)) place(true);
    }
  }

  /// Where along a seam its name meets no notch, near the middle if possible; nothing where it
  /// meets one everywhere.
  [[nodiscard]] std::optional<double> freeMiddle(const Points2& points, double length,
                                                 double width) const {
    for (const double part : {0.5, 0.4, 0.6, 0.3, 0.7, 0.22, 0.78}) {
      const double middle = part * length;
      if (middle < 0.55 * width || middle > length - 0.55 * width) continue;
      const Vector2d centre = pointAt(points, middle);
      const bool isFree =
          std::none_of(piece_.notches.begin(), piece_.notches.end(), [&](const Notch& notch) {
            return (placement_.apply(notch.onSewLine) - centre).norm() < 0.5 * width + 4;
          });
      if (isFree) return middle;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool sewCorner(const OutlineRun& run) const {
    return piece_.sewLines[run.loop][run.first].corner;
  }

  /// @return whether the text stays inside the piece; otherwise nothing is drawn
  bool placeEdgeName(const Points2& points, double middle, double width, const std::string& text) {
    const Vector2d a = pointAt(points, middle - 0.5 * width);
    const Vector2d b = pointAt(points, middle + 0.5 * width);
    const Vector2d along = b - a;
    if (along.norm() <= 0) return false;
    // The piece lies on the left. Clear of the line where it bends inwards beside the text.
    const Vector2d inward = Vector2d(-along.y(), along.x()).normalized();
    double bulge = 0;
    for (int i = 1; i < 8; ++i)
      bulge = std::max(bulge, (pointAt(points, middle + (i / 8.0 - 0.5) * width) - a).dot(inward));
    const double angle = readableAngle(along);
    const Vector2d up(-std::sin(angle), std::cos(angle));
    // The baseline is the text's lower rim, which lies towards the line or away from it.
    constexpr double kClearMm = 1.8;
    const double toBaseline =
        bulge + kClearMm + (up.dot(inward) > 0 ? 0.2 * kEdgeSizeMm : 0.75 * kEdgeSizeMm);
    const Vector2d baseline = 0.5 * (a + b) + toBaseline * inward;
    if (!holds(baseline + 0.3 * kEdgeSizeMm * up, {std::cos(angle), std::sin(angle)}, width,
               0.8 * kEdgeSizeMm))
      return false;
    out_.texts.push_back({SheetRole::Text, baseline, angle, kEdgeSizeMm, false, text});
    return true;
  }

  const Pattern& pattern_;
  const PatternPiece& piece_;
  const Placement& placement_;
  std::vector<Points2> sew_;
  PieceDrawing out_;
};

}  // namespace

const char* layerName(SheetRole role) {
  switch (role) {
    case SheetRole::Cut:
      return "cut line";
    case SheetRole::Sew:
      return "sew line";
    case SheetRole::Internal:
      return "inner lines";
    case SheetRole::Notch:
      return "notches";
    case SheetRole::Grain:
      return "grain line";
    case SheetRole::Drill:
      return "drill holes";
    case SheetRole::Text:
      return "text";
    case SheetRole::Material:
      return "material";
  }
  return "";
}

double estimatedWidth(const std::string& utf8, double size) {
  constexpr double kMeanAdvance = 0.61;  // of the em, DejaVu Sans in mixed text
  const auto characters = std::count_if(utf8.begin(), utf8.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  });
  return kMeanAdvance * size * static_cast<double>(characters);
}

PieceDrawing drawPiece(const Pattern& pattern, const PatternPiece& piece,
                       const Placement& placement) {
  return PieceArtist(pattern, piece, placement).draw();
}

SheetDrawing makeEmptySheet(const Design& design) {
  SheetDrawing sheet;
  sheet.name = design.name;
  sheet.heading = design.order.style.empty() ? design.name : design.order.style;
  if (sheet.heading.empty()) sheet.heading = "Pattern";
  if (!design.order.size.empty()) sheet.heading += ", size " + design.order.size;
  if (!design.order.customer.empty()) sheet.heading += ", for " + design.order.customer;
  if (!design.order.date.empty()) sheet.heading += ", " + design.order.date;
  if (const auto date = fileDate(design))
    sheet.date = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", date->year, date->month,
                             date->day, date->hour, date->minute, date->second);
  return sheet;
}

void fitBox(SheetDrawing& sheet) {
  Points2 all;
  const auto take = [&](const PieceDrawing& drawing) {
    for (const SheetLine& line : drawing.lines)
      if (line.role == SheetRole::Cut || line.role == SheetRole::Material)
        all.insert(all.end(), line.points.begin(), line.points.end());
  };
  for (const PieceDrawing& piece : sheet.pieces) take(piece);
  take(sheet.around);
  const Box2 box = boxOf(all);
  sheet.min = box.min;
  sheet.max = box.max;
}

SheetDrawing drawSheet(const Pattern& pattern) {
  SheetDrawing sheet = makeEmptySheet(*pattern.document.design);
  sheet.pieces.resize(pattern.pieces.size());
  parallelFor(pattern.pieces.size(), [&](std::size_t i) {
    sheet.pieces[i] = drawPiece(pattern, pattern.pieces[i], pattern.layout.placements[i]);
  });
  fitBox(sheet);
  return sheet;
}

}  // namespace toile
