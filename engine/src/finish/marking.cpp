// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/marking.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace toile {
namespace {

const StylingCurve* findCurve(const Design& design, const std::string& id) {
  for (const StylingCurve& curve : design.curves)
    if (curve.id == id) return &curve;
  return nullptr;
}

std::string curveName(const Design& design, const std::string& id) {
  const StylingCurve* curve = findCurve(design, id);
  return curve != nullptr && !curve->name.empty() ? curve->name : id;
}

/// Weights of a point of the triangle's plane; the triangle must have area.
Eigen::Vector3d weightsIn(const std::array<Eigen::Vector3d, 3>& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double squared = normal.squaredNorm();
  Eigen::Vector3d w;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = t[static_cast<std::size_t>((k + 1) % 3)];
    const Eigen::Vector3d& b = t[static_cast<std::size_t>((k + 2) % 3)];
    w[k] = (b - a).cross(p - a).dot(normal) / squared;
  }
  return w;
}

/// The part of a segment inside a triangle, as parameters of the segment and weights at its ends.
struct Clipped {
  double from, to;
  Eigen::Vector2d a, b;  ///< flat
};

/// Draws model paths on a flat piece: each piece face shows its part of the model face that holds
/// it.
class PathDrawer {
 public:
  PathDrawer(const Mesh& model, const Piece& piece, const FlatPiece& flat)
      : model_(model), piece_(piece), flat_(flat) {
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f)
      facesOn_[piece.sourceFace[FaceId(f)]].push_back(FaceId(f));
  }

  std::vector<Points2> draw(const SurfacePath& path) const {
    std::vector<Points2> lines;
    for (std::size_t s = 0; s < path.faceOfSegment.size(); ++s) {
      const auto faces = facesOn_.find(path.faceOfSegment[s]);
      if (faces == facesOn_.end()) continue;
      const Eigen::Vector3d a = position(model_, path.points[s]);
      const Eigen::Vector3d b = position(model_, path.points[(s + 1) % path.points.size()]);
      for (const Clipped& part : clip(faces->second, a, b)) {
        constexpr double kJoinMm = 1e-4;
        if (lines.empty() || (lines.back().back() - part.a).norm() > kJoinMm)
          lines.push_back({part.a});
        lines.back().push_back(part.b);
      }
    }
    return lines;
  }

 private:
  [[nodiscard]] std::vector<Clipped> clip(const std::vector<FaceId>& faces,
                                          const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b) const {
    std::vector<Clipped> parts;
    for (const FaceId face : faces) {
      const Triangle& corners = piece_.mesh->vertices(face);
      if (piece_.mesh->area(face) <= 0) continue;
      std::array<Eigen::Vector3d, 3> t;
      for (std::size_t k = 0; k < 3; ++k) t[k] = piece_.mesh->position(corners[k]);
      const Eigen::Vector3d wa = weightsIn(t, a);
      const Eigen::Vector3d wb = weightsIn(t, b);
      double from = 0;
      double to = 1;
      for (int k = 0; k < 3; ++k) {
        constexpr double kEdge = 1e-9;  // a segment along an edge belongs to both faces
        const double d = wb[k] - wa[k];
        const double edge = -kEdge - wa[k];
        if (d > 0) from = std::max(from, edge / d);
        if (d < 0) to = std::min(to, edge / d);
        if (d == 0 && wa[k] < -kEdge) to = -1;
      }
      if (to - from <= 1e-9) continue;
      const auto flatAt = [&](double u) {
        const Eigen::Vector3d w = (1 - u) * wa + u * wb;
        Eigen::Vector2d p = Eigen::Vector2d::Zero();
        for (std::size_t k = 0; k < 3; ++k)
          p += w[static_cast<Eigen::Index>(k)] * flat_.position[corners[k]];
        return p;
      };
      parts.push_back({from, to, flatAt(from), flatAt(to)});
    }
    std::sort(parts.begin(), parts.end(),
              [](const Clipped& x, const Clipped& y) { return x.from < y.from; });
    std::vector<Clipped> once;
    for (const Clipped& part : parts)
      if (once.empty() || part.to > once.back().to + 1e-9) once.push_back(part);
    return once;
  }

  const Mesh& model_;
  const Piece& piece_;
  const FlatPiece& flat_;
  std::map<FaceId, std::vector<FaceId>> facesOn_;
};

/// Makes one line of the parts of a curve between its crossings with others, whichever way and in
/// which order they run.
void joinParts(std::vector<InternalLine>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = i + 1; k < lines.size() && !lines[i].closed;) {
      Points2& points = lines[i].points;
      Points2& part = lines[k].points;
      const bool isSame =
          !lines[k].closed && lines[k].curve == lines[i].curve && lines[k].kind == lines[i].kind;
      const bool meetsFront = points.front() == part.front() || points.front() == part.back();
      const bool meetsBack = points.back() == part.front() || points.back() == part.back();
      if (!isSame || !(meetsFront || meetsBack)) {
        ++k;
        continue;
      }
      if (!meetsBack) std::reverse(points.begin(), points.end());
      if (points.back() != part.front()) std::reverse(part.begin(), part.end());
      points.insert(points.end(), part.begin() + 1, part.end());
      if (points.front() == points.back()) {
        points.pop_back();
        lines[i].closed = true;
      }
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(k));
      k = i + 1;  // the line has a new end
    }
  }
}

