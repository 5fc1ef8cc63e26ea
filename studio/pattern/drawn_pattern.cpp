// SPDX-License-Identifier: GPL-3.0-or-later
#include "pattern/drawn_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/palette.h"

namespace toile::studio {

namespace {

constexpr double kConnectorEvery = 0.2;  // of the length of a seam
constexpr double kPixelsPerMm = 0.6;     // of strain images; strain is smooth
constexpr int kMostPixels = 1600;        // of their longer side

QPainterPath pathOf(const std::vector<Outline>& outlines, const Placement& placement) {
  QPainterPath path;
  for (const Outline& outline : outlines) {
    QPolygonF polygon;
    for (const OutlinePoint& p : outline) polygon << toQt(placement.apply(p.position));
    if (polygon.isEmpty()) continue;
    path.addPolygon(polygon);
    path.closeSubpath();
  }
  return path;
}

CurveKind kindOf(WireKind kind) {
  switch (kind) {
    case WireKind::Opening:
      return CurveKind::Opening;
    case WireKind::Dart:
      return CurveKind::Dart;
    case WireKind::Feature:
      return CurveKind::Feature;
    case WireKind::Elastic:
      return CurveKind::Elastic;
    case WireKind::Seam:
    case WireKind::Border:
      return CurveKind::Seam;
  }
  return CurveKind::Seam;
}

/// The place at a part of the length of a polyline.
QPointF pointAt(const QPolygonF& line, double part) {
  double length = 0;
  for (int i = 1; i < line.size(); ++i) length += QLineF(line[i - 1], line[i]).length();
  double rest = part * length;
  for (int i = 1; i < line.size(); ++i) {
    const QLineF step(line[i - 1], line[i]);
    if (rest <= step.length())
      return step.length() > 0 ? step.pointAt(rest / step.length()) : line[i];
    rest -= step.length();
  }
  return line.isEmpty() ? QPointF() : line.last();
}

const DrawnRun* runOf(const DrawnPiece& piece, std::uint32_t wire) {
  const auto found =
      std::ranges::find_if(piece.runs, [&](const DrawnRun& run) { return run.wire == wire; });
  return found == piece.runs.end() ? nullptr : &*found;
}

}  // namespace

std::vector<DrawnPiece> drawPattern(const Pattern& pattern, PieceColours colours,
                                    const std::vector<DrawnPiece>* full) {
  std::vector<DrawnPiece> pieces;
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
    const PatternPiece& piece = pattern.pieces[i];
    const Placement& placement = pattern.layout.placements[i];
    const auto& flat = pattern.flats[pattern.pieceIndex[i]];
    if (full != nullptr) {
      const auto same = std::ranges::find_if(*full, [&](const DrawnPiece& known) {
        return known.id == piece.id && known.flat == flat &&
               known.placement.angle == placement.angle &&
               known.placement.offset == placement.offset;
      });
      if (same != full->end()) {
        pieces.push_back(*same);
        pieces.back().index = i;
        pieces.back().cutIndex = pattern.pieceIndex[i];
        continue;
      }
    }
    DrawnPiece drawn;
    drawn.id = piece.id;
    drawn.name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
    drawn.index = i;
    drawn.cutIndex = pattern.pieceIndex[i];
    drawn.placement = placement;
    drawn.sew = pathOf(piece.sewLines, placement);
    drawn.cut = pathOf(piece.cutLines, placement);
    drawn.tint = pieceTint(pattern, drawn.cutIndex, colours);
    drawn.middle = drawn.cut.boundingRect().center();
    drawn.flat = flat;
    drawn.isPreview = full != nullptr;
    for (const OutlineRun& run : piece.runs) {
      const Outline& loop = piece.sewLines[run.loop];
      DrawnRun line{run.curve, {}, kindOf(run.kind), run.wire, run.length};
      for (std::size_t k = 0; k <= run.edgeCount; ++k) {
        line.points << toQt(placement.apply(loop[(run.first + k) % loop.size()].position));
      }
      drawn.runs.push_back(std::move(line));
    }
    for (const InternalLine& inner : piece.internalLines) {
      DrawnRun line{inner.curve, {}, inner.kind, 0, 0};
      for (const auto& p : inner.points) line.points << toQt(placement.apply(p));
      if (inner.closed && !line.points.isEmpty()) line.points << line.points.first();
      for (int k = 1; k < line.points.size(); ++k) {
        line.length += QLineF(line.points[k - 1], line.points[k]).length();
      }
      drawn.inner.push_back(std::move(line));
    }
    for (const Notch& notch : piece.notches) {
      const auto from = placement.apply(notch.position);
      const auto to = placement.apply(notch.position + notch.depth * notch.direction);
      drawn.notches.emplace_back(toQt(from), toQt(to));
    }
    drawn.grain = {toQt(placement.apply(piece.grain[0])), toQt(placement.apply(piece.grain[1]))};
    drawn.label = toQt(placement.apply(piece.labelPosition));
    if (piece.count != 1) drawn.note = QStringLiteral("× %1").arg(piece.count);
    pieces.push_back(std::move(drawn));
  }
  return pieces;
}

