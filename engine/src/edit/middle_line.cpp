// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/middle_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mirror.h"
#include "toile/curve/geodesic.h"
#include "toile/curve/trace.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

constexpr double kOnMiddle = 1e-6;  ///< mm that a point of the middle line may lie beside its image
constexpr double kLeastAcross =
    1e-3;                          ///< sine between surface and plane, below which none is square
constexpr double kFeel = 1e-3;     ///< part of a step by which its direction is tried
constexpr double kMostTurn = 0.7;  ///< radians that square on the surface may be off in space
constexpr int kTurnRounds = 50;    ///< of the golden section: 0.62^50 of the turn are 1e-10

}  // namespace

MiddleLine::MiddleLine(const ReferenceModel& model) {
  if (!model.symmetry) return;
  const Mesh& mesh = *model.mesh;
  const Symmetry& symmetry = *model.symmetry;
  if (symmetry.partner.empty()) {
    for (const SurfacePath& path : model.index->planeSection(symmetry.normal, symmetry.offset)) {
      for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
        segments_.push_back(
            {path.faceOfSegment[i], path.points[i], path.points[(i + 1) % path.points.size()]});
      }
    }
    return;
  }
  const auto& partner = symmetry.partner;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const FaceId face(f);
    const Triangle& t = mesh.vertices(face);
    for (int k = 0; k < 3; ++k) {
      const VertexId a = t[static_cast<std::size_t>(k)],
                     b = t[static_cast<std::size_t>((k + 1) % 3)];
      const VertexId c = t[static_cast<std::size_t>((k + 2) % 3)];
      if (partner[a] == a && partner[b] == b) {
        segments_.push_back({face, {a}, {b}});
      } else if (partner[a] == b && partner[c] == c) {
        const EdgeId edge = mesh.edge(mesh.halfedge(face, k));
        segments_.push_back({face, {c}, {SurfacePoint::OnEdge{edge, 0.5}}});
      }
    }
  }
}

SurfacePoint MiddleLine::nearest(const Mesh& mesh, const Vector3d& place) const {
  double least = std::numeric_limits<double>::infinity();
  SurfacePoint best;
  for (const Segment& segment : segments_) {
    const Vector3d a = position(mesh, segment.a), d = position(mesh, segment.b) - a;
    const double square = d.squaredNorm();
    const double t = square > 0 ? std::clamp((place - a).dot(d) / square, 0.0, 1.0) : 0.0;
    const double distance = (a + t * d - place).norm();
    if (!(distance < least)) continue;
    least = distance;
    best = makeSurfacePoint(mesh, segment.face,
                            (1 - t) * barycentricIn(mesh, segment.a, segment.face) +
                                t * barycentricIn(mesh, segment.b, segment.face));
  }
  return best;
}

double sideOf(const ReferenceModel& model, const SurfacePoint& point) {
  const Symmetry& symmetry = *model.symmetry;
  const Vector3d p = position(*model.mesh, point);
  if (symmetry.partner.empty()) return symmetry.normal.dot(p) - symmetry.offset;
  const SurfacePoint image = mirrored(*model.mesh, symmetry.partner, point);
  return 0.5 * symmetry.normal.dot(p - position(*model.mesh, image));
}

std::optional<SurfacePoint> stepSquare(const ReferenceModel& model, const SurfacePoint& from,
                                       const Vector3d& towards, double length) {
  const Mesh& mesh = *model.mesh;
  const Symmetry& symmetry = *model.symmetry;
  Vector3d up = Vector3d::Zero();
  for (const FaceId face : facesOf(mesh, from)) up += mesh.area(face) * mesh.normal(face);
  up.normalize();
  const Vector3d across = symmetry.normal - symmetry.normal.dot(up) * up;
  if (!(across.norm() > kLeastAcross)) return std::nullopt;
  const bool isLeft = across.dot(towards - position(mesh, from)) > 0;
  const Vector3d start = (isLeft ? 1 : -1) * across.normalized();
  const Vector3d side = up.cross(start);
  const auto directionAt = [&](double turn) -> Vector3d {
    return std::cos(turn) * start + std::sin(turn) * side;
  };
  double best = 0;
  // A point beside the line by rounding may lie on another edge or face than its image.
  const bool isPaired =
      !symmetry.partner.empty() &&
      facesOf(mesh, mirrored(mesh, symmetry.partner, from)) == facesOf(mesh, from);
  if (isPaired) {
    // How far the step and its image are from going straight on: least at one turn, by golden
    // section.
    const auto missAt = [&](double turn) {
      const auto step = traceStraight(mesh, from, directionAt(turn), kFeel * length);
      if (!step) return std::numeric_limits<double>::infinity();
      const SurfacePath image = mirrored(mesh, symmetry.partner, *step);
      const SurfacePath through{{image.points[1], from, step->points[1]},
                                {image.faceOfSegment[0], step->faceOfSegment[0]},
                                false};
      return geodesicDefect(mesh, through);
    };
    constexpr double kGolden = 0.6180339887498949;
    double low = -kMostTurn, high = kMostTurn;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double missA = missAt(a), missB = missAt(b);
    for (int round = 0; round < kTurnRounds; ++round) {
      if (missA <= missB) {
        high = b;
        b = a;
        missB = missA;
        a = high - kGolden * (high - low);
        missA = missAt(a);
      } else {
        low = a;
        a = b;
        missA = missB;
        b = low + kGolden * (high - low);
        missB = missAt(b);
      }
    }
    best = 0.5 * (low + high);
  }
  const auto step = traceStraight(mesh, from, directionAt(best), length);
  if (!step || step->points.back() == from) return std::nullopt;
  return step->points.back();
}

bool isOnMiddle(const ReferenceModel& model, const SurfacePoint& point) {
  if (!model.symmetry) return false;
  const Result<SurfacePoint> image = mirrored(model, point);
  return image && (position(*model.mesh, *image) - position(*model.mesh, point)).norm() < kOnMiddle;
}

}  // namespace toile::detail
