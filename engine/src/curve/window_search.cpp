// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/window_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve/vertex_route.h"

namespace toile::detail {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A way must be shorter by this part to count, so that rounding finds nothing new.
constexpr double kGain = 1e-9;
/// Below a full turn by less, a vertex counts as a saddle.
constexpr double kFlatAngle = 1e-9;
/// What lies beside the view by so much (sine) still counts as seen: two neighbouring windows then
/// both see what lies on their common border.
constexpr double kSeenMargin = 1e-12;

double cross(const Vector2d& u, const Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// The least sum of the distances from the origin to a point x of the line from a to b, for a part
/// of it, and from there to a place in space: both are turned into one plane around the line.
double shortestDetour(const Vector2d& a, const Vector2d& b, double from, double to,
                      const Vector3d& a3, const Vector3d& b3, const Vector3d& place) {
  const Vector2d along = b - a;
  const double length = along.norm();
  if (!(length > 0)) return a.norm() + (place - a3).norm();
  const double originAlong = -a.dot(along) / length;
  const double originAside = std::abs(cross(a, along)) / length;
  const Vector3d along3 = (b3 - a3) / length;
  const double placeAlong = (place - a3).dot(along3);
  const double placeAside = (place - a3 - placeAlong * along3).norm();
  const double aside = originAside + placeAside;
  double x =
      aside > 0 ? originAlong + (placeAlong - originAlong) * originAside / aside : originAlong;
  x = std::clamp(x, from * length, to * length);
  return std::hypot(x - originAlong, originAside) + std::hypot(x - placeAlong, placeAside);
}

/// Part of the way from a to b at which the ray from the origin crosses, 0..1.
double partOnRay(const Vector2d& a, const Vector2d& b, const Vector2d& ray) {
  const double sideA = cross(ray, a), sideB = cross(ray, b);
  return sideA != sideB ? std::clamp(sideA / (sideA - sideB), 0.0, 1.0) : 0.0;
}

}  // namespace

WindowSearch::WindowSearch(const Mesh& mesh, FaceGeometry& geometry)
    : mesh_(mesh), geometry_(geometry), reached_(mesh.vertexCount(), {0U, 0.0}) {}

bool WindowSearch::mayBend(VertexId vertex) {
  return mesh_.isBorder(vertex) ||
         geometry_.angleAround(vertex) > 2 * std::numbers::pi - kFlatAngle;
}

void WindowSearch::reach(VertexId vertex, double offset, std::uint32_t parent, std::uint32_t window,
                         FaceId face) {
  if (offset + (mesh_.position(vertex) - endPosition_).norm() >= bound_) return;
  auto& [run, best] = reached_[vertex.index()];
  if (run == run_ && best <= offset) return;
  if (!mayBend(vertex)) return;
  run = run_;
  best = offset;
  sources_.push_back({vertex, offset, parent, window, face});
}

void WindowSearch::reachEnd(double length, std::uint32_t source, std::uint32_t window,
                            FaceId face) {
  if (length >= bound_) return;
  bound_ = length;
  arrival_ = {VertexId(), length, source, window, face};
}

void WindowSearch::open(const Window& window) {
  if (!(cross(window.seenRight, window.seenLeft) > 0)) return;
  const HalfedgeId h = window.entered;
  const double from = partOnRay(window.left, window.right, window.seenLeft);
  const double to = partOnRay(window.left, window.right, window.seenRight);
  const double detour =
      shortestDetour(window.left, window.right, from, std::max(from, to),
                     mesh_.position(mesh_.from(h)), mesh_.position(mesh_.to(h)), endPosition_);
  if (sources_[window.source].offset + detour < bound_) windows_.push_back(window);
}

void WindowSearch::openFace(std::uint32_t source, FaceId face) {
  const VertexId vertex = sources_[source].vertex;
  const double offset = sources_[source].offset;
  const SurfacePoint at = vertex.isValid() ? SurfacePoint{vertex} : start_;
  const Vector3d weights = barycentricIn(mesh_, at, face);
  // The face in the plane, relative to the source.
  const HalfedgeId base = mesh_.halfedge(face, 0);
  const double length = (mesh_.position(mesh_.to(base)) - mesh_.position(mesh_.from(base))).norm();
  const FaceGeometry::Apex& apex = geometry_.apex(base);
  std::array<Vector2d, 3> corner{Vector2d(0, 0), Vector2d(length, 0),
                                 Vector2d(apex.along * length, apex.aside * length)};
  const Vector2d origin = weights[1] * corner[1] + weights[2] * corner[2];
  for (Vector2d& c : corner) c -= origin;

  if (touches(mesh_, end_, face)) {
    const Vector3d w = barycentricIn(mesh_, end_, face);
    const Vector2d place = w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2];
    reachEnd(offset + place.norm(), source, kNone, face);
  }
  for (int k = 0; k < 3; ++k) {
    const auto from = static_cast<std::size_t>(k), to = (from + 1) % 3;
    const VertexId v = mesh_.vertices(face)[from];
    if (v != vertex) reach(v, offset + corner[from].norm(), source, kNone, face);
    // A side that the source lies on or at the end of shows nothing more than its neighbours do.
    if (weights[(k + 2) % 3] == 0) continue;
    const HalfedgeId entered = mesh_.opposite(mesh_.halfedge(face, k));
    if (!entered.isValid()) continue;
    open({entered, corner[to], corner[from], corner[to], corner[from], kNone, source});
  }
}

