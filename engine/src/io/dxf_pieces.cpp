// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "finish/marking.h"
#include "finish/polygon.h"
#include "io/ascii.h"
#include "layout/clearance.h"
#include "toile/io/dxf_file.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kJoinMm = 0.5;  // ends of runs nearer than this are one point
constexpr double kCornerRadians = 20 * std::numbers::pi / 180;

/// A closed outline from runs that meet head to tail, whichever way each was drawn.
class RunJoiner {
 public:
  explicit RunJoiner(std::vector<Points2> runs) : runs_(std::move(runs)) {}

  std::vector<Points2> loops(std::size_t& open) {
    std::vector<Points2> loops;
    std::vector<char> used(runs_.size(), 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (used[i] != 0) continue;
      used[i] = 1;
      Points2 loop = runs_[i];
      while ((loop.front() - loop.back()).norm() > kJoinMm && extend(loop, used)) continue;
      if ((loop.front() - loop.back()).norm() > kJoinMm) {
        ++open;
        continue;
      }
      loop.pop_back();
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  bool extend(Points2& loop, std::vector<char>& used) const {
    std::size_t best = runs_.size();
    double nearest = kJoinMm;
    bool turned = false;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (used[k] != 0) continue;
      const double front = (runs_[k].front() - loop.back()).norm();
      const double back = (runs_[k].back() - loop.back()).norm();
      if (std::min(front, back) > nearest) continue;
      nearest = std::min(front, back);
      best = k;
      turned = back < front;
    }
    if (best == runs_.size()) return false;
    used[best] = 1;
    Points2 run = runs_[best];
    if (turned) std::reverse(run.begin(), run.end());
    loop.insert(loop.end(), run.begin() + 1, run.end());
    return true;
  }

  std::vector<Points2> runs_;
};

void dropRepeats(Points2& loop) {
  Points2 distinct;
  for (const Vector2d& p : loop)
    if (distinct.empty() || distinct.back() != p) distinct.push_back(p);
  while (distinct.size() > 1 && distinct.back() == distinct.front()) distinct.pop_back();
  loop = std::move(distinct);
}

/// Counter-clockwise, or clockwise for a hole, corners marked.
Outline toOutline(Points2 loop, bool isHole) {
  if ((signedArea(loop) > 0) == isHole) std::reverse(loop.begin(), loop.end());
  Outline outline;
  const std::size_t count = loop.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = turnAngle(loop[(i + count - 1) % count], loop[i], loop[(i + 1) % count]);
    outline.push_back({loop[i], std::abs(turn) > kCornerRadians});
  }
  return outline;
}

int firstNumber(const std::string& text, int fallback) {
  int value = fallback;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() ? value : fallback;
}

std::optional<CurveKind> lineKind(const std::string& layer) {
  if (layer == "8") return CurveKind::Mark;
  if (layer == "6") return CurveKind::Feature;
  if (layer == "5" || layer == "9" || layer == "10") return CurveKind::Guide;
  return std::nullopt;
}

/// Layer 4 holds slits, and V notches, which have a width.
std::optional<NotchKind> notchKind(const DxfEntity& entity) {
  if (entity.layer == "4") return entity.width.value_or(0) != 0 ? NotchKind::V : NotchKind::Slit;
  if (entity.layer == "80") return NotchKind::T;
  if (entity.layer == "81") return NotchKind::Castle;
  if (entity.layer == "82") return NotchKind::Check;
  if (entity.layer == "83") return NotchKind::U;
  return std::nullopt;
}

class PieceReader {
 public:
  PieceReader(const DxfBlock& block, const DxfInsert* insert, double scale)
      : block_(block), insert_(insert), scale_(scale) {}

