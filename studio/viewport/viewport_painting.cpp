// SPDX-License-Identifier: GPL-3.0-or-later
// How the viewport draws: body, lines and what the tool shows over them.
#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <utility>

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
  const BodyPaint paint{session_.pieceColours(), session_.strainLook().on,
                        session_.strainLook().kind, session_.strains().get()};
  body_.setVertices(makeBodyVertices(*shape_, session_.fullPattern().get(), paint));
}

QRect Viewport::pixelsOf(const std::vector<Vector3d>& points) const {
  // Half of the widest halo, a control point, and the smooth rim.
  constexpr int kMargin = 14;
  const Screen shown = screen();
  QPolygonF pixels;
  for (const Vector3d& point : points) {
    const auto pixel = shown.toPixel(point);
    if (!pixel) return rect();
    pixels << QPointF(pixel->x(), pixel->y());
  }
  const QRect box = pixels.boundingRect().toAlignedRect();
  return pixels.isEmpty() ? QRect() : box.adjusted(-kMargin, -kMargin, kMargin, kMargin);
}

QRegion Viewport::pixelsOf(const Overlay& overlay) const {
  // A label is at most so large, on either side of its place.
  constexpr QPoint kLabel(340, 130);
  QRegion region;
  for (const OverlayLine& line : overlay.lines) region += pixelsOf(line.points);
  for (const OverlayPoint& point : overlay.points) region += pixelsOf({point.place});
  const auto label = [&](const QPoint& at) { region += QRect(at - kLabel, at + kLabel); };
  if (overlay.snap) label(pixelsOf({overlay.snap->place}).center());
  for (const OverlayLabel& each : overlay.labels) label(pixelsOf({each.place}).center());
  if (!overlay.readOut.empty()) label(shownCursor_.toPoint());
  return region;
}

QRegion Viewport::changedPixels() {
  Overlay next = session_.tool().overlay(session_);
  const bool isWhole = shownBy_ != camera_ || shownIn_ != size() || !drawnBody_ ||
                       shownPreview_ != session_.isPreview() || next.seeThroughTo ||
                       overlay_.seeThroughTo || next.showMiddle != overlay_.showMiddle;
  QRegion region;
  if (!isWhole) {
    region += pixelsOf(overlay_);
    std::map<std::string, ShownLine> now;
    for (const auto& line : session_.lines().all()) {
      const auto known = shownLines_.find(line->curve.id);
      if (known != shownLines_.end() && known->second.version == line->version) {
        now.insert(*known);
        continue;
      }
      const ShownLine shown{line->version, pixelsOf(line->points)};
      region += shown.pixels;
      if (known != shownLines_.end()) region += known->second.pixels;
      now.emplace(line->curve.id, shown);
    }
    for (const auto& [id, shown] : shownLines_) {
      if (!now.contains(id)) region += shown.pixels;
    }
    shownLines_ = std::move(now);
  }
  overlay_ = std::move(next);
  overlayIsNew_ = true;
  if (lastPointer_) shownCursor_ = {lastPointer_->at.x(), lastPointer_->at.y()};
  if (isWhole) return rect();
  region += pixelsOf(overlay_);
  return region.boundingRect().intersected(rect());
}

