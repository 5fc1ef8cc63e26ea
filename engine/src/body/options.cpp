// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "toile/body/body.h"
#include "toile/body/sizes.h"
#include "toile/core/nearest_name.h"

namespace toile {
namespace {

Result<double> parseShare(std::string_view text) {
  const Result<Ratio> ratio = parseRatio(text);
  if (!ratio) return ratio.error();
  return ratio->value();
}

Result<double> parseForm(std::string_view text) {
  if (text == "female") return 0.0;
  if (text == "male") return 1.0;
  const Result<double> share = parseShare(text);
  if (share) return *share;
  return Error{ErrorCode::InvalidArgument,
               "\"" + std::string(text) + "\" is no form; say female, male or a ratio such as 30%",
               {}};
}

}  // namespace

std::vector<std::string> bodyOptionNames() {
  std::vector<std::string> names;
  for (const BodyMeasureInfo& info : bodyMeasures()) names.emplace_back(info.name);
  for (const char* name : {"form", "childlike", "posture", "size"}) names.emplace_back(name);
  return names;
}

Result<void> setBodyOption(BodyOptions& options, std::string_view name, std::string_view text) {
  const std::string where = "option " + std::string(name);
  if (name == "form") {
    const Result<double> form = parseForm(text);
    if (!form) return form.error().during(where);
    options.masculine = *form;
    return {};
  }
  if (name == "childlike") {
    const Result<double> share = parseShare(text);
    if (!share) return share.error().during(where);
    options.childlike = *share;
    return {};
  }
  if (name == "posture") {
    const Result<Posture> posture = parsePosture(text);
    if (!posture) return posture.error().during(where);
    options.posture = *posture;
    return {};
  }
  if (name == "size") {
    const Result<BodySize> size = findSize(standardSizes(), text);
    if (!size) return size.error().during(where);
    const Posture posture = options.posture;
    BodyOptions sized = size->options;
    for (const auto& [measure, length] : options.measures) sized.measures[measure] = length;
    options = sized;
    options.posture = posture;
    return {};
  }
  const auto found = std::find_if(bodyMeasures().begin(), bodyMeasures().end(),
                                  [&](const BodyMeasureInfo& info) { return info.name == name; });
  if (found == bodyMeasures().end()) {
    return Error{ErrorCode::InvalidArgument,
                 "a body has no measure \"" + std::string(name) + "\"" +
                     suggestion(std::string(name), bodyOptionNames()),
                 {}};
  }
  const Result<Length> length = parseLength(text);
  if (!length) return length.error().during(where);
  options.measures[found->measure] = *length;
  return {};
}

}  // namespace toile
