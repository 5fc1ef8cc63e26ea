// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/graph.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace toile::fitting {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Link {
  std::uint32_t to;
  double length;
};

/// Neighbours of every vertex, row by row.
struct Links {
  std::vector<std::size_t> start;
  std::vector<Link> links;
};

Links linksOf(const Mesh& mesh, const std::vector<Eigen::Vector3d>& positions) {
  Links result;
  result.start.assign(positions.size() + 1, 0);
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    ++result.start[mesh.tail(EdgeId(e)).index() + 1];
    ++result.start[mesh.head(EdgeId(e)).index() + 1];
  }
  for (std::size_t v = 0; v < positions.size(); ++v) result.start[v + 1] += result.start[v];
  result.links.resize(2 * mesh.edgeCount());
  std::vector<std::size_t> fill(result.start.begin(), result.start.end() - 1);
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    const std::uint32_t a = mesh.tail(EdgeId(e)).index();
    const std::uint32_t b = mesh.head(EdgeId(e)).index();
    const double length = (positions[a] - positions[b]).norm();
    result.links[fill[a]++] = {b, length};
    result.links[fill[b]++] = {a, length};
  }
  return result;
}

struct Waiting {
  double distance;
  std::uint32_t vertex;
  std::uint32_t source;
  friend bool operator>(const Waiting& a, const Waiting& b) {
    if (a.distance != b.distance) return a.distance > b.distance;
    return std::pair(a.vertex, a.source) > std::pair(b.vertex, b.source);
  }
};
using Front = std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>>;

/// The first is the vertex farthest from vertex 0's part's start; each next the farthest from all.
std::vector<std::uint32_t> spread(const Links& links, std::size_t count) {
  const std::size_t vertices = links.start.size() - 1;
  std::vector<double> distance(vertices, kFar);
  std::vector<std::uint32_t> chosen;
  std::uint32_t next = 0;
  while (chosen.size() < std::min(count, vertices)) {
    chosen.push_back(next);
    Front front;
    distance[next] = 0;
    front.push({0, next, 0});
    while (!front.empty()) {
      const Waiting at = front.top();
      front.pop();
      if (at.distance > distance[at.vertex]) continue;
      for (std::size_t k = links.start[at.vertex]; k < links.start[at.vertex + 1]; ++k) {
        const Link& link = links.links[k];
        const double d = at.distance + link.length;
        if (d >= distance[link.to]) continue;
        distance[link.to] = d;
        front.push({d, link.to, 0});
      }
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest <= 0) break;
    next = static_cast<std::uint32_t>(farthest - distance.begin());
  }
  return chosen;
}

}  // namespace

Graph makeGraph(const Mesh& connectivity, const std::vector<Eigen::Vector3d>& positions,
                std::size_t nodes) {
  const Links links = linksOf(connectivity, positions);
  const std::vector<std::uint32_t> chosen = spread(links, nodes);
  Graph graph;
  graph.vertexOfNode = chosen;

  // All nodes at once walk out; a vertex takes the first six that reach it.
  constexpr std::size_t kReached = Graph::kPerVertex + 1;
  std::vector<std::array<Waiting, kReached>> reached(positions.size());
  std::vector<std::uint8_t> count(positions.size(), 0);
  Front front;
  for (std::uint32_t k = 0; k < chosen.size(); ++k) front.push({0, chosen[k], k});
  while (!front.empty()) {
    const Waiting at = front.top();
    front.pop();
    auto& list = reached[at.vertex];
    std::uint8_t& n = count[at.vertex];
    const bool isKnown = std::any_of(list.begin(), list.begin() + n,
                                     [&](const Waiting& one) { return one.source == at.source; });
    if (n == kReached || isKnown) continue;
    list[n++] = at;
    for (std::size_t k = links.start[at.vertex]; k < links.start[at.vertex + 1]; ++k) {
      const Link& link = links.links[k];
      if (count[link.to] < kReached) {
        front.push({at.distance + link.length, link.to, at.source});
      }
    }
  }
  graph.ofVertex.resize(positions.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> shared;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::size_t n = std::min<std::size_t>(count[v], Graph::kPerVertex);
    const double limit = count[v] == kReached ? reached[v][kReached - 1].distance
                                              : 1.5 * reached[v][n - 1].distance + 1e-9;
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double left = 1 - reached[v][k].distance / limit;
      graph.ofVertex[v][k] = {reached[v][k].source, left * left + 1e-12};
      sum += graph.ofVertex[v][k].weight;
    }
    for (auto& share : graph.ofVertex[v]) share.weight /= sum;
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t l = k + 1; l < n; ++l) {
        const auto [a, b] = std::minmax(graph.ofVertex[v][k].node, graph.ofVertex[v][l].node);
        shared[{a, b}] += graph.ofVertex[v][k].weight * graph.ofVertex[v][l].weight;
      }
    }
  }
  for (const auto& [pair, weight] : shared) {
    if (weight <= 1e-3) continue;
    const double length = (positions[chosen[pair.first]] - positions[chosen[pair.second]]).norm();
    graph.edges.push_back({pair.first, pair.second, length});
  }
  return graph;
}

}  // namespace toile::fitting
