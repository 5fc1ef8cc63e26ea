// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/progress.h"
#include "toile/design/design.h"
#include "toile/fit/correspondence.h"

namespace toile {

struct TransferOptions {
  /// Curves that were drawn smooth, and cuts along model curves, are made smooth again where the
  /// other shape makes them more restless (edit/fair.h): each keeps as many bends as it has on its
  /// own model.
  bool fair = true;
  Length maxDeviation = Length::mm(25);  ///< that fairing may move a point of a curve
  std::vector<std::string> keep{};       ///< ids of curves that are not to be faired
};

/// A curve before and after.
struct TransferredCurve {
  enum class Fairing {
    Faired,
    None,        ///< not asked for, or it could not be done: see the findings
    Tangled,     ///< its smooth shape would part pieces otherwise; left as carried over
    Calm,        ///< no more restless than on its own model, or fairing makes it no calmer
    Kept,        ///< by TransferOptions::keep
    Anatomical,  ///< no cut, along a model curve, a section or mesh edges: left where it is
    Angular      ///< it was drawn straight from point to point
  };
  std::string id;
  Fairing fairing = Fairing::None;
  Length lengthBefore;                   ///< on its own model
  Length lengthCarried, lengthAfter;     ///< on the other, before and after fairing
  int bendsBefore = 0;                   ///< changes of direction of bending on its own model
  int bendsCarried = 0, bendsAfter = 0;  ///< on the other, before and after fairing
  double variationBefore = 0;            ///< of geodesic curvature, 1/mm, on its own model
  double variationCarried = 0, variationAfter = 0;
  Length deviation;  ///< farthest that fairing moved a point of it
};
[[nodiscard]] std::string_view toString(TransferredCurve::Fairing fairing);

struct Transfer {
  Document document;  ///< the design on the target, which has the names of its own model now
  std::vector<TransferredCurve> curves;  ///< in the design's order, without live mirror images
  /// piece-bounded-otherwise, piece-moved, piece-lost, curve-off-border, ...
  std::vector<Finding> findings;
};

/// Carries a design over to another model.
///
/// Where curves meet, the meeting first becomes a data point of all of them, so that they still
/// meet. Data points go by the correspondence and are linked by geodesics there; so go the anchors
/// of the pieces, the places that curves were drawn from, and the model's names. Live mirror images
/// stay live where the target has a pairing of its vertices; elsewhere they are carried over by
/// themselves, since a person is not symmetric. Every piece must be bounded by the same curves in
/// the same cyclic order as before: otherwise its anchor goes to the region that is, or it is
/// reported.
///
/// Without fairing, there and back between models of one connectivity gives the curves of
/// the design, bit for bit where their meetings were data points.
///
/// @param map from the document's model to the target.
/// @return the errors of placeCurves() and cut() on either model, NameNotFound for `keep`.
/// @par Cost  0.3 s for a wetsuit on 25k triangles is the bound; bench/transfer_bench.cpp tells
/// @see docs/transfer.md
Result<Transfer> transferDesign(const Document& document,
                                const std::shared_ptr<const ReferenceModel>& target,
                                const Correspondence& map, const TransferOptions& options = {},
                                Progress* progress = nullptr);

/// The report as JSON, "toile-transfer" version 1 (docs/transfer.md).
[[nodiscard]] std::string writeTransferReport(const Transfer& transfer);

}  // namespace toile
