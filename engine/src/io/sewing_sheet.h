// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/body_view.h"
#include "toile/sew/sewing.h"

namespace toile {

struct FabricUse {
  std::string name;  ///< "" where the design names none
  int pieces = 0;    ///< counted as often as they are cut
  double area = 0;   ///< mm^2, of the cut lines
};

/// What the sewing sheet tells, for both its forms.
struct SewingSheet {
  std::string title;
  SewingPlan plan;
  std::vector<FabricUse> fabrics;
  std::vector<double> area;    ///< mm^2, per pattern piece, inside its cut line
  std::vector<double> length;  ///< mm, of its cut line
  BodyViews body;
  std::vector<LengthLine> contract;
  std::string inputs;  ///< hash
};
[[nodiscard]] SewingSheet sewingSheet(const Pattern& pattern);

/// Both forms of a sheet that is made once.
[[nodiscard]] std::string writeSewingHtml(const Pattern& pattern, const SewingSheet& sheet,
                                          std::string_view coverPng);
[[nodiscard]] Result<std::string> writeSewingPdf(const Pattern& pattern, const SewingSheet& sheet,
                                                 std::string_view coverPng);

/// What to do in a step, for people: "close the dart", ...
[[nodiscard]] const char* describe(SewStep::Kind kind);

/// Name of a styling curve; its id where it has none.
[[nodiscard]] std::string curveName(const Pattern& pattern, const std::string& id);

/// "1 h 25 min"
[[nodiscard]] std::string describeMinutes(double minutes);

}  // namespace toile
