// SPDX-License-Identifier: GPL-3.0-or-later
// Near links against an independent search: shortest ways in a graph with many points per edge.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <queue>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/surface_random.h"
#include "toile/curve/geodesic.h"

namespace toile {
namespace {

using Eigen::Vector3d;

/// Ways over the surface that change direction only at vertices and at evenly spaced points of the
/// edges: never shorter than the shortest way, and hardly longer.
class EdgePointGraph {
 public:
  EdgePointGraph(const Mesh& mesh, int pointsPerEdge) : mesh_(mesh), perEdge_(pointsPerEdge) {
    places_ = mesh.positions();
    for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
      const Vector3d &a = mesh.position(mesh.tail(EdgeId(e))),
                     &b = mesh.position(mesh.head(EdgeId(e)));
      for (int k = 1; k <= perEdge_; ++k) {
        places_.push_back(a + (b - a) * k / (perEdge_ + 1));
      }
    }
    facesOfNode_.resize(places_.size());
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
      for (const std::size_t node : nodesOf(FaceId(f))) facesOfNode_[node].push_back(FaceId(f));
    }
  }

  /// Distance between two points inside faces; gives up beyond `limit`.
  double distance(const SurfacePoint& a, const SurfacePoint& b, double limit) const {
    const Vector3d from = position(mesh_, a), to = position(mesh_, b);
    const std::vector<FaceId> last = facesOf(mesh_, b);
    std::vector<double> cost(places_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](std::size_t node, double value) {
      if (value >= cost[node] || value > limit) return;
      cost[node] = value;
      queue.emplace(value, node);
    };
    for (const FaceId f : facesOf(mesh_, a)) {
      for (const std::size_t node : nodesOf(f)) offer(node, (places_[node] - from).norm());
    }
    double best = std::numeric_limits<double>::infinity();
    while (!queue.empty()) {
      const auto [value, node] = queue.top();
      queue.pop();
      if (value > cost[node]) continue;
      for (const FaceId f : facesOfNode_[node]) {
        if (touches(mesh_, b, f)) best = std::min(best, value + (places_[node] - to).norm());
        for (const std::size_t next : nodesOf(f)) {
          offer(next, value + (places_[next] - places_[node]).norm());
        }
      }
    }
    return best;
  }

 private:
  std::vector<std::size_t> nodesOf(FaceId f) const {
    std::vector<std::size_t> nodes;
    for (int side = 0; side < 3; ++side) {
      const HalfedgeId h = mesh_.halfedge(f, side);
      nodes.push_back(mesh_.from(h).index());
      const std::size_t first =
          mesh_.vertexCount() + mesh_.edge(h).index() * static_cast<std::size_t>(perEdge_);
      for (int k = 0; k < perEdge_; ++k) nodes.push_back(first + static_cast<std::size_t>(k));
    }
    return nodes;
  }

  const Mesh& mesh_;
  int perEdge_;
  std::vector<Vector3d> places_;
  std::vector<std::vector<FaceId>> facesOfNode_;
};

/// Links near pairs; none may be longer than the graph's way, nor much shorter.
void expectShortestNearby(const Mesh& made, double reach, unsigned seed) {
  const auto mesh = std::make_shared<const Mesh>(made);
  const EdgePointGraph graph(*mesh, 7);
  GeodesicLinker linker(mesh);
  test::SurfaceRandom random(*mesh, seed);
  int linked = 0;
  double closest = 0;
  while (linked < 60) {
    const SurfacePoint a = random.point(), b = random.point();
    const double straight = (position(*mesh, a) - position(*mesh, b)).norm();
    if (straight > reach || commonFace(*mesh, a, b).isValid()) continue;
    const Result<SurfacePath> path = linker.link(a, b);
    ASSERT_TRUE(path) << path.error();
    const double found = length(*mesh, *path);
    const double known = graph.distance(a, b, 1.05 * found);
    EXPECT_LE(found, known * (1 + 1e-9)) << "pair " << linked << " seed " << seed;
    closest = std::max(closest, found / known);
    ++linked;
  }
  EXPECT_GT(closest, 0.999);  // the graph is fine enough to notice a wrong side of a vertex
}

TEST(Geodesic, IsTheShortestOfAllBetweenNearPoints) {
  expectShortestNearby(test::irregularGrid(12, 12), 50, 1);
  expectShortestNearby(test::cube(100, 3), 70, 2);
  expectShortestNearby(test::icosphere(100, 2), 80, 3);
  expectShortestNearby(test::torus(100, 40, 20, 12), 70, 4);
  expectShortestNearby(test::saddle(12, 10, 0.05), 50, 5);
  expectShortestNearby(test::trousers(12, 6), 150, 6);
  const auto spikes = [](double x, double y) {
    return 25 * std::sin(0.21 * x * x) * std::cos(0.17 * y * x);
  };
  expectShortestNearby(test::heightField(10, 10, 10, spikes), 30, 7);
}

}  // namespace
}  // namespace toile
