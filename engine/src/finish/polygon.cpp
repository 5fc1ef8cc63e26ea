// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

namespace toile {
namespace {

Eigen::Vector2d closestOnEdge(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                              const Eigen::Vector2d& p) {
  const Eigen::Vector2d d = b - a;
  const double squared = d.squaredNorm();
  if (squared == 0) return a;
  return a + std::clamp((p - a).dot(d) / squared, 0.0, 1.0) * d;
}

}  // namespace

Points2 positions(const Outline& outline) {
  Points2 points;
  points.reserve(outline.size());
  for (const OutlinePoint& p : outline) points.push_back(p.position);
  return points;
}

std::vector<Points2> positions(const std::vector<Outline>& outlines) {
  std::vector<Points2> loops;
  loops.reserve(outlines.size());
  for (const Outline& outline : outlines) loops.push_back(positions(outline));
  return loops;
}

double signedArea(std::span<const Eigen::Vector2d> polygon) {
  if (polygon.size() < 3) return 0;
  // Relative to the first point, so that a far-off polygon loses no digits.
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

double turnAngle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d in = b - a;
  const Eigen::Vector2d out = c - b;
  return std::atan2(cross(in, out), in.dot(out));
}

bool isInside(const std::vector<Points2>& loops, const Eigen::Vector2d& p) {
  bool inside = false;
  for (const Points2& loop : loops) {
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d& b = loop[j];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
  }
  return inside;
}

std::vector<std::size_t> simplifiedIndices(std::span<const Eigen::Vector2d> polygon,
                                           std::span<const char> keep, double tolerance) {
  const std::size_t count = polygon.size();
  std::vector<std::size_t> kept;
  if (count < 4) {
    for (std::size_t i = 0; i < count; ++i) kept.push_back(i);
    return kept;
  }
  std::size_t start = 0;
  while (start < count && keep[start] == 0) ++start;
  if (start == count) start = 0;

  // Greedy: the chord from the last kept vertex is prolonged while everything between stays close.
  // 64 vertices a chord bound the cost.
  constexpr std::size_t kMostSkipped = 64;
  std::size_t anchor = 0;  // offset from start
  while (anchor < count) {
    kept.push_back((start + anchor) % count);
    std::size_t next = anchor + 1;
    while (next < count && next - anchor <= kMostSkipped && keep[(start + next) % count] == 0) {
      const Eigen::Vector2d& from = polygon[(start + anchor) % count];
      const Eigen::Vector2d& to = polygon[(start + next + 1) % count];
      bool close = true;
      for (std::size_t k = anchor + 1; k <= next && close; ++k) {
        const Eigen::Vector2d& p = polygon[(start + k) % count];
        close = (p - closestOnEdge(from, to, p)).norm() <= tolerance;
      }
      if (!close) break;
      ++next;
    }
    anchor = next;
  }
  std::sort(kept.begin(), kept.end());
  if (kept.size() < 3) {
    kept.clear();
    for (std::size_t i = 0; i < count; ++i) kept.push_back(i);
  }
  return kept;
}

Box2 boxOf(std::span<const Eigen::Vector2d> points) {
  Box2 box;
  if (points.empty()) return box;
  box.min = box.max = points[0];
  for (const Eigen::Vector2d& p : points) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

// Clips as Liang and Barsky do.
bool crosses(const Box2& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double from = 0;
  double to = 1;
  for (int k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    if (d == 0) {
      if (a[k] < box.min[k] || a[k] > box.max[k]) return false;
      continue;
    }
    const double t0 = (box.min[k] - a[k]) / d;
    const double t1 = (box.max[k] - a[k]) / d;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from <= to;
}

EdgeGrid::EdgeGrid(const std::vector<Points2>& loops) {
  for (const Points2& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      edges_.push_back({loop[i], loop[(i + 1) % loop.size()]});
  Points2 all;
  for (const auto& edge : edges_) all.push_back(edge[0]);
  box_ = boxOf(all);
  const Eigen::Vector2d size = box_.size();
  cellSize_ = std::max({size.x(), size.y(), 1e-6}) /
              std::clamp(std::sqrt(double(edges_.size())), 1.0, 128.0);
  columns_ = static_cast<std::int64_t>(size.x() / cellSize_) + 1;
  rows_ = static_cast<std::int64_t>(size.y() / cellSize_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Box2 box = boxOf(edges_[e]);
    for (std::int64_t r = row(box.min.y()); r <= row(box.max.y()); ++r)
      for (std::int64_t c = column(box.min.x()); c <= column(box.max.x()); ++c)
        cells_[static_cast<std::size_t>(r * columns_ + c)].push_back(static_cast<std::uint32_t>(e));
  }
}

std::int64_t EdgeGrid::column(double x) const {
  return std::clamp<std::int64_t>(
      static_cast<std::int64_t>(std::floor((x - box_.min.x()) / cellSize_)), 0, columns_ - 1);
}

std::int64_t EdgeGrid::row(double y) const {
  return std::clamp<std::int64_t>(
      static_cast<std::int64_t>(std::floor((y - box_.min.y()) / cellSize_)), 0, rows_ - 1);
}

EdgeGrid::Nearest EdgeGrid::nearest(const Eigen::Vector2d& p) const {
  Nearest best;
  best.distance = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d home = p.cwiseMax(box_.min).cwiseMin(box_.max);
  const double outside = (p - home).norm();
  const std::int64_t c0 = column(home.x());
  const std::int64_t r0 = row(home.y());
  const auto look = [&](std::int64_t c, std::int64_t r) {
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return;
    for (const std::uint32_t e : cells_[static_cast<std::size_t>(r * columns_ + c)]) {
      const Eigen::Vector2d q = closestOnEdge(edges_[e][0], edges_[e][1], p);
      const double distance = (p - q).norm();
      if (std::tie(distance, e) < std::make_tuple(best.distance, best.edge))
        best = {distance, e, q};
    }
  };
  // Rings of cells around the home cell; the ring at step k lies at least (k - 1) cells away from
  // the home point, which is at most as far from any edge as p is less `outside`.
  const std::int64_t most = std::max(columns_, rows_);
  for (std::int64_t k = 0; k <= most; ++k) {
    if (static_cast<double>(k - 1) * cellSize_ - outside > best.distance) break;
    for (std::int64_t c = c0 - k; c <= c0 + k; ++c) {
      look(c, r0 - k);
      if (k > 0) look(c, r0 + k);
    }
    for (std::int64_t r = r0 - k + 1; r <= r0 + k - 1; ++r) {
      look(c0 - k, r);
      look(c0 + k, r);
    }
  }
  return best;
}

InmostPoint inmostPoint(const std::vector<Points2>& loops) {
  const EdgeGrid grid(loops);
  const Box2 box = boxOf(loops.front());
  const auto clearance = [&](const Eigen::Vector2d& p) {
    const double distance = grid.nearest(p).distance;
    return isInside(loops, p) ? distance : -distance;
  };
  struct Cell {
    Eigen::Vector2d centre;
    double half;
    double clearance;
    std::size_t order;  // ties by age, so that the answer is always the same
    [[nodiscard]] double bound() const { return clearance + half * std::numbers::sqrt2; }
  };
  const auto later = [](const Cell& a, const Cell& b) {
    return a.bound() != b.bound() ? a.bound() < b.bound() : a.order > b.order;
  };
  std::priority_queue<Cell, std::vector<Cell>, decltype(later)> queue(later);
  std::size_t made = 0;
  const auto push = [&](const Eigen::Vector2d& centre, double half) {
    queue.push({centre, half, clearance(centre), made++});
  };
  const double side = std::max(std::min(box.size().x(), box.size().y()), 1e-3);
  InmostPoint best{0.5 * (box.min + box.max), 0};
  best.clearance = clearance(best.position);
  const int across = std::min(64, 1 + static_cast<int>(box.size().x() / side));
  const int along = std::min(64, 1 + static_cast<int>(box.size().y() / side));
  const double half = 0.5 * std::max(box.size().x() / across, box.size().y() / along);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j)
      push(box.min + Eigen::Vector2d(box.size().x() * (i + 0.5) / across,
                                     box.size().y() * (j + 0.5) / along),
           half);
  constexpr double kPrecisionMm = 0.5;
  constexpr std::size_t kMostCells = 20000;
  while (!queue.empty() && made < kMostCells) {
    const Cell cell = queue.top();
    queue.pop();
    if (cell.clearance > best.clearance) best = {cell.centre, cell.clearance};
    if (cell.bound() - best.clearance <= kPrecisionMm) break;
    const double quarter = 0.5 * cell.half;
    for (const double dx : {-quarter, quarter})
      for (const double dy : {-quarter, quarter})
        push(cell.centre + Eigen::Vector2d(dx, dy), quarter);
  }
  return best;
}

}  // namespace toile
