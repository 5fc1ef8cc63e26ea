// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>

#include "toile/curve/fairing.h"
#include "toile/edit/edited.h"

namespace toile {

struct FairCurvesOptions {
  FairingOptions fairing;
  FairEnd ends = FairEnd::Clamped;  ///< of lines that end on no other line
  bool keepCrossings = false;       ///< crossings stay where they are; else they move along
  /// The same curves on the model they come from: each keeps as many bends as it has there.
  const Document* source = nullptr;
  std::map<std::string, int> inflections;  ///< by hand, by id; before the source
};

/// How a curve was before and after, for people to judge.
struct FairedCurve {
  std::string id;
  Length wavelength;  ///< ripples shorter than this were taken out
  int inflectionsBefore = 0, inflectionsAfter = 0;
  double variationBefore = 0, variationAfter = 0;  ///< of geodesic curvature, 1/mm
  Length deviation;
};

struct FairedDocument {
  Document document;
  std::vector<FairedCurve> curves;
  std::vector<Finding> findings;
};

/// Fairs curves on the surface, all at once (curve/fairing.h). Crossings, among them and with
/// curves that are not named, are shared before and after; the latter keep their place. Where
/// ripples let two lines meet three times and more within `maxDeviation`, they cross once (an even
/// number: twice) afterwards. Corners stay corners, in their place unless they are crossings. Live
/// mirror images follow, and halves that meet them keep doing so smoothly.
/// @return CurveInvalid when everything is fixed, NameNotFound.
Result<FairedDocument> fairCurves(const Document& document, std::span<const std::string> curves,
                                  const FairCurvesOptions& options = {});

}  // namespace toile