  /// Nothing where the block holds no closed outline.
  std::optional<PatternPiece> read(std::vector<Finding>& findings) {
    std::size_t open = 0;
    std::vector<Points2> cut = loopsOn("1", open);
    if (cut.empty()) cut = loopsOn("84", open);
    if (cut.empty()) return std::nullopt;
    std::stable_sort(cut.begin(), cut.end(), [](const Points2& a, const Points2& b) {
      return std::abs(signedArea(a)) > std::abs(signedArea(b));
    });
    const Points2 outer = cut.front();
    PatternPiece piece;
    piece.name = toUtf8(dxfText(block_.entities, "piece name").value_or(block_.name));
    piece.id = block_.name;
    piece.cutLines.push_back(toOutline(cut.front(), false));
    for (std::size_t i = 1; i < cut.size(); ++i) piece.cutLines.push_back(toOutline(cut[i], true));
    for (Points2& hole : loopsOn("11", open)) piece.cutLines.push_back(toOutline(hole, true));
    readSewLines(piece, open);
    readMarks(piece, {outer});
    readTexts(piece);
    if (open > 0)
      findings.push_back({"dxf-open-outline",
                          fmt::format("piece \"{}\": {} outline{} not close within {} mm and {} "
                                      "left out",
                                      piece.name, open, open == 1 ? " does" : "s do", kJoinMm,
                                      open == 1 ? "is" : "are"),
                          {Element::piece(piece.id)}});
    return piece;
  }

 private:
  [[nodiscard]] Vector2d place(const Vector2d& p) const {
    Vector2d q = p;
    if (insert_ != nullptr) {
      const double angle = insert_->angle * std::numbers::pi / 180;
      q = q.cwiseProduct(insert_->scale);
      q = Vector2d(std::cos(angle) * q.x() - std::sin(angle) * q.y(),
                   std::sin(angle) * q.x() + std::cos(angle) * q.y()) +
          insert_->at;
    }
    return scale_ * q;
  }

  [[nodiscard]] Points2 placed(const DxfEntity& entity) const {
    Points2 points;
    for (const Vector2d& p : entity.points) points.push_back(place(p));
    return points;
  }

  std::vector<Points2> loopsOn(const std::string& layer, std::size_t& open) const {
    std::vector<Points2> loops;
    std::vector<Points2> runs;
    for (const DxfEntity& entity : block_.entities) {
      const bool isLine =
          entity.kind == DxfEntity::Kind::Polyline || entity.kind == DxfEntity::Kind::Line;
      if (!isLine || entity.layer != layer) continue;
      Points2 points = placed(entity);
      if (entity.closed) {
        dropRepeats(points);
        if (points.size() >= 3) loops.push_back(std::move(points));
      } else if (points.size() >= 2) {
        double length = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
          length += (points[i] - points[i - 1]).norm();
        if (length > 0) runs.push_back(std::move(points));
      }
    }
    for (Points2& loop : RunJoiner(std::move(runs)).loops(open)) {
      dropRepeats(loop);
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

  void readSewLines(PatternPiece& piece, std::size_t& open) const {
    std::vector<Points2> sew = loopsOn("14", open);
    const bool hasAllowance = !sew.empty();
    if (!hasAllowance) {
      piece.sewLines = piece.cutLines;
    } else {
      std::stable_sort(sew.begin(), sew.end(), [](const Points2& a, const Points2& b) {
        return std::abs(signedArea(a)) > std::abs(signedArea(b));
      });
      for (std::size_t i = 0; i < sew.size(); ++i)
        piece.sewLines.push_back(toOutline(sew[i], i > 0));
    }
    const EdgeGrid cut(positions(piece.cutLines));
    for (std::size_t l = 0; l < piece.sewLines.size(); ++l) {
      const Outline& loop = piece.sewLines[l];
      OutlineRun run;
      run.kind = WireKind::Border;
      run.loop = l;
      run.edgeCount = loop.size();
      std::vector<double> widths;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector2d& a = loop[i].position;
        const Vector2d& b = loop[(i + 1) % loop.size()].position;
        run.length += (b - a).norm();
        widths.push_back(cut.nearest(0.5 * (a + b)).distance);
      }
      std::nth_element(widths.begin(),
                       widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2),
                       widths.end());
      if (hasAllowance) run.allowance = std::max(widths[widths.size() / 2], 1e-3);
      piece.runs.push_back(run);
    }
  }

