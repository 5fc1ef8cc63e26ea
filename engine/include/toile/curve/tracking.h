// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "toile/curve/view.h"
#include "toile/mesh/surface_point.h"

namespace toile {

/// A point that follows a moving place, or the cursor, over the surface without ever jumping: it
/// stays on its limb however near another one comes.
///
/// A move is taken in steps of a few edges; in each the point goes to the nearest place among the
/// surface that hangs together within a small ball around it (the article's "closest surface point
/// with temporal coherence"). So it may only pass to another part where the surface itself leads
/// there, and the answer does not depend on how often the mouse was asked.
class SurfaceTracker {
 public:
  SurfaceTracker(std::shared_ptr<const Mesh> mesh, SurfacePoint start);
  ~SurfaceTracker();
  SurfaceTracker(SurfaceTracker&&) noexcept;
  SurfaceTracker& operator=(SurfaceTracker&&) noexcept;

  [[nodiscard]] const SurfacePoint& at() const;
  /// Puts the point somewhere else, which begins a new way. Precondition: isValid(mesh, point).
  void restart(const SurfacePoint& point);

  /// Follows a place in space. Places that are not finite leave the point where it is.
  /// @par Cost  the triangles within a few edges, once per step of two edge lengths
  const SurfacePoint& moveTo(const Eigen::Vector3d& place);
  /// Follows the cursor: comes to lie under the ray on the side where it was, or as near to the ray
  /// as the limb reaches when the cursor leaves its outline.
  const SurfacePoint& moveUnder(const Ray& ray);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toile