std::vector<DrawnLine> Viewport::drawnLines(const Overlay& overlay, const QRect& within) const {
  std::vector<DrawnLine> drawn;
  const Palette& colours = studio::palette();
  QColor halo("#1558D6"), hoverHalo = halo;
  halo.setAlphaF(0.5F);
  hoverHalo.setAlphaF(0.25F);

  for (const auto& line : session_.lines().all()) {
    const auto shown = shownLines_.find(line->curve.id);
    if (shown != shownLines_.end() && !shown->second.pixels.intersects(within)) continue;
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
  for (const Ghost& ghost : session_.ghosts()) {
    DrawnLine ink = inkOf(ghost.kind);
    ink.points = ghost.points;
    ink.normals = ghost.normals;
    drawn.push_back(std::move(ink));
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

bool Viewport::drawBody(const QSize& size, const Overlay& overlay) {
  BodyPicture wanted{camera_, size, verticesNumber_, look_, !coarse_};
  if (overlay.seeThroughTo) {
    wanted.look.seeThrough = SeeThrough{*overlay.seeThroughTo};
    wanted.fine = false;  // another one at the next move
  }
  if (drawnBody_ && drawnBody_->fine) wanted.fine = true;  // a finer one serves as well
  if (drawnBody_ == wanted) return false;
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
  return true;
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
  for (const Ghost& ghost : session_.ghosts()) {
    if (ghost.points.empty()) continue;
    const std::size_t middle = ghost.points.size() / 2;
    const auto at = pixelOf(ghost.points[middle]);
    if (at && studio::isVisible(session_, ghost.points[middle], ghost.normals[middle])) {
      paintMarker(painter, *at, ghost.label, /*strong=*/true);
    }
  }
}

void Viewport::placeLabels() {
  bodyLabels_.clear();
  const auto& pattern = session_.fullPattern();
  if (!pattern) return;
  std::vector<std::pair<double, BodyLabel>> labels;
  const Mesh& body = *pattern->document.model->mesh;
  for (const Piece& piece : pattern->cut.pieces) {
    // A name that was given stands at the anchor, which is deep inside of its piece.
    const PieceRecord* record = recordOf(*pattern->document.design, piece.id);
    if (record == nullptr || !piece.include) continue;
    const auto anchor = resolvePlace(record->anchor, *pattern->document.model, pattern->curves);
    if (!anchor) continue;
    BodyLabel label{QString::fromStdString(record->name.empty() ? record->id : record->name),
                    position(body, *anchor), Vector3d::Zero()};
    for (const FaceId face : facesOf(body, *anchor)) label.normal += body.normal(face);
    label.normal.normalize();
    labels.emplace_back(-static_cast<double>(piece.mesh->faceCount()), std::move(label));
  }
  std::ranges::stable_sort(labels, {}, [](const auto& entry) { return entry.first; });
  for (auto& [size, label] : labels) bodyLabels_.push_back(std::move(label));
}

void Viewport::paintLabels(QPainter& painter) const {
  if (!labels_ || coarse_ || session_.isPreview()) return;  // out of the way of the hand
  QFont font = painter.font();
  font.setPixelSize(11);
  font.setBold(true);
  painter.setFont(font);
  const QFontMetricsF metrics(font);
  const Screen shown = screen();
  std::vector<QRectF> taken;
  for (const BodyLabel& label : bodyLabels_) {
    const auto pixel = shown.toPixel(label.place);
    // Names on the turned side and on slopes would be read as those of their neighbours.
    if (!pixel || label.normal.dot(shown.towardsEye(label.place)) < 0.35) continue;
    QRectF room = metrics.boundingRect(label.text).adjusted(-5, -1, 5, 1);
    room.moveCenter({pixel->x(), pixel->y()});
    if (std::ranges::any_of(taken, [&](const QRectF& other) { return other.intersects(room); })) {
      continue;
    }
    if (!studio::isVisible(session_, label.place, label.normal)) continue;
    taken.push_back(room);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(251, 250, 248, 190));
    painter.drawRoundedRect(room, 4, 4);
    painter.setPen(QColor("#1F2124"));
    painter.drawText(room, Qt::AlignCenter, label.text);
  }
}

bool Viewport::paintGL(const QSize& size, const QRect& part) {
  if (verticesAreOld_) updateVertices();
  if (!session_.hasWork()) {
    overlay_ = Overlay();
    body_.drawGround(*this);
    return false;
  }
  if (!std::exchange(overlayIsNew_, false)) overlay_ = session_.tool().overlay(session_);
  const QRect whole(QPoint(), size);
  const bool isPart = !drawBody(size, overlay_) && part != whole;
  if (!isPart) {
    shownLines_.clear();
    for (const auto& line : session_.lines().all()) {
      shownLines_[line->curve.id] = {line->version, pixelsOf(line->points)};
    }
    shownBy_ = camera_;
    shownIn_ = this->size();
    shownPreview_ = session_.isPreview();
    if (lastPointer_) shownCursor_ = {lastPointer_->at.x(), lastPointer_->at.y()};
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, bodyPicture_->handle());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer());
  if (isPart) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x(), size.height() - part.y() - part.height(), part.width(), part.height());
  }
  glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  const Ball ball = ballOf(*session_.document().model);
  const double ratio = devicePixelRatioF();
  const QRect within = isPart ? QRectF(part.x() / ratio, part.y() / ratio, part.width() / ratio,
                                       part.height() / ratio)
                                    .toAlignedRect()
                              : rect();
  lines_.draw(*this, screen(), screen().clipFromWorld(ball.centre, ball.radius), ratio,
              drawnLines(overlay_, within), seeThrough_);
  glDisable(GL_SCISSOR_TEST);
  return isPart;
}

void Viewport::paintOver(QPainter& painter) {
  if (!session_.hasWork()) return;
  const std::optional<Vector2d> cursor =
      lastPointer_ ? std::optional(lastPointer_->at) : std::nullopt;
  paintLabels(painter);
  paintMarkers(painter);
  paintToolOverlay(painter, overlay_, session_, cursor);
}

}  // namespace toile::studio
