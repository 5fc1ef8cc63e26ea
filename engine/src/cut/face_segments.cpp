// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/face_segments.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toile::cutting {
namespace {

constexpr int kMaxRounds = 64;
constexpr int kFullToleranceRounds = 16;  // then halved each round: rest comes at the lattice

struct PlacedNode {
  Node node;
  LatticePoint lattice;
  Eigen::Vector2d flat;
};

struct PlacedSegment {
  LatticePoint a, b;
  Eigen::Vector2d flatA, flatB;
};

int sign(std::int64_t value) {
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

bool isStrictlyBetween(std::int64_t low, std::int64_t value, std::int64_t high) {
  return std::min(low, high) < value && value < std::max(low, high);
}

/// The point lies on the open segment, exactly.
bool isOn(const PlacedSegment& s, const LatticePoint& p) {
  return orientation(s.a, s.b, p) == 0 &&
         (isStrictlyBetween(s.a.x, p.x, s.b.x) || isStrictlyBetween(s.a.y, p.y, s.b.y));
}

/// The segment should be led through the node: it lies on it, or beside it closer than the distance
/// with both parts shorter than the whole.
bool leadsThrough(const PlacedSegment& s, const PlacedNode& n, double distance) {
  if (isOn(s, n.lattice)) return true;
  const Eigen::Vector2d along = s.flatB - s.flatA;
  const double squared = along.squaredNorm();
  const double reach = distance + distance;
  if (n.flat.x() < std::min(s.flatA.x(), s.flatB.x()) - reach ||
      n.flat.x() > std::max(s.flatA.x(), s.flatB.x()) + reach ||
      n.flat.y() < std::min(s.flatA.y(), s.flatB.y()) - reach ||
      n.flat.y() > std::max(s.flatA.y(), s.flatB.y()) + reach) {
    return false;
  }
  const Eigen::Vector2d toNode = n.flat - s.flatA;
  const double t = along.dot(toNode);
  if (!(t > 0 && t < squared)) return false;
  const double cross = along.x() * toNode.y() - along.y() * toNode.x();
  if (cross * cross >= distance * distance * squared) return false;
  return toNode.squaredNorm() < squared && (n.flat - s.flatB).squaredNorm() < squared;
}

bool cross(const PlacedSegment& s, const PlacedSegment& t) {
  if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) ||
      std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) ||
      std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y)) {
    return false;
  }
  return sign(orientation(s.a, s.b, t.a)) * sign(orientation(s.a, s.b, t.b)) < 0 &&
         sign(orientation(t.a, t.b, s.a)) * sign(orientation(t.a, t.b, s.b)) < 0;
}

/// The lattice point next to where two segments cross.
LatticePoint crossing(const PlacedSegment& s, const PlacedSegment& t) {
  const auto before = static_cast<double>(orientation(t.a, t.b, s.a));
  const auto after = static_cast<double>(orientation(t.a, t.b, s.b));
  const double fraction = before / (before - after);
  const auto between = [fraction](std::int64_t from, std::int64_t to) {
    return from + std::llround(fraction * static_cast<double>(to - from));
  };
  return {between(s.a.x, s.b.x), between(s.a.y, s.b.y)};
}

