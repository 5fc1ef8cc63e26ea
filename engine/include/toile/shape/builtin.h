// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "toile/model/reference_model.h"

namespace toile {

/// True for "builtin:...".
[[nodiscard]] bool isBuiltin(std::string_view reference);

/// Makes a model of our own: "builtin:bent-sleeve@1?length=450mm&...", "builtin:torso@1".
///
/// The connectivity of a name@version never changes; parameters change the shape. Models come with
/// landmarks, feature curves and symmetry (docs/file-format.md lists them).
/// @return NameNotFound with the names that exist; InvalidArgument for a parameter out of range.
Result<ReferenceModel> makeBuiltinModel(std::string_view reference);

[[nodiscard]] std::vector<std::string> builtinNames();

}  // namespace toile
