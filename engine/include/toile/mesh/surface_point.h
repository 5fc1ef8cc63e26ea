// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "toile/mesh/mesh.h"

namespace toile {

/// A point on a mesh surface. Holds exactly one of the three forms, so it is never half valid.
struct SurfacePoint {
  struct OnEdge {
    EdgeId edge;
    double t = 0.5;  ///< 0 < t < 1, from tail (smaller vertex index) to head
    friend bool operator==(const OnEdge&, const OnEdge&) = default;
  };
  struct InFace {
    FaceId face;
    Eigen::Vector3d barycentric;  ///< each > 0, sum 1, in the face's corner order
    friend bool operator==(const InFace&, const InFace&) = default;
  };
  std::variant<VertexId, OnEdge, InFace> at;
  friend bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};

/// From a face and any barycentric weights (clamped to >= 0, sum made 1): a vertex or edge point
/// where weights are zero.
[[nodiscard]] SurfacePoint makeSurfacePoint(const Mesh& mesh, FaceId face,
                                            const Eigen::Vector3d& barycentric);
[[nodiscard]] Eigen::Vector3d position(const Mesh& mesh, const SurfacePoint& point);
/// The faces that hold the point: 1 inside, 1-2 on an edge, the fan of a vertex; ascending.
[[nodiscard]] std::vector<FaceId> facesOf(const Mesh& mesh, const SurfacePoint& point);
[[nodiscard]] bool touches(const Mesh& mesh, const SurfacePoint& point, FaceId face);
/// Weights of the point in one of its faces. Precondition: touches().
[[nodiscard]] Eigen::Vector3d barycentricIn(const Mesh& mesh, const SurfacePoint& point,
                                            FaceId face);
/// A face that both points touch, the smallest id; invalid if there is none.
[[nodiscard]] FaceId commonFace(const Mesh& mesh, const SurfacePoint& a, const SurfacePoint& b);
/// Ids exist in the mesh, t and weights in range, finite.
[[nodiscard]] bool isValid(const Mesh& mesh, const SurfacePoint& point);

/// A polyline on the surface: each segment lies in the closed face named for it, which both its
/// ends touch. Closed: the last point is joined to the first by one more segment.
struct SurfacePath {
  std::vector<SurfacePoint> points;
  std::vector<FaceId> faceOfSegment;  ///< points.size()-1, or points.size() when closed
  bool closed = false;
};

[[nodiscard]] double length(const Mesh& mesh, const SurfacePath& path);
/// Point at a fraction 0..1 of the length; a closed path wraps.
[[nodiscard]] SurfacePoint pointAtFraction(const Mesh& mesh, const SurfacePath& path,
                                           double fraction);
/// The part from fraction a to b, in direction of the path; on a closed path b < a wraps; on an
/// open one b < a gives the part reversed.
[[nodiscard]] SurfacePath subPath(const Mesh& mesh, const SurfacePath& path, double a, double b);
/// Every segment has its face, ends touch it, at least two points (three if closed).
[[nodiscard]] bool isValid(const Mesh& mesh, const SurfacePath& path);

}  // namespace toile