/// Pairs of crossing segments in order; found by sweeping along x.
std::vector<std::pair<std::size_t, std::size_t>> crossingPairs(
    const std::vector<PlacedSegment>& segments) {
  const auto low = [&](std::size_t i) { return std::min(segments[i].a.x, segments[i].b.x); };
  std::vector<std::size_t> order(segments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair{low(i), i} < std::pair{low(j), j};
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const PlacedSegment& s = segments[order[i]];
    const std::int64_t high = std::max(s.a.x, s.b.x);
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= high; ++j) {
      if (cross(s, segments[order[j]])) pairs.emplace_back(std::minmax({order[i], order[j]}));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Replaces each segment that got nodes by the chain through them, in their order along it.
void splitAt(const FaceFrame& frame, std::vector<Segment>& segments,
             std::vector<std::vector<Node>>& nodesOfSegment) {
  std::vector<Segment> parts;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& whole = segments[i];
    std::vector<Node>& nodes = nodesOfSegment[i];
    if (nodes.empty()) {
      parts.push_back(whole);
      continue;
    }
    const Eigen::Vector2d a = frame.flat(frame.lattice(whole.a));
    const Eigen::Vector2d along = frame.flat(frame.lattice(whole.b)) - a;
    const auto place = [&](const Node& node) {
      return (frame.flat(frame.lattice(node)) - a).dot(along);
    };
    std::sort(nodes.begin(), nodes.end(), [&](const Node& l, const Node& r) {
      const double placeL = place(l);
      const double placeR = place(r);
      return placeL != placeR ? placeL < placeR : l < r;
    });
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.push_back(whole.b);
    Node from = whole.a;
    for (const Node& to : nodes) {
      const Owner& owner = whole.owner;
      parts.push_back(owner.backward ? makeSegment(to, from, owner.rank, owner.curve)
                                     : makeSegment(from, to, owner.rank, owner.curve));
      from = to;
    }
  }
  segments = std::move(parts);
}

void moveToEdges(const FaceFrame& frame, std::vector<Segment>& segments,
                 std::vector<Segment>& alongEdges) {
  const auto isInside = [&](const Segment& s) {
    return frame.commonSide(frame.lattice(s.a), frame.lattice(s.b)) < 0;
  };
  const auto inside = std::stable_partition(segments.begin(), segments.end(), isInside);
  alongEdges.insert(alongEdges.end(), inside, segments.end());
  segments.erase(inside, segments.end());
}

}  // namespace

Segment makeSegment(const Node& from, const Node& to, std::uint8_t rank, std::uint32_t curve) {
  if (to < from) return {to, from, {rank, curve, true}};
  return {from, to, {rank, curve, false}};
}

void mergeSegments(std::vector<Segment>& segments) {
  std::erase_if(segments, [](const Segment& s) { return s.a == s.b; });
  std::sort(segments.begin(), segments.end());
  const auto last =
      std::unique(segments.begin(), segments.end(),
                  [](const Segment& l, const Segment& r) { return l.a == r.a && l.b == r.b; });
  segments.erase(last, segments.end());
}

bool settleSegments(const FaceFrame& frame, NodeTable& table, std::vector<Segment>& segments,
                    std::vector<Segment>& alongEdges, double tolerance) {
  for (int round = 0; round < kMaxRounds; ++round) {
    if (round > kFullToleranceRounds) tolerance /= 2;
    mergeSegments(segments);
    moveToEdges(frame, segments, alongEdges);
    if (segments.empty()) return true;

    std::vector<PlacedNode> nodes;
    for (const Node& node : table.nodesOf(frame)) {
      const LatticePoint lattice = frame.lattice(node);
      nodes.push_back({node, lattice, frame.flat(lattice)});
    }
    std::sort(nodes.begin(), nodes.end(), [](const PlacedNode& l, const PlacedNode& r) {
      return l.lattice.x != r.lattice.x ? l.lattice.x < r.lattice.x : l.lattice.y < r.lattice.y;
    });
    std::vector<PlacedSegment> placed;
    for (const Segment& s : segments) {
      const LatticePoint a = frame.lattice(s.a);
      const LatticePoint b = frame.lattice(s.b);
      placed.push_back({a, b, frame.flat(a), frame.flat(b)});
    }

    bool changed = false;
    std::vector<std::vector<Node>> nodesOfSegment(segments.size());
    const auto lead = [&](std::size_t i, const Node& node) {
      if (node == segments[i].a || node == segments[i].b) return;
      nodesOfSegment[i].push_back(node);
      changed = true;
    };
    const std::int64_t reach = frame.reach(tolerance);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto [low, high] = std::minmax({placed[i].a.x, placed[i].b.x});
      auto n = std::lower_bound(
          nodes.begin(), nodes.end(), low - reach,
          [](const PlacedNode& node, std::int64_t x) { return node.lattice.x < x; });
      for (; n != nodes.end() && n->lattice.x <= high + reach; ++n) {
        if (n->node != segments[i].a && n->node != segments[i].b &&
            leadsThrough(placed[i], *n, tolerance / 2)) {
          lead(i, n->node);
        }
      }
    }
    if (!changed) {
      for (const auto& [i, j] : crossingPairs(placed)) {
        const Node node = table.insertInFace(frame, crossing(placed[i], placed[j]), tolerance);
        lead(i, node);
        lead(j, node);
      }
    }
    if (!changed) return true;
    splitAt(frame, segments, nodesOfSegment);
  }
  return false;
}

}  // namespace toile::cutting