  void readMarks(PatternPiece& piece, const std::vector<Points2>& outline) const {
    const EdgeGrid edges(positions(piece.cutLines));
    const std::vector<Points2> cutLoops = positions(piece.cutLines);
    const std::vector<Points2> sewLoops = positions(piece.sewLines);
    piece.labelPosition = inmostPoint(sewLoops).position;
    bool hasGrain = false;
    for (const DxfEntity& entity : block_.entities) {
      const bool isLine =
          entity.kind == DxfEntity::Kind::Polyline || entity.kind == DxfEntity::Kind::Line;
      const Points2 points = placed(entity);
      if (entity.layer == "7" && isLine && points.size() >= 2) {
        piece.grain = {points.front(), points.back()};
        hasGrain = true;
      } else if (const auto kind = lineKind(entity.layer); kind && isLine) {
        InternalLine line;
        line.kind = *kind;
        line.curve = "layer-" + entity.layer;
        line.points = points;
        line.closed = entity.closed;
        piece.internalLines.push_back(std::move(line));
      } else if (notchKind(entity) && entity.kind == DxfEntity::Kind::Point) {
        piece.notches.push_back(notchAt(points.front(), entity, edges, cutLoops));
      } else if (entity.layer == "13" && entity.kind == DxfEntity::Kind::Point) {
        piece.drillHoles.push_back(points.front());
      }
    }
    if (!hasGrain) piece.grain = grainLine(outline, piece.labelPosition);
  }

  /// The place counts; the direction is that of the outline there, since dialects mean other
  /// things by the angle.
  [[nodiscard]] Notch notchAt(const Vector2d& at, const DxfEntity& entity, const EdgeGrid& edges,
                              const std::vector<Points2>& loops) const {
    Notch notch;
    notch.position = notch.onSewLine = at;
    std::size_t edge = edges.nearest(at).edge;
    for (const Points2& loop : loops) {
      if (edge >= loop.size()) {
        edge -= loop.size();
        continue;
      }
      // Across the two edges that meet in a vertex.
      const Vector2d& a = loop[edge];
      const Vector2d& b = loop[(edge + 1) % loop.size()];
      const Vector2d from =
          (at - a).norm() < 1e-6 ? loop[(edge + loop.size() - 1) % loop.size()] : a;
      const Vector2d to = (at - b).norm() < 1e-6 ? loop[(edge + 2) % loop.size()] : b;
      const Vector2d along = (to - from).normalized();
      notch.direction = {-along.y(), along.x()};
      break;
    }
    const double depth = std::abs(entity.z) * scale_;
    constexpr double kUsualMm = 4;
    constexpr double kLeastMm = 1;  // less is a size in centimetres, or none
    notch.depth = depth < kLeastMm || depth > 40 ? kUsualMm : depth;
    notch.kind = notchKind(entity).value_or(NotchKind::Slit);
    if (notch.kind == NotchKind::Slit) return notch;
    const double width = std::abs(entity.width.value_or(0)) * scale_;
    notch.width = width < kLeastMm || width > 40 ? kUsualMm : width;
    return notch;
  }

  static std::string toUtf8(const std::string& text) {
    return std::any_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) >= 0x80; })
               ? toAscii(text)
               : text;
  }

  void readTexts(PatternPiece& piece) const {
    piece.fabric = toUtf8(dxfText(block_.entities, "material")
                              .value_or(dxfText(block_.entities, "fabric").value_or("")));
    const std::string quantity = dxfText(block_.entities, "quantity").value_or("1");
    int count = std::max(0, firstNumber(quantity, 1));
    if (const std::size_t comma = quantity.find(','); comma != std::string::npos)
      count += std::max(0, firstNumber(quantity.substr(comma + 1), 0));
    piece.count = std::max(1, count);
    piece.label = {piece.name, fmt::format("Cut {}", piece.count)};
    if (!piece.fabric.empty()) piece.label.push_back("Fabric: " + piece.fabric);
    for (const DxfEntity& entity : block_.entities)
      if (entity.kind == DxfEntity::Kind::Text && entity.layer == "15" && !entity.text.empty() &&
          piece.label.size() < 8)
        piece.label.push_back(toUtf8(entity.text));
  }

  const DxfBlock& block_;
  const DxfInsert* insert_;
  double scale_;
};

