// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/batch/grade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "toile/core/file.h"
#include "toile/core/nearest_name.h"
#include "toile/io/nested.h"
#include "toile/pipeline/carry.h"

namespace toile {

namespace {

using Eigen::Vector2d;

constexpr double kNestGapMm = 20;
constexpr double kNestWidthMm = 1600;

struct Box {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = -min;
  void add(const Vector2d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

/// A size of one's own table may have any name.
std::string folderName(std::string name) {
  for (char& c : name) {
    if (c == '/' || c == '\\' || c == ':' || static_cast<unsigned char>(c) < 32) c = '-';
  }
  return name.empty() || name.front() == '.' ? "size" + name : name;
}

std::size_t pieceOf(const Pattern& pattern, const std::string& id) {
  const auto found = std::find_if(pattern.pieces.begin(), pattern.pieces.end(),
                                  [&](const PatternPiece& piece) { return piece.id == id; });
  return static_cast<std::size_t>(found - pattern.pieces.begin());
}

/// Where runs of the sew line begin, by curve and count: what two sizes of a piece have in common.
std::map<std::pair<std::string, int>, Vector2d> runStarts(const PatternPiece& piece) {
  std::map<std::pair<std::string, int>, Vector2d> starts;
  std::map<std::string, int> counts;
  for (const OutlineRun& run : piece.runs) {
    starts[{run.curve, counts[run.curve]++}] = piece.sewLines[run.loop][run.first].position;
  }
  return starts;
}

/// The rigid motion that brings the piece closest to where `base` is placed.
Placement onto(const PatternPiece& piece, const PatternPiece& base, const Placement& placed) {
  const auto own = runStarts(piece), others = runStarts(base);
  std::vector<std::pair<Vector2d, Vector2d>> pairs;
  for (const auto& [key, from] : own) {
    if (const auto found = others.find(key); found != others.end()) {
      pairs.emplace_back(from, placed.apply(found->second));
    }
  }
  Vector2d middle = Vector2d::Zero(), target = Vector2d::Zero();
  for (const auto& [from, to] : pairs) {
    middle += from / static_cast<double>(pairs.size());
    target += to / static_cast<double>(pairs.size());
  }
  double along = 0, across = 0;
  for (const auto& [from, to] : pairs) {
    const Vector2d a = from - middle, b = to - target;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  Placement placement;
  placement.angle = pairs.size() < 2 ? placed.angle : std::atan2(across, along);
  if (pairs.empty()) {
    middle = piece.labelPosition;
    target = placed.apply(base.labelPosition);
  }
  placement.offset = target - placement.applyToDirection(middle);
  return placement;
}

/// Puts the nested pieces in rows, the tallest first.
void nest(std::vector<GradedSize>& sizes, const GradedSize& base) {
  const Pattern& own = *base.pattern;
  for (GradedSize& size : sizes) size.nest.placements.resize(size.pattern->pieces.size());
  std::vector<Box> boxes(own.pieces.size());
  const auto indexIn = [&](const GradedSize& size, std::size_t p) {
    return pieceOf(*size.pattern, own.pieces[p].id);
  };
  for (std::size_t p = 0; p < own.pieces.size(); ++p) {
    const Placement upright{own.layout.placements[p].angle, Vector2d::Zero()};
    for (GradedSize& size : sizes) {
      const std::size_t k = indexIn(size, p);
      const PatternPiece& piece = size.pattern->pieces[k];
      size.nest.placements[k] = onto(piece, own.pieces[p], upright);
      for (const OutlinePoint& point : piece.cutLines.front()) {
        boxes[p].add(size.nest.placements[k].apply(point.position));
      }
    }
  }
  std::vector<std::size_t> order(boxes.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (boxes[a].max - boxes[a].min).y() > (boxes[b].max - boxes[b].min).y();
  });
  Vector2d at(0, 0);
  double rowHeight = 0;
  for (const std::size_t p : order) {
    const Vector2d extent = boxes[p].max - boxes[p].min;
    if (at.x() > 0 && at.x() + extent.x() > kNestWidthMm) {
      at = {0, at.y() - rowHeight - kNestGapMm};
      rowHeight = 0;
    }
    const Vector2d shift = Vector2d(at.x(), at.y() - extent.y()) - boxes[p].min;
    for (GradedSize& size : sizes) size.nest.placements[indexIn(size, p)].offset += shift;
    at.x() += extent.x() + kNestGapMm;
    rowHeight = std::max(rowHeight, extent.y());
  }
  for (GradedSize& size : sizes) {
    Box box;
    for (std::size_t k = 0; k < size.pattern->pieces.size(); ++k) {
      for (const OutlinePoint& point : size.pattern->pieces[k].cutLines.front()) {
        box.add(size.nest.placements[k].apply(point.position));
      }
    }
    size.nest.min = box.min;
    size.nest.max = box.max;
  }
}

Result<GradedSize> makeSize(const Document& document, const BodySize& size, Progress* progress) {
  if (progress != nullptr) progress->step("size " + size.name);
  const auto failed = [&](const Error& error) { return error.during("size " + size.name); };
  Result<ReferenceModel> body = makeBody(size.options);
  if (!body) return failed(body.error());
  const Result<CarriedDesign> carried =
      carryToModel(document, std::make_shared<const ReferenceModel>(*std::move(body)));
  if (!carried) return failed(carried.error());
  Document sized = carried->transfer.document;
  Design design = *sized.design;
  design.order.size = size.name;
  sized.design = std::make_shared<const Design>(std::move(design));
  Result<Pattern> pattern = makePattern(sized);
  if (!pattern) return failed(pattern.error());
  for (const auto& failure : pattern->failures) {
    if (failure) return failed(*failure);
  }
  pattern->findings.insert(pattern->findings.begin(), carried->transfer.findings.begin(),
                           carried->transfer.findings.end());
  return GradedSize{size.name, false, std::make_shared<const Pattern>(*std::move(pattern)), {}};
}

/// A line for each seam of each piece, a column for each size.
std::string gradeTable(const std::vector<GradedSize>& sizes, const Pattern& base) {
  std::string text = "piece,line";
  const auto out = std::back_inserter(text);
  for (const GradedSize& size : sizes) {
    fmt::format_to(out, ",{}{}_mm", size.name, size.isBase ? "_base" : "");
  }
  text += "\n";
  for (const PatternPiece& piece : base.pieces) {
    for (std::size_t r = 0; r < piece.runs.size(); ++r) {
      fmt::format_to(out, "{},{}", piece.id, piece.runs[r].curve);
      for (const GradedSize& size : sizes) {
        const PatternPiece& own = size.pattern->pieces[pieceOf(*size.pattern, piece.id)];
        if (r < own.runs.size() && own.runs[r].curve == piece.runs[r].curve) {
          fmt::format_to(out, ",{:.2f}", own.runs[r].length);
        } else {
          text += ",";
        }
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace

Result<std::vector<GradedSize>> gradeDesign(const Document& document,
                                            std::span<const BodySize> sizes,
                                            const std::string& base, Progress* progress) {
  std::vector<std::string> names;
  for (const BodySize& size : sizes) names.push_back(size.name);
  if (std::find(names.begin(), names.end(), base) == names.end()) {
    return Error{ErrorCode::NameNotFound,
                 "the base size \"" + base + "\" is none of the sizes" + suggestion(base, names),
                 {}};
  }
  std::vector<GradedSize> graded;
  for (const BodySize& size : sizes) {
    if (isCancelled(progress)) {
      return Error{ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
    }
    Result<GradedSize> made = makeSize(document, size, progress);
    if (!made) return made.error();
    made->isBase = size.name == base;
    graded.push_back(*std::move(made));
  }
  const auto isBase = [](const GradedSize& size) { return size.isBase; };
  const GradedSize& own = *std::find_if(graded.begin(), graded.end(), isBase);
  for (const GradedSize& size : graded) {
    for (const PatternPiece& piece : own.pattern->pieces) {
      const bool isThere = pieceOf(*size.pattern, piece.id) < size.pattern->pieces.size();
      if (isThere && size.pattern->pieces.size() == own.pattern->pieces.size()) continue;
      return Error{ErrorCode::NotConverged,
                   fmt::format("size {} has other pieces than the base size {} (\"{}\")", size.name,
                               base, piece.id),
                   {Element::piece(piece.id)}};
    }
  }
  nest(graded, own);
  return graded;
}

Result<std::vector<Finding>> writeGrading(const std::vector<GradedSize>& sizes,
                                          const std::filesystem::path& folder, Progress* progress) {
  std::vector<Finding> findings;
  std::vector<Pattern> nested;
  std::vector<NestedSize> list;
  nested.reserve(sizes.size());
  const Pattern* base = nullptr;
  for (const GradedSize& size : sizes) {
    const Result<WrittenPattern> written =
        writePattern(*size.pattern, folder / folderName(size.name), progress);
    if (!written) return written.error();
    for (const Finding& finding : written->findings) {
      findings.push_back(
          {finding.code, "size " + size.name + ": " + finding.message, finding.where});
    }
    nested.push_back(*size.pattern);
    nested.back().layout = size.nest;
    list.push_back({size.name, &nested.back(), size.isBase});
    if (size.isBase) base = size.pattern.get();
  }
  const std::map<std::string, std::string> files = {
      {"nested.svg", writeNestedSvg(list)},
      {"nested.dxf", writeNestedDxf(list).text},
      {"grade.csv", gradeTable(sizes, *base)},
  };
  for (const auto& [name, text] : files) {
    if (const auto done = writeFileWhole(folder / name, text); !done) return done.error();
  }
  return findings;
}

}  // namespace toile
