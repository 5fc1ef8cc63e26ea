// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/model/reference_model.h"

namespace toile::cli {

/// A place on or near a model: the name of a landmark, or "x,y,z" in mm.
Result<Eigen::Vector3d> findPlace(const ReferenceModel& model, const std::string& text);

}  // namespace toile::cli
