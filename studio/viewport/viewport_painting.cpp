// SPDX-License-Identifier: GPL-3.0-or-later
// How the viewport draws: body, lines and what the tool shows over them.
#include <QPainter>
#include <algorithm>

#include "app/palette.h"
#include "document/strain_spots.h"
#include "tools/picking.h"
#include "viewport/overlay_painter.h"
#include "viewport/viewport.h"

namespace toile::studio {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kFineSamples = 4;

/// How far the body reaches around the middle of its box.
struct Ball {
  Vector3d centre{0, 0, 900};
  double radius = 1000;
};
Ball ballOf(const ReferenceModel& model) {
  const Vector3d& low = model.mesh->boxMin();
  const Vector3d& high = model.mesh->boxMax();
  return {0.5 * (low + high), 0.5 * (high - low).norm() + 20};
}

void applyDashes(DrawnLine& line, const LineLook& look) {
  if (look.dots) {
    line.gap = look.dashes[1];
    line.casing = 0;
    return;
  }
  if (look.dashes.size() >= 2) line.dash = look.dashes[0], line.gap = look.dashes[1];
  if (look.dashes.size() >= 4) line.dash2 = look.dashes[2], line.gap2 = look.dashes[3];
}

DrawnLine inkOf(CurveKind kind) {
  const LineLook look = lookOf(kind);
  DrawnLine line;
  line.colour = look.onBody;
  line.width = look.width;
  applyDashes(line, look);
  return line;
}

}  // namespace

void Viewport::initializeGL() {
  body_.initialize();
  lines_.initialize();
  verticesAreOld_ = true;
}

void Viewport::resizeEvent(QResizeEvent*) {
  session_.setScreen(screen());
}

void Viewport::updateVertices() {
  verticesAreOld_ = false;
  ++verticesNumber_;
  if (!shape_) return;
  const BodyPaint paint{session_.strainLook().on ? BodyColouring::Strain : colouring_,
                        session_.strainLook().kind, session_.strains().get()};
  body_.setVertices(makeBodyVertices(*shape_, session_.fullPattern().get(), paint));
}

std::vector<DrawnLine> Viewport::drawnLines(const Overlay& overlay) const {
  std::vector<DrawnLine> drawn;
  const Palette& colours = studio::palette();
  QColor halo("#1558D6"), hoverHalo = halo;
  halo.setAlphaF(0.5F);
  hoverHalo.setAlphaF(0.25F);

  for (const auto& line : session_.lines().all()) {
    DrawnLine ink = inkOf(line->curve.kind);
    ink.points = line->points;
    ink.normals = line->normals;
    const bool isDraft =
        session_.isPreview() && line->curve.mirrorOf && session_.selection().id != line->curve.id &&
        !std::ranges::any_of(session_.document().design->curves,
                             [&](const auto& c) { return c.id == line->curve.id; });
    if (isDraft) {  // the twin of a line at work
      ink.width = 1.8;
      ink.dash = 6, ink.gap = 4, ink.dash2 = ink.gap2 = 0;
    }
    if (session_.selection().isLine(line->curve.id)) {
      ink.halo = halo;
    } else if (session_.hover().isLine(line->curve.id)) {
      ink.halo = hoverHalo;
    }
    drawn.push_back(std::move(ink));
  }
  // The outline of the selected piece.
  if (session_.pattern() && !session_.isPreview()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      const bool isSelected = session_.selection().isPiece(piece.id);
      if (!isSelected && !session_.hover().isPiece(piece.id)) continue;
      for (const Wire& wire : piece.wires) {
        if (!isBoundary(wire.kind)) continue;
        DrawnLine outline;
        for (const VertexId v : wire.vertices) {
          outline.points.push_back(piece.mesh->position(v));
          Vector3d normal = Vector3d::Zero();
          for (const FaceId f : piece.mesh->facesAround(v)) normal += piece.mesh->normal(f);
          outline.normals.push_back(normal.normalized());
        }
        outline.width = 0;
        outline.casing = 0;
        outline.halo = isSelected ? halo : hoverHalo;
        drawn.push_back(std::move(outline));
      }
    }
  }
  if (overlay.showMiddle) {
    for (const auto& middle : session_.middle()) {
      DrawnLine line;
      line.points = middle;
      line.colour = QColor("#5A2CB0");
      line.width = 1.3;
      line.casing = 0;
      line.dash = 9, line.gap = 4, line.dash2 = 1.5, line.gap2 = 4;
      drawn.push_back(std::move(line));
    }
  }
  for (const OverlayLine& line : overlay.lines) {
    DrawnLine ink = inkOf(line.kind);
    ink.points = line.points;
    ink.normals = line.normals;
    switch (line.style) {
      case OverlayLine::Style::Draft:
        break;
      case OverlayLine::Style::Twin:
        ink.width = 1.8;
        ink.dash = 6, ink.gap = 4;
        break;
      case OverlayLine::Style::Before:
        ink.width = 1.4;
        ink.colour = QColor("#55585E");
        ink.dash = 2, ink.gap = 3, ink.dash2 = ink.gap2 = 0;
        ink.casing = 0.3;
        break;
      case OverlayLine::Style::Remove:
        ink.halo = colours.trouble;
        ink.halo.setAlphaF(0.55F);
        break;
      case OverlayLine::Style::Picked:
        ink.halo = halo;
        break;
      case OverlayLine::Style::Comb:
      case OverlayLine::Style::Measure:
        ink.colour = QColor("#1558D6");
        ink.width = line.style == OverlayLine::Style::Comb ? 1.0 : 1.8;
        ink.dash = ink.gap = ink.dash2 = ink.gap2 = 0;
        ink.casing = line.style == OverlayLine::Style::Comb ? 0 : 0.55;
        break;
    }
    drawn.push_back(std::move(ink));
  }
  return drawn;
}

