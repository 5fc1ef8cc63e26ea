// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/fit/fit.h"

#include "fit/fitter.h"

namespace toile {

Result<Fit> fitTemplate(const ReferenceModel& model, const Scan& scan, const FitOptions& options,
                        Progress* progress) {
  if (progress != nullptr) progress->step("fit: scan");
  Result<fitting::Target> target = fitting::prepareTarget(scan);
  if (!target) return target.error();
  const fitting::Fitter fitter(model, scan.name, options, progress);
  if (const Result<void> fine = fitter.check(*target); !fine) return fine.error();
  const std::optional<fitting::Draft> draft = fitter.draft(*target);
  if (!draft) return Error{ErrorCode::Cancelled, "the fit was cancelled", {}};
  return fitter.finish(*draft, *target);
}

}  // namespace toile
