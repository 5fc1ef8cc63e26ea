// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/judge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "fit/missing_parts.h"
#include "fit/segments.h"
#include "mesh/bounding_tree.h"
#include "mesh/triangle_queries.h"
#include "toile/core/parallel.h"
#include "toile/mesh/mesh_check.h"

namespace toile::fitting {
namespace {

/// A point of the fit farther than this from the scan has no scan near it: of the diagonal, and
/// what scans of any size leave between their points.
constexpr double kMissing = 0.006;
constexpr double kSpacing = 2;  // mm
constexpr double kNoise = 1;    // mm
/// Half the diagonal of long triangles, over the root of what a point stands for.
constexpr double kSparse = 1.5;
/// A mirror image that lies so much better is what was scanned.
constexpr double kMirrored = 0.8;
/// A second placement that is not worse than this leaves a doubt.
constexpr double kUnsure = 1.15;
/// A region of which a twentieth is that many times the mean's limit off is told.
constexpr double kRegionOff = 3;
constexpr double kJustMissed = 1.001;
/// A region of which so much has no scan is not there, and a part that reaches so far and is such a
/// share of the whole. Crowns, soles and armpits reach 0.5 at most.
constexpr double kRegionGone = 0.6;
constexpr double kReach = 1;
constexpr double kPartShare = 0.005;
/// A region of which a part that sticks out takes so much is cut off.
constexpr double kCutOff = 0.3;
/// A limb so much smaller than the other one was drawn together over a closed stump.
constexpr double kShrunk = 0.5;
/// From so much on it is told what was filled in.
constexpr double kFilledIn = 0.1;
constexpr double kPartGone = 2;  // told after a scan that is nothing of the kind

struct Foot {
  std::uint32_t face = 0;
  double distance = 0;
};

std::vector<Foot> feetOn(const Mesh& mesh, const detail::BoundingTree& tree,
                         const std::vector<Eigen::Vector3d>& points) {
  std::vector<Foot> feet(points.size());
  constexpr std::size_t kChunk = 1024;
  parallelFor((points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(points.size(), (chunk + 1) * kChunk); ++i) {
      double best = std::numeric_limits<double>::infinity();
      tree.visitNear(points[i], [&](FaceId face) {
        const auto& [a, b, c] = mesh.vertices(face);
        const Eigen::Vector3d w =
            detail::closestWeights(points[i], mesh.position(a), mesh.position(b), mesh.position(c));
        const double squared = (w[0] * mesh.position(a) + w[1] * mesh.position(b) +
                                w[2] * mesh.position(c) - points[i])
                                   .squaredNorm();
        if (squared < best || (squared == best && face.index() < feet[i].face)) {
          best = squared;
          feet[i].face = face.index();
        }
        return best;
      });
      feet[i].distance = std::sqrt(best);
    }
  });
  return feet;
}

class Judge {
 public:
  explicit Judge(const Judged& fit)
      : fit_(fit), tree_(fit.mesh), diagonal_((fit.mesh.boxMax() - fit.mesh.boxMin()).norm()) {}

  FitReport run() {
    measureScan();
    measureFit();
    measureRegions();
    countFaults();
    report_.scale = fit_.placement.similarity.scale;
    report_.placementMargin = fit_.placement.margin;
    report_.mirrorScore = fit_.placement.mirrorScore / std::max(fit_.placement.score, 1e-9);
    weighReasons();
    return std::move(report_);
  }

 private:
  void measureScan() {
    feet_ = feetOn(fit_.mesh, tree_, fit_.target.points);
    double total = 0, stray = 0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const double area = fit_.target.area[i];
      total += area;
      if (isStray(i)) {
        stray += area;
        continue;
      }
      distances_.push_back(feet_[i].distance);
      areas_.push_back(area);
    }
    report_.strayShare = total > 0 ? stray / total : 1;
    report_.scanToFit = summarise(distances_, areas_);
  }

  [[nodiscard]] bool isStray(std::size_t i) const { return feet_[i].distance > strayDistance(); }

  [[nodiscard]] double strayDistance() const {
    return kSpacing + fit_.limits.strayDistance.value() * diagonal_;
  }
  [[nodiscard]] double meanLimit() const {
    return kNoise + fit_.limits.meanDistance.value() * diagonal_;
  }

