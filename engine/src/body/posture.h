// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "body/subdivision.h"
#include "toile/body/body.h"

namespace toile::body {

/// Bends a body in A-pose at its joints: each vertex turns about a joint by its share of the
/// joint's angle, so that what lies beside a joint keeps its distance from it and does not
/// collapse. The shares grow smoothly along limbs, over more than 1.5 x angle x radius, which is
/// when the inner side of a bend would fold.
///
/// @param places of the refined net's vertices, exactly symmetric; mm
/// @return the same in the posture, standing or sitting on z = 0; exactly symmetric but for
///   KneeBent, which bends the left leg.
std::vector<Eigen::Vector3d> inPosture(std::vector<Eigen::Vector3d> places, Posture posture);

}  // namespace toile::body
