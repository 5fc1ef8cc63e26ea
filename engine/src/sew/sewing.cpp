// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/sew/sewing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "sew/edges.h"

namespace toile {
namespace {

// An estimate for a home sewer: laying the edges together, then stitching.
constexpr double kHandlingMinutes = 1;
constexpr double kFlatMinutesPerMetre = 3;
constexpr double kTubeMinutesPerMetre = 4.5;
constexpr double kRoundMinutesPerMetre = 6;

double minutesOf(SewStep::Kind kind, double length) {
  const double metres = length / 1000;
  switch (kind) {
    case SewStep::Kind::Dart:
    case SewStep::Kind::Flat:
      return kHandlingMinutes + kFlatMinutesPerMetre * metres;
    case SewStep::Kind::Tube:
      return kHandlingMinutes + kTubeMinutesPerMetre * metres;
    case SewStep::Kind::Round:
      return kHandlingMinutes + kRoundMinutesPerMetre * metres;
  }
  return 0;
}

/// Which seams must be sewn before which: by seam number.
using SewnBefore = std::map<int, std::set<int>>;

/// A point of the sewn article, by its place on the model.
using Node = std::tuple<double, double, double>;

SewnBefore junctionOrder(const Pattern& pattern) {
  struct Passing {
    std::size_t piece;
    int before, next;
    bool isCorner;
  };
  std::map<Node, std::vector<Passing>> nodes;
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
    const PatternPiece& piece = pattern.pieces[p];
    const Piece& cut = pattern.cut.pieces[pattern.pieceIndex[p]];
    for (std::size_t r = 0; r < piece.runs.size(); ++r) {
      const OutlineRun& run = piece.runs[r];
      const auto ends = [&](const OutlineRun& other) {
        return other.loop == run.loop &&
               (other.first + other.edgeCount) % piece.sewLines[run.loop].size() == run.first;
      };
      const auto before = std::find_if(piece.runs.begin(), piece.runs.end(), ends);
      if (before == piece.runs.end() || run.wire >= cut.wires.size()) continue;
      const Eigen::Vector3d& at = cut.mesh->position(cut.wires[run.wire].vertices.front());
      nodes[{at.x(), at.y(), at.z()}].push_back(
          {p, before->seam, run.seam, piece.sewLines[run.loop][run.first].corner});
    }
  }
  SewnBefore order;
  for (const auto& [node, list] : nodes) {
    for (const Passing& straight : list) {
      if (straight.isCorner || straight.before == 0 || straight.next == 0) continue;
      for (const Passing& other : list) {
        for (const int seam : {other.before, other.next}) {
          if (seam == 0 || seam == straight.before || seam == straight.next) continue;
          order[straight.before].insert(seam);
          order[straight.next].insert(seam);
        }
      }
    }
  }
  return order;
}

/// The article as far as it is sewn: the boundary loops of its parts, each a cycle of edges that
/// are still open. Edges that are never sewn are kNever.
class Article {
 public:
  static constexpr std::size_t kNever = static_cast<std::size_t>(-1);

  Article(const Pattern& pattern, const std::vector<SewEdge>& edges) {
    for (std::uint32_t p = 0; p < pattern.pieces.size(); ++p) {
      const PatternPiece& piece = pattern.pieces[p];
      std::map<std::size_t, std::vector<std::size_t>> loops;
      for (const std::vector<std::uint32_t>& group : edgeGroups(piece)) {
        const auto edge = std::find_if(edges.begin(), edges.end(), [&](const SewEdge& each) {
          return each.piece == p && each.runs == group;
        });
        loops[piece.runs[group.front()].loop].push_back(
            edge == edges.end() ? kNever : static_cast<std::size_t>(edge - edges.begin()));
      }
      for (auto& [loop, cycle] : loops) loops_.push_back({p, std::move(cycle)});
    }
  }

  /// What sewing the two edges together would do.
  [[nodiscard]] SewStep::Kind kindOf(std::size_t a, std::size_t b) const {
    const std::size_t i = loopOf(a);
    const std::size_t j = loopOf(b);
    const bool isFlat = !tubes_.contains(loops_[i].part) && !tubes_.contains(loops_[j].part);
    return isFlat && goesOn(a, b) ? SewStep::Kind::Flat : SewStep::Kind::Tube;
  }

  /// Whether sewing the two edges joins two parts, or closes a border from the end of a seam on, as
  /// a dart does. What does neither closes a tube: it parts a border in two, or joins two borders
  /// of a part, or leaves nothing of a border open.
  [[nodiscard]] bool goesOn(std::size_t a, std::size_t b) const {
    const std::size_t i = loopOf(a);
    const std::size_t j = loopOf(b);
    if (loops_[i].part != loops_[j].part) return true;
    const std::vector<std::size_t>& cycle = loops_[i].cycle;
    const std::size_t count = cycle.size();
    if (i != j || count == 2) return false;
    const std::size_t at = place(i, a);
    return cycle[(at + 1) % count] == b || cycle[(at + count - 1) % count] == b;
  }

  void sew(std::size_t a, std::size_t b, SewStep::Kind kind) {
    const std::size_t i = loopOf(a);
    const std::size_t j = loopOf(b);
    std::vector<std::size_t> afterA = turned(i, a);
    if (i == j) {
      const auto at = std::find(afterA.begin(), afterA.end(), b);
      std::vector<std::size_t> rest(at + 1, afterA.end());
      afterA.erase(at, afterA.end());
      loops_.push_back({loops_[i].part, std::move(rest)});
    } else {
      const std::vector<std::size_t> afterB = turned(j, b);
      afterA.insert(afterA.end(), afterB.begin(), afterB.end());
      const std::size_t part = loops_[i].part;
      const std::size_t joined = loops_[j].part;
      for (Loop& loop : loops_)
        if (loop.part == joined) loop.part = part;
      loops_[j].cycle.clear();
      if (tubes_.contains(joined)) tubes_.insert(part);
    }
    if (kind == SewStep::Kind::Tube || kind == SewStep::Kind::Round) tubes_.insert(loops_[i].part);
    loops_[i].cycle = std::move(afterA);
  }

