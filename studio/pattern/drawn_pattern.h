// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QLineF>
#include <QPainterPath>
#include <QPolygonF>
#include <memory>
#include <string>
#include <vector>

#include "document/piece_colours.h"
#include "toile/layout/pattern.h"

namespace toile::studio {

/// A run of a sew line, or a line inside of a piece.
struct DrawnRun {
  std::string curve;
  QPolygonF points;  ///< on the sheet, mm, y up
  CurveKind kind = CurveKind::Seam;
  std::uint32_t wire = 0;  ///< of its piece; of runs only
  double length = 0;       ///< mm
};

/// A piece as it lies on the sheet.
struct DrawnPiece {
  std::string id;
  QString name;
  std::size_t index = 0;     ///< in Pattern::pieces
  std::size_t cutIndex = 0;  ///< in Pattern::cut.pieces
  std::shared_ptr<const FlatPiece> flat;
  Placement placement;
  QPainterPath sew, cut;
  QColor tint;
  std::vector<DrawnRun> runs, inner;
  std::vector<QLineF> notches;
  QLineF grain;
  QPointF label, middle;
  QString note;
  bool isPreview = false;  ///< drawn dashed: its full answer is still to come
  QImage strain;           ///< its colours, null where they are not shown
  QRectF strainPlace;      ///< of the image on the sheet
};

/// @param full the pieces of the last full pattern if this one is a preview: what is the same there
/// is taken over, what is not is marked as preview. Null for a full pattern.
[[nodiscard]] std::vector<DrawnPiece> drawPattern(const Pattern& pattern, PieceColours colours,
                                                  const std::vector<DrawnPiece>* full);

/// The two runs of a seam that are sewn together.
struct DrawnMates {
  const DrawnPiece* pieceA = nullptr;
  const DrawnRun* a = nullptr;
  const DrawnPiece* pieceB = nullptr;
  const DrawnRun* b = nullptr;
  /// Places that come together, at even parts of the length.
  std::vector<QLineF> connectors;
};
/// Of the seam or dart along one curve. Pointers into `pieces`.
[[nodiscard]] std::vector<DrawnMates> matesOf(const std::vector<DrawnPiece>& pieces,
                                              const Pattern& pattern, const std::string& curve);

/// Colours a piece by the strain of its vertices.
/// @param scale the strain at the end of the colours
void paintStrain(DrawnPiece& piece, const Pattern& pattern, const std::vector<float>& ofVertices,
                 double scale, bool oneSided);

[[nodiscard]] inline QPointF toQt(const Eigen::Vector2d& p) {
  return {p.x(), p.y()};
}

}  // namespace toile::studio
