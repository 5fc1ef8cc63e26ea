// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/tracking.h"

#include <algorithm>
#include <cmath>

#include "curve/local_closest.h"

namespace toile {

namespace {

using Eigen::Vector3d;

/// Length of a step in mean edge lengths: long enough to be quick, short beside any limb.
constexpr double kStepEdges = 2;
/// The ball that is searched, in steps. A point on a hollow place moves farther than the cursor.
constexpr double kBallSteps = 3;
constexpr int kMaxSteps = 400;  ///< a wild jump of the mouse takes longer steps
/// Ends going to and fro between ray and surface; on a slope of 80 degrees each round leaves 3 %
/// less of the way.
constexpr int kMaxRounds = 40;

Vector3d closestOnRay(const Ray& ray, const Vector3d& p) {
  const Vector3d direction = ray.direction.normalized();
  return ray.origin + std::max(0.0, (p - ray.origin).dot(direction)) * direction;
}

}  // namespace

struct SurfaceTracker::State {
  State(std::shared_ptr<const Mesh> m, SurfacePoint start)
      : mesh(std::move(m)), local(*mesh), at(std::move(start)), place(position(*mesh, at)) {
    step = kStepEdges * mesh->meanEdgeLength();
  }

  /// Down to the nearest point of this part of the surface, ball by ball.
  void descend(const Vector3d& goal, double ball) {
    for (int round = 0; round < kMaxRounds; ++round) {
      const SurfacePoint next = local.find(goal, at, ball);
      if (next == at) return;
      at = next;
    }
  }

  template <class Move>
  void inSteps(const Vector3d& from, const Vector3d& to, const Move& move) const {
    const double way = (to - from).norm();
    const int count = std::clamp(static_cast<int>(std::ceil(way / step)), 1, kMaxSteps);
    const double ball = kBallSteps * std::max(step, way / count);
    for (int k = 1; k <= count; ++k) {
      move(k == count ? to : Vector3d(from + (to - from) * (static_cast<double>(k) / count)), ball);
    }
  }

  std::shared_ptr<const Mesh> mesh;
  detail::LocalClosest local;
  SurfacePoint at;
  Vector3d place;  ///< that was followed last
  double step = 0;
};

SurfaceTracker::SurfaceTracker(std::shared_ptr<const Mesh> mesh, SurfacePoint start)
    : state_(std::make_unique<State>(std::move(mesh), std::move(start))) {}
SurfaceTracker::~SurfaceTracker() = default;
SurfaceTracker::SurfaceTracker(SurfaceTracker&&) noexcept = default;
SurfaceTracker& SurfaceTracker::operator=(SurfaceTracker&&) noexcept = default;

const SurfacePoint& SurfaceTracker::at() const {
  return state_->at;
}

void SurfaceTracker::restart(const SurfacePoint& point) {
  state_->at = point;
  state_->place = position(*state_->mesh, point);
}

const SurfacePoint& SurfaceTracker::moveTo(const Vector3d& place) {
  State& s = *state_;
  if (!place.allFinite()) return s.at;
  s.inSteps(s.place, place, [&](const Vector3d& goal, double ball) { s.descend(goal, ball); });
  s.place = place;
  return s.at;
}

const SurfacePoint& SurfaceTracker::moveUnder(const Ray& ray) {
  State& s = *state_;
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || ray.direction.isZero(0)) return s.at;
  const Vector3d start = position(*s.mesh, s.at);
  const Vector3d end = closestOnRay(ray, start);
  s.inSteps(start, end, [&](const Vector3d& goal, double ball) {
    // Between the two rays the way is short: a parallel to the new one serves.
    const Ray between{goal - ray.direction * ((goal - ray.origin).dot(ray.direction) /
                                              ray.direction.squaredNorm()),
                      ray.direction};
    for (int round = 0; round < kMaxRounds; ++round) {
      const SurfacePoint next = s.local.find(
          closestOnRay(goal == end ? ray : between, position(*s.mesh, s.at)), s.at, ball);
      if (next == s.at) break;
      s.at = next;
    }
  });
  s.place = position(*s.mesh, s.at);
  return s.at;
}

}  // namespace toile
