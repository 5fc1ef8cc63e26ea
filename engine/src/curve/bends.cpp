// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/bends.h"

#include <algorithm>
#include <cmath>

namespace toile::detail {

namespace {

constexpr double kMostSamples = 120;
constexpr double kFewestSamples = 24;
constexpr double kSpacingInEdges = 0.8;

void appendBend(std::vector<double>& bends, double turn) {
  if (!bends.empty() && (bends.back() > 0) == (turn > 0)) {
    bends.back() += turn;
  } else if (turn != 0) {
    bends.push_back(turn);
  }
}

}  // namespace

int countInflections(const std::vector<double>& turns, bool closed, double least) {
  std::vector<double> bends;
  for (const double turn : turns) appendBend(bends, turn);
  const auto joinRound = [&] {
    if (closed && bends.size() > 1 && (bends.front() > 0) == (bends.back() > 0)) {
      bends.front() += bends.back();
      bends.pop_back();
    }
  };
  joinRound();
  while (!bends.empty()) {
    const auto smallest = std::min_element(
        bends.begin(), bends.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (std::abs(*smallest) >= least) break;
    bends.erase(smallest);
    std::vector<double> joined;
    for (const double bend : bends) appendBend(joined, bend);
    bends = std::move(joined);
    joinRound();
  }
  if (bends.size() < 2) return 0;
  return static_cast<int>(closed ? bends.size() : bends.size() - 1);
}

std::size_t evenSampleCount(const Mesh& mesh, double length) {
  const double wanted =
      std::max(length / kMostSamples,
               std::min(length / kFewestSamples, kSpacingInEdges * mesh.meanEdgeLength()));
  return static_cast<std::size_t>(std::max(3.0, std::round(length / wanted)));
}

}  // namespace toile::detail
