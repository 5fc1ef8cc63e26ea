// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/coarse.h"
#include "fit/placement.h"
#include "fit/posture.h"
#include "fit/segments.h"
#include "fit/target.h"
#include "fit/untangle.h"
#include "toile/fit/fit.h"

namespace toile::fitting {

/// makeTarget(), or why that is none.
[[nodiscard]] Result<Target> prepareTarget(const Scan& scan);

/// A template near a scan, but for details: what the coarse step leads to.
struct Draft {
  Placement placement;
  CoarseProblem problem;
  CoarseFit coarse;
};

/// How far a draft is from being a fit: shares of the scan's area far from it, and of its own area
/// far from the scan.
struct Misfit {
  double strayShare = 0, missingShare = 0;
};

/// The steps of fitTemplate(), for those who fit several templates of one connectivity to a scan.
class Fitter {
 public:
  /// Keeps references to everything.
  Fitter(const ReferenceModel& model, const std::string& scanName, const FitOptions& options,
         Progress* progress)
      : model_(model),
        mesh_(*model.mesh),
        scanName_(scanName),
        options_(options),
        progress_(progress) {}

  /// Names, connectivities, units.
  [[nodiscard]] Result<void> check(const Target& target) const;

  /// From any placement. Turns the target's normals outwards. Nothing when cancelled.
  [[nodiscard]] std::optional<Draft> draft(Target& target) const;

  /// From where another template of the same connectivity came to lie: only what is new is sought.
  [[nodiscard]] std::optional<Draft> draftFrom(const Draft& near, const Target& target) const;

  [[nodiscard]] Misfit misfit(const Draft& draft, const Target& target) const;

  /// The last details, and judgement.
  [[nodiscard]] Result<Fit> finish(const Draft& draft, const Target& target) const;

 private:
  void step(std::string_view name) const;
  [[nodiscard]] Placement findPlacement(const Target& target) const;
  [[nodiscard]] Shape placed(const Similarity& similarity) const;
  [[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> familyAround(const Shape& rest) const;
  void pose(const Placement& placement, const Target& target, CoarseProblem& problem) const;
  void take(Posed posed, CoarseProblem& problem) const;
  [[nodiscard]] std::vector<Pin> landmarkPins() const;
  [[nodiscard]] Pin pinAt(const std::string& landmark) const;
  [[nodiscard]] Expectation expect(const Draft& draft) const;

  const ReferenceModel& model_;
  const Mesh& mesh_;
  const std::string& scanName_;
  const FitOptions& options_;
  Progress* progress_;
};

}  // namespace toile::fitting
