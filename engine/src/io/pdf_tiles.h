// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "finish/polygon.h"
#include "toile/io/sheet_drawing.h"

namespace toile {

/// Of a grid that prints on A4 and on Letter at 100 %, whichever way a viewer lays the page on the
/// paper: 10 mm from the sides of A4, 28.5 mm from its top and bottom.
inline constexpr double kTileWidthMm = 190;
inline constexpr double kTileHeightMm = 240;

/// What a page shows of the sheet.
struct TileSize {
  double width = kTileWidthMm, height = kTileHeightMm;  ///< mm
  double overlap = 0;  ///< mm that a tile shares with the next one to the right and above
};

struct Tile {
  int row = 0;     ///< from the top
  int column = 0;  ///< from the left
  int page = 0;    ///< of the document, from 1
  Box2 box;        ///< on the sheet
  [[nodiscard]] std::string name() const;
};

struct TilePlan {
  int rows = 0, columns = 0;
  TileSize size;
  Eigen::Vector2d origin{0, 0};  ///< lower left corner of the grid on the sheet
  std::vector<Tile> tiles;       ///< that hold something, row by row; the others are not printed

  [[nodiscard]] Box2 box(int row, int column) const;
  /// From one tile to the next.
  [[nodiscard]] Eigen::Vector2d step() const {
    return {size.width - size.overlap, size.height - size.overlap};
  }
  [[nodiscard]] const Tile* find(int row, int column) const;
};

/// "A1" is at the top left; rows beyond Z go on with AA.
[[nodiscard]] std::string tileName(int row, int column);

/// Lays the grid over the sheet so that few tiles are needed; pages are numbered from `firstPage`.
/// A tile inside a piece belongs to it even if no line crosses it.
[[nodiscard]] TilePlan planTiles(const SheetDrawing& sheet, int firstPage,
                                 const TileSize& size = {});

}  // namespace toile
