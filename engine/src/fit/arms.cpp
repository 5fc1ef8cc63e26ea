// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/arms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fit/wrist.h"
#include "toile/core/parallel.h"

namespace toile::fitting {
namespace {

// Of the scan's diagonal.
constexpr double kCap = 0.05;  // distances count no more than this
constexpr double kEdgeStep = 0.002;
constexpr double kGap = 0.013;  // farther from the rest of the body than this is the limb
/// The limb may be that much longer than the template's.
constexpr double kReach = 1.3;
/// A turn is taken when it brings the limb that much nearer.
constexpr double kBetter = 0.8;
constexpr double kAgreement = 0.3;
constexpr std::size_t kSamples = 600;
constexpr int kRounds = 12;
constexpr std::size_t kFewest = 40;

/// An arm or a hand is stretched by no more than this.
constexpr double kLeastStretch = 0.8;
constexpr double kMostStretch = 1.25;
constexpr double kMostHandStretch = 1.6;  // mittens have no fingers
/// A hand whose length is less off finds the scan's in the later steps, and pulls the arm along.
constexpr double kSameHand = 0.2;
constexpr double kFingertip = 0.995;  // of the hand's points are nearer to the wrist

struct Joint {
  std::vector<std::size_t> moved;   // segments, the one at the joint first
  std::vector<std::string> around;  // landmarks
  double most = 0;                  // degrees, of the grid
};

struct Arm {
  std::string side;
  std::size_t first;  // segment: upper arm, forearm, hand
  [[nodiscard]] Joint shoulder() const {
    return {{first, first + 1, first + 2}, {"shoulder" + side, "armpit" + side}, 60};
  }
  [[nodiscard]] Joint elbow() const {
    return {{first + 1, first + 2}, {"elbow_outer" + side, "elbow_inner" + side}, 40};
  }
  [[nodiscard]] Joint wrist() const {
    return {{first + 2}, {"wrist_thumb" + side, "wrist_little" + side}, 40};
  }
};

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
        arms_{std::vector<Similarity>(bodySegments().size()), {}} {}

  std::optional<Arms> run() {
    bool any = false;
    for (const Arm& arm : {Arm{"_l", 3}, Arm{"_r", 9}}) {
      any = turn(arm.shoulder()) || any;
      any = turn(arm.elbow()) || any;
      any = reachWrist(arm) || any;
    }
    if (!any) return std::nullopt;
    return std::move(arms_);
  }

 private:
  /// Middle of the landmarks of a joint, which go with what hangs on it.
  [[nodiscard]] std::optional<Eigen::Vector3d> centreOf(const Joint& joint) const {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::string& name : joint.around) {
      const auto found = places_.find(name);
      if (found == places_.end()) return std::nullopt;
      centre += found->second / static_cast<double>(joint.around.size());
    }
    return arms_.motions[joint.moved.front()].apply(centre);
  }

  /// Stretches the arm to the scan's wrist and the hand to its fingertips, where a hand of another
  /// kind (a mitten) would not find them.
  bool reachWrist(const Arm& arm) {
    const auto shoulder = centreOf(arm.shoulder());
    const auto elbow = centreOf(arm.elbow());
    const auto wrist = centreOf(arm.wrist());
    if (!shoulder || !elbow || !wrist || !places_.contains(tipName(arm))) return false;
    const Forearm forearm{*elbow, *wrist};
    const std::vector<Eigen::Vector3d> points = pointsOf(arm);
    const std::optional<double> along = wristAlong(forearm, points);
    if (!along) return false;
    const double own = (*elbow - *shoulder).norm() + forearm.length();
    const double longer = (own + *along - forearm.length()) / own;
    const double reach = reachOf(points, forearm, *along);
    if (std::abs(reach / (tipOf(arm) - *wrist).norm() - 1) < kSameHand) return false;
    stretch(arm.shoulder(), *shoulder, longer, kMostStretch);
    turn(arm.wrist());
    const Eigen::Vector3d there = *centreOf(arm.wrist());
    const Eigen::Vector3d hand = tipOf(arm) - there;
    stretch(arm.wrist(), there, reach / hand.norm(), kMostHandStretch);
    for (const std::string& name : arm.wrist().around) {
      arms_.levels.push_back({name, forearm.axis()});
    }
    arms_.levels.push_back({tipName(arm), hand.normalized()});
    return true;
  }

