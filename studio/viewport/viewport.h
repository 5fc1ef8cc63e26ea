// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QVariantAnimation>
#include <map>
#include <memory>

#include "app/session.h"
#include "viewport/body_layer.h"
#include "viewport/camera.h"
#include "viewport/gl_canvas.h"
#include "viewport/line_layer.h"
#include "viewport/navigation.h"

namespace toile::studio {

/// The body with its lines, and the hands on it: turns mouse and pen into events for the tool.
class Viewport final : public GlCanvas {
  Q_OBJECT
 public:
  explicit Viewport(Session& session, QWidget* parent = nullptr);
  ~Viewport() override;

  [[nodiscard]] const Camera& camera() const { return camera_; }
  /// Goes there in a short motion; at once when motion is off.
  void lookFrom(const Camera& camera);
  void lookFrom(StandardView side);
  void fitAll();
  void fitSelection();
  void lookStraightAtSelection();

  void setNavigation(NavigationPreset preset) { navigation_ = preset; }
  void setEdges(bool edges);
  void setLabels(bool labels);  ///< names of pieces on the body
  void setSeeThrough(bool seeThrough);
  [[nodiscard]] bool seeThrough() const { return seeThrough_; }
  void setMotion(bool motion) { motion_ = motion; }
  void themeChanged();

  /// "front, from the right"
  [[nodiscard]] QString viewName() const;

 Q_SIGNALS:
  void cameraChanged();
  void contextMenuWanted(const QPoint& globalPlace);

 protected:
  void initializeGL() override;
  bool paintGL(const QSize& size, const QRect& part) override;
  void paintOver(QPainter& painter) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void tabletEvent(QTabletEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  [[nodiscard]] Screen screen() const;
  [[nodiscard]] PointerEvent pointer(const QPointF& place, Qt::KeyboardModifiers modifiers) const;
  void setCamera(const Camera& camera);
  void pressed(Qt::MouseButton button, const PointerEvent& event, Qt::KeyboardModifiers modifiers);
  void moved(const PointerEvent& event);
  void released(const PointerEvent& event, const QPoint& globalPlace);
  void bodyChanged();
  void updateVertices();
  void strainChanged();
  void lookAtPlace(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);
  void updateCursor();
  void interacted();
  [[nodiscard]] std::vector<Eigen::Vector3d> selectedPoints() const;
  /// What must be painted anew after a move of the hand that holds a tool, in logical pixels.
  [[nodiscard]] QRegion changedPixels();
  [[nodiscard]] QRect pixelsOf(const std::vector<Eigen::Vector3d>& points) const;
  [[nodiscard]] QRegion pixelsOf(const Overlay& overlay) const;
  /// @param within only lines that are seen there, in logical pixels
  [[nodiscard]] std::vector<DrawnLine> drawnLines(const Overlay& overlay,
                                                  const QRect& within) const;
  void paintMarkers(QPainter& painter) const;
  void placeLabels();
  void paintLabels(QPainter& painter) const;
  /// @return whether it had to be drawn anew
  bool drawBody(const QSize& size, const Overlay& overlay);

  Session& session_;
  Camera camera_;
  NavigationPreset navigation_ = NavigationPreset::Toile;
  bool motion_ = true;
  QVariantAnimation flight_;
  Camera flightFrom_, flightTo_;

  BodyLayer body_;
  LineLayer lines_;
  std::shared_ptr<BodyShape> shape_;
  std::uint64_t shapeNumber_ = 0;
  bool verticesAreOld_ = true;
  BodyLook look_;
  bool seeThrough_ = false;
  bool labels_ = true;
  struct BodyLabel {
    QString text;
    Eigen::Vector3d place, normal;
  };
  std::vector<BodyLabel> bodyLabels_;  ///< of the pieces of the full pattern, the largest first
  /// Ground and body with their depth. While a line is dragged they stay as they are.
  struct BodyPicture {
    Camera camera;
    QSize size;
    std::uint64_t vertices = 0;
    BodyLook look;
    bool fine = false;
    friend bool operator==(const BodyPicture&, const BodyPicture&) = default;
  };
  std::unique_ptr<QOpenGLFramebufferObject> bodyPicture_, fineBody_;
  std::optional<BodyPicture> drawnBody_;
  std::uint64_t verticesNumber_ = 0;
  Overlay overlay_;            ///< of the picture that is painted
  bool overlayIsNew_ = false;  ///< made for the picture to come
  /// Lines as they are on the screen: a drag paints only where one of them changes.
  struct ShownLine {
    std::uint64_t version = 0;
    QRect pixels;
  };
  std::map<std::string, ShownLine> shownLines_;
  Camera shownBy_;
  QSize shownIn_;
  QPointF shownCursor_;
  bool shownPreview_ = false;
  bool inHand_ = false;  ///< a tool that is held takes a move: one picture follows it
  bool coarse_ = false;  ///< while the view moves: without smooth edges of the body
  QTimer rest_;          ///< until it is drawn finely again

  ViewGesture gesture_ = ViewGesture::None;
  Qt::MouseButton button_ = Qt::NoButton;
  bool toolHasPress_ = false;
  bool space_ = false;
  Eigen::Vector2d pressedAt_{0, 0}, lastAt_{0, 0};
  double travelled_ = 0;
  std::optional<PointerEvent> lastPointer_;
  QElapsedTimer clock_;
};

}  // namespace toile::studio