std::vector<DrawnMates> matesOf(const std::vector<DrawnPiece>& pieces, const Pattern& pattern,
                                const std::string& curve) {
  const auto pieceOf = [&](std::size_t cutIndex) -> const DrawnPiece* {
    const auto found = std::ranges::find_if(
        pieces, [&](const DrawnPiece& piece) { return piece.cutIndex == cutIndex; });
    return found == pieces.end() ? nullptr : &*found;
  };
  std::vector<DrawnMates> all;
  for (const SeamMates& mates : pattern.cut.mates) {
    const Piece& onBody = pattern.cut.pieces[mates.pieceA];
    if (onBody.wires[mates.wireA].curve != curve) continue;
    DrawnMates drawn{pieceOf(mates.pieceA), nullptr, pieceOf(mates.pieceB), nullptr, {}};
    if (drawn.pieceA == nullptr || drawn.pieceB == nullptr) continue;
    drawn.a = runOf(*drawn.pieceA, mates.wireA);
    drawn.b = runOf(*drawn.pieceB, mates.wireB);
    if (drawn.a == nullptr || drawn.b == nullptr) continue;
    for (double part = 0; part < 1 + 0.5 * kConnectorEvery; part += kConnectorEvery) {
      const double at = std::min(part, 1.0);
      drawn.connectors.emplace_back(pointAt(drawn.a->points, at), pointAt(drawn.b->points, 1 - at));
    }
    all.push_back(std::move(drawn));
  }
  return all;
}

void paintStrain(DrawnPiece& piece, const Pattern& pattern, const std::vector<float>& ofVertices,
                 double scale, bool oneSided) {
  piece.strain = {};
  const FlatPiece* flat = pattern.flats[piece.cutIndex].get();
  const Mesh& mesh = *pattern.cut.pieces[piece.cutIndex].mesh;
  if (flat == nullptr || ofVertices.size() != mesh.vertexCount()) return;
  const QRectF box = piece.sew.boundingRect();
  const double perMm =
      std::min(kPixelsPerMm, kMostPixels / std::max({box.width(), box.height(), 1.0}));
  const int width = static_cast<int>(std::ceil(box.width() * perMm)) + 2;
  const int height = static_cast<int>(std::ceil(box.height() * perMm)) + 2;
  QImage image(width, height, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  piece.strainPlace =
      QRectF(box.left() - 1 / perMm, box.top() - 1 / perMm, width / perMm, height / perMm);

  std::array<QRgb, 512> colours{};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i] = strainColour(2.0 * static_cast<double>(i) / (colours.size() - 1) - 1).rgb();
  }
  std::vector<Eigen::Vector2d> places(mesh.vertexCount());
  for (std::size_t v = 0; v < places.size(); ++v) {
    const Eigen::Vector2d p = piece.placement.apply(flat->position[VertexId(v)]);
    // Rows of the image grow with y of the sheet; whoever draws it turns it over with the sheet.
    places[v] = {(p.x() - piece.strainPlace.left()) * perMm,
                 (p.y() - piece.strainPlace.top()) * perMm};
  }
  for (const Triangle& corners : mesh.triangles()) {
    const Eigen::Vector2d &a = places[corners[0].index()], &b = places[corners[1].index()],
                          &c = places[corners[2].index()];
    const Eigen::Vector2d u = b - a, v = c - a;
    const double det = u.x() * v.y() - u.y() * v.x();
    if (std::abs(det) < 1e-12) continue;
    const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const int left = std::max(0, static_cast<int>(std::floor(low.x() - 0.5)));
    const int right = std::min(width - 1, static_cast<int>(std::ceil(high.x() + 0.5)));
    const int top = std::max(0, static_cast<int>(std::floor(low.y() - 0.5)));
    const int bottom = std::min(height - 1, static_cast<int>(std::ceil(high.y() + 0.5)));
    const std::array<double, 3> strain{ofVertices[corners[0].index()],
                                       ofVertices[corners[1].index()],
                                       ofVertices[corners[2].index()]};
    // A little over the edges, so that the outline, which is drawn sharply, finds colour below it.
    const double slack = 1.2 *
                         (std::abs(u.x()) + std::abs(u.y()) + std::abs(v.x()) + std::abs(v.y())) /
                         (2 * std::abs(det));
    for (int y = top; y <= bottom; ++y) {
      auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
      for (int x = left; x <= right; ++x) {
        const Eigen::Vector2d p(x + 0.5 - a.x(), y + 0.5 - a.y());
        const double s = (p.x() * v.y() - p.y() * v.x()) / det;
        const double t = (u.x() * p.y() - u.y() * p.x()) / det;
        const bool isInside = s >= 0 && t >= 0 && s + t <= 1;
        if (!isInside && (row[x] != 0 || s < -slack || t < -slack || s + t > 1 + slack)) continue;
        double value = ((1 - s - t) * strain[0] + s * strain[1] + t * strain[2]) / scale;
        if (oneSided) value = std::abs(value);
        const double place = (std::clamp(value, -1.0, 1.0) + 1) / 2 * (colours.size() - 1);
        row[x] = colours[static_cast<std::size_t>(std::lround(place))];
      }
    }
  }
  piece.strain = std::move(image);
}

}  // namespace toile::studio
