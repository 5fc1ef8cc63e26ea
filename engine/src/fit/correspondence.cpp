// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/fit/correspondence.h"

namespace toile {
namespace {

Result<void> checkConnectivity(const SurfaceIndex& a, const SurfaceIndex& b) {
  if (a.mesh().connectivityHash() == b.mesh().connectivityHash()) return {};
  return Error{
      ErrorCode::ModelMismatch,
      "the two shapes are not on one connectivity: no point of one is a point of the other",
      {}};
}

}  // namespace

Result<Correspondence> Correspondence::onOneConnectivity(std::shared_ptr<const SurfaceIndex> a,
                                                         std::shared_ptr<const SurfaceIndex> b) {
  if (const Result<void> same = checkConnectivity(*a, *b); !same) return same.error();
  Correspondence made;
  made.fitted_ = std::move(b);
  return made;
}

Result<Correspondence> Correspondence::throughFit(std::shared_ptr<const SurfaceIndex> a,
                                                  std::shared_ptr<const SurfaceIndex> fitted,
                                                  std::shared_ptr<const SurfaceIndex> b) {
  if (const Result<void> same = checkConnectivity(*a, *fitted); !same) return same.error();
  Correspondence made;
  made.fitted_ = std::move(fitted);
  made.b_ = std::move(b);
  return made;
}

SurfacePoint Correspondence::toB(const SurfacePoint& onA) const {
  if (!b_) return onA;
  return b_->closestPoint(position(fitted_->mesh(), onA)).point;
}

SurfacePoint Correspondence::toA(const SurfacePoint& onB) const {
  if (!b_) return onB;
  return fitted_->closestPoint(position(b_->mesh(), onB)).point;
}

}  // namespace toile
