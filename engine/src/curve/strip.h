// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curve/face_geometry.h"
#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// A strip of faces from one surface point to another, and the shortest path within it.
///
/// The strip is the row of halfedges that are crossed, each seen from the face that is left; the
/// vertex that a halfedge leads to is on the walker's left. Notation: crossing i leads from face i
/// to face i + 1, the start lies in face 0, the end in the last one.
class Strip {
 public:
  Strip(const Mesh& mesh, FaceGeometry& geometry) : mesh_(mesh), geometry_(geometry) {}

  /// Takes a row of crossings and drops what leads back at once, or along the ends' own edges.
  /// Precondition: not empty, unless the ends share a face.
  void set(const SurfacePoint& start, const SurfacePoint& end,
           const std::vector<HalfedgeId>& crossings);

  /// Shortest path within the strip, by unfolding it into the plane and pulling a funnel through
  /// it (Lee and Preparata, Networks 14, 1984). Linear in practice.
  void pullTight();

  /// Leads the strip around the other side of each corner where that side has less than pi; after
  /// that pullTight() finds a strictly shorter path.
  /// @return how many corners were passed on the other side; 0 = locally shortest.
  int rerouteCorners();

  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<HalfedgeId>& crossings() const { return crossings_; }
  /// The path of the last pullTight().
  [[nodiscard]] SurfacePath path() const;

 private:
  using Point = Eigen::Vector2d;
  /// A crossing unfolded; the end of the strip counts as a last portal without width.
  struct Portal {
    Point left, right;
    VertexId leftVertex, rightVertex;
  };
  /// A vertex at which the path bends: the portals first..last end there.
  struct Corner {
    VertexId vertex;
    Point place;
    bool isLeft = false;
    std::size_t first = 0, last = 0;
  };

  void unfold();
  [[nodiscard]] double angleOnOtherSide(std::size_t corner) const;
  bool appendOtherWay(const Corner& corner, std::vector<HalfedgeId>& row) const;
  [[nodiscard]] bool isOnEdgeOf(const SurfacePoint& point, HalfedgeId h) const;
  [[nodiscard]] SurfacePoint pointOnPortal(std::size_t portal, const Point& from,
                                           const Point& to) const;

  const Mesh& mesh_;
  FaceGeometry& geometry_;
  SurfacePoint start_, end_;
  Point startPlace_, endPlace_;
  std::vector<HalfedgeId> crossings_;
  std::vector<Portal> portals_;
  std::vector<Corner> corners_;
  double length_ = 0;
};

}  // namespace toile::detail
