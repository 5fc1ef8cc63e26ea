// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/node_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace toile::cutting {
namespace {

/// The place of a segment closest to a point, as a fraction of it.
double closestFraction(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& p) {
  const double squared = (b - a).squaredNorm();
  return squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
}

}  // namespace

NodeTable::NodeTable(const Mesh& mesh)
    : mesh_(mesh), onEdge_(mesh.edgeCount()), inFace_(mesh.faceCount()) {}

Node NodeTable::insertOnEdge(EdgeId edge, std::int64_t t, double tolerance) {
  std::vector<std::uint32_t>& nodes = onEdge_[edge.index()];
  const double partLength = mesh_.length(edge) / static_cast<double>(kUnit);
  const auto distance = [&](std::int64_t other) {
    return static_cast<double>(std::abs(other - t)) * partLength;
  };
  const auto after = std::lower_bound(nodes.begin(), nodes.end(), t);
  const std::int64_t below = after == nodes.begin() ? 0 : *(after - 1);
  const std::int64_t above = after == nodes.end() ? kUnit : *after;
  const std::int64_t nearest = distance(above) < distance(below) ? above : below;
  if (distance(nearest) < tolerance || nearest == t || t <= 0 || t >= kUnit) {
    if (nearest == 0) return Node::vertex(mesh_.tail(edge));
    if (nearest == kUnit) return Node::vertex(mesh_.head(edge));
    return Node::edge(edge, nearest);
  }
  nodes.insert(after, static_cast<std::uint32_t>(t));
  changedEdges_.push_back(edge);
  return Node::edge(edge, t);
}

Node NodeTable::insertInFace(const FaceFrame& frame, LatticePoint at, double tolerance) {
  const Eigen::Vector2d place = frame.flat(at);
  std::optional<Node> nearest;
  double nearestDistance = tolerance;
  const auto consider = [&](const Node& node) {
    const LatticePoint lattice = frame.lattice(node);
    const double distance = lattice == at ? -1.0 : (frame.flat(lattice) - place).norm();
    if (distance < nearestDistance) {
      nearest = node;
      nearestDistance = distance;
    }
  };
  for (const Node& node : nodesAround(frame)) consider(node);
  auto& inside = inFace_[frame.face().index()];
  const std::int64_t reach = frame.reach(tolerance);
  const auto low = static_cast<std::uint32_t>(std::max<std::int64_t>(at.x - reach, 0));
  for (auto in = std::lower_bound(inside.begin(), inside.end(), std::pair{low, 0U});
       in != inside.end() && in->first <= at.x + reach; ++in) {
    consider(Node::face(frame.face(), in->first, in->second));
  }
  if (nearest) return *nearest;

  const std::array<std::int64_t, 3> weightOffSide{at.y, kUnit - at.x - at.y, at.x};
  int nearestSide = -1;
  double fraction = 0;
  nearestDistance = tolerance;
  for (int side = 0; side < 3; ++side) {
    const Eigen::Vector2d a = frame.flatCorner(side);
    const Eigen::Vector2d b = frame.flatCorner((side + 1) % 3);
    const double t = closestFraction(a, b, place);
    const bool onSide = weightOffSide[static_cast<std::size_t>(side)] <= 0;
    const double distance = onSide ? 0.0 : (a + t * (b - a) - place).norm();
    if (onSide || distance < nearestDistance) {
      nearestSide = side;
      fraction = t;
      nearestDistance = distance;
      if (onSide) break;
    }
  }
  if (nearestSide >= 0) {
    const std::int64_t t = std::llround(fraction * static_cast<double>(kUnit));
    return insertOnEdge(frame.edge(nearestSide), frame.alongEdge(nearestSide, t), tolerance);
  }
  const Node node = Node::face(frame.face(), at.x, at.y);
  inside.insert(std::lower_bound(inside.begin(), inside.end(), std::pair{node.p, node.q}),
                {node.p, node.q});
  return node;
}

std::vector<Node> NodeTable::nodesAround(const FaceFrame& frame) const {
  std::vector<Node> nodes;
  for (int k = 0; k < 3; ++k) nodes.push_back(Node::vertex(frame.corner(k)));
  for (int k = 0; k < 3; ++k) {
    for (const std::uint32_t t : onEdge(frame.edge(k))) {
      nodes.push_back(Node::edge(frame.edge(k), t));
    }
  }
  return nodes;
}

std::vector<Node> NodeTable::nodesOf(const FaceFrame& frame) const {
  std::vector<Node> nodes = nodesAround(frame);
  for (const auto& [p, q] : inFace(frame.face())) nodes.push_back(Node::face(frame.face(), p, q));
  return nodes;
}

std::vector<EdgeId> NodeTable::takeChangedEdges() {
  std::vector<EdgeId> changed;
  std::swap(changed, changedEdges_);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

}  // namespace toile::cutting
