// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QWidget>
#include <memory>
#include <vector>

namespace toile::studio {

/// A widget whose picture is drawn by OpenGL 3.3 off the screen and put there as an image.
///
/// A QOpenGLWidget makes the whole window a matter of OpenGL: without a graphics card each frame
/// then composes all of it (20 ms for 1600 x 1000), even where only a line moved. Reading the
/// picture back costs a tenth of that, and painting over it is as fast as on any widget.
class GlCanvas : public QWidget, protected QOpenGLExtraFunctions {
  Q_OBJECT
 public:
  explicit GlCanvas(QWidget* parent = nullptr);
  ~GlCanvas() override;

  /// The last picture, without what was painted over it; null before the first.
  [[nodiscard]] const QImage& picture() const { return picture_; }

 Q_SIGNALS:
  void painted();  ///< for the trace of latencies

 protected:
  /// Once, before the first picture, with the context current.
  virtual void initializeGL() = 0;
  /// Draws into the bound framebuffer of that size, in device pixels.
  /// @param part that is to be drawn anew, in device pixels from the top left; the rest still holds
  ///   the last picture
  /// @return whether only that was drawn; otherwise all of it was
  virtual bool paintGL(const QSize& size, const QRect& part) = 0;
  /// Over the picture, in logical pixels.
  virtual void paintOver(QPainter& painter) = 0;

  /// @return false where OpenGL 3.3 is missing; the widget says so
  bool makeCurrent();
  void doneCurrent();
  [[nodiscard]] GLuint framebuffer() const { return target_->handle(); }

  void paintEvent(QPaintEvent* event) override;

 private:
  void readPicture(const QRect& part);

  QOpenGLContext context_;
  QOffscreenSurface surface_;
  bool isTried_ = false, isMade_ = false;
  std::unique_ptr<QOpenGLFramebufferObject> target_;
  std::vector<uchar> rows_;  ///< as OpenGL gives them, bottom up
  QImage picture_;
};

}  // namespace toile::studio
