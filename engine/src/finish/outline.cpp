// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "finish/polygon.h"

namespace toile {
namespace {

Error outlineError(const Piece& piece, const std::string& reason) {
  return {ErrorCode::InvalidArgument,
          fmt::format("piece \"{}\" has no usable outline: {}; check its cut lines", piece.name,
                      reason),
          {Element::piece(piece.id)}};
}

/// Boundary wires of each loop, in order: indices into piece.wires.
Result<std::vector<std::vector<std::uint32_t>>> wireLoops(const Piece& piece) {
  std::map<VertexId, std::uint32_t> startingAt;
  std::vector<std::uint32_t> boundary;
  for (std::uint32_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (!isBoundary(wire.kind)) continue;
    if (wire.vertices.size() < 2) return outlineError(piece, "a boundary wire has no edge");
    if (!startingAt.emplace(wire.vertices.front(), w).second)
      return outlineError(piece, "two boundary wires begin at one vertex");
    boundary.push_back(w);
  }
  if (boundary.empty()) return outlineError(piece, "it has no boundary wire");
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<char> used(piece.wires.size(), 0);
  for (const std::uint32_t first : boundary) {
    if (used[first] != 0) continue;
    std::vector<std::uint32_t>& loop = loops.emplace_back();
    for (std::uint32_t w = first; used[w] == 0;) {
      used[w] = 1;
      loop.push_back(w);
      const auto next = startingAt.find(piece.wires[w].vertices.back());
      if (next == startingAt.end())
        return outlineError(piece, "a boundary wire ends where no other begins");
      w = next->second;
      if (used[w] != 0 && w != first) return outlineError(piece, "its boundary wires branch");
    }
  }
  return loops;
}

void markCorners(Outline& loop, const std::vector<char>& isJunction) {
  constexpr double kRadians = std::numbers::pi / 180;
  const std::size_t count = loop.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = std::abs(turnAngle(loop[(i + count - 1) % count].position, loop[i].position,
                                           loop[(i + 1) % count].position));
    const double limit = isJunction[i] != 0 ? kJunctionCornerDegrees : kCornerDegrees;
    loop[i].corner = turn > limit * kRadians;
  }
}

}  // namespace

Result<SewOutline> makeSewOutline(const Piece& piece, const FlatPiece& flat) {
  for (const Wire& wire : piece.wires)
    for (const VertexId v : wire.vertices)
      if (v.index() >= flat.position.size())
        return outlineError(piece, "its flat piece has other vertices");
  auto wiresOfLoops = wireLoops(piece);
  if (!wiresOfLoops) return wiresOfLoops.error();

  struct Loop {
    Outline points;
    std::vector<OutlineRun> runs;
    double area = 0;
  };
  std::vector<Loop> loops;
  for (std::vector<std::uint32_t>& wires : *wiresOfLoops) {
    const auto build = [&] {
      Loop loop;
      std::vector<char> isJunction;
      for (const std::uint32_t w : wires) {
        const Wire& wire = piece.wires[w];
        OutlineRun run;
        run.curve = wire.curve;
        run.kind = wire.kind;
        run.wire = w;
        run.first = loop.points.size();
        run.edgeCount = wire.vertices.size() - 1;
        for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
          const Eigen::Vector2d& from = flat.position[wire.vertices[i]];
          run.length += (flat.position[wire.vertices[i + 1]] - from).norm();
          loop.points.push_back({from, false});
          isJunction.push_back(i == 0 && wires.size() > 1 ? 1 : 0);
        }
        loop.runs.push_back(run);
      }
      markCorners(loop.points, isJunction);
      return loop;
    };
    Loop loop = build();
    // Readers of pattern files pick a sharp corner as the start anyway; it is a run's start here.
    // Not within a dart: its legs shall follow each other.
    const auto start = [&]() -> std::size_t {
      std::size_t atTip = 0;
      for (std::size_t r = 0; r < loop.runs.size(); ++r) {
        if (!loop.points[loop.runs[r].first].corner) continue;
        const OutlineRun& before = loop.runs[(r + loop.runs.size() - 1) % loop.runs.size()];
        const bool isTip = loop.runs[r].kind == WireKind::Dart && before.kind == WireKind::Dart;
        if (!isTip) return r;
        if (atTip == 0) atTip = r;
      }
      return atTip;
    }();
    if (start != 0) {
      std::rotate(wires.begin(), wires.begin() + static_cast<std::ptrdiff_t>(start), wires.end());
      loop = build();
    }
    loop.area = signedArea(positions(loop.points));
    if (!std::isfinite(loop.area)) return outlineError(piece, "a flat position is no number");
    if (loop.points.size() < 3) return outlineError(piece, "a loop has fewer than three edges");
    loops.push_back(std::move(loop));
  }
  const auto outer = std::max_element(loops.begin(), loops.end(),
                                      [](const Loop& a, const Loop& b) { return a.area < b.area; });
  if (outer->area <= 0) return outlineError(piece, "it lies wrong side up");
  std::rotate(loops.begin(), outer, outer + 1);

  SewOutline outline;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (l > 0 && loops[l].area >= 0) return outlineError(piece, "it has several outer loops");
    for (OutlineRun& run : loops[l].runs) {
      run.loop = l;
      outline.runs.push_back(std::move(run));
    }
    outline.loops.push_back(std::move(loops[l].points));
  }
  return outline;
}

}  // namespace toile
