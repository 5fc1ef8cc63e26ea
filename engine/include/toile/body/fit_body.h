// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/body/body.h"
#include "toile/fit/fit.h"

namespace toile {

struct BodyFitOptions {
  /// As in FitOptions; those of fingers, which the body has not, are left out, with a finding.
  std::map<std::string, Eigen::Vector3d> landmarks = {};
  Length landmarkError = Length::mm(5);
  /// As for others, but that more of the scan may be stray: the body has mittens for fingers.
  FitLimits limits = {.strayShare = Ratio::percent(5)};
};

struct BodyFit {
  Fit fit;           ///< on the connectivity of builtin:body@1
  BodyOptions body;  ///< the parametric body nearest to it: form, posture, and its measures
  /// What the fit itself measures, in the order of the enumeration; nothing for other postures than
  /// the A-pose, and where landmarks may have bent it.
  std::vector<Length> measures;
};

/// The parametric body in the shape of a scan: first its measures, then its shape.
///
/// Bodies of both forms, of children, slim and stout ones are the family of a first fit; what it
/// measures makes the body that the second starts from, whose family are that body's own measures,
/// each a little larger. A scan that does not fit the A-pose is tried with arms raised, a bent
/// knee, and seated.
/// @return as fitTemplate()
/// @par Cost  about twice that of fitTemplate(); more for other postures
Result<BodyFit> fitBody(const Scan& scan, const BodyFitOptions& options = {},
                        Progress* progress = nullptr);

}  // namespace toile
