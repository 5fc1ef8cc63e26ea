// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "layout/clearance.h"
#include "layout/mirror_images.h"
#include "layout/part_pieces.h"
#include "layout/placed_piece.h"

namespace toile {
namespace {

using Eigen::Vector2d;

Box2 boxOfAll(const std::vector<PlacedPiece>& placed, const std::vector<std::size_t>& pieces) {
  Points2 corners;
  for (const std::size_t p : pieces) {
    const Box2 box = boxOf(placed[p].cut);
    corners.push_back(box.min);
    corners.push_back(box.max);
  }
  return boxOf(corners);
}

/// Moves and turns a piece as a hand did, about the middle of its cut line.
void placeByHand(PlacedPiece& placed, const HandPlacement& byHand) {
  const Box2 box = boxOf(placed.cut);
  const Vector2d middle = 0.5 * (box.min + box.max);
  Placement motion{byHand.turn.radians(), Vector2d::Zero()};
  motion.offset = middle + byHand.move - motion.applyToDirection(middle);
  placed.move(motion);
  placed.byHand = true;
}

/// The promise itself, measured on the true lines: a piece that breaks it goes to the far right.
void moveAsideWhatOverlaps(std::vector<PlacedPiece>& placed,
                           const std::vector<PatternPiece>& pattern,
                           std::vector<Finding>& findings) {
  constexpr double kRoundingMm = 1e-3;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    all.push_back(i);
    for (std::size_t j = 0; j < i; ++j) {
      const Box2 a = boxOf(placed[i].cut);
      const Box2 b = boxOf(placed[j].cut);
      if ((a.min - b.max).maxCoeff() > kLayoutGapMm || (b.min - a.max).maxCoeff() > kLayoutGapMm)
        continue;
      if (distanceBetween(placed[i].cut, placed[j].cut) >= kLayoutGapMm - kRoundingMm) continue;
      const PatternPiece& moved = pattern[placed[i].piece];
      const PatternPiece& other = pattern[placed[j].piece];
      if (placed[i].byHand && placed[j].byHand) {
        findings.push_back(
            {"layout-hand-overlap",
             fmt::format("pieces \"{}\" and \"{}\" were placed by hand closer than {} mm; "
                         "move one of them before cutting",
                         other.name, moved.name, kLayoutGapMm),
             {Element::piece(other.id), Element::piece(moved.id)}});
        continue;
      }
      PlacedPiece& aside = placed[i].byHand ? placed[j] : placed[i];
      aside.shift({boxOfAll(placed, all).max.x() + kLayoutGapMm - boxOf(aside.cut).min.x(), 0});
      findings.push_back(
          {"layout-moved-aside",
           fmt::format("piece \"{}\" found no place beside \"{}\" and lies on the right of the "
                       "sheet",
                       pattern[aside.piece].name, &aside == &placed[i] ? other.name : moved.name),
           {Element::piece(pattern[aside.piece].id)}});
      break;
    }
  }
}

}  // namespace

