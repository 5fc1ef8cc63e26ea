// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/transfer/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "edit/parts.h"
#include "toile/core/parallel.h"
#include "toile/curve/curvature.h"
#include "toile/cut/cut.h"
#include "toile/edit/fair.h"
#include "toile/transfer/names.h"
#include "transfer/border.h"
#include "transfer/live_images.h"
#include "transfer/network.h"
#include "transfer/records.h"
#include "transfer/spikes.h"

namespace toile {

using detail::CurveNetwork;
using detail::Sketch;
using detail::WorkCurve;

namespace {

/// Bends are counted on as many even samples of a curve, on either model.
constexpr std::size_t kSamples = 100;
/// The variation of curvature, times the length, may be so much greater than on its own model: what
/// facets of the mesh make of it.
constexpr double kMoreRestless = 1.5;
constexpr double kRestlessFacets = 5;
/// Then nothing is faired.
constexpr int kMaxRounds = 3;

Error cancelled() {
  return {ErrorCode::Cancelled, "stopped before the end; nothing was carried over", {}};
}

Restlessness restlessness(const Mesh& mesh, const SurfacePath& path) {
  return measureRestlessness(sampleCurvature(mesh, path, kSamples), path.closed);
}

/// Whether the other shape made a curve more restless than it is on its own model.
bool isRestless(const TransferredCurve& curve) {
  const double before = curve.variationBefore * curve.lengthBefore.mm();
  const double carried = curve.variationCarried * curve.lengthCarried.mm();
  return curve.bendsCarried > curve.bendsBefore ||
         carried > kMoreRestless * before + kRestlessFacets;
}

/// @param curve as it is drawn: of an image, its original
/// @param report of the curve itself, carried over
TransferredCurve::Fairing fairingOf(const StylingCurve& curve, const TransferredCurve& report,
                                    const TransferOptions& options) {
  using Fairing = TransferredCurve::Fairing;
  if (!options.fair) return Fairing::None;
  if (std::find(options.keep.begin(), options.keep.end(), curve.id) != options.keep.end()) {
    return Fairing::Kept;
  }
  if (std::holds_alternative<ShortestWay>(curve.way)) return Fairing::Angular;
  const bool isOnModelCurve =
      !std::holds_alternative<SmoothWay>(curve.way) && !std::holds_alternative<ViewWay>(curve.way);
  if (isOnModelCurve && !isCut(curve.kind)) return Fairing::Anatomical;
  return isRestless(report) ? Fairing::Faired : Fairing::Calm;
}

/// What says on the other model how the curve was drawn. `controls` are those of its data points.
CurveWay carriedWay(const CurveWay& own, const SmoothWay& controls,
                    const std::vector<ModelPoint>& data) {
  if (std::holds_alternative<AlongModelCurve>(own)) return own;
  if (std::holds_alternative<ShortestWay>(own)) return ShortestWay{controls.controls, {}};
  if (std::holds_alternative<AlongSection>(own) || std::holds_alternative<AlongVertices>(own)) {
    ShortestWay way;
    way.controls = {data.front(), data[data.size() / 2], data.back()};
    return way;
  }
  return controls;
}

class Carrier {
 public:
  Carrier(const Document& document, std::shared_ptr<const ReferenceModel> target,
          const Correspondence& map, const TransferOptions& options)
      : source_(document), target_(std::move(target)), map_(map), options_(options) {}

