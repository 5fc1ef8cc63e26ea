// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "finish/polygon.h"
#include "toile/sew/sewing.h"

namespace toile {

/// The pieces as they sit on the model, seen from in front or from behind; mm, y up.
struct BodyView {
  std::vector<std::vector<Points2>> lines;     ///< per pattern piece: what is seen of its outline
  std::vector<std::vector<Points2>> outlines;  ///< per pattern piece: its loops, to fill
  Box2 box;
};

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
  std::vector<char> isBehind;  ///< per pattern piece: seen better from behind
  BodyView front, back;
  std::vector<LengthLine> contract;
  std::string inputs;  ///< hash
};
[[nodiscard]] SewingSheet sewingSheet(const Pattern& pattern);

/// What to do in a step, for people: "close the dart", ...
[[nodiscard]] const char* describe(SewStep::Kind kind);

/// Name of a styling curve; its id where it has none.
[[nodiscard]] std::string curveName(const Pattern& pattern, const std::string& id);

/// "1 h 25 min"
[[nodiscard]] std::string describeMinutes(double minutes);

}  // namespace toile