Result<Layout> arrange(const ReferenceModel& model, const CutResult& cut,
                       const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                       const std::vector<PatternPiece>& pattern,
                       const std::vector<std::uint32_t>& pieceIndex,
                       const std::vector<HandPlacement>& byHand) {
  if (pieceIndex.size() != pattern.size())
    return Error{ErrorCode::InvalidArgument, "the layout needs the index of each piece", {}};
  const std::shared_ptr<const GuidingMap> map = guidingMap(model);
  std::vector<PlacedPiece> placed;
  std::array<std::vector<std::size_t>, 2> onSide;
  Layout layout;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::uint32_t index = pieceIndex[i];
    if (index >= cut.pieces.size() || index >= flats.size() || flats[index] == nullptr ||
        pattern[i].cutLines.empty())
      return Error{
          ErrorCode::InvalidArgument,
          fmt::format("piece \"{}\" has no flat piece or no cut line to lay out", pattern[i].name),
          {Element::piece(pattern[i].id)}};
    const Piece& onModel = cut.pieces[index];
    if (onModel.sourceFace.size() != onModel.mesh->faceCount() ||
        onModel.onModel.size() != onModel.mesh->vertexCount())
      return Error{
          ErrorCode::InvalidArgument,
          fmt::format("piece \"{}\" does not say where on the model it lies", pattern[i].name),
          {Element::piece(pattern[i].id)}};
    const PlaceOnMap place = placeOnMap(onModel, *flats[index], *model.mesh, *map);
    PlacedPiece piece;
    piece.piece = i;
    piece.side = map->charts[place.chart].side;
    piece.placement = place.placement;
    for (const OutlinePoint& p : pattern[i].cutLines.front())
      piece.cut.push_back(place.placement.apply(p.position));
    piece.grownBy = grown(piece.cut, 0.5 * kLayoutGapMm + kSameLineMm);
    layout.beforeHands.push_back(place.placement);
    onSide[piece.side == MapSide::Back ? 1 : 0].push_back(i);
    placed.push_back(std::move(piece));
  }
  std::vector<std::optional<std::size_t>> mirror = makeMirrored(placed);
  layout.placements.resize(pattern.size());
  for (const PlacedPiece& piece : placed) {
    layout.side.push_back(piece.side);
    layout.onMap.push_back(piece.placement);
  }
  for (const std::vector<std::size_t>& pieces : onSide) partPieces(placed, pieces, mirror);
  constexpr double kBetweenSidesMm = 4 * kLayoutGapMm;
  if (!onSide[0].empty() && !onSide[1].empty()) {
    const double right = boxOfAll(placed, onSide[0]).max.x();
    const double left = boxOfAll(placed, onSide[1]).min.x();
    layout.mapOrigin[1] = {right + kBetweenSidesMm - left, 0};
  }
  // Hands come last, so that a piece that one moves leaves the others where they are; only what it
  // would lie on makes way.
  bool isAnyByHand = false;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (const HandPlacement& hand : byHand) {
      if (hand.piece != pattern[i].id) continue;
      isAnyByHand = true;
      placed[i].move(composed(layout.beforeHands[i], inverse(placed[i].placement)));
      placeByHand(placed[i], hand);
      layout.onMap[i] = placed[i].placement;
      if (mirror[i]) mirror[*mirror[i]].reset();
      mirror[i].reset();
    }
  }
  if (isAnyByHand) {
    for (const std::vector<std::size_t>& pieces : onSide) partPieces(placed, pieces, mirror);
  }
  for (const std::size_t p : onSide[1]) placed[p].shift(layout.mapOrigin[1]);
  moveAsideWhatOverlaps(placed, pattern, layout.findings);

  std::vector<std::size_t> all(placed.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const Box2 box = boxOfAll(placed, all);
  for (PlacedPiece& piece : placed) {
    piece.shift(-box.min);
    layout.placements[piece.piece] = piece.placement;
  }
  for (Vector2d& origin : layout.mapOrigin) origin -= box.min;
  layout.max = box.size();
  return layout;
}

HandPlacement placedByHand(const Layout& layout, const PatternPiece& piece, std::size_t index,
                           const Placement& wanted) {
  // Notation: a, m = turn and offset of the place on the map, b = the middle of the piece turned by
  // a. placeByHand() takes p to R (p - b - m) + b + m + move.
  const Placement& before = layout.beforeHands[index];
  const Placement turned{before.angle, Vector2d::Zero()};
  std::vector<Vector2d> cut;
  for (const OutlinePoint& p : piece.cutLines.front()) cut.push_back(turned.apply(p.position));
  const Box2 box = boxOf(cut);
  const Vector2d b = 0.5 * (box.min + box.max);
  HandPlacement hand;
  hand.piece = piece.id;
  hand.turn = Angle::radians(std::remainder(wanted.angle - before.angle, 2 * std::numbers::pi));
  const Placement turn{hand.turn.radians(), Vector2d::Zero()};
  hand.move = wanted.offset - layout.mapOrigin[layout.side[index] == MapSide::Back ? 1 : 0] +
              turn.applyToDirection(b) - b - before.offset;
  return hand;
}

}  // namespace toile
