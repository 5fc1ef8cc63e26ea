// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/label_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr double kStep = 2;        // px between the points that stand for a line
constexpr int kPlaces = 16;        // tried along the longer side of the piece
constexpr double kMargin = 1.12;   // the box and a little air
constexpr double kCovering = 0.6;  // what a place is worth where lines run beneath
constexpr double kTurned = 0.8;    // and one where the head must be turned

std::vector<Vector2d> pointsAlong(const std::vector<std::vector<Vector2d>>& lines, bool closed) {
  std::vector<Vector2d> points;
  for (const std::vector<Vector2d>& line : lines) {
    if (line.empty()) continue;
    Vector2d last = line.front();
    points.push_back(last);
    for (std::size_t i = 1; i < line.size() + (closed ? 1 : 0); ++i) {
      const Vector2d& next = line[i % line.size()];
      const double length = (next - last).norm();
      if (length < kStep) continue;
      const int count = static_cast<int>(std::ceil(length / kStep));
      for (int k = 1; k <= count; ++k) points.emplace_back(last + (next - last) * k / count);
      last = next;
    }
  }
  return points;
}

bool isWithin(const std::vector<std::vector<Vector2d>>& outlines, const Vector2d& p) {
  bool within = false;
  for (const std::vector<Vector2d>& loop : outlines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d& a = loop[i];
      const Vector2d& b = loop[(i + 1) % loop.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) within = !within;
    }
  }
  return within;
}

/// The type size at which the box round `middle` meets the first of the points; a size below
/// `enough` may be larger than that.
double freeSize(const std::vector<Vector2d>& points, const Vector2d& middle, const Vector2d& along,
                const LabelBlock& block, double enough) {
  double size = std::numeric_limits<double>::infinity();
  const double stop = 0.5 * kMargin * enough;
  for (const Vector2d& p : points) {
    const Vector2d d = p - middle;
    const double x = std::abs(d.dot(along)) / block.width;
    const double y = std::abs(d.x() * along.y() - d.y() * along.x()) / block.height;
    size = std::min(size, std::max(x, y));
    if (size < stop) break;
  }
  return 2 * size / kMargin;
}

/// Direction in which the outline extends most, turned so that text reads from the left.
double longDirection(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const Vector2d& p : points) {
    const Vector2d d = p - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  return 0.5 * std::atan2(2 * xy, xx - yy);
}

}  // namespace

std::optional<LabelPlace> fitLabel(const LabelRoom& room, std::span<const LabelBlock> blocks,
                                   double mostSize, double leastSize) {
  const std::vector<Vector2d> border = pointsAlong(room.outlines, true);
  if (border.size() < 3) return std::nullopt;
  const std::vector<Vector2d> lines = pointsAlong(room.lines, false);
  Vector2d low = border.front();
  Vector2d high = low;
  for (const Vector2d& p : border) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector2d size = high - low;
  // The same places from left and right: mirrored pieces get mirrored labels.
  const double step = std::max(size.maxCoeff() / kPlaces, kStep);
  const int columns = std::max(1, static_cast<int>(std::lround(size.x() / step)));
  const int rows = std::max(1, static_cast<int>(std::lround(size.y() / step)));
  std::vector<Vector2d> places = {room.wish};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back(low.x() + size.x() * (column + 0.5) / columns,
                          low.y() + size.y() * (row + 0.5) / rows);
    }
  }
  std::erase_if(places, [&](const Vector2d& p) { return !isWithin(room.outlines, p); });

  const std::array<double, 3> angles = {0, -std::numbers::pi / 2, longDirection(border)};
  std::optional<LabelPlace> best;
  double bestWorth = 0;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    for (const double angle : angles) {
      const Vector2d along(std::cos(angle), std::sin(angle));
      for (const Vector2d& middle : places) {
        // What can be worth no more than the best is not measured to its end.
        const double factor = blocks[block].worth * (angle == 0 ? 1 : kTurned);
        const double useful = std::max(leastSize, bestWorth / factor);
        if (mostSize < useful) break;
        const double free = freeSize(border, middle, along, blocks[block], useful);
        if (free < useful) continue;
        const double clear =
            std::min({free, mostSize, freeSize(lines, middle, along, blocks[block], 0)});
        double worth = std::max(clear, kCovering * std::min(free, mostSize));
        worth *= factor;
        worth *= 1 - 0.15 * (middle - room.wish).norm() / size.norm();
        if (worth <= bestWorth) continue;
        bestWorth = worth;
        const bool covers = clear < leastSize || clear < kCovering * std::min(free, mostSize);
        best = {block, covers ? std::min(free, mostSize) : clear, middle, angle};
      }
    }
  }
  return best;
}

}  // namespace toile