  Result<Transfer> run(Progress* progress) {
    for (const std::string& id : options_.keep) {
      if (const auto known = Sketch(source_).indexOf(id); !known) return known.error();
    }
    const auto tell = [progress](const char* step) {
      if (progress != nullptr) progress->step(step);
      return isCancelled(progress);
    };
    if (tell("carry the curves over")) return cancelled();
    if (const Result<void> done = carry(); !done) return done.error();
    // Lines that fairing would entangle or not make calmer are left as they were carried over.
    for (int round = 0;; ++round) {
      if (tell("make the curves smooth again")) return cancelled();
      Result<Document> smooth = fair();
      if (!smooth) return smooth.error();
      if (tell("compare the pieces")) return cancelled();
      const Result<std::set<std::string>> tangled = finish(*smooth);
      if (!tangled) return tangled.error();
      const std::size_t known = tangled_.size() + settled_.size();
      tangled_.insert(tangled->begin(), tangled->end());
      settle();
      if (tangled_.size() + settled_.size() == known || !isFaired()) break;
      if (round == kMaxRounds) {
        for (const StylingCurve& curve : own().curves) tangled_.insert(curve.id);
      }
    }
    std::erase_if(result_.curves, [this](const TransferredCurve& curve) {
      return network_.originalOf[*Sketch(source_).indexOf(curve.id)].has_value();
    });
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Design& own() const { return *source_.design; }
  [[nodiscard]] const Mesh& sourceMesh() const { return *source_.model->mesh; }
  [[nodiscard]] const Mesh& targetMesh() const { return *target_->mesh; }

  /// Every curve, images too, on the target with its own data points.
  Result<void> carry() {
    Result<ReferenceModel> named = carryNames(*source_.model, *target_, map_);
    if (!named) return named.error();
    target_ = std::make_shared<const ReferenceModel>(*std::move(named));
    Sketch sketch(source_);
    Result<CurveNetwork> network = detail::makeNetwork(sketch);
    if (!network) return network.error();
    network_ = *std::move(network);

    auto design = std::make_shared<Design>(own());
    design->models = {
        ModelReference{target_->reference, std::nullopt, targetMesh().connectivityHash(), {}}};
    Sketch onTarget({design, target_});
    detail::BorderKeeper border(sourceMesh(), *target_);
    for (std::size_t c = 0; c < own().curves.size(); ++c) {
      const WorkCurve& before = network_.curves[c];
      const StylingCurve& curve = own().curves[c];
      std::vector<SurfacePoint> points;
      for (const SurfacePoint& point : before.data) {
        points.push_back(border.keep(point, map_.toB(point)));
      }
      Result<WorkCurve> after =
          detail::makeWorkCurve(onTarget.linker(), targetMesh(), points, before.closed);
      if (!after) return after.error().during("curve \"" + curve.id + "\"");
      copyFlags(before, points, *after);
      detail::markEnds(*after);
      onTarget.store(curve.id, *after);
      StylingCurve& carried = onTarget.edit(curve.id);
      const auto* controls = std::get_if<SmoothWay>(&carried.way);
      carried.way = carriedWay(curve.way, *controls, carried.dataPoints);

      TransferredCurve report;
      report.id = curve.id;
      const SurfacePath path = pathOf(before), pathAfter = pathOf(*after);
      const Restlessness calm = restlessness(sourceMesh(), path);
      const Restlessness raw = restlessness(targetMesh(), pathAfter);
      report.lengthBefore = Length::mm(length(sourceMesh(), path));
      report.bendsBefore = calm.inflections;
      report.variationBefore = calm.variation;
      report.lengthCarried = Length::mm(length(targetMesh(), pathAfter));
      report.bendsCarried = raw.inflections;
      report.variationCarried = raw.variation;
      result_.curves.push_back(report);
      placedBefore_.push_back({curve.id, curve.kind, before.data, path});
    }
    carriedFindings_ = border.findings();
    carried_ = onTarget.document();
    return {};
  }

  /// Points that fell together on the target were dropped; the others keep what they were.
  static void copyFlags(const WorkCurve& before, const std::vector<SurfacePoint>& images,
                        WorkCurve& after) {
    std::size_t from = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      for (std::size_t k = from; k < after.data.size(); ++k) {
        if (!(after.data[k] == images[i])) continue;
        after.isControl[k] = after.isControl[k] || before.isControl[i];
        after.isCorner[k] = after.isCorner[k] || before.isCorner[i];
        from = k;
        break;
      }
    }
  }

  [[nodiscard]] bool isFaired() const {
    return std::any_of(result_.curves.begin(), result_.curves.end(), [](const auto& curve) {
      return curve.fairing == TransferredCurve::Fairing::Faired;
    });
  }

  /// Notes the lines whose curvature varies more than before fairing, as where a line round an
  /// ankle had two bends too small to see.
  void settle() {
    for (const TransferredCurve& curve : result_.curves) {
      if (curve.fairing == TransferredCurve::Fairing::Faired &&
          curve.variationAfter > curve.variationCarried) {
        settled_.insert(curve.id);
      }
    }
  }

