// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/carry.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "body/body_template.h"
#include "toile/body/fit_body.h"
#include "toile/curve/curvature.h"

namespace toile {

namespace {

/// Hands of scans are in any posture, and most products end before them: a share of the scan may be
/// beside the fit. Half a body or two people are far beyond.
constexpr double kStrayShare = 0.06;
constexpr double kMissingShare = 0.2;

Error missedLimits(const Fit& fit, const std::string& scan) {
  std::string reasons;
  for (const Finding& reason : fit.report.reasons) {
    reasons += (reasons.empty() ? "" : "; ") + reason.message;
  }
  return {ErrorCode::NotConverged,
          fmt::format("the model does not fit {} as it must: {}", scan, reasons),
          fit.report.reasons.front().where};
}

/// Triangles of the scan whose side is looked at.
constexpr std::size_t kSides = 2000;

/// Whether the faces of a scan look inward. Of a closed one reading says it, having turned it; of
/// one with holes the fit shows it.
bool looksInward(const Scan& scan, const Fit& fit) {
  for (const Finding& finding : scan.findings) {
    if (finding.code == "turned-surface") return true;
  }
  std::size_t seen = 0, inward = 0;
  const std::size_t step = std::max<std::size_t>(1, scan.triangles.size() / kSides);
  for (std::size_t t = 0; t < scan.triangles.size(); t += step) {
    const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& {
      return scan.points[scan.triangles[t][k].index()];
    };
    const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const ClosestPoint near =
        fit.model.index->closestPoint((corner(0) + corner(1) + corner(2)) / 3);
    ++seen;
    if (normal.dot(smoothNormal(*fit.model.mesh, near.point)) < 0) ++inward;
  }
  return 2 * inward > seen;
}

/// What reading the scan had to say, what the fit had, and what a scanner's faces may betray.
std::vector<Finding> findingsOf(const Scan& scan, const Fit& fit) {
  std::vector<Finding> findings = scan.findings;
  const std::vector<Finding>& told = fit.report.findings;
  findings.insert(findings.end(), told.begin(), told.end());
  if (looksInward(scan, fit)) {
    findings.push_back({"maybe-mirrored",
                        "the faces of the scan look inward: it may be mirrored, so that left and "
                        "right have changed places; compare it with the person",
                        {}});
  }
  return findings;
}

/// The design's model in the shape of a scan. A built-in body brings what bodies differ in along.
Result<Fit> fitModel(const ReferenceModel& model, const Scan& scan, FitOptions fitting,
                     Progress* progress) {
  if (progress != nullptr) progress->step("fit the model to " + scan.name);
  fitting.limits.strayShare = std::max(fitting.limits.strayShare, Ratio::of(kStrayShare));
  fitting.limits.missingShare = std::max(fitting.limits.missingShare, Ratio::of(kMissingShare));
  const Mesh& builtin = *body::bodyTemplate().mesh;
  if (fitting.family.empty() && model.mesh->connectivityHash() == builtin.connectivityHash()) {
    Result<BodyFit> body = fitBody(scan,
                                   {.landmarks = std::move(fitting.landmarks),
                                    .landmarkError = fitting.landmarkError,
                                    .limits = fitting.limits},
                                   progress);
    if (!body) return body.error();
    if (!body->fit.report.isOk()) return missedLimits(body->fit, scan.name);
    // The design may name more on its model than the built-in body does.
    Result<ReferenceModel> named = withMesh(model, scan.name, *body->fit.model.mesh);
    if (!named) return named.error();
    body->fit.model = *std::move(named);
    return std::move(body->fit);
  }
  Result<Fit> fit = fitTemplate(model, scan, fitting, progress);
  if (!fit) return fit.error();
  if (!fit->report.isOk()) return missedLimits(*fit, scan.name);
  return fit;
}

}  // namespace

Result<MappedModels> mapToModel(const ReferenceModel& model, const ReferenceModel& target,
                                const FitOptions& options, Progress* progress) {
  if (model.mesh->connectivityHash() == target.mesh->connectivityHash()) {
    Result<Correspondence> map = Correspondence::onOneConnectivity(model.index, target.index);
    if (!map) return map.error();
    return MappedModels{*std::move(map), std::nullopt};
  }
  Result<Fit> fit = fitModel(model, makeScan(target.name, *target.mesh), options, progress);
  if (!fit) return fit.error();
  Result<Correspondence> map =
      Correspondence::throughFit(model.index, fit->model.index, target.index);
  if (!map) return map.error();
  return MappedModels{*std::move(map), *std::move(fit)};
}

Result<CarriedDesign> carryToScan(const Document& document, const Scan& scan,
                                  const CarryOptions& options, Progress* progress) {
  Result<Fit> fit = fitModel(*document.model, scan, options.fit, progress);
  if (!fit) return fit.error();
  const auto target = std::make_shared<const ReferenceModel>(fit->model);
  const auto map = Correspondence::onOneConnectivity(document.model->index, target->index);
  if (!map) return map.error();
  Result<Transfer> transfer = transferDesign(document, target, *map, options.transfer, progress);
  if (!transfer) return transfer.error();
  std::vector<Finding> findings = findingsOf(scan, *fit);
  transfer->findings.insert(transfer->findings.begin(), findings.begin(), findings.end());
  return CarriedDesign{*std::move(transfer), *std::move(fit)};
}

Result<CarriedDesign> carryToModel(const Document& document,
                                   const std::shared_ptr<const ReferenceModel>& target,
                                   const CarryOptions& options, Progress* progress) {
  Result<MappedModels> mapped = mapToModel(*document.model, *target, options.fit, progress);
  if (!mapped) return mapped.error();
  Result<Transfer> transfer =
      transferDesign(document, target, mapped->map, options.transfer, progress);
  if (!transfer) return transfer.error();
  if (mapped->fit) {
    const std::vector<Finding>& told = mapped->fit->report.findings;
    transfer->findings.insert(transfer->findings.begin(), told.begin(), told.end());
  }
  return CarriedDesign{*std::move(transfer), std::move(mapped->fit)};
}

}  // namespace toile
