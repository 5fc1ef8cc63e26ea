// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace toile::fitting {
namespace {

using Names = std::vector<std::string>;

std::vector<Segment> makeSegments() {
  const Names neck{"neck_front", "neck_back", "neck_side_l", "neck_side_r"};
  const Names waist{"waist_front", "waist_back", "waist_side_l", "waist_side_r"};
  const Names hips{"hip_front", "hip_back", "hip_side_l", "hip_side_r", "crotch"};
  std::vector<Segment> segments;
  segments.push_back({"head", neck, {"crown"}, {"nose_tip", "chin"}});
  segments.push_back(
      {"upper trunk",
       neck,
       waist,
       {"bust_point_l", "bust_point_r", "bust_front", "bust_back", "underbust_front", "armpit_l",
        "armpit_r", "armpit_front_l", "armpit_front_r", "armpit_back_l", "armpit_back_r"}});
  segments.push_back({"lower trunk", waist, hips, {"navel", "buttock_l", "buttock_r"}});
  for (const std::string side : {"_l", "_r"}) {
    const std::string word = side == "_l" ? "left " : "right ";
    const auto sided = [&](Names names) {
      for (std::string& name : names) name += side;
      return names;
    };
    const Names shoulder = sided({"shoulder", "armpit", "armpit_front", "armpit_back"});
    const Names elbow = sided({"elbow_outer", "elbow_inner"});
    const Names wrist = sided({"wrist_thumb", "wrist_little"});
    const Names knee = sided({"knee_front", "knee_back", "knee_outer", "knee_inner"});
    const Names ankle = sided({"ankle_outer", "ankle_inner", "ankle_front", "ankle_back"});
    Names hip = sided({"hip_side", "gluteal_fold", "buttock"});
    hip.push_back("crotch");
    segments.push_back({word + "upper arm", shoulder, elbow, {}});
    segments.push_back({word + "forearm", elbow, wrist, {}});
    segments.push_back({word + "hand", wrist, sided({"middle_tip"}),
                        sided({"thumb_tip", "index_tip", "ring_tip", "little_tip"})});
    segments.push_back({word + "thigh", hip, knee, {}});
    segments.push_back({word + "shank", knee, ankle, {}});
    segments.push_back({word + "foot", ankle, sided({"toe_big", "toe_little"}), sided({"heel"})});
  }
  return segments;
}

std::optional<Eigen::Vector3d> centre(const Names& names, const Places& landmarks) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const std::string& name : names) {
    const auto found = landmarks.find(name);
    if (found == landmarks.end()) continue;
    sum += found->second;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

struct Axis {
  Eigen::Vector3d from, to;
  double thickness = 1;
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d along = to - from;
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - from - t * along).norm();
  }
};

}  // namespace

std::vector<std::string> Segment::all() const {
  std::vector<std::string> names = from;
  names.insert(names.end(), to.begin(), to.end());
  names.insert(names.end(), on.begin(), on.end());
  return names;
}

const std::vector<Segment>& bodySegments() {
  static const std::vector<Segment> segments = makeSegments();
  return segments;
}

std::vector<std::uint32_t> segmentOfPoints(const std::vector<Eigen::Vector3d>& points,
                                           const Places& landmarks) {
  std::vector<Axis> axes;
  for (const Segment& segment : bodySegments()) {
    const auto from = centre(segment.from, landmarks);
    const auto to = centre(segment.to, landmarks);
    if (!from || !to || (*to - *from).norm() < 1e-6) return {};
    Axis axis{*from, *to, 0};
    double count = 0;
    for (const std::string& name : segment.all()) {
      const auto found = landmarks.find(name);
      if (found == landmarks.end()) continue;
      axis.thickness += axis.distance(found->second);
      ++count;
    }
    axis.thickness = std::max(axis.thickness / count, 0.1 * (*to - *from).norm());
    axes.push_back(axis);
  }
  std::vector<std::uint32_t> segmentOf;
  segmentOf.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (std::uint32_t s = 0; s < axes.size(); ++s) {
      const double distance = axes[s].distance(p) / axes[s].thickness;
      if (distance < least) {
        least = distance;
        best = s;
      }
    }
    segmentOf.push_back(best);
  }
  return segmentOf;
}

std::vector<std::uint32_t> regionOfPoints(const std::vector<Eigen::Vector3d>& points,
                                          const Places& landmarks) {
  std::vector<std::uint32_t> regionOf = segmentOfPoints(points, landmarks);
  if (regionOf.empty()) return regionOf;
  const std::vector<Segment>& segments = bodySegments();
  for (std::uint32_t forearm = 0; forearm + 1 < segments.size(); ++forearm) {
    if (!segments[forearm].name.ends_with("forearm")) continue;
    const std::uint32_t hand = forearm + 1;
    const Eigen::Vector3d elbow = *centre(segments[forearm].from, landmarks);
    const Eigen::Vector3d wrist = *centre(segments[forearm].to, landmarks);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (regionOf[i] != forearm && regionOf[i] != hand) continue;
      regionOf[i] = (points[i] - wrist).dot(wrist - elbow) > 0 ? hand : forearm;
    }
  }
  return regionOf;
}

}  // namespace toile::fitting
