// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/subdivision.h"

#include <algorithm>

#include "toile/core/assert.h"

namespace toile::body {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;
using Quads = std::vector<std::array<std::size_t, 4>>;
using Entries = std::vector<Eigen::Triplet<double, int>>;

constexpr int kRefinements = 2;

Edge edgeOf(std::size_t a, std::size_t b) {
  return {std::min(a, b), std::max(a, b)};
}

void add(Entries& entries, std::size_t row, std::size_t column, double weight) {
  entries.emplace_back(static_cast<int>(row), static_cast<int>(column), weight);
}

SparseRows matrix(std::size_t rows, std::size_t columns, const Entries& entries) {
  SparseRows out(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

struct Refinement {
  Quads quads;
  std::vector<std::size_t> partner;
  SparseRows weights;  ///< rows: new vertices, columns: old ones
  std::map<Edge, std::size_t> edgePoint;
};

/// New vertices: the old ones, then one per edge, then one per quad.
Refinement refine(const Quads& quads, const std::vector<std::size_t>& partner) {
  const std::size_t oldCount = partner.size();
  Refinement out;
  std::vector<std::size_t> valence(oldCount, 0);
  std::size_t next = oldCount;
  for (const auto& quad : quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      ++valence[quad[i]];  // a closed surface: as many quads as edges around a vertex
      const auto [found, isNew] = out.edgePoint.emplace(edgeOf(quad[i], quad[(i + 1) % 4]), next);
      if (isNew) ++next;
    }
  }
  const std::size_t firstFace = next;
  next += quads.size();

  Entries entries;
  for (std::size_t f = 0; f < quads.size(); ++f) {
    for (const std::size_t v : quads[f]) add(entries, firstFace + f, v, 0.25);
  }
  for (const auto& quad : quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      // Edge point: mean of both ends and both face points; each of the two quads adds its half.
      const std::size_t point = out.edgePoint.at(edgeOf(quad[i], quad[(i + 1) % 4]));
      add(entries, point, quad[i], 0.125);
      add(entries, point, quad[(i + 1) % 4], 0.125);
      for (const std::size_t v : quad) add(entries, point, v, 0.0625);
      // Vertex point: (F + 2 E + (n - 3) v) / n with F, E the means of face points and edge
      // midpoints around it. Each quad has one of the n face points and half of two midpoints.
      const std::size_t v = quad[i];
      const double n = static_cast<double>(valence[v]);
      for (const std::size_t corner : quad) add(entries, v, corner, 0.25 / (n * n));
      for (const std::size_t neighbour : {quad[(i + 1) % 4], quad[(i + 3) % 4]}) {
        add(entries, v, v, 0.5 / (n * n));
        add(entries, v, neighbour, 0.5 / (n * n));
      }
    }
  }
  for (std::size_t v = 0; v < oldCount; ++v) {
    const double n = static_cast<double>(valence[v]);
    add(entries, v, v, (n - 3) / n);
  }
  out.weights = matrix(next, oldCount, entries);

  out.partner.resize(next);
  std::copy(partner.begin(), partner.end(), out.partner.begin());
  for (const auto& [edge, point] : out.edgePoint) {
    out.partner[point] = out.edgePoint.at(edgeOf(partner[edge.first], partner[edge.second]));
  }
  const auto sorted = [](std::array<std::size_t, 4> quad) {
    std::sort(quad.begin(), quad.end());
    return quad;
  };
  std::map<std::array<std::size_t, 4>, std::size_t> facePoint;
  for (std::size_t f = 0; f < quads.size(); ++f) facePoint[sorted(quads[f])] = firstFace + f;
  for (std::size_t f = 0; f < quads.size(); ++f) {
    const auto& q = quads[f];
    out.partner[firstFace + f] =
        facePoint.at(sorted({partner[q[0]], partner[q[1]], partner[q[2]], partner[q[3]]}));
  }
  for (std::size_t f = 0; f < quads.size(); ++f) {
    const auto& quad = quads[f];
    for (std::size_t i = 0; i < 4; ++i) {
      out.quads.push_back({quad[i], out.edgePoint.at(edgeOf(quad[i], quad[(i + 1) % 4])),
                           firstFace + f, out.edgePoint.at(edgeOf(quad[i], quad[(i + 3) % 4]))});
    }
  }
  return out;
}

/// Limit position: (n^2 v + 4 sum of edge neighbours + sum of opposite corners) / (n (n + 5)).
SparseRows limitWeights(const Quads& quads, std::size_t count) {
  std::vector<double> valence(count, 0);
  for (const auto& quad : quads) {
    for (const std::size_t v : quad) valence[v] += 1;
  }
  Entries entries;
  for (const auto& quad : quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double n = valence[quad[i]];
      const double scale = 1 / (n * (n + 5));
      add(entries, quad[i], quad[(i + 1) % 4], 2 * scale);  // each neighbour lies in two quads
      add(entries, quad[i], quad[(i + 3) % 4], 2 * scale);
      add(entries, quad[i], quad[(i + 2) % 4], scale);
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    add(entries, v, v, valence[v] / (valence[v] + 5));
  }
  return matrix(count, count, entries);
}

}  // namespace

Subdivision::Subdivision(const ControlNet& net) : quads_(net.quads()), partner_(net.partner()) {
  const auto cageSize = static_cast<Eigen::Index>(net.vertexCount());
  weights_.resize(cageSize, cageSize);
  weights_.setIdentity();
  for (int i = 0; i < kRefinements; ++i) {
    Refinement refined = refine(quads_, partner_);
    quads_ = std::move(refined.quads);
    partner_ = std::move(refined.partner);
    weights_ = SparseRows(refined.weights * weights_);
    edgePoints_.push_back(std::move(refined.edgePoint));
  }
  weights_ = SparseRows(limitWeights(quads_, partner_.size()) * weights_);
  interpolation_.compute(Eigen::SparseMatrix<double>(weights_.topRows(cageSize)));
  TOILE_ASSERT(interpolation_.info() == Eigen::Success);
}

Points Subdivision::cageThrough(const Points& controlPoints) const {
  return interpolation_.solve(controlPoints);
}

std::array<std::size_t, 5> Subdivision::alongEdge(NetVertex from, NetVertex to) const {
  const std::size_t middle = edgePoints_[0].at(edgeOf(from, to));
  return {from, edgePoints_[1].at(edgeOf(from, middle)), middle,
          edgePoints_[1].at(edgeOf(middle, to)), to};
}

const Subdivision& subdivision() {
  static const Subdivision surface(controlNet());
  return surface;
}

}  // namespace toile::body
