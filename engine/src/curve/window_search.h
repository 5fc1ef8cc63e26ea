// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "curve/face_geometry.h"
#include "toile/mesh/surface_point.h"

namespace toile::detail {

/// Looks for a way between two points that is shorter than a known one, by following what can be
/// seen from the start through rows of unfolded faces (the windows of Mitchell, Mount and
/// Papadimitriou, SIAM J. Comput. 16, 1987), again from every vertex where shortest ways may bend.
/// Only windows through which a way shorter than the known one is possible are followed: for near
/// points these are few, and the answer is the shortest way of all.
class WindowSearch {
 public:
  WindowSearch(const Mesh& mesh, FaceGeometry& geometry);

  struct Found {
    std::vector<HalfedgeId> crossings;
    double length = 0;
  };
  /// @param maxWindows ends the search; then there may be shorter ways that were not seen.
  /// @return the shortest way found that is shorter than `length`; nullopt if there is none.
  std::optional<Found> findShorter(const SurfacePoint& start, const SurfacePoint& end,
                                   double length, std::size_t maxWindows);
  /// Windows followed by the last search.
  [[nodiscard]] std::size_t windowCount() const { return windows_.size(); }

 private:
  using Point = Eigen::Vector2d;
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// The start, or a vertex reached by a straight way from another source.
  struct Source {
    VertexId vertex;    ///< invalid for the start
    double offset = 0;  ///< length of the way to it
    std::uint32_t parent = kNone;
    std::uint32_t window = kNone;  ///< through which the parent sees it; none = in the same face
    FaceId face;                   ///< in which the way arrives
    bool isDone = false;
  };
  /// What a source, at the origin, sees of a halfedge and the face behind it.
  struct Window {
    HalfedgeId entered;         ///< of the face behind, from the left end to the right one
    Point left, right;          ///< ends of the halfedge
    Point seenLeft, seenRight;  ///< directions that bound the view
    std::uint32_t parent = kNone;
    std::uint32_t source = 0;
  };

  void reach(VertexId vertex, double offset, std::uint32_t parent, std::uint32_t window,
             FaceId face);
  void reachEnd(double length, std::uint32_t source, std::uint32_t window, FaceId face);
  void openFace(std::uint32_t source, FaceId face);
  void open(const Window& window);
  void follow(std::uint32_t window);
  [[nodiscard]] bool mayBend(VertexId vertex);
  [[nodiscard]] std::vector<HalfedgeId> crossingsToEnd();

  const Mesh& mesh_;
  FaceGeometry& geometry_;
  std::vector<Source> sources_;
  std::vector<Window> windows_;
  std::vector<std::pair<std::uint32_t, double>> reached_;  ///< per vertex: the run, its offset
  std::uint32_t run_ = 0;
  SurfacePoint start_, end_;
  Eigen::Vector3d endPosition_;
  double bound_ = 0;
  Source arrival_;  ///< the best way to the end
};

}  // namespace toile::detail
