// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "toile/curve/stroke.h"
#include "toile/edit/edited.h"

namespace toile {

/// What a new curve is.
struct NewCurve {
  std::string id;  ///< empty: "line", "line-2", ...
  std::string name;
  CurveKind kind = CurveKind::Seam;
};

struct PencilOptions {
  std::optional<Length> tolerance;  ///< of fitting; absent: 1/400 of the height of the view
  std::optional<bool> closed;       ///< absent: as drawn
};

/// A freehand stroke on the view becomes a curve (curve/stroke.h). Where it leaves the outline or
/// passes to another limb it is cut: one curve for each run on the surface, and a finding
/// "cut-at-silhouette" or "cut-at-other-part" that says where.
/// @return LeavesSilhouette when nothing of it lies on the model; CurveInvalid for what is no
/// stroke.
Result<Edited> drawStroke(const Document& document, const View& view,
                          std::span<const StrokeSample> stroke, const NewCurve& curve = {},
                          const PencilOptions& options = {});
/// Goes on with a curve from the end nearest to where the stroke begins.
Result<Edited> continueStroke(const Document& document, const std::string& curve, const View& view,
                              std::span<const StrokeSample> stroke,
                              const PencilOptions& options = {});
/// Draws a part of a curve anew: the stretch between the places nearest to the ends of the stroke
/// is replaced by it. Of a closed curve, the side on which the stroke lies.
Result<Edited> drawOver(const Document& document, const std::string& curve, const View& view,
                        std::span<const StrokeSample> stroke, const PencilOptions& options = {});

/// A curve by control points on the view plane (which may be moved there before). Cut as a stroke
/// is.
Result<Edited> drawInView(const Document& document, const ViewWay& way, bool closed,
                          const NewCurve& curve = {});
/// A smooth curve through points of the surface; or the shortest way from each to the next.
Result<Edited> drawThrough(const Document& document, std::span<const SurfacePoint> points,
                           bool closed, const NewCurve& curve = {});
Result<Edited> drawShortest(const Document& document, std::span<const SurfacePoint> points,
                            const NewCurve& curve = {});
/// The loop through a point of the section square to the normal.
Result<Edited> drawGirth(const Document& document, const SurfacePoint& through,
                         const Eigen::Vector3d& normal, const NewCurve& curve = {});
/// A dart from a place on a curve (the nearest to the apex, if none is given), straight over the
/// surface. It goes on hanging on the curve.
Result<Edited> drawDart(const Document& document, const std::string& edge, const SurfacePoint& apex,
                        std::optional<double> at = std::nullopt, const NewCurve& curve = {});
/// Along a curve of the model.
Result<Edited> drawAlongModelCurve(const Document& document, const std::string& name,
                                   const Stretch& stretch, const NewCurve& curve = {});
/// Along mesh edges, the shortest way between each two of the vertices.
Result<Edited> drawAlongEdges(const Document& document, std::span<const VertexId> vertices,
                              const NewCurve& curve = {});

}  // namespace toile
