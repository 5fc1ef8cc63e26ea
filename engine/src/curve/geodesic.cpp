// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/geodesic.h"

#include <fmt/format.h>
#include <algorithm>

#include "curve/strip.h"
#include "curve/vertex_route.h"
#include "curve/window_search.h"

namespace toile {

namespace {

/// Rounds of straightening; each one makes the path shorter. Far links take some dozens.
constexpr int kMaxRounds = 20000;
/// Windows that the search for a shorter way may follow: enough for nearly all links of a few
/// triangles, and a small part of the cost of a far one.
constexpr std::size_t kMaxWindows = 300;

/// A fixed order of surface points, so that a link and its reverse are worked out the same way.
bool isBefore(const SurfacePoint& a, const SurfacePoint& b) {
  if (a.at.index() != b.at.index()) return a.at.index() < b.at.index();
  if (const auto* v = std::get_if<VertexId>(&a.at)) return *v < std::get<VertexId>(b.at);
  if (const auto* on = std::get_if<SurfacePoint::OnEdge>(&a.at)) {
    const auto& other = std::get<SurfacePoint::OnEdge>(b.at);
    return on->edge != other.edge ? on->edge < other.edge : on->t < other.t;
  }
  const auto& in = std::get<SurfacePoint::InFace>(a.at);
  const auto& other = std::get<SurfacePoint::InFace>(b.at);
  if (in.face != other.face) return in.face < other.face;
  return std::lexicographical_compare(in.barycentric.begin(), in.barycentric.end(),
                                      other.barycentric.begin(), other.barycentric.end());
}

std::string describe(const Mesh& mesh, const SurfacePoint& point) {
  const Eigen::Vector3d p = position(mesh, point);
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", p.x(), p.y(), p.z());
}

}  // namespace

struct GeodesicLinker::Workspace {
  explicit Workspace(std::shared_ptr<const Mesh> m)
      : mesh(std::move(m)),
        geometry(*mesh),
        route(*mesh, geometry),
        strip(*mesh, geometry),
        search(*mesh, geometry) {}

  Result<SurfacePath> link(const SurfacePoint& a, const SurfacePoint& b);
  void straighten(const SurfacePoint& a, const SurfacePoint& b,
                  const std::vector<HalfedgeId>& crossings);

  std::shared_ptr<const Mesh> mesh;
  detail::FaceGeometry geometry;
  detail::VertexRoute route;
  detail::Strip strip;
  detail::WindowSearch search;
};

void GeodesicLinker::Workspace::straighten(const SurfacePoint& a, const SurfacePoint& b,
                                           const std::vector<HalfedgeId>& crossings) {
  strip.set(a, b, crossings);
  strip.pullTight();
  for (int round = 0; round < kMaxRounds && strip.rerouteCorners() > 0; ++round) strip.pullTight();
}

Result<SurfacePath> GeodesicLinker::Workspace::link(const SurfacePoint& a, const SurfacePoint& b) {
  if (const FaceId face = commonFace(*mesh, a, b); face.isValid()) {
    return SurfacePath{{a, b}, {face}, false};
  }
  const auto row = route.find(a, b);
  if (!row) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("the points at {} and {} lie on parts of the model that do not touch; "
                             "place both on one part",
                             describe(*mesh, a), describe(*mesh, b)),
                 {}};
  }
  straighten(a, b, *row);
  const double straightened = strip.length();
  const auto shorter = search.findShorter(a, b, straightened, kMaxWindows);
  if (!shorter) return strip.path();
  SurfacePath known = strip.path();
  straighten(a, b, shorter->crossings);
  return strip.length() < straightened ? strip.path() : known;
}

GeodesicLinker::GeodesicLinker(std::shared_ptr<const Mesh> mesh)
    : workspace_(std::make_unique<Workspace>(std::move(mesh))) {}
GeodesicLinker::~GeodesicLinker() = default;
GeodesicLinker::GeodesicLinker(GeodesicLinker&&) noexcept = default;
GeodesicLinker& GeodesicLinker::operator=(GeodesicLinker&&) noexcept = default;

Result<SurfacePath> GeodesicLinker::link(const SurfacePoint& a, const SurfacePoint& b) {
  const Mesh& mesh = *workspace_->mesh;
  if (!isValid(mesh, a) || !isValid(mesh, b)) {
    return Error{ErrorCode::CurveInvalid, "a point to link does not lie on the model", {}};
  }
  if (a == b) {
    return Error{
        ErrorCode::CurveInvalid, "the ends of a link are the same point, " + describe(mesh, a), {}};
  }
  if (isBefore(a, b)) return workspace_->link(a, b);
  Result<SurfacePath> path = workspace_->link(b, a);
  if (path) {
    std::reverse(path->points.begin(), path->points.end());
    std::reverse(path->faceOfSegment.begin(), path->faceOfSegment.end());
  }
  return path;
}

Result<SurfacePath> GeodesicLinker::linkAll(std::span<const SurfacePoint> points, bool closed) {
  std::vector<SurfacePoint> distinct;
  for (const SurfacePoint& point : points) {
    if (distinct.empty() || !(distinct.back() == point)) distinct.push_back(point);
  }
  while (closed && distinct.size() > 1 && distinct.front() == distinct.back()) distinct.pop_back();
  const std::size_t needed = closed ? 3 : 2;
  if (distinct.size() < needed) {
    return Error{ErrorCode::CurveInvalid,
                 fmt::format("{} different points are too few: {} curve needs {}", distinct.size(),
                             closed ? "a closed" : "an open", needed),
                 {}};
  }
  SurfacePath path;
  path.closed = closed;
  path.points.push_back(distinct.front());
  for (std::size_t i = 0; i + (closed ? 0 : 1) < distinct.size(); ++i) {
    Result<SurfacePath> part = link(distinct[i], distinct[(i + 1) % distinct.size()]);
    if (!part) return part;
    path.points.insert(path.points.end(), part->points.begin() + 1, part->points.end());
    path.faceOfSegment.insert(path.faceOfSegment.end(), part->faceOfSegment.begin(),
                              part->faceOfSegment.end());
  }
  if (closed) path.points.pop_back();
  return path;
}

}  // namespace toile
