// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPixmap>
#include <QWidget>
#include <optional>
#include <vector>

#include "app/session.h"
#include "pattern/drawn_pattern.h"
#include "pattern/pattern_painter.h"

namespace toile::studio {

/// The pieces as they will be cut, to scale on a ruled ground, and the hands on them: pieces are
/// moved and turned, their grain is turned, distances are measured.
class PatternView final : public QWidget {
  Q_OBJECT
 public:
  explicit PatternView(Session& session, QWidget* parent = nullptr);

  void fitAll();
  [[nodiscard]] double pixelsPerMm() const { return view_.scale; }
  [[nodiscard]] const SheetView& sheetView() const { return view_; }
  [[nodiscard]] const std::vector<DrawnPiece>& pieces() const { return pieces_; }
  [[nodiscard]] const PatternShown& shown() const { return shown_; }
  void setShown(const PatternShown& shown);

 Q_SIGNALS:
  void scaleChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  enum class Gesture { None, Pan, Move, Turn, Grain };
  void takePattern();
  [[nodiscard]] QRect pixelsOfPreview() const;
  void paintStill();
  void colour();
  [[nodiscard]] Selection pick(const QPointF& pixel) const;
  [[nodiscard]] const DrawnPiece* find(const std::string& id) const;
  [[nodiscard]] Gesture gestureAt(const QPointF& pixel, const DrawnPiece** piece) const;
  /// Of the piece that is held, as far as the hand has come.
  [[nodiscard]] QTransform motion() const;
  [[nodiscard]] double turnOfHand() const;  ///< degrees, counter-clockwise
  void finishGesture();
  void paintMeasure(QPainter& painter) const;
  [[nodiscard]] QPointF caught(const QPointF& pixel) const;

  Session& session_;
  PatternShown shown_;
  std::vector<DrawnPiece> pieces_;
  std::vector<DrawnPiece> full_;  ///< of the last full pattern
  QRectF box_;                    ///< of all pieces, mm
  SheetView view_;
  Eigen::Vector2d origin_{0, 0};  ///< of the map in the pattern that is shown
  bool fitted_ = true;            ///< the user has not moved it since the last fit
  std::string putDown_;           ///< the piece that a hand has just moved
  QPointF putDownAt_;             ///< px, its middle

  /// Ground and pieces that a drag on the body does not touch: while it goes on they are painted
  /// once, and previews go over them.
  struct Still {
    SheetView view;
    PatternShown shown;
    Selection selection, hover;
    QRgb ground = 0;  ///< tells the themes apart
    std::vector<std::string> pieces;
    friend bool operator==(const Still&, const Still&) = default;
  };
  std::optional<Still> stillOf_;
  QPixmap still_;

  Gesture gesture_ = Gesture::None;
  std::string held_;
  bool moved_ = false;
  QPointF pressedAt_, lastAt_;
  std::vector<QPointF> measured_;  ///< on the sheet: none, one or two places
  QPointF measureAt_;
};

}  // namespace toile::studio
