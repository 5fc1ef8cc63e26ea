// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/arms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "toile/core/parallel.h"

namespace toile::fitting {
namespace {

// Of the scan's diagonal.
constexpr double kCap = 0.05;   // distances count no more than this
constexpr double kGap = 0.013;  // farther from the rest of the body than this is the limb
/// The limb may be that much longer than the template's.
constexpr double kReach = 1.3;
/// A turn is taken when it brings the limb that much nearer.
constexpr double kBetter = 0.8;
constexpr double kAgreement = 0.3;
constexpr std::size_t kSamples = 600;
constexpr int kRounds = 12;
constexpr std::size_t kFewest = 40;

struct Joint {
  std::vector<std::size_t> moved;   // segments, the one at the joint first
  std::vector<std::string> around;  // landmarks
  double most = 0;                  // degrees, of the grid
};

/// In the order in which they are turned: shoulder and elbow, left and right.
std::vector<Joint> joints() {
  std::vector<Joint> list;
  for (const auto& [first, side] : {std::pair<std::size_t, std::string>{3, "_l"}, {9, "_r"}}) {
    list.push_back({{first, first + 1, first + 2}, {"shoulder" + side, "armpit" + side}, 60});
    list.push_back({{first + 1, first + 2}, {"elbow_outer" + side, "elbow_inner" + side}, 40});
  }
  return list;
}

template <class T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t count) {
  std::vector<T> some;
  const std::size_t step = std::max<std::size_t>(1, all.size() / count);
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// One limb that turns about a joint, and the part of the scan that it should lie on.
class Limb {
 public:
  Limb(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& normals,
       const Eigen::Vector3d& joint, const Target& target, std::vector<Eigen::Vector3d> wanted)
      : points_(thinned(points, kSamples)),
        normals_(thinned(normals, kSamples)),
        joint_(joint),
        target_(target),
        wanted_(thinned(wanted, kSamples)),
        tree_(points),
        all_(points) {}

  /// Mean distance both ways, of what is turned by `turn`.
  [[nodiscard]] double miss(const Eigen::Matrix3d& turn) const {
    const double cap = kCap * target_.diagonal;
    double own = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d p = turn * (points_[i] - joint_) + joint_;
      const KdTree::Neighbour near = target_.tree.nearest(p);
      const bool agrees = target_.normals[near.point].dot(turn * normals_[i]) > kAgreement;
      own += agrees ? std::min(cap, std::sqrt(near.squaredDistance)) : cap;
    }
    double theirs = 0;
    for (const Eigen::Vector3d& q : wanted_) {
      const Eigen::Vector3d back = turn.transpose() * (q - joint_) + joint_;
      theirs += std::min(cap, std::sqrt(tree_.nearest(back).squaredDistance));
    }
    return own / static_cast<double>(points_.size()) + theirs / static_cast<double>(wanted_.size());
  }

  /// Nearest points, turning about the joint alone.
  [[nodiscard]] Eigen::Matrix3d improve(Eigen::Matrix3d turn) const {
    const double cap = kCap * target_.diagonal;
    for (int round = 0; round < kRounds; ++round) {
      Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
      const auto add = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
        const double weight =
            1 / (1 + (turn * (from - joint_) - (to - joint_)).squaredNorm() / (0.04 * cap * cap));
        cross += weight * (to - joint_) * (from - joint_).transpose();
      };
      for (const Eigen::Vector3d& q : wanted_) {
        add(all_[tree_.nearest(turn.transpose() * (q - joint_) + joint_).point], q);
      }
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const KdTree::Neighbour near = target_.tree.nearest(turn * (points_[i] - joint_) + joint_);
        if (near.squaredDistance > cap * cap ||
            target_.normals[near.point].dot(turn * normals_[i]) < kAgreement) {
          continue;
        }
        add(points_[i], target_.points[near.point]);
      }
      turn = nearestRotation(cross);
    }
    return turn;
  }

 private:
  std::vector<Eigen::Vector3d> points_, normals_;
  Eigen::Vector3d joint_;
  const Target& target_;
  std::vector<Eigen::Vector3d> wanted_;
  KdTree tree_;
  const std::vector<Eigen::Vector3d>& all_;
};

class ArmFinder {
 public:
  ArmFinder(const Shape& body, const std::vector<std::uint32_t>& segmentOf, const Places& own,
            const Eigen::Matrix3d& upright, const Target& target)
      : positions_(body.positions),
        normals_(body.normals),
        segmentOf_(segmentOf),
        places_(own),
        upright_(upright),
        target_(target),
        motions_(bodySegments().size()) {}