std::string sizeOf(const DxfBlock& block) {
  if (auto size = dxfText(block.entities, "size")) return *size;
  return dxfText(block.entities, "size name").value_or("");
}

}  // namespace

Result<Pattern> patternFrom(const DxfDrawing& drawing, const std::string& name,
                            const std::optional<std::string>& size) {
  std::set<std::string> sizes;
  for (const DxfBlock& block : drawing.blocks) sizes.insert(sizeOf(block));
  std::optional<std::string> chosen = size;
  if (!chosen && sizes.size() > 1) {
    const std::string sample = dxfText(drawing.entities, "sample size").value_or("");
    chosen = sizes.contains(sample) ? sample : *sizes.begin();
  }
  std::string list;
  for (const std::string& each : sizes) list += (list.empty() ? "" : ", ") + each;
  if (size && !sizes.contains(*size))
    return Error{ErrorCode::NameNotFound,
                 fmt::format("{} has no size \"{}\"; it has: {}", name, *size, list),
                 {}};

  Pattern pattern;
  auto design = std::make_shared<Design>();
  design->name = dxfText(drawing.entities, "style name").value_or(name);
  if (design->name.empty()) design->name = name;
  if (chosen) design->order.size = *chosen;
  pattern.findings = drawing.findings;
  for (const DxfBlock& block : drawing.blocks) {
    if (chosen && sizeOf(block) != *chosen) continue;
    const auto insert = std::find_if(drawing.inserts.begin(), drawing.inserts.end(),
                                     [&](const DxfInsert& i) { return i.block == block.name; });
    PieceReader reader(block, insert == drawing.inserts.end() ? nullptr : &*insert,
                       millimetresPer(drawing.unit));
    auto piece = reader.read(pattern.findings);
    const auto crossing =
        piece ? findSelfCrossing(positions(piece->cutLines.front())) : std::nullopt;
    if (crossing) {
      pattern.findings.push_back(
          {"dxf-crossing-outline",
           fmt::format("the outline of block \"{}\" crosses itself at ({:.1f}, {:.1f}) mm; the "
                       "piece is left out",
                       block.name, crossing->x(), crossing->y()),
           {Element::piece(block.name)}});
    } else if (piece) {
      pattern.pieces.push_back(*std::move(piece));
    } else {
      pattern.findings.push_back(
          {"dxf-no-outline",
           fmt::format("block \"{}\" has no closed outline on layer 1 and is left out", block.name),
           {Element::piece(block.name)}});
    }
  }
  if (pattern.pieces.empty())
    return Error{ErrorCode::FileFormat,
                 fmt::format("{} holds no pieces: none of its {} blocks has a closed outline on "
                             "layer 1 that does not cross itself",
                             name, drawing.blocks.size()),
                 {}};
  Points2 all;
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
    PatternPiece& piece = pattern.pieces[i];
    piece.number = static_cast<int>(i) + 1;
    piece.of = static_cast<int>(pattern.pieces.size());
    pattern.layout.placements.emplace_back();
    const Points2 outer = positions(piece.cutLines.front());
    all.insert(all.end(), outer.begin(), outer.end());
  }
  const Box2 box = boxOf(all);
  pattern.layout.min = box.min;
  pattern.layout.max = box.max;
  pattern.document.design = std::move(design);
  return pattern;
}

}  // namespace toile