  void measureFit() {
    shape_ = makeShape(fit_.mesh.triangles(), fit_.mesh.positions());
    const std::size_t count = shape_.positions.size();
    const double gap = kSpacing + kMissing * diagonal_;
    isMissing_.assign(count, 0);
    std::vector<Eigen::Vector3d> back(count);
    std::vector<double> distances(count);
    for (std::size_t v = 0; v < count; ++v) {
      const Eigen::Vector3d& p = shape_.positions[v];
      const KdTree::Neighbour near = fit_.target.tree.nearest(p);
      const Eigen::Vector3d& n = fit_.target.normals[near.point];
      const double above = n.dot(p - fit_.target.points[near.point]);
      distances[v] = std::abs(above);
      back[v] = p - above * n;
      const double spacing = kSparse * std::sqrt(fit_.target.area[near.point]);
      isMissing_[v] = std::sqrt(near.squaredDistance) > std::max(gap, spacing) ? 1 : 0;
    }
    const std::vector<Foot> feet = feetOn(fit_.mesh, tree_, back);
    std::vector<double> kept, areas, trips;
    double missing = 0;
    for (std::size_t v = 0; v < count; ++v) {
      if (isMissing_[v] != 0) {
        missing += shape_.area[v];
        continue;
      }
      kept.push_back(distances[v]);
      areas.push_back(shape_.area[v]);
      // The way along the surface: what is left of the way to the vertex after going back.
      const auto& [a, b, c] = fit_.mesh.vertices(FaceId(feet[v].face));
      const Eigen::Vector3d w = detail::closestWeights(
          back[v], fit_.mesh.position(a), fit_.mesh.position(b), fit_.mesh.position(c));
      trips.push_back((w[0] * fit_.mesh.position(a) + w[1] * fit_.mesh.position(b) +
                       w[2] * fit_.mesh.position(c) - shape_.positions[v])
                          .norm());
    }
    report_.fitToScan = summarise(kept, areas);
    report_.roundTrip = summarise(trips, areas);
    report_.missingShare = missing / shape_.totalArea;
  }

