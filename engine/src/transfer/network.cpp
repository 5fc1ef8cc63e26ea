// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/network.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "model/mirror.h"
#include "toile/curve/crossing.h"

namespace toile::detail {

namespace {

Eigen::AlignedBox3d boxOf(const Mesh& mesh, const SurfacePath& path) {
  Eigen::AlignedBox3d box;
  for (const SurfacePoint& point : path.points) box.extend(position(mesh, point));
  box.min().array() -= kEndsOn;
  box.max().array() += kEndsOn;
  return box;
}

class MeetingSharer {
 public:
  MeetingSharer(Sketch& sketch, CurveNetwork& network)
      : sketch_(sketch), mesh_(sketch.mesh()), network_(network) {
    for (const WorkCurve& curve : network.curves) {
      paths_.push_back(pathOf(curve));
      boxes_.push_back(boxOf(mesh_, paths_.back()));
    }
  }

  Result<void> run() {
    const std::size_t count = network_.curves.size();
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        if (!boxes_[a].intersects(boxes_[b])) continue;
        if (const Result<void> done = share(a, b); !done) return done;
      }
    }
    return shareWithOriginals();
  }

 private:
  Result<void> share(std::size_t a, std::size_t b) {
    // A link of rounding's size may have lost its face; such lines are left as they are.
    if (!isValid(mesh_, paths_[a]) || !isValid(mesh_, paths_[b])) return {};
    const std::vector<PathMeeting> meetings = findMeetings(mesh_, paths_[a], paths_[b]);
    for (const PathMeeting& meeting : meetings) {
      const std::size_t inA = insertData(mesh_, network_.curves[a], meeting.a);
      if (const auto done = insertAt(b, meeting.b, network_.curves[a].data[inA]); !done) {
        return done;
      }
    }
    for (const auto& [ending, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (const auto done = joinEnds(ending, other); !done) return done;
    }
    if (!meetings.empty()) {
      for (const std::size_t c : {a, b}) paths_[c] = pathOf(network_.curves[c]);
    }
    return {};
  }

  /// Makes `point` the data point of a curve at an arc length.
  Result<void> insertAt(std::size_t c, double arc, const SurfacePoint& point) {
    WorkCurve& curve = network_.curves[c];
    const std::size_t at = insertData(mesh_, curve, arc);
    if (curve.data[at] == point) return {};
    curve.data[at] = point;
    return linkAgain(c);
  }
  Result<void> linkAgain(std::size_t c) {
    WorkCurve& curve = network_.curves[c];
    for (std::size_t i = 0; i < curve.linkCount(); ++i) {
      SurfacePath& link = curve.links[i];
      if (link.points.front() == curve.from(i) && link.points.back() == curve.to(i)) continue;
      link.points.clear();
    }
    if (const Result<void> linked = linkAll(sketch_.linker(), curve); !linked) {
      return linked.error().during("curve \"" + sketch_.design().curves[c].id + "\"");
    }
    paths_[c] = pathOf(curve);
    return {};
  }

  /// Ends that cutting would merge with a line that they do not quite touch.
  Result<void> joinEnds(std::size_t ending, std::size_t other) {
    WorkCurve& curve = network_.curves[ending];
    if (curve.closed) return {};
    for (const std::size_t end : {std::size_t{0}, curve.data.size() - 1}) {
      const SurfacePoint point = curve.data[end];
      const auto& data = network_.curves[other].data;
      if (std::find(data.begin(), data.end(), point) != data.end()) continue;
      if (!boxes_[other].contains(position(mesh_, point))) continue;
      const PathFoot foot = nearestOnPath(mesh_, paths_[other], position(mesh_, point));
      if (foot.distance > kEndsOn) continue;
      const std::size_t at = insertData(mesh_, network_.curves[other], foot.arc);
      const SurfacePoint shared = network_.curves[other].data[at];
      paths_[other] = pathOf(network_.curves[other]);
      curve.data[end] = shared;
      if (const Result<void> done = linkAgain(ending); !done) return done;
    }
    return {};
  }

  Result<void> shareWithOriginals() {
    const ReferenceModel& model = sketch_.model();
    if (!model.symmetry || model.symmetry->partner.empty()) return {};
    // Images of images hand their points on, so the later a curve hangs the earlier it comes.
    std::vector<std::pair<std::size_t, std::size_t>> byDepth;
    for (std::size_t i = 0; i < network_.curves.size(); ++i) {
      std::size_t depth = 0;
      for (auto at = network_.originalOf[i]; at; at = network_.originalOf[*at]) ++depth;
      if (depth > 0) byDepth.emplace_back(depth, i);
    }
    std::sort(byDepth.begin(), byDepth.end(), std::greater<>());
    for (const auto& [depth, i] : byDepth) {
      const std::size_t original = *network_.originalOf[i];
      const std::vector<double> arcs = arcsOf(mesh_, network_.curves[i]);
      for (std::size_t p = 0; p < network_.curves[i].data.size(); ++p) {
        const SurfacePoint image =
            mirrored(mesh_, model.symmetry->partner, network_.curves[i].data[p]);
        const auto& data = network_.curves[original].data;
        if (std::find(data.begin(), data.end(), image) != data.end()) continue;
        if (const auto done = insertAt(original, arcs[p], image); !done) return done;
      }
    }
    return {};
  }

  Sketch& sketch_;
  const Mesh& mesh_;
  CurveNetwork& network_;
  std::vector<SurfacePath> paths_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace

Result<CurveNetwork> makeNetwork(Sketch& sketch) {
  CurveNetwork network;
  for (const StylingCurve& curve : sketch.design().curves) {
    Result<WorkCurve> work = sketch.load(curve.id);
    if (!work) return work.error();
    network.curves.push_back(*std::move(work));
    std::optional<std::size_t> original;
    if (curve.mirrorOf && curve.dataPoints.empty()) {
      const Result<std::size_t> found = sketch.indexOf(*curve.mirrorOf);
      if (!found) return found.error();
      original = *found;
    }
    network.originalOf.push_back(original);
  }
  if (const Result<void> shared = MeetingSharer(sketch, network).run(); !shared) {
    return shared.error();
  }
  return network;
}

}  // namespace toile::detail