  static std::string tipName(const Arm& arm) { return "middle_tip" + arm.side; }
  [[nodiscard]] Eigen::Vector3d tipOf(const Arm& arm) const {
    return arms_.motions[arm.first + 2].apply(places_.at(tipName(arm)));
  }

  /// How far the scan's fingers reach from its wrist, mm.
  static double reachOf(const std::vector<Eigen::Vector3d>& points, const Forearm& forearm,
                        double wristAlong) {
    const Eigen::Vector3d wrist = forearm.elbow + wristAlong * forearm.axis();
    std::vector<double> reaches;
    for (const Eigen::Vector3d& p : points) {
      if ((p - wrist).dot(forearm.axis()) > 0) reaches.push_back((p - wrist).norm());
    }
    return quantile(std::move(reaches), kFingertip);
  }

  /// The scan's points to which the arm is nearer than the rest of the body.
  [[nodiscard]] std::vector<Eigen::Vector3d> pointsOf(const Arm& arm) const {
    const KdTree tree(positions_);
    std::vector<Eigen::Vector3d> points;
    Eigen::AlignedBox3d box;
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (isMoved(arm.shoulder(), v)) box.extend(positions_[v]);
    }
    const Eigen::Vector3d room = Eigen::Vector3d::Constant(kCap * target_.diagonal);
    box.extend(Eigen::Vector3d(box.min() - room)).extend(Eigen::Vector3d(box.max() + room));
    const auto add = [&](const Eigen::Vector3d& p) {
      if (box.contains(p) && isMoved(arm.shoulder(), tree.nearest(p).point)) points.push_back(p);
    };
    for (const Eigen::Vector3d& p : target_.points) add(p);
    // Along the edges of large triangles, which are as good as points.
    const double step = kEdgeStep * target_.diagonal;
    for (const Triangle& t : target_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d& a = target_.points[t[k].index()];
        const Eigen::Vector3d& b = target_.points[t[(k + 1) % 3].index()];
        if (!box.contains(a) || !box.contains(b)) continue;
        const auto parts = static_cast<int>((b - a).norm() / step);
        for (int i = 1; i < parts; ++i) add(a + static_cast<double>(i) / parts * (b - a));
      }
    }
    return points;
  }

  bool turn(const Joint& joint) {
    const auto joined = centreOf(joint);
    if (!joined) return false;
    const Eigen::Vector3d& centre = *joined;
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
    moveBy({turn, 1, centre - turn * centre}, joint);
  }
  void stretch(const Joint& joint, const Eigen::Vector3d& centre, double factor, double most) {
    factor = std::clamp(factor, kLeastStretch, most);
    moveBy({Eigen::Matrix3d::Identity(), factor, (1 - factor) * centre}, joint);
  }
  void moveBy(const Similarity& motion, const Joint& joint) {
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      if (!isMoved(joint, v)) continue;
      positions_[v] = motion.apply(positions_[v]);
      normals_[v] = motion.rotation * normals_[v];
    }
    for (const std::size_t s : joint.moved) {
      Similarity& at = arms_.motions[s];
      at = {motion.rotation * at.rotation, motion.scale * at.scale, motion.apply(at.shift)};
    }
  }

  std::vector<Eigen::Vector3d> positions_, normals_;
  const std::vector<std::uint32_t>& segmentOf_;
  const Places& places_;
  Eigen::Matrix3d upright_;
  const Target& target_;
  Arms arms_;
};

}  // namespace

std::optional<Arms> findArms(const Shape& body, const std::vector<std::uint32_t>& segmentOf,
                             const Places& own, const Eigen::Matrix3d& upright,
                             const Target& target) {
  if (segmentOf.empty()) return std::nullopt;
  return ArmFinder(body, segmentOf, own, upright, target).run();
}

}  // namespace toile::fitting
