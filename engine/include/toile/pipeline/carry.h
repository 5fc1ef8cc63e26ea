// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "toile/core/progress.h"
#include "toile/fit/fit.h"
#include "toile/transfer/transfer.h"

namespace toile {

struct CarryOptions {
  TransferOptions transfer;
  FitOptions fit;  ///< without a family a built-in body is fitted by fitBody()
};

/// A design on the shape of a scan.
struct CarriedDesign {
  Transfer transfer;
  std::optional<Fit> fit;  ///< nothing where the body has the design's own connectivity
};

/// The map from model to model.
struct MappedModels {
  Correspondence map;
  std::optional<Fit> fit;  ///< nothing where they have one connectivity
};

/// Exact between models of one connectivity; otherwise the first is fitted to the other.
/// @return NotConverged when the fit misses its limits, with the reasons; the errors of
///   fitTemplate().
Result<MappedModels> mapToModel(const ReferenceModel& model, const ReferenceModel& target,
                                const FitOptions& options = {}, Progress* progress = nullptr);

/// Fits the design's model to a scan and carries the design over to the fitted shape: closed, on
/// the connectivity that the design knows, without the scan's holes and noise. The findings begin
/// with those of the scan and of the fit, and maybe-mirrored where its faces look inward.
/// @return NotConverged when the fit misses its limits, with the reasons; the errors of
///   fitTemplate() and transferDesign().
Result<CarriedDesign> carryToScan(const Document& document, const Scan& scan,
                                  const CarryOptions& options = {}, Progress* progress = nullptr);

/// The same onto the surface of a model itself, by way of a fit, whose findings come first, where
/// its connectivity is another.
Result<CarriedDesign> carryToModel(const Document& document,
                                   const std::shared_ptr<const ReferenceModel>& target,
                                   const CarryOptions& options = {}, Progress* progress = nullptr);

}  // namespace toile