  Result<Document> fair() {
    std::vector<std::string> ids;
    FairCurvesOptions options;
    options.fairing.maxDeviation = options_.maxDeviation;
    for (std::size_t c = 0; c < result_.curves.size(); ++c) {
      TransferredCurve& curve = result_.curves[c];
      // An image is drawn as its original is.
      std::size_t original = c;
      while (network_.originalOf[original]) original = *network_.originalOf[original];
      curve.fairing = fairingOf(own().curves[original], curve, options_);
      curve.deviation = Length();
      if (curve.fairing == TransferredCurve::Fairing::Faired &&
          (tangled_.contains(curve.id) || tangled_.contains(own().curves[original].id))) {
        curve.fairing = TransferredCurve::Fairing::Tangled;
      } else if (curve.fairing == TransferredCurve::Fairing::Faired &&
                 (settled_.contains(curve.id) || settled_.contains(own().curves[original].id))) {
        curve.fairing = TransferredCurve::Fairing::Calm;
      }
      if (curve.fairing != TransferredCurve::Fairing::Faired) continue;
      ids.push_back(curve.id);
      options.inflections[curve.id] = curve.bendsBefore;
    }
    if (ids.empty()) return carried_;
    Result<FairedDocument> faired = fairCurves(carried_, ids, options);
    if (!faired) {
      for (TransferredCurve& curve : result_.curves) {
        if (curve.fairing == TransferredCurve::Fairing::Faired) {
          curve.fairing = TransferredCurve::Fairing::None;
        }
      }
      carriedFindings_.push_back(
          {"not-faired", "the curves are as they were carried over: " + faired.error().message,
           faired.error().where});
      return carried_;
    }
    for (const FairedCurve& curve : faired->curves) {
      for (TransferredCurve& report : result_.curves) {
        if (report.id == curve.id) report.deviation = curve.deviation;
      }
    }
    Sketch smooth(faired->document);
    if (const auto done = detail::removeSpikes(smooth, ids); !done) return done.error();
    return smooth.document();
  }

  /// Images become live again, anchors go along, pieces are compared.
  /// @return curves that bound a piece which they did not bound before
  Result<std::set<std::string>> finish(const Document& smooth) {
    result_.findings = carriedFindings_;
    Sketch sketch(smooth);
    if (const auto done = detail::reviveImages(sketch, own(), network_.originalOf); !done) {
      return done.error();
    }
    auto design = std::make_shared<Design>(sketch.design());
    for (std::size_t r = 0; r < own().pieces.size(); ++r) {
      const Result<SurfacePoint> anchor =
          resolvePlace(own().pieces[r].anchor, *source_.model, placedBefore_);
      if (!anchor) {
        return anchor.error().during("anchor of piece \"" + own().pieces[r].id + "\"");
      }
      design->pieces[r].anchor = toModelPoint(targetMesh(), map_.toB(*anchor));
    }
    const Result<std::vector<PlacedCurve>> placed = placeCurves(*design, *target_);
    if (!placed) return placed.error();
    for (std::size_t c = 0; c < placed->size(); ++c) {
      TransferredCurve& report = result_.curves[c];
      const SurfacePath& path = (*placed)[c].path;
      const Restlessness after = restlessness(targetMesh(), path);
      report.lengthAfter = Length::mm(length(targetMesh(), path));
      report.bendsAfter = after.inflections;
      report.variationAfter = after.variation;
    }
    std::optional<Result<CutResult>> after;
    parallelFor(2, [&](std::size_t i) {
      if (i == 0 && !cutBefore_) cutBefore_ = cut(source_, placedBefore_);
      if (i == 1) after = cut({design, target_}, *placed);
    });
    if (!*cutBefore_) return cutBefore_->error().during("the design on its own model");
    if (!*after) return after->error();
    std::set<std::string> tangled =
        detail::checkRecords(*design, own(), **cutBefore_, **after, targetMesh(), result_.findings);
    result_.document = {std::move(design), target_};
    return tangled;
  }

  const Document& source_;
  std::shared_ptr<const ReferenceModel> target_;
  const Correspondence& map_;
  const TransferOptions& options_;
  CurveNetwork network_;
  std::vector<PlacedCurve> placedBefore_;
  std::optional<Result<CutResult>> cutBefore_;
  /// On the target, not faired, with images as curves of their own.
  Document carried_;
  std::vector<Finding> carriedFindings_;
  std::set<std::string> tangled_;
  std::set<std::string> settled_;  ///< carried over as calm as they can be
  Transfer result_;
};

}  // namespace

std::string_view toString(TransferredCurve::Fairing fairing) {
  switch (fairing) {
    case TransferredCurve::Fairing::Faired:
      return "faired";
    case TransferredCurve::Fairing::None:
      return "not-faired";
    case TransferredCurve::Fairing::Kept:
      return "kept";
    case TransferredCurve::Fairing::Tangled:
      return "tangled";
    case TransferredCurve::Fairing::Calm:
      return "calm";
    case TransferredCurve::Fairing::Anatomical:
      return "anatomical";
    case TransferredCurve::Fairing::Angular:
      return "angular";
  }
  return "";
}

Result<Transfer> transferDesign(const Document& document,
                                const std::shared_ptr<const ReferenceModel>& target,
                                const Correspondence& map, const TransferOptions& options,
                                Progress* progress) {
  return Carrier(document, target, map, options).run(progress);
}

}  // namespace toile
