// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "support/result_printing.h"
#include "toile/curve/crossing.h"
#include "toile/design/design.h"
#include "toile/shape/builtin.h"

/// What tests of edits look at.
namespace toile::test {

inline Document documentOn(ReferenceModel model) {
  return {std::make_shared<const Design>(),
          std::make_shared<const ReferenceModel>(std::move(model))};
}
inline Document documentOn(const std::string& builtin) {
  Result<ReferenceModel> model = makeBuiltinModel(builtin);
  EXPECT_TRUE(model) << model.error();
  return documentOn(*std::move(model));
}
/// The nearest surface point to a place.
inline SurfacePoint near(const Document& document, const Eigen::Vector3d& place) {
  return document.model->index->closestPoint(place).point;
}
inline Eigen::Vector3d placeOf(const Document& document, const SurfacePoint& point) {
  return position(*document.model->mesh, point);
}
inline const StylingCurve& curveOf(const Document& document, const std::string& id) {
  const auto& curves = document.design->curves;
  const auto found = std::find_if(curves.begin(), curves.end(),
                                  [&](const StylingCurve& curve) { return curve.id == id; });
  EXPECT_NE(found, curves.end()) << id;
  return *found;
}
/// The curve on the surface.
inline SurfacePath pathOf(const Document& document, const std::string& id) {
  GeodesicLinker linker(document.model->mesh);
  const auto placed = placeCurves(*document.design, *document.model, std::span(&id, 1), linker);
  EXPECT_TRUE(placed) << placed.error();
  return placed ? placed->front().path : SurfacePath{};
}

}  // namespace toile::test
