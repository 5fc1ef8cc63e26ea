// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pdf_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kAroundMm = 3;  ///< free paper around the pieces

/// A tile without what it shares with the next ones.
Box2 ownBox(const TilePlan& plan, int row, int column) {
  Box2 box = plan.box(row, column);
  box.max = box.min + plan.step();
  return box;
}

std::vector<char> usedTiles(const SheetDrawing& sheet, const TilePlan& plan) {
  std::vector<char> used(static_cast<std::size_t>(plan.rows * plan.columns), 0);
  const auto at = [&](int row, int column) -> char& {
    return used[static_cast<std::size_t>(row * plan.columns + column)];
  };
  const Eigen::Vector2d step = plan.step();
  const double top = plan.origin.y() + plan.rows * step.y();
  // What lies in the overlap alone counts for the tile that has it as its own.
  const auto columnOf = [&](double x) {
    return std::clamp(static_cast<int>(std::floor((x - plan.origin.x()) / step.x())), 0,
                      plan.columns - 1);
  };
  const auto rowOf = [&](double y) {
    return std::clamp(static_cast<int>(std::floor((top - y) / step.y())), 0, plan.rows - 1);
  };
  for (const PieceDrawing& piece : sheet.pieces) {
    std::vector<Points2> cut;
    for (const SheetLine& line : piece.lines) {
      if (line.role != SheetRole::Cut) continue;  // everything else lies inside
      cut.push_back(line.points);
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Eigen::Vector2d& a = line.points[i];
        const Eigen::Vector2d& b = line.points[(i + 1) % line.points.size()];
        for (int r = rowOf(std::max(a.y(), b.y())); r <= rowOf(std::min(a.y(), b.y())); ++r)
          for (int c = columnOf(std::min(a.x(), b.x())); c <= columnOf(std::max(a.x(), b.x())); ++c)
            if (at(r, c) == 0 && crosses(ownBox(plan, r, c), a, b)) at(r, c) = 1;
      }
    }
    if (cut.empty()) continue;
    const Box2 box = boxOf(cut.front());
    for (int r = rowOf(box.max.y()); r <= rowOf(box.min.y()); ++r)
      for (int c = columnOf(box.min.x()); c <= columnOf(box.max.x()); ++c) {
        const Box2 tile = ownBox(plan, r, c);
        if (at(r, c) == 0 && isInside(cut, 0.5 * (tile.min + tile.max))) at(r, c) = 1;
      }
  }
  return used;
}

}  // namespace

std::string tileName(int row, int column) {
  std::string letters;
  for (int r = row; r >= 0; r = r / 26 - 1)
    letters.insert(letters.begin(), static_cast<char>('A' + r % 26));
  return fmt::format("{}{}", letters, column + 1);
}

std::string Tile::name() const {
  return tileName(row, column);
}

Box2 TilePlan::box(int row, int column) const {
  Box2 tile;
  tile.min = origin + Eigen::Vector2d(column * step().x(), (rows - 1 - row) * step().y());
  tile.max = tile.min + Eigen::Vector2d(size.width, size.height);
  return tile;
}

const Tile* TilePlan::find(int row, int column) const {
  for (const Tile& tile : tiles)
    if (tile.row == row && tile.column == column) return &tile;
  return nullptr;
}

TilePlan planTiles(const SheetDrawing& sheet, int firstPage, const TileSize& tileSize) {
  const Eigen::Vector2d size = sheet.max - sheet.min + Eigen::Vector2d(2, 2) * kAroundMm;
  TilePlan plan;
  plan.size = tileSize;
  const Eigen::Vector2d step = plan.step();
  // The grid may lie anywhere: of 12 x 12 places the one that saves most paper, and of those the
  // first, since the others spread over more rows and columns.
  constexpr int kPlaces = 12;
  const Eigen::Vector2d low = sheet.min - Eigen::Vector2d(1, 1) * kAroundMm;
  std::vector<char> best;
  TilePlan bestPlan = plan;
  std::ptrdiff_t fewest = 0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const Eigen::Vector2d shift(step.x() * i / kPlaces, step.y() * j / kPlaces);
      plan.origin = low - shift;
      plan.columns = std::max(1, static_cast<int>(std::ceil((size.x() + shift.x()) / step.x())));
      plan.rows = std::max(1, static_cast<int>(std::ceil((size.y() + shift.y()) / step.y())));
      std::vector<char> used = usedTiles(sheet, plan);
      const std::ptrdiff_t count = std::count(used.begin(), used.end(), 1);
      if (!best.empty() && count >= fewest) continue;
      best = std::move(used);
      bestPlan = plan;
      fewest = count;
    }
  }
  plan = bestPlan;
  for (int r = 0; r < plan.rows; ++r)
    for (int c = 0; c < plan.columns; ++c)
      if (best[static_cast<std::size_t>(r * plan.columns + c)] != 0) {
        plan.tiles.push_back(
            {r, c, firstPage + static_cast<int>(plan.tiles.size()), plan.box(r, c)});
      }
  return plan;
}

}  // namespace toile
