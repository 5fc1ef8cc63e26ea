// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/gl_canvas.h"

#include <QPaintEvent>
#include <QPainter>
#include <algorithm>
#include <cstring>

namespace toile::studio {

GlCanvas::GlCanvas(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
}

GlCanvas::~GlCanvas() {
  if (!isMade_ || !context_.makeCurrent(&surface_)) return;
  target_.reset();
  doneCurrent();
}

bool GlCanvas::makeCurrent() {
  if (!isTried_) {
    isTried_ = true;
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    context_.setFormat(format);
    if (context_.create()) {
      surface_.setFormat(context_.format());
      surface_.create();
      isMade_ = context_.makeCurrent(&surface_) && context_.format().version() >= qMakePair(3, 3);
    }
    if (isMade_) {
      initializeOpenGLFunctions();
      initializeGL();
    }
  }
  return isMade_ && context_.makeCurrent(&surface_);
}

void GlCanvas::doneCurrent() {
  context_.doneCurrent();
}

void GlCanvas::readPicture(const QRect& part) {
  const QSize size = target_->size();
  if (picture_.size() != size) picture_ = QImage(size, QImage::Format_RGB32);
  const auto stride = static_cast<std::size_t>(part.width()) * 4;
  rows_.resize(stride * static_cast<std::size_t>(part.height()));
  glReadPixels(part.x(), size.height() - part.y() - part.height(), part.width(), part.height(),
               GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, rows_.data());
  const auto left = static_cast<std::size_t>(part.x()) * 4;
  for (int y = 0; y < part.height(); ++y) {
    std::memcpy(picture_.scanLine(part.y() + part.height() - 1 - y) + left,
                rows_.data() + stride * static_cast<std::size_t>(y), stride);
  }
  picture_.setDevicePixelRatio(devicePixelRatioF());
}

void GlCanvas::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  if (!makeCurrent()) {
    painter.fillRect(rect(), palette().window());
    painter.drawText(rect().adjusted(24, 0, -24, 0), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The body cannot be drawn: this computer has no OpenGL 3.3. The package "
                        "libgl1-mesa-dri brings it for every computer."));
    return;
  }
  const QSize size = (QSizeF(this->size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
  const QRect whole(QPoint(), size);
  const double ratio = devicePixelRatioF();
  const QRect asked = event->region().boundingRect();
  QRect part =
      QRectF(asked.x() * ratio, asked.y() * ratio, asked.width() * ratio, asked.height() * ratio)
          .toAlignedRect()
          .intersected(whole);
  if (!target_ || target_->size() != size) {
    target_ = std::make_unique<QOpenGLFramebufferObject>(
        size, QOpenGLFramebufferObject::CombinedDepthStencil);
    part = whole;
  }
  target_->bind();
  glViewport(0, 0, size.width(), size.height());
  if (!paintGL(size, part)) {
    if (part != whole) update();  // what lies beside the part that may be painted now
    part = whole;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target_->handle());
  readPicture(part);
  doneCurrent();
  const QRectF place(part.x() / ratio, part.y() / ratio, part.width() / ratio,
                     part.height() / ratio);
  painter.drawImage(place, picture_, part);
  painter.setRenderHint(QPainter::Antialiasing);
  paintOver(painter);
  Q_EMIT painted();
}

}  // namespace toile::studio
