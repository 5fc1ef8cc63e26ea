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
  friend bool operator==(const PatternShown&, const PatternShown&) = default;
};

/// Between the sheet (mm, y up) and the pane (px, y down).
struct SheetView {
  QSizeF size;
  double scale = 0.5;  ///< px per mm
  QPointF centre;      ///< place of the sheet in the middle of the pane

  [[nodiscard]] QPointF toSheet(const QPointF& pixel) const;
  [[nodiscard]] QPointF toPixel(const QPointF& sheet) const;
  [[nodiscard]] QTransform transform() const;
  friend bool operator==(const SheetView&, const SheetView&) = default;
};

/// Paints the pieces on their ruled ground.
class PatternPainter {
 public:
  PatternPainter(QPainter& painter, const SheetView& view, const Session& session,
                 const PatternShown& shown)
      : painter_(painter), view_(view), session_(session), shown_(shown) {}

  void paintGround();
  void paintRulers();
  /// @param motion of a piece that a hand is moving, in sheet coordinates
  void paintPiece(const DrawnPiece& piece, const QTransform& motion = {});
  /// The two sides of the selected seam: dotted connectors and both lengths.
  void paintMates(const std::vector<DrawnMates>& mates);
  /// The ring by which a selected piece is turned, and the ends of its grain.
  void paintHandles(const DrawnPiece& piece, const QTransform& motion = {});
  void paintSpots(const std::vector<DrawnPiece>& pieces);
  void paintGhosts(const std::vector<DrawnPiece>& pieces);

 private:
  void paintRun(const DrawnRun& run, const QTransform& toWindow, double width, bool isPreview);
  void paintGrain(const QLineF& grain);
  void paintName(const DrawnPiece& piece, const QTransform& toWindow, const QPainterPath& cut);

  QPainter& painter_;
  const SheetView& view_;
  const Session& session_;
  const PatternShown& shown_;
};

/// Where the ring that turns a piece stands, px.
[[nodiscard]] QPointF turnHandle(const DrawnPiece& piece, const SheetView& view);

}  // namespace toile::studio