void WindowSearch::follow(std::uint32_t index) {
  const Window window = windows_[index];
  const FaceId face = mesh_.face(window.entered);
  const double offset = sources_[window.source].offset;
  const Vector2d d = window.right - window.left;
  const FaceGeometry::Apex& third = geometry_.apex(window.entered);
  const Vector2d top = window.left + third.along * d + third.aside * Vector2d(-d.y(), d.x());
  const auto isSeen = [&](const Vector2d& place) {
    const double margin = kSeenMargin * place.norm();
    return cross(window.seenRight, place) >= -margin * window.seenRight.norm() &&
           cross(place, window.seenLeft) >= -margin * window.seenLeft.norm();
  };
  if (touches(mesh_, end_, face)) {
    const Vector3d w = barycentricIn(mesh_, end_, face);
    const int side = mesh_.side(window.entered);
    const Vector2d place =
        window.left + w[(side + 1) % 3] * d + w[(side + 2) % 3] * (top - window.left);
    if (isSeen(place)) reachEnd(offset + place.norm(), window.source, index, face);
  }
  const HalfedgeId rightSide = mesh_.next(window.entered),
                   leftSide = mesh_.previous(window.entered);
  if (isSeen(top)) reach(mesh_.to(rightSide), offset + top.norm(), window.source, index, face);

  // What is left of the top falls on the left side, what is right of it on the other.
  const bool isLeftOfView = cross(window.seenLeft, top) > 0;
  const bool isRightOfView = cross(window.seenRight, top) < 0;
  const HalfedgeId pastLeft = mesh_.opposite(leftSide), pastRight = mesh_.opposite(rightSide);
  if (pastLeft.isValid() && !isLeftOfView) {
    open({pastLeft, window.left, top, window.seenLeft, isRightOfView ? window.seenRight : top,
          index, window.source});
  }
  if (pastRight.isValid() && !isRightOfView) {
    open({pastRight, top, window.right, isLeftOfView ? window.seenLeft : top, window.seenRight,
          index, window.source});
  }
}

std::vector<HalfedgeId> WindowSearch::crossingsToEnd() {
  // The straight stretches of the way, the last first.
  std::vector<const Source*> stretches{&arrival_};
  while (sources_[stretches.back()->parent].vertex.isValid()) {
    stretches.push_back(&sources_[stretches.back()->parent]);
  }
  std::reverse(stretches.begin(), stretches.end());
  std::vector<HalfedgeId> row;
  for (const Source* stretch : stretches) {
    std::vector<HalfedgeId> part;
    for (std::uint32_t w = stretch->window; w != kNone; w = windows_[w].parent) {
      part.push_back(mesh_.opposite(windows_[w].entered));
    }
    std::reverse(part.begin(), part.end());
    const Source& from = sources_[stretch->parent];
    if (from.vertex.isValid()) {
      const FaceId leaves = part.empty() ? stretch->face : mesh_.face(part.front());
      appendTurn(mesh_, geometry_, from.vertex, from.face, std::span(&leaves, 1), row);
    }
    row.insert(row.end(), part.begin(), part.end());
  }
  return row;
}

std::optional<WindowSearch::Found> WindowSearch::findShorter(const SurfacePoint& start,
                                                             const SurfacePoint& end, double length,
                                                             std::size_t maxWindows) {
  ++run_;
  sources_.clear();
  windows_.clear();
  start_ = start;
  end_ = end;
  endPosition_ = position(mesh_, end);
  bound_ = length * (1 - kGain);
  arrival_ = {};
  sources_.push_back({});

  for (;;) {
    std::uint32_t nearest = kNone;
    for (std::uint32_t s = 0; s < sources_.size(); ++s) {
      if (sources_[s].isDone) continue;
      if (nearest == kNone || sources_[s].offset < sources_[nearest].offset) nearest = s;
    }
    if (nearest == kNone) break;
    Source& source = sources_[nearest];
    source.isDone = true;
    const VertexId vertex = source.vertex;
    // A vertex that was reached again by a shorter way has a source of its own for that.
    if (vertex.isValid() && reached_[vertex.index()].second < source.offset) continue;
    auto next = static_cast<std::uint32_t>(windows_.size());
    for (const FaceId face : facesOf(mesh_, vertex.isValid() ? SurfacePoint{vertex} : start)) {
      openFace(nearest, face);
    }
    for (; next < windows_.size() && windows_.size() < maxWindows; ++next) follow(next);
    if (windows_.size() >= maxWindows) break;
  }
  if (arrival_.parent == kNone) return std::nullopt;
  return Found{crossingsToEnd(), bound_};
}

}  // namespace toile::detail
