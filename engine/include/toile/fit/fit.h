// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/progress.h"
#include "toile/fit/scan.h"
#include "toile/model/reference_model.h"

namespace toile {

/// What a fit must keep to be called good; the defaults suit bodies and whatever is made for them.
/// Lengths given as ratios are of the diagonal of the fitted model's box (a body: about 1.9 m).
struct FitLimits {
  Ratio meanDistance = Ratio::of(0.001);    ///< scan to fit, without stray parts; and 1 mm of noise
  Ratio strayDistance = Ratio::of(0.012);   ///< and 2 mm: a scan point farther off is stray
  Ratio strayShare = Ratio::percent(2);     ///< of the scan's area that may be stray
  Ratio missingShare = Ratio::percent(12);  ///< of the fit's area, without scan: hands, feet apart
  Ratio flippedShare = Ratio::of(0.001);    ///< of the triangles that may be turned inside out
  double leastScale = 0.4;                  ///< scan to template
  double mostScale = 2.5;
};

struct FitOptions {
  /// Other shapes on the template's connectivity: what such models usually differ in. Without them
  /// smooth limbs slide by a centimetre or so along themselves, which no distance shows.
  std::vector<std::shared_ptr<const Mesh>> family = {};
  /// Places on the scan, mm, by names of the template's landmarks. Six or more place the template.
  /// Needed for postures that differ much from the template's: a segment of the body then needs
  /// three that lie on it or at its joints.
  std::map<std::string, Eigen::Vector3d> landmarks = {};
  Length landmarkError = Length::mm(5);  ///< how far they may be off: less weighs more
  bool hasMittens = false;  ///< the template's hands have no fingers, which the scan's have
  FitLimits limits = {};
};

/// Of distances in mm.
struct DistanceSummary {
  double mean = 0, median = 0, percentile95 = 0, largest = 0;
};

struct FitRegion {
  std::string name;  ///< "head", "left shank", ...; of models without body landmarks "all"
  DistanceSummary scanToFit;
  double missingShare = 0;  ///< of its area, without scan near it
};

struct FitReport {
  /// No reason stands against it. A fit with reasons must not be used without looking at it.
  [[nodiscard]] bool isOk() const { return reasons.empty(); }
  std::vector<Finding> reasons;   ///< limits that were missed, in words; the worst first
  std::vector<Finding> findings;  ///< no failure, but worth knowing

  DistanceSummary scanToFit;  ///< of all scan points that are not stray
  DistanceSummary fitToScan;  ///< of all vertices that have scan near them
  DistanceSummary landmarks;  ///< of the given landmarks to their places on the fit
  std::vector<FitRegion> regions;
  double strayShare = 0;    ///< of the scan's area, far from the fit
  double missingShare = 0;  ///< of the fit's area, far from the scan: holes, filled from the prior
  std::size_t flippedFaces = 0;
  std::size_t crossings = 0;   ///< pairs of faces of the fit; those of the template count too
  DistanceSummary roundTrip;   ///< of fit -> scan -> fit, along the surface
  double scale = 1;            ///< of the scan to the template as given
  double placementMargin = 0;  ///< how much worse the second best placement is: 1 = no better
  /// How well the mirror image of the template would lie, over how well the template does: below 1
  /// better. 1 for symmetric templates.
  double mirrorScore = 1;
  std::size_t familySize = 0;
};

struct Fit {
  /// The template's names on its connectivity, in the scan's shape and place.
  ReferenceModel model;
  /// Template to scan: rotation, one scale, shift. Its inverse stands the scan upright as the
  /// template stands.
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  FitReport report;
};

/// Brings the template's connectivity into the scan's shape.
///
/// Rigid placement from any start; then an affine deformation graph together with the family, stiff
/// to soft, on nearest points with agreeing normals; then every vertex along its normal. Where
/// the scan has a hole the shape follows from its surroundings and the family. Given landmarks of
/// a body in another posture, it starts from the template's limbs put in place by them.
/// Equal input gives equal output, for any number of threads.
///
/// @param model  closed or open; landmarks with the names of docs/body.md name the regions.
/// @return the fit, good or not: see `report`. An Error where none can be made:
///   InvalidArgument  a landmark's name, too few points or no extent
///   ModelMismatch    a family member on another connectivity
///   UnitsMissing     the scan is as large as the template only in another unit
///   Cancelled
/// @par Cost  about 2 s for 12k vertices and 130k scan points on two cores
/// @see docs/fitting.md; Amberg, Romdhani and Vetter, "Optimal Step Nonrigid ICP Algorithms for
///   Surface Registration", CVPR 2007; Sumner, Schmid and Pauly, "Embedded Deformation for Shape
///   Manipulation", ACM TOG 26(3), 2007; Allen, Curless and Popovic, "The space of human body
///   shapes", ACM TOG 22(3), 2003.
Result<Fit> fitTemplate(const ReferenceModel& model, const Scan& scan,
                        const FitOptions& options = {}, Progress* progress = nullptr);

/// Places on a scan by name: JSON {"landmarks": {"crown": [x, y, z], ...}} in mm.
Result<std::map<std::string, Eigen::Vector3d>> parseScanLandmarks(std::string_view json,
                                                                  const std::string& file);

/// The report as JSON, "toile-fit" version 1 (docs/fitting.md).
[[nodiscard]] std::string writeFitReport(const Fit& fit);

}  // namespace toile
