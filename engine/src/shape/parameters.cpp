// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/parameters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "toile/core/nearest_name.h"
#include "toile/core/units.h"

namespace toile {
namespace {

std::string withUnit(ShapeParameter::Kind kind, double value) {
  switch (kind) {
    case ShapeParameter::Kind::Length:
      return toString(Length::mm(value));
    case ShapeParameter::Kind::Angle:
      return formatExact(std::round(Angle::radians(value).degrees() * 1e6) / 1e6) + "deg";
    case ShapeParameter::Kind::Ratio:
      return toString(Ratio::of(value));
  }
  return {};
}

Result<double> parseValue(ShapeParameter::Kind kind, std::string_view text) {
  if (kind == ShapeParameter::Kind::Length) {
    const Result<Length> length = parseLength(text);
    if (!length) return length.error();
    return length->mm();
  }
  if (kind == ShapeParameter::Kind::Angle) {
    const Result<Angle> angle = parseAngle(text);
    if (!angle) return angle.error();
    return angle->radians();
  }
  const Result<Ratio> ratio = parseRatio(text);
  if (!ratio) return ratio.error();
  return ratio->value();
}

Error refusal(const std::string& what) {
  return {ErrorCode::InvalidArgument, what, {}};
}

}  // namespace

Result<ParameterValues> parseParameters(std::string_view query,
                                        std::span<const ShapeParameter> known) {
  ParameterValues values, given;
  std::vector<std::string> names;
  for (const ShapeParameter& parameter : known) {
    values.emplace(parameter.name, parameter.standard);
    names.push_back(parameter.name);
  }
  while (!query.empty()) {
    const std::string_view item = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), item.size() + 1));
    const std::string name(item.substr(0, item.find('=')));
    const auto parameter =
        std::find_if(known.begin(), known.end(), [&](const auto& p) { return p.name == name; });
    if (parameter == known.end()) {
      return refusal("there is no parameter \"" + name + "\"" + suggestion(name, names));
    }
    const std::string_view text = item.substr(std::min(item.size(), name.size() + 1));
    const Result<double> value = parseValue(parameter->kind, text);
    if (!value) return value.error().during("parameter " + name);
    if (!(*value >= parameter->least && *value <= parameter->most)) {
      return refusal("parameter " + name + " must be from " +
                     withUnit(parameter->kind, parameter->least) + " to " +
                     withUnit(parameter->kind, parameter->most) + ", not " + std::string(text));
    }
    if (!given.emplace(name, *value).second) return refusal("parameter " + name + " stands twice");
    values[name] = *value;
  }
  return values;
}

}  // namespace toile
