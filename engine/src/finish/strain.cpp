// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/finish/strain.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "finish/strain_words.h"

// Notation: F = the map from the pattern to the face's shape on the body, g = unit grain in the
// plane, h = g turned to the left. F g and F h are what the threads become.
namespace toile {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Worst places that are told of a piece, and how far they lie apart, as a share of its size.
constexpr std::size_t kMaxSpots = 3;
constexpr double kApart = 0.2;
/// Strain that nobody asks for.
constexpr double kUnnoticed = 0.01;
/// Cloth shears more willingly than it stretches.
constexpr double kShearCounts = 0.5;

/// A triangle of those sides: from corner 0 to 1 along x.
Matrix2d edgesOf(const std::array<double, 3>& sides) {
  const double a = sides[0], b = sides[1], c = sides[2];
  const double x = (a * a + c * c - b * b) / (2 * a);
  Matrix2d edges;
  edges << a, x, 0, 2 * areaOf(sides) / a;
  return edges;
}

Strain strainOf(const Piece& piece, const FlatPiece& flat, FaceId f, const Vector2d& g) {
  const Triangle& t = piece.mesh->vertices(f);
  Matrix2d inPlane;
  inPlane.col(0) = flat.position[t[1]] - flat.position[t[0]];
  inPlane.col(1) = flat.position[t[2]] - flat.position[t[0]];
  Strain strain;
  if (!(inPlane.determinant() > 0)) return strain;
  const Matrix2d map = edgesOf(targetSides(piece, f)) * inPlane.inverse();
  const Vector2d along = map * g, across = map * Vector2d(-g.y(), g.x());
  strain.along = along.norm() - 1;
  strain.across = across.norm() - 1;
  strain.area = map.determinant() - 1;
  strain.shear = std::abs(along.dot(across)) / map.determinant();
  const FaceDistortion& distortion = flat.distortion[f];
  if (distortion.stretchMin > 0) {
    strain.greatest = 1 / distortion.stretchMin - 1;
    strain.least = 1 / distortion.stretchMax - 1;
  }
  return strain;
}

/// Mean of the faces round each vertex, so that no sliver speaks for its surroundings.
VertexData<Strain> strainAtVertices(const Piece& piece, const FaceData<Strain>& faces) {
  const Mesh& mesh = *piece.mesh;
  VertexData<Strain> means(mesh.vertexCount());
  VertexData<double> weights(mesh.vertexCount(), 0.0);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const double area = mesh.area(FaceId(f));
    const Strain& s = faces[FaceId(f)];
    for (const VertexId v : mesh.vertices(FaceId(f))) {
      means[v].along += area * s.along;
      means[v].across += area * s.across;
      means[v].shear += area * s.shear;
      weights[v] += area;
    }
  }
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const double weight = weights[VertexId(v)];
    if (!(weight > 0)) continue;
    means[VertexId(v)].along /= weight;
    means[VertexId(v)].across /= weight;
    means[VertexId(v)].shear /= weight;
  }
  return means;
}

double rankOf(const StrainSpot& spot) {
  const double size = std::abs(spot.value) * (spot.kind == StrainKind::Shear ? kShearCounts : 1);
  return spot.isOverLimit() ? 1e3 * (1 + spot.value / *spot.limit) : size;
}

std::vector<StrainSpot> findWorst(const Piece& piece, const FlatPiece& flat,
                                  const VertexData<Strain>& strains, const StrainLimits& limits) {
  std::vector<StrainSpot> spots;
  for (std::size_t v = 0; v < strains.size(); ++v) {
    std::optional<StrainSpot> worst;
    for (const StrainKind kind : {StrainKind::Across, StrainKind::Along, StrainKind::Shear}) {
      const StrainSpot spot{VertexId(v), kind, strains[VertexId(v)].of(kind), limits.of(kind), ""};
      if (std::abs(spot.value) < kUnnoticed) continue;
      if (!worst || rankOf(spot) > rankOf(*worst)) worst = spot;
    }
    if (worst) spots.push_back(*worst);
  }
  std::stable_sort(spots.begin(), spots.end(),
                   [](const StrainSpot& a, const StrainSpot& b) { return rankOf(a) > rankOf(b); });
  double area = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) area += piece.mesh->area(FaceId(f));
  const double apart = kApart * std::sqrt(area);
  std::vector<StrainSpot> kept;
  for (const StrainSpot& spot : spots) {
    if (kept.size() == kMaxSpots) break;
    const auto isNear = [&](const StrainSpot& other) {
      return (flat.position[spot.vertex] - flat.position[other.vertex]).norm() < apart;
    };
    if (std::none_of(kept.begin(), kept.end(), isNear)) kept.push_back(spot);
  }
  return kept;
}

}  // namespace

std::string_view toString(StrainKind kind) {
  switch (kind) {
    case StrainKind::Area:
      return "area";
    case StrainKind::Along:
      return "along";
    case StrainKind::Across:
      return "across";
    case StrainKind::Shear:
      return "shear";
  }
  return "";
}

double Strain::of(StrainKind kind) const {
  switch (kind) {
    case StrainKind::Area:
      return area;
    case StrainKind::Along:
      return along;
    case StrainKind::Across:
      return across;
    case StrainKind::Shear:
      return shear;
  }
  return 0;
}

std::optional<double> StrainLimits::of(StrainKind kind) const {
  switch (kind) {
    case StrainKind::Area:
      break;
    case StrainKind::Along:
      return along;
    case StrainKind::Across:
      return across;
    case StrainKind::Shear:
      return shear;
  }
  return std::nullopt;
}

StrainLimits strainLimits(const Design& design, const std::string& pieceId) {
  StrainLimits limits;
  const Fabric* fabric = fabricOf(design, recordOf(design, pieceId));
  if (fabric == nullptr) return limits;
  if (fabric->stretchAlong) limits.along = fabric->stretchAlong->value();
  if (fabric->stretchAcross) limits.across = fabric->stretchAcross->value();
  if (fabric->shear) limits.shear = fabric->shear->value();
  return limits;
}

PieceStrain measureStrain(const Document& document, const Piece& piece, const FlatPiece& flat,
                          const PatternPiece& finished) {
  PieceStrain result;
  result.limits = strainLimits(*document.design, piece.id);
  const Vector2d grain = (finished.grain[1] - finished.grain[0]).normalized();
  const Mesh& mesh = *piece.mesh;
  result.faces = FaceData<Strain>(mesh.faceCount());
  double over = 0, total = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Strain strain = strainOf(piece, flat, FaceId(f), grain);
    result.faces[FaceId(f)] = strain;
    const double area = mesh.area(FaceId(f));
    total += area;
    const bool isOver = std::any_of(kStrainKinds.begin(), kStrainKinds.end(), [&](StrainKind kind) {
      const std::optional<double> limit = result.limits.of(kind);
      return limit && strain.of(kind) > *limit;
    });
    if (isOver) over += area;
  }
  result.overLimit = total > 0 ? over / total : 0;
  result.worst = findWorst(piece, flat, strainAtVertices(piece, result.faces), result.limits);
  for (StrainSpot& spot : result.worst) {
    spot.place = placeInWords(document, piece, flat, spot.vertex);
  }
  return result;
}

}  // namespace toile