  void measureRegions() {
    const bool isBody = !fit_.regionOfVertex.empty();
    const std::size_t regions = isBody ? bodySegments().size() : 1;
    std::vector<std::vector<double>> distances(regions), areas(regions);
    std::vector<double> total(regions, 0.0), missing(regions, 0.0);
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      if (isStray(i)) continue;
      const std::uint32_t v = fit_.mesh.vertices(FaceId(feet_[i].face))[0].index();
      const std::size_t r = isBody ? fit_.regionOfVertex[v] : 0;
      distances[r].push_back(feet_[i].distance);
      areas[r].push_back(fit_.target.area[i]);
    }
    for (std::size_t v = 0; v < shape_.area.size(); ++v) {
      const std::size_t r = isBody ? fit_.regionOfVertex[v] : 0;
      total[r] += shape_.area[v];
      if (isMissing_[v] != 0) missing[r] += shape_.area[v];
    }
    for (std::size_t r = 0; r < regions; ++r) {
      report_.regions.push_back({isBody ? bodySegments()[r].name : "all",
                                 summarise(distances[r], areas[r]),
                                 total[r] > 0 ? missing[r] / total[r] : 0});
    }
    areaOfRegion_ = std::move(total);
  }

  [[nodiscard]] std::optional<std::size_t> otherSide(std::size_t region) const {
    std::string name = report_.regions[region].name;
    if (name.starts_with("left ")) {
      name = "right " + name.substr(5);
    } else if (name.starts_with("right ")) {
      name = "left " + name.substr(6);
    } else {
      return std::nullopt;
    }
    for (std::size_t r = 0; r < report_.regions.size(); ++r) {
      if (report_.regions[r].name == name) return r;
    }
    return std::nullopt;
  }

  /// Of a body by its regions, and whatever sticks out; elsewhere by what sticks out alone.
  void findMissing() {
    std::vector<char> isGone(report_.regions.size(), 0);
    if (fit_.regionOfVertex.empty()) {
      tellMissingPlaces();
    } else {
      isGone = missingRegions();
      tellMissingRegions(isGone);
    }
    tellFilledIn(isGone);
  }

  [[nodiscard]] std::vector<char> missingRegions() const {
    std::vector<char> isGone(report_.regions.size(), 0);
    for (std::size_t r = 0; r < isGone.size(); ++r) {
      const std::optional<std::size_t> other = otherSide(r);
      const bool isShrunk = other && areaOfRegion_[r] < kShrunk * areaOfRegion_[*other];
      if (report_.regions[r].missingShare > kRegionGone || isShrunk) isGone[r] = 1;
    }
    for (const MissingPart& part : partsThatStickOut()) {
      std::vector<double> share(isGone.size(), 0.0);
      for (const FaceId f : part.faces) {
        const Triangle& t = fit_.mesh.vertices(f);
        const std::size_t r = fit_.regionOfVertex[t[0].index()];
        share[r] += faceCross(fit_.mesh.positions(), t).norm() / 2 / areaOfRegion_[r];
      }
      const double most = *std::max_element(share.begin(), share.end());
      for (std::size_t r = 0; r < isGone.size(); ++r) {
        if (share[r] >= std::min(kCutOff, most)) isGone[r] = 1;
      }
    }
    return isGone;
  }

  [[nodiscard]] std::vector<MissingPart> partsThatStickOut() const {
    std::vector<MissingPart> parts = findMissingParts(fit_.mesh, isMissing_);
    std::erase_if(parts, [&](const MissingPart& part) {
      return part.area < kPartShare * shape_.totalArea || part.reach < kReach;
    });
    return parts;
  }

  void tellMissingPlaces() {
    std::vector<std::string> places;
    for (const MissingPart& part : partsThatStickOut()) {
      places.push_back(fmt::format("a part of {:.0f} cm2 at ({:.0f}, {:.0f}, {:.0f})",
                                   part.area / 100, part.centre.x(), part.centre.y(),
                                   part.centre.z()));
    }
    if (!places.empty()) addMissing(fmt::format("{}", fmt::join(places, ", ")));
  }

  /// Clothes end at hands and feet, and scanners lose them: without these alone the fit is good.
  void tellMissingRegions(const std::vector<char>& isGone) {
    std::vector<std::string> names;
    double told = 0;
    bool isTold = true;
    for (std::size_t r = 0; r < isGone.size(); ++r) {
      if (isGone[r] == 0) continue;
      const FitRegion& region = report_.regions[r];
      names.push_back(region.name);
      told += region.missingShare * areaOfRegion_[r] / shape_.totalArea;
      isTold = isTold && (region.name.ends_with("hand") || region.name.ends_with("foot"));
    }
    if (names.empty()) return;
    const std::string all = fmt::format("the {}", fmt::join(names, ", "));
    if (!isTold) {
      addMissing(all);
      return;
    }
    toldShare_ = told;
    report_.findings.push_back(
        {"fit-missing-part",
         fmt::format("there is no scan of {}: what the fit has there is invented", all),
         {}});
  }

  void addMissing(const std::string& what) {
    add(kPartGone, "fit-missing-part",
        fmt::format("there is no scan of {}: the scan is not whole", what));
  }

  void tellFilledIn(const std::vector<char>& isGone) {
    std::vector<std::string> holes;
    for (std::size_t r = 0; r < isGone.size(); ++r) {
      const FitRegion& region = report_.regions[r];
      if (isGone[r] != 0 || region.missingShare < kFilledIn) continue;
      holes.push_back(fmt::format("{} {:.0f} %", region.name == "all" ? "model" : region.name,
                                  100 * region.missingShare));
    }
    if (holes.empty()) return;
    report_.findings.push_back(
        {"fit-filled-in",
         fmt::format("the scan has holes, which were filled in from what is around them: {}",
                     fmt::join(holes, ", ")),
         {}});
  }

  void countFaults() {
    report_.flippedFaces = turnedFaces(fit_.mesh, fit_.mesh.positions(), fit_.expected).size();
    report_.crossings = findCrossingFaces(fit_.mesh).size();
  }

  void add(double excess, std::string code, std::string message) {
    if (!(excess > 1)) return;
    reasons_.push_back({excess, {std::move(code), std::move(message), {}}});
  }

  void weighReasons() {
    const FitLimits& limits = fit_.limits;
    add(report_.strayShare / limits.strayShare.value(), "fit-stray-scan",
        fmt::format("{:.0f} % of the scan lies more than {:.0f} mm from the fit: another kind of "
                    "model, another posture, or more than one model in the file",
                    100 * report_.strayShare, strayDistance()));
    findMissing();
    add((report_.missingShare - toldShare_) / limits.missingShare.value(), "fit-missing-scan",
        fmt::format("for {:.0f} % of the model there is no scan{}; the scan is not whole",
                    100 * report_.missingShare, worstRegions()));
    add(report_.scanToFit.mean / meanLimit(), "fit-distance",
        fmt::format("the scan lies {:.1f} mm from the fit on average; {:.1f} mm is the limit",
                    report_.scanToFit.mean, meanLimit()));
    const double flipped =
        static_cast<double>(report_.flippedFaces) / static_cast<double>(fit_.mesh.faceCount());
    // Mostly it follows from another reason: it is told after them.
    add(std::min(flipped / limits.flippedShare.value(), kJustMissed), "fit-flipped-faces",
        fmt::format("{} triangles are turned inside out", report_.flippedFaces));
    const double scale = report_.scale;
    add(std::max(limits.leastScale / scale, scale / limits.mostScale), "fit-size",
        fmt::format("the scan is {:.2f} times as large as the template: another unit, or another "
                    "kind of model",
                    scale));
    add(kMirrored / std::max(report_.mirrorScore, 1e-9), "fit-mirrored",
        "the scan looks like the mirror image of the template: a left one for a right one?");
    add(fit_.placement.scanIsInsideOut && !fit_.target.isCloud ? 2 : 0, "fit-inside-out",
        "the faces of the scan look inwards: it was mirrored, or its faces are turned; "
        "`toile check --repair` tells");
    std::stable_sort(reasons_.begin(), reasons_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [excess, reason] : reasons_) report_.reasons.push_back(std::move(reason));
    if (report_.placementMargin > 0 && report_.placementMargin < kUnsure) {
      report_.findings.push_back(
          {"fit-placement-unsure",
           fmt::format("another placement lies nearly as well ({:.2f} times as far off): see that "
                       "front and back, left and right are right",
                       report_.placementMargin),
           {}});
    }
    for (const FitRegion& region : report_.regions) {
      if (region.scanToFit.percentile95 < kRegionOff * meanLimit()) continue;
      if (fit_.hasMittens && region.name.ends_with("hand")) continue;
      report_.findings.push_back(
          {"fit-region-off",
           fmt::format(
               "{}: a twentieth of the scan lies {:.0f} mm off or more; measures near it are "
               "not to be trusted, landmarks help",
               region.name, region.scanToFit.percentile95),
           {}});
    }
    if (report_.crossings > 0) {
      report_.findings.push_back(
          {"fit-crossings", fmt::format("{} pairs of faces cross", report_.crossings), {}});
    }
  }

  /// " (worst: left shank, left foot)" of regions that mostly are not there.
  [[nodiscard]] std::string worstRegions() const {
    std::string names;
    for (const FitRegion& region : report_.regions) {
      if (region.missingShare < 0.5 || region.name == "all") continue;
      names += (names.empty() ? " (" : ", ") + region.name;
    }
    return names.empty() ? "" : names + ")";
  }

  const Judged& fit_;
  detail::BoundingTree tree_;
  double diagonal_;
  FitReport report_;
  Shape shape_;
  std::vector<Foot> feet_;
  std::vector<char> isMissing_;
  std::vector<double> distances_, areas_;
  std::vector<double> areaOfRegion_;  // mm2
  double toldShare_ = 0;              // of the fit: missing hands and feet, which are no failure
  std::vector<std::pair<double, Finding>> reasons_;
};

}  // namespace

DistanceSummary summarise(const std::vector<double>& distances,
                          const std::vector<double>& weights) {
  DistanceSummary summary;
  if (distances.empty()) return summary;
  std::vector<std::size_t> order(distances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distances[a] != distances[b] ? distances[a] < distances[b] : a < b;
  });
  double total = 0, sum = 0;
  for (const std::size_t i : order) {
    total += weights[i];
    sum += weights[i] * distances[i];
  }
  summary.mean = total > 0 ? sum / total : 0;
  summary.largest = distances[order.back()];
  summary.median = summary.percentile95 = summary.largest;
  double below = 0;
  bool isMedianFound = false;
  for (const std::size_t i : order) {
    below += weights[i];
    if (!isMedianFound && below >= 0.5 * total) {
      summary.median = distances[i];
      isMedianFound = true;
    }
    if (below >= 0.95 * total) {
      summary.percentile95 = distances[i];
      break;
    }
  }
  return summary;
}

FitReport judge(const Judged& fit) {
  return Judge(fit).run();
}

}  // namespace toile::fitting
