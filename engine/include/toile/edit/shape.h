// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "toile/curve/tracking.h"
#include "toile/edit/edited.h"

namespace toile {

/// A point by which a stretch of a curve can be pulled.
struct Handle {
  double at = 0;  ///< fraction of the curve
  SurfacePoint point;
  bool isControl = false;  ///< a control point; otherwise an even sample
};

/// The handles of a stretch: its control points; where it has none, four to six even samples by arc
/// length, more where it bends more. The ends of an open curve are handles of a stretch that
/// reaches them.
Result<std::vector<Handle>> handlesOf(const Document& document, const std::string& curve,
                                      const Stretch& stretch = {});

/// One gesture of editing a curve in 3D (the article's "styling curve editing").
///
/// The handle follows the cursor over the surface without jumping to another limb, and what lies
/// between the handles follows it: a smooth displacement, put on the surface and linked again,
/// denser where the stretch grows. Ends of the stretch keep place and tangent; everything outside,
/// and everything beyond the neighbouring handles that does not move, stays bit for bit. Each move
/// starts from the curve as it was when the gesture began, so that no error gathers.
///
/// An end of a curve that lies on another curve slides along it. A handle that several curves share
/// takes them all along.
class CurveDrag {
 public:
  /// @param handle index into handlesOf()
  /// @return NameNotFound, InvalidArgument, or why the curve cannot be put on the model.
  static Result<CurveDrag> begin(const Document& document, const std::string& curve,
                                 const Stretch& stretch, std::size_t handle);
  ~CurveDrag();
  CurveDrag(CurveDrag&&) noexcept;
  CurveDrag& operator=(CurveDrag&&) noexcept;

  /// @return an Error, with the curve as it was before this move.
  /// @par Cost  the triangles around the stretch; see bench/edit_bench.cpp
  Result<void> moveTo(const Eigen::Vector3d& place);
  Result<void> moveUnder(const Ray& ray);
  /// To a point of the surface itself.
  Result<void> moveOnto(const SurfacePoint& point);

  /// The handle now, on the curve that was taken (the mirror image, if that one was).
  [[nodiscard]] SurfacePoint handle() const;
  /// The curve now, or the original of the mirror image that was taken.
  [[nodiscard]] SurfacePath path() const;
  /// The whole document with the curve as it is now, and the curves that share its points.
  Result<Document> document() const;

 private:
  struct State;
  explicit CurveDrag(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A gesture in one call: the handle goes to a point of the surface.
Result<Document> moveHandle(const Document& document, const std::string& curve,
                            const Stretch& stretch, std::size_t handle, const SurfacePoint& to);

/// Makes a place on the curve a control point. Its shape does not change.
Result<Document> insertControl(const Document& document, const std::string& curve, double at);
/// Takes the nearest control point (within `within` mm of the place at the fraction) out; the curve
/// there runs smoothly between its neighbours.
Result<Document> removeControl(const Document& document, const std::string& curve, double at,
                               Length within = Length::mm(10));

}  // namespace toile
