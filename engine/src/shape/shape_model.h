// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "toile/model/reference_model.h"

namespace toile {

/// A kind of model that we generate: builtin:<name>@<version>.
struct BuiltinShape {
  std::string name;  ///< "bent-sleeve@1"
  /// From "name=value&name=value"; errors name the parameter.
  Result<ReferenceModel> (*make)(std::string_view query);
};

const BuiltinShape& bentSleeve();
const BuiltinShape& torso();
const BuiltinShape& parametricBody();

}  // namespace toile