void Viewport::drawBody(const QSize& size, const Overlay& overlay) {
  BodyPicture wanted{camera_, size, verticesNumber_, look_, !coarse_};
  if (overlay.seeThroughTo) {
    wanted.look.seeThrough = SeeThrough{*overlay.seeThroughTo};
    wanted.fine = false;  // another one at the next move
  }
  if (drawnBody_ && drawnBody_->fine) wanted.fine = true;  // a finer one serves as well
  if (drawnBody_ == wanted) return;
  wanted.fine = !coarse_ && !overlay.seeThroughTo;
  drawnBody_ = wanted;

  const auto make = [&](std::unique_ptr<QOpenGLFramebufferObject>& buffer, int samples) {
    if (buffer && buffer->size() == size) return;
    QOpenGLFramebufferObjectFormat format;
    format.setSamples(samples);
    format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
    buffer = std::make_unique<QOpenGLFramebufferObject>(size, format);
  };
  make(bodyPicture_, 0);
  if (wanted.fine) make(fineBody_, kFineSamples);
  QOpenGLFramebufferObject& buffer = wanted.fine ? *fineBody_ : *bodyPicture_;
  buffer.bind();
  Screen pixels = screen();
  pixels.width = size.width();
  pixels.height = size.height();
  const Ball ball = ballOf(*session_.document().model);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  body_.drawGround(*this);
  body_.draw(*this, pixels, screen().clipFromWorld(ball.centre, ball.radius), wanted.look);
  if (wanted.fine) {
    QOpenGLFramebufferObject::blitFramebuffer(bodyPicture_.get(), fineBody_.get(),
                                              GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
}

void Viewport::paintMarkers(QPainter& painter) const {
  const Screen shown = screen();
  const auto pixelOf = [&](const Vector3d& place) {
    const auto pixel = shown.toPixel(place);
    return pixel ? std::optional(QPointF(pixel->x(), pixel->y())) : std::nullopt;
  };
  const auto& pattern = session_.fullPattern();
  std::vector<PlacedSpot> spots;
  if (session_.strainLook().on && pattern && session_.strains()) {
    spots = worstSpots(*pattern, *session_.strains(), session_.strainLook().kind);
  }
  for (const PlacedSpot& spot : spots) {
    const auto at = pixelOf(spot.place);
    if (at && studio::isVisible(session_, spot.place, spot.normal)) {
      paintMarker(painter, *at, QString::number(spot.number), spot.isOverLimit);
    }
  }
}

void Viewport::paintGL(const QSize& size) {
  if (verticesAreOld_) updateVertices();
  overlay_ = session_.hasWork() ? session_.tool().overlay(session_) : Overlay();
  if (!session_.hasWork()) {
    body_.drawGround(*this);
    return;
  }
  drawBody(size, overlay_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, bodyPicture_->handle());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer());
  glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  const Ball ball = ballOf(*session_.document().model);
  lines_.draw(*this, screen(), screen().clipFromWorld(ball.centre, ball.radius),
              devicePixelRatioF(), drawnLines(overlay_), seeThrough_);
}

void Viewport::paintOver(QPainter& painter) {
  if (!session_.hasWork()) return;
  const std::optional<Vector2d> cursor =
      lastPointer_ ? std::optional(lastPointer_->at) : std::nullopt;
  paintMarkers(painter);
  paintToolOverlay(painter, overlay_, session_, cursor);
}

}  // namespace toile::studio
