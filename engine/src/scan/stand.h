// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fit/placement.h"
#include "toile/core/progress.h"
#include "toile/model/reference_model.h"

namespace toile::scanning {

/// The parametric body laid on a scan.
struct Stand {
  ReferenceModel body;
  fitting::Placement placement;  ///< body to scan

  /// Nothing else that was tried comes near: people in the body's postures score below 0.3,
  /// furniture, toys, feet and hands above 0.5.
  [[nodiscard]] bool isPerson() const { return placement.score < kMostScore; }
  [[nodiscard]] double height() const;
  /// Nearness to the body: farther points are no part of it.
  [[nodiscard]] bool isNear(const Eigen::Vector3d& p) const;
  /// "left foot, below": the part of the body and the side of it that looks that way, both in the
  /// scan's frame.
  [[nodiscard]] std::string describe(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const;

  static constexpr double kMostScore = 0.42;
};

/// The body in the posture that lies on the scan best.
[[nodiscard]] Result<Stand> findStand(const fitting::Target& target, const Progress* progress);

/// "front", "left", "above", ... : where a direction points for what faces -y with z up.
[[nodiscard]] std::string nameOfDirection(const Eigen::Vector3d& direction);

}  // namespace toile::scanning