  std::optional<std::vector<Similarity>> run() {
    bool any = false;
    for (const Joint& joint : joints()) any = turn(joint) || any;
    if (!any) return std::nullopt;
    return std::move(motions_);
  }

 private:
  bool turn(const Joint& joint) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::string& name : joint.around) {
      const auto found = places_.find(name);
      if (found == places_.end()) return false;
      // Landmarks at a joint go with what hangs on it, when that has been turned before.
      centre += found->second / static_cast<double>(joint.around.size());
    }
    centre = motions_[joint.moved.front()].apply(centre);
    std::vector<Eigen::Vector3d> limb, limbNormals, rest;
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (isMoved(joint, v)) {
        limb.push_back(positions_[v]);
        limbNormals.push_back(normals_[v]);
      } else {
        rest.push_back(positions_[v]);
      }
    }
    if (limb.size() < kFewest) return false;
    double reach = 0;
    for (const Eigen::Vector3d& p : limb) reach = std::max(reach, (p - centre).norm());
    const KdTree others(rest);
    const double gap = kGap * target_.diagonal;
    std::vector<Eigen::Vector3d> wanted;
    const std::size_t step = 1 + target_.points.size() / 20000;
    for (std::size_t i = 0; i < target_.points.size(); i += step) {
      const Eigen::Vector3d& q = target_.points[i];
      if ((q - centre).norm() > kReach * reach) continue;
      if (others.nearest(q).squaredDistance > gap * gap) wanted.push_back(q);
    }
    if (wanted.size() < kFewest) return false;
    const Limb at(limb, limbNormals, centre, target_, std::move(wanted));
    const Eigen::Matrix3d found = search(at, joint.most);
    if (at.miss(found) > kBetter * at.miss(Eigen::Matrix3d::Identity())) return false;
    move(joint, found, centre);
    return true;
  }

  [[nodiscard]] bool isMoved(const Joint& joint, std::size_t v) const {
    return std::find(joint.moved.begin(), joint.moved.end(), segmentOf_[v]) != joint.moved.end();
  }

  /// Raised and lowered, then brought forward and back.
  [[nodiscard]] Eigen::Matrix3d search(const Limb& limb, double most) const {
    constexpr int kSteps = 4;  // each way
    constexpr std::size_t kSide = 2 * kSteps + 1;
    std::vector<Eigen::Matrix3d> turns(kSide * kSide);
    std::vector<double> misses(turns.size());
    parallelFor(turns.size(), [&](std::size_t i) {
      const double unit = most / kSteps * std::numbers::pi / 180;
      const std::size_t row = i / kSide;
      const double raise = (static_cast<double>(i % kSide) - kSteps) * unit;
      const double forward = (static_cast<double>(row) - kSteps) * unit;
      turns[i] =
          (Eigen::AngleAxisd(forward, upright_.col(2)) * Eigen::AngleAxisd(raise, upright_.col(1)))
              .toRotationMatrix();
      misses[i] = limb.miss(turns[i]);
    });
    const auto best = std::min_element(misses.begin(), misses.end()) - misses.begin();
    return limb.improve(turns[static_cast<std::size_t>(best)]);
  }

  void move(const Joint& joint, const Eigen::Matrix3d& turn, const Eigen::Vector3d& centre) {
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (!isMoved(joint, v)) continue;
      positions_[v] = turn * (positions_[v] - centre) + centre;
      normals_[v] = turn * normals_[v];
    }
    for (const std::size_t s : joint.moved) {
      motions_[s].rotation = turn * motions_[s].rotation;
      motions_[s].shift = turn * (motions_[s].shift - centre) + centre;
    }
  }

  std::vector<Eigen::Vector3d> positions_, normals_;
  const std::vector<std::uint32_t>& segmentOf_;
  const Places& places_;
  Eigen::Matrix3d upright_;
  const Target& target_;
  std::vector<Similarity> motions_;
};

}  // namespace

std::optional<std::vector<Similarity>> findArms(const Shape& body,
                                                const std::vector<std::uint32_t>& segmentOf,
                                                const Places& own, const Eigen::Matrix3d& upright,
                                                const Target& target) {
  if (segmentOf.empty()) return std::nullopt;
  return ArmFinder(body, segmentOf, own, upright, target).run();
}

}  // namespace toile::fitting