 private:
  struct Loop {
    std::size_t part;  ///< of the article: the same for all that is joined
    std::vector<std::size_t> cycle;
  };
  [[nodiscard]] std::size_t loopOf(std::size_t edge) const {
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (std::find(loops_[i].cycle.begin(), loops_[i].cycle.end(), edge) != loops_[i].cycle.end())
        return i;
    return 0;
  }
  [[nodiscard]] std::size_t place(std::size_t loop, std::size_t edge) const {
    const std::vector<std::size_t>& cycle = loops_[loop].cycle;
    return static_cast<std::size_t>(std::find(cycle.begin(), cycle.end(), edge) - cycle.begin());
  }
  /// The loop from the edge after `edge` on, without it.
  [[nodiscard]] std::vector<std::size_t> turned(std::size_t loop, std::size_t edge) const {
    std::vector<std::size_t> cycle = loops_[loop].cycle;
    std::rotate(cycle.begin(), cycle.begin() + static_cast<std::ptrdiff_t>(place(loop, edge)),
                cycle.end());
    cycle.erase(cycle.begin());
    return cycle;
  }

  std::vector<Loop> loops_;
  std::set<std::size_t> tubes_;  ///< parts that no longer lie flat
};

std::vector<SewEdge> sewnEdges(const Pattern& pattern) {
  std::vector<SewEdge> edges;
  for (std::uint32_t p = 0; p < pattern.pieces.size(); ++p) {
    const PatternPiece& piece = pattern.pieces[p];
    for (std::vector<std::uint32_t>& group : edgeGroups(piece)) {
      const OutlineRun& first = piece.runs[group.front()];
      if (first.seam == 0) continue;
      SewEdge edge;
      const std::string codes = edgeCodes(pattern, piece, first);
      edge.code = codes.substr(0, codes.find('-'));
      edge.piece = p;
      edge.curve = first.curve;
      edge.seam = first.seam;
      edge.isDart = first.kind == WireKind::Dart;
      std::size_t points = 0;
      const Piece& cut = pattern.cut.pieces[pattern.pieceIndex[p]];
      for (const std::uint32_t r : group) {
        const OutlineRun& run = piece.runs[r];
        points += run.edgeCount;
        edge.length += drawnLength(piece, run);
        const Wire& wire = cut.wires[run.wire];
        edge.body += shareOf(run, wire) * total(wire.bodyLength);
        edge.target += shareOf(run, wire) * total(wire.targetLength);
      }
      edge.isRing = points == piece.sewLines[first.loop].size();
      edge.runs = std::move(group);
      edges.push_back(std::move(edge));
    }
  }
  return edges;
}

}  // namespace

SewingPlan planSewing(const Pattern& pattern) {
  SewingPlan plan;
  if (pattern.pieceIndex.size() != pattern.pieces.size()) return plan;  // not cut from a model
  plan.edges = sewnEdges(pattern);
  std::map<int, std::vector<std::uint32_t>> sides;
  for (std::uint32_t e = 0; e < plan.edges.size(); ++e) {
    plan.edges[e].mate = e;
    sides[plan.edges[e].seam].push_back(e);
  }
  std::map<int, SewStep> waiting;
  for (const auto& [seam, list] : sides) {
    if (list.size() != 2) continue;
    plan.edges[list[0]].mate = list[1];
    plan.edges[list[1]].mate = list[0];
    SewStep step;
    step.edgeA = list[0];
    step.edgeB = list[1];
    step.length = std::max(plan.edges[list[0]].length, plan.edges[list[1]].length);
    waiting[seam] = step;
  }

  const SewnBefore order = junctionOrder(pattern);
  Article article(pattern, plan.edges);
  const auto kindOf = [&](const SewStep& step) {
    const SewEdge& a = plan.edges[step.edgeA];
    const SewEdge& b = plan.edges[step.edgeB];
    if (a.isDart) return SewStep::Kind::Dart;
    if (a.isRing || b.isRing) return SewStep::Kind::Round;
    return article.kindOf(step.edgeA, step.edgeB);
  };
  while (!waiting.empty()) {
    const auto isFree = [&](int seam) {
      const auto found = order.find(seam);
      return found == order.end() ||
             std::none_of(found->second.begin(), found->second.end(),
                          [&](int other) { return waiting.contains(other); });
    };
    // Seams that wait for each other in a circle are sewn as if nothing held them.
    const bool anyFree = std::any_of(waiting.begin(), waiting.end(),
                                     [&](const auto& each) { return isFree(each.first); });
    auto best = waiting.end();
    for (auto it = waiting.begin(); it != waiting.end(); ++it) {
      if (anyFree && !isFree(it->first)) continue;
      it->second.kind = kindOf(it->second);
      // On a tube, first on from the end of what is sewn.
      const auto rank = [&article](const SewStep& step) {
        return std::make_tuple(step.kind, !article.goesOn(step.edgeA, step.edgeB), -step.length);
      };
      if (best == waiting.end() || rank(it->second) < rank(best->second)) best = it;
    }
    SewStep step = best->second;
    step.minutes = minutesOf(step.kind, step.length);
    article.sew(step.edgeA, step.edgeB, step.kind);
    plan.totalLength += step.length;
    plan.minutes += step.minutes;
    plan.steps.push_back(step);
    waiting.erase(best);
  }
  return plan;
}

}  // namespace toile
