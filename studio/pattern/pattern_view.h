// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainterPath>
#include <QWidget>
#include <vector>

#include "app/session.h"

namespace toile::studio {

/// The pieces as they will be cut, to scale on a ruled ground.
class PatternView final : public QWidget {
  Q_OBJECT
 public:
  explicit PatternView(Session& session, QWidget* parent = nullptr);

  void fitAll();
  [[nodiscard]] double pixelsPerMm() const { return scale_; }

 Q_SIGNALS:
  void scaleChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  struct Run {
    std::string curve;
    QPolygonF points;  ///< sheet, mm, y up
    CurveKind kind = CurveKind::Seam;
  };
  struct Drawn {
    std::string id;
    QString name;
    QPainterPath sew, cut;
    std::vector<Run> runs, inner;
    std::vector<QLineF> notches;
    QLineF grain;
    QPointF label;
    QString note;
  };
  void takePattern();
  [[nodiscard]] QPointF toSheet(const QPointF& pixel) const;
  [[nodiscard]] QPointF toPixel(const QPointF& sheet) const;
  [[nodiscard]] Selection pick(const QPointF& pixel) const;
  void paintGround(QPainter& painter) const;
  void paintRulers(QPainter& painter) const;
  void paintPiece(QPainter& painter, const Drawn& piece) const;

  Session& session_;
  std::vector<Drawn> pieces_;
  QRectF box_;          ///< of all pieces, mm
  double scale_ = 0.5;  ///< px per mm
  QPointF centre_;      ///< sheet place in the middle of the window
  bool fitted_ = true;  ///< the user has not moved it since the last fit
  QPointF pressedAt_, lastAt_;
  bool panning_ = false;
};

}  // namespace toile::studio
