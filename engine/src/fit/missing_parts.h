// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/mesh/mesh.h"

namespace toile::fitting {

/// A connected part of a fit that has no scan near it.
struct MissingPart {
  std::vector<FaceId> faces;  ///< ascending
  double area = 0;            ///< mm2
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// How far it sticks out of where it begins: what it encloses with its openings filled flat, over
  /// the 3/2 power of their area. A flat hole 0, a half ball 0.4, a tube as long as thick 1.1 and
  /// twice as long 2.3; below 0 where it is hollow, as between two legs; infinite without openings.
  double reach = 0;
};

/// The parts, the largest first. A face belongs to one when all three vertices are marked.
[[nodiscard]] std::vector<MissingPart> findMissingParts(const Mesh& fit,
                                                        const std::vector<char>& isMissing);

}  // namespace toile::fitting
