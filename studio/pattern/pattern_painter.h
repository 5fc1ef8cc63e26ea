// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <optional>

#include "app/session.h"
#include "pattern/drawn_pattern.h"

namespace toile::studio {

/// px from the edge of the pane that the rulers take.
inline constexpr double kRuler = 22;

/// What of the pieces is shown beside their sew lines.
struct PatternShown {
  bool allowance = true;
  bool notches = true;
  bool grain = true;
  bool labels = true;
  bool features = true;
};

/// Between the sheet (mm, y up) and the pane (px, y down).
struct SheetView {
  QSizeF size;
  double scale = 0.5;  ///< px per mm
  QPointF centre;      ///< place of the sheet in the middle of the pane

  [[nodiscard]] QPointF toSheet(const QPointF& pixel) const;
  [[nodiscard]] QPointF toPixel(const QPointF& sheet) const;
  [[nodiscard]] QTransform transform() const;
};

/// Paints the pieces on their ruled ground.
class PatternPainter {
 public:
  PatternPainter(QPainter& painter, const SheetView& view, const Session& session,
                 const PatternShown& shown)
      : painter_(painter), view_(view), session_(session), shown_(shown) {}

  void paintGround();
  void paintRulers();
  void paintPiece(const DrawnPiece& piece);
  /// The two sides of the selected seam: dotted connectors and both lengths.
  void paintMates(const std::vector<DrawnMates>& mates);
  /// The ends of the grain, by which it is turned.
  void paintHandles(const DrawnPiece& piece);
  void paintSpots(const std::vector<DrawnPiece>& pieces);

 private:
  void paintRun(const DrawnRun& run, const QTransform& toWindow, double width);
  void paintGrain(const QLineF& grain);
  void paintName(const DrawnPiece& piece, const QTransform& toWindow, const QPainterPath& cut);

  QPainter& painter_;
  const SheetView& view_;
  const Session& session_;
  const PatternShown& shown_;
};

}  // namespace toile::studio
