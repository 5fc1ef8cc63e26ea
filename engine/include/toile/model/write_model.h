// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/model/reference_model.h"

namespace toile {

/// The text of a `*.model.json` with the model's curves, landmarks and symmetry in it
/// (docs/file-format.md); readModel() gives the same names back.
/// @param meshFile where its mesh will be, relative to this file
[[nodiscard]] std::string writeModelFile(const ReferenceModel& model, const std::string& meshFile);

}  // namespace toile
