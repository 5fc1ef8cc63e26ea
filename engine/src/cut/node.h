// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <cstdint>

#include "toile/mesh/surface_point.h"

namespace toile::cutting {

/// Places on the mesh are whole numbers: an edge and a face are divided into 2^26 parts. On a
/// triangle of 1 cm one part is 0.15 nm, so that rounding to it never matters for cloth, and a
/// determinant of three points of a face fits into 64 bits: orientation is exact.
inline constexpr std::int64_t kUnit = std::int64_t{1} << 26;

/// A point of the cut, by where it lies: a mesh vertex, a place on an edge (p parts from tail to
/// head, 0 < p < kUnit), or one inside a face (p and q are the weights of its second and third
/// corner). Both faces of an edge name a point on it alike, so that they cannot disagree. The order
/// of nodes is that of where they lie, whichever curve made them.
struct Node {
  enum class Kind : std::uint8_t { Vertex, Edge, Face };
  Kind kind = Kind::Vertex;
  std::uint32_t element = 0;
  std::uint32_t p = 0;
  std::uint32_t q = 0;
  friend auto operator<=>(const Node&, const Node&) = default;

  static Node vertex(VertexId v) { return {Kind::Vertex, v.index(), 0, 0}; }
  static Node edge(EdgeId e, std::int64_t t) {
    return {Kind::Edge, e.index(), static_cast<std::uint32_t>(t), 0};
  }
  static Node face(FaceId f, std::int64_t b1, std::int64_t b2) {
    return {Kind::Face, f.index(), static_cast<std::uint32_t>(b1), static_cast<std::uint32_t>(b2)};
  }
};

[[nodiscard]] Eigen::Vector3d position(const Mesh& mesh, const Node& node);
/// The same place with parameters that are exact in double.
[[nodiscard]] SurfacePoint surfacePoint(const Node& node);

/// Weights of the second and third corner of a face, in parts: a plane with exact orientation.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

/// Twice the signed area in parts of the face: > 0 when a, b, c turn left. Exact.
[[nodiscard]] constexpr std::int64_t orientation(const LatticePoint& a, const LatticePoint& b,
                                                 const LatticePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// One face of the mesh with its two planes: the exact one of whole numbers and the isometric one
/// in mm, for distances.
class FaceFrame {
 public:
  FaceFrame(const Mesh& mesh, FaceId face);

  [[nodiscard]] FaceId face() const { return face_; }
  [[nodiscard]] EdgeId edge(int side) const { return edges_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] VertexId corner(int k) const { return corners_[static_cast<std::size_t>(k)]; }
  /// Precondition: the node lies on the closed face.
  [[nodiscard]] LatticePoint lattice(const Node& node) const;
  [[nodiscard]] Eigen::Vector2d flat(const LatticePoint& point) const;
  /// The side (corner k to k+1) on which both lie; -1 if there is none.
  [[nodiscard]] int commonSide(const LatticePoint& a, const LatticePoint& b) const;
  /// Parts from the tail of the side's edge of a point that is t parts from corner `side`.
  [[nodiscard]] std::int64_t alongEdge(int side, std::int64_t t) const {
    return fromTail_[static_cast<std::size_t>(side)] ? t : kUnit - t;
  }
  /// Parts from corner `side` towards the next corner. Precondition: the point lies on that side.
  [[nodiscard]] static std::int64_t alongSide(int side, const LatticePoint& point);
  /// How far two points that are so many mm apart differ in LatticePoint::x at most.
  [[nodiscard]] std::int64_t reach(double distance) const;
  /// mm^2 of the isometric plane per unit of orientation().
  [[nodiscard]] double areaScale() const { return second_.x() * third_.y() / (kParts * kParts); }
  [[nodiscard]] Eigen::Vector2d flatCorner(int k) const {
    return k == 0 ? Eigen::Vector2d(0, 0) : (k == 1 ? second_ : third_);
  }

 private:
  static constexpr double kParts = static_cast<double>(kUnit);
  FaceId face_;
  std::array<VertexId, 3> corners_;
  std::array<EdgeId, 3> edges_;
  std::array<bool, 3> fromTail_{};  ///< the side runs from the tail of its edge
  Eigen::Vector2d second_;
  Eigen::Vector2d third_;
};

}  // namespace toile::cutting
