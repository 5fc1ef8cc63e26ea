// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "toile/core/result.h"

namespace toile {

/// A number that shapes a builtin model; mm, radians or a plain ratio.
struct ShapeParameter {
  enum class Kind { Length, Angle, Ratio };
  std::string name;  ///< as in "builtin:torso@1?bust-girth=900mm"
  Kind kind = Kind::Length;
  double standard = 0;
  double least = 0;
  double most = 0;
};

using ParameterValues = std::map<std::string, double, std::less<>>;

/// Values of "name=value&name=value"; the standard ones where nothing is said.
/// @return InvalidArgument naming the parameter: unknown (with the nearest name), said twice,
///   without unit, out of range.
Result<ParameterValues> parseParameters(std::string_view query,
                                        std::span<const ShapeParameter> known);

}  // namespace toile