/// "10", "12.5": as short as a hundredth of a millimetre allows.
std::string shortMm(double mm) {
  std::string text = fmt::format("{:.2f}", mm);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::vector<InternalLine> internalLines(const Document& document,
                                        const std::vector<PlacedCurve>& curves, const Piece& piece,
                                        const FlatPiece& flat) {
  std::vector<InternalLine> lines;
  for (const Wire& wire : piece.wires) {
    if (isBoundary(wire.kind) || wire.vertices.size() < 2) continue;
    InternalLine line;
    line.kind = wire.kind == WireKind::Elastic ? CurveKind::Elastic : CurveKind::Feature;
    line.curve = wire.curve;
    line.name = curveName(*document.design, wire.curve);
    line.closed = wire.vertices.front() == wire.vertices.back();
    for (const VertexId v : wire.vertices) line.points.push_back(flat.position[v]);
    if (line.closed) line.points.pop_back();
    lines.push_back(std::move(line));
  }
  joinParts(lines);
  const bool hasMarks = std::any_of(curves.begin(), curves.end(), [](const PlacedCurve& curve) {
    return curve.kind == CurveKind::Mark;
  });
  if (!hasMarks || document.model == nullptr || piece.sourceFace.size() != piece.mesh->faceCount())
    return lines;
  const PathDrawer drawer(*document.model->mesh, piece, flat);
  for (const PlacedCurve& curve : curves) {
    if (curve.kind != CurveKind::Mark) continue;
    for (Points2& points : drawer.draw(curve.path)) {
      InternalLine line;
      line.kind = CurveKind::Mark;
      line.curve = curve.id;
      line.name = curveName(*document.design, curve.id);
      line.points = std::move(points);
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::array<Eigen::Vector2d, 2> grainLine(const std::vector<Points2>& loops,
                                         const Eigen::Vector2d& labelPosition) {
  constexpr double kFromEdgeMm = 10;
  constexpr double kPart = 0.6;    // of the height: the least that the trade asks for
  constexpr double kAsideMm = 45;  // so that the label's text stands clear of it
  const Box2 box = boxOf(loops.front());
  const double height = box.size().y();

  struct Chord {
    double x = 0, low = 0, high = 0;
    [[nodiscard]] double length() const { return high - low; }
  };
  const auto longestChord = [&](double x) {
    std::vector<double> crossings;
    for (const Points2& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& a = loop[i];
        const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
        if ((a.x() > x) == (b.x() > x)) continue;
        crossings.push_back(a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    Chord best{x, labelPosition.y(), labelPosition.y()};
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      if (crossings[i + 1] - crossings[i] > best.length())
        best = {x, crossings[i], crossings[i + 1]};
    const double margin = std::min(kFromEdgeMm, 0.1 * best.length());
    best.low += margin;
    best.high -= margin;
    return best;
  };

  // As long as asked for; then beside the label, but no farther from it than need be.
  Chord best;
  double bestCost = 0;
  constexpr int kSamples = 60;
  for (int i = 1; i < kSamples; ++i) {
    const Chord chord = longestChord(box.min.x() + box.size().x() * i / kSamples);
    const double missing = std::max(0.0, kPart * height - chord.length());
    const double fromLabel = std::abs(chord.x - labelPosition.x());
    const double cost = 10 * missing + std::abs(fromLabel - kAsideMm);
    if (i == 1 || cost < bestCost - 1e-6) {
      best = chord;
      bestCost = cost;
    }
  }
  // No longer than needed to be seen: the rest of the chord stays free for other marks.
  const double length = std::min(best.length(), std::max(0.7 * height, 100.0));
  const double middle = std::clamp(labelPosition.y(), best.low + 0.5 * length,
                                   std::max(best.high - 0.5 * length, best.low + 0.5 * length));
  return {Eigen::Vector2d(best.x, middle - 0.5 * length),
          Eigen::Vector2d(best.x, middle + 0.5 * length)};
}

std::vector<std::string> labelLines(const Design& design, const PatternPiece& piece) {
  std::vector<std::string> lines{piece.name};
  lines.push_back(fmt::format("Piece {} of {}, cut {}", piece.number, piece.of, piece.count));
  if (!piece.fabric.empty()) lines.push_back("Fabric: " + piece.fabric);
  std::string order;
  const auto append = [&order](const std::string& label, const std::string& value) {
    if (value.empty()) return;
    if (!order.empty()) order += ", ";
    order += label + value;
  };
  append("", design.order.style.empty() ? design.name : design.order.style);
  append("size ", design.order.size);
  append("for ", design.order.customer);
  append("", design.order.date);
  if (!order.empty()) lines.push_back(order);
  double least = 0;
  double most = 0;
  for (std::size_t r = 0; r < piece.runs.size(); ++r) {
    const double a = piece.runs[r].allowance;
    least = r == 0 ? a : std::min(least, a);
    most = std::max(most, a);
  }
  if (most <= 0) {
    lines.emplace_back("No seam allowance");
  } else if (least == most) {
    lines.push_back(fmt::format("With {} mm seam allowance", shortMm(most)));
  } else {
    lines.push_back(fmt::format("With {} to {} mm seam allowance", shortMm(least), shortMm(most)));
  }
  return lines;
}

}  // namespace toile
