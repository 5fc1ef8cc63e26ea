// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "edit/work_curve.h"
#include "toile/edit/edited.h"

namespace toile::detail {

/// A document that is being edited: a design to change, and what working on the surface needs.
class Sketch {
 public:
  explicit Sketch(const Document& document);

  [[nodiscard]] const Design& design() const { return design_; }
  [[nodiscard]] const ReferenceModel& model() const { return *model_; }
  [[nodiscard]] const Mesh& mesh() const { return *model_->mesh; }
  [[nodiscard]] GeodesicLinker& linker() { return linker_; }

  /// @return NameNotFound with the nearest name.
  Result<std::size_t> indexOf(const std::string& id) const;
  /// The curve whose edit an edit of this one is: itself, or the one that it mirrors.
  struct Target {
    std::string id;
    bool isMirrored = false;
  };
  Result<Target> targetOf(const std::string& id) const;
  /// A point of the model for a target: its mirror image if the target is mirrored.
  Result<SurfacePoint> forTarget(const Target& target, const SurfacePoint& point) const;
  /// Live mirror images of a curve.
  [[nodiscard]] std::vector<std::string> imagesOf(const std::string& id) const;

  /// The curve on the surface.
  Result<WorkCurve> load(const std::string& id);
  /// Makes a curve on the surface the truth of a styling curve: data points, way, closed. Where it
  /// joins its live mirror image straight over the middle, the new curve does so too.
  void store(const std::string& id, WorkCurve curve);
  StylingCurve& edit(const std::string& id);
  /// After the last curve. An empty id gets a new one; one that exists is refused.
  Result<std::string> add(StylingCurve curve);
  /// A copy without mirrorOf and data points, under a new id beside the curve it was parted from.
  std::string addBeside(const std::string& id, const std::string& newId);
  [[nodiscard]] std::string freeId(const std::string& stem) const;

  /// Takes a curve out. Mirror images of it stay as curves of their own, and what hangs on it keeps
  /// its place.
  Result<void> remove(const std::string& id);
  /// Where a place on a curve is after an edit: another curve and fraction, or nowhere.
  struct Moved {
    std::string id;
    double fraction = 0;
  };
  using Moving = std::function<std::optional<Moved>(double)>;
  /// Lets what hangs on a curve follow an edit that changes its fractions; what is nowhere any more
  /// keeps the place that it has now. To be called before the curve is changed.
  Result<void> moveHangers(const std::string& id, const Moving& moving);

  [[nodiscard]] Document document() const;

 private:
  void keepSquare(const std::string& id, WorkCurve& curve);
  Result<std::vector<SurfacePoint>> controlPlaces(const StylingCurve& curve);

  Design design_;
  std::shared_ptr<const ReferenceModel> model_;
  GeodesicLinker linker_;
};

/// Clamped to 0..1 where it may be; InvalidArgument otherwise.
Result<double> checkedFraction(double fraction);

}  // namespace toile::detail
