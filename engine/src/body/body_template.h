// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "body/form.h"
#include "toile/model/reference_model.h"

namespace toile::body {

/// The standard woman in A-pose with all names: what every other body takes its connectivity,
/// curves, landmarks and pairing from.
const ReferenceModel& bodyTemplate();

/// Positions of the mesh from the cage of the surface: exactly symmetric, the floor at z = 0.
std::vector<Eigen::Vector3d> meshPositions(const Points& cage);

}  // namespace toile::body
