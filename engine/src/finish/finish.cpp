// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "finish/allowance.h"
#include "finish/corners.h"
#include "finish/marking.h"
#include "finish/notches.h"
#include "finish/polygon.h"
#include "finish/seam_net.h"
#include "finish/smoothing.h"
#include "toile/core/parallel.h"
#include "toile/finish/pattern_piece.h"

namespace toile {
namespace {

const StylingCurve* findStylingCurve(const Design& design, const std::string& id) {
  for (const StylingCurve& curve : design.curves)
    if (curve.id == id) return &curve;
  return nullptr;
}

/// Whether a boundary wire runs the way its curve was drawn: each of a few of its edges is compared
/// with the nearest segment of the curve's path on the model.
bool runsAlongCurve(const Piece& piece, const Wire& wire, const Mesh& model,
                    const SurfacePath& path) {
  std::vector<Eigen::Vector3d> points;
  for (const SurfacePoint& p : path.points) points.push_back(position(model, p));
  if (path.closed && !points.empty()) points.push_back(points.front());
  const std::size_t edges = wire.vertices.size() - 1;
  constexpr std::size_t kSamples = 7;
  double along = 0;
  for (std::size_t k = 0; k < std::min(edges, kSamples); ++k) {
    const std::size_t e = edges <= kSamples ? k : k * (edges - 1) / (kSamples - 1);
    const Eigen::Vector3d a = piece.mesh->position(wire.vertices[e]);
    const Eigen::Vector3d b = piece.mesh->position(wire.vertices[e + 1]);
    const Eigen::Vector3d middle = 0.5 * (a + b);
    double nearest = std::numeric_limits<double>::infinity();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    for (std::size_t s = 0; s + 1 < points.size(); ++s) {
      const Eigen::Vector3d d = points[s + 1] - points[s];
      if (d.squaredNorm() == 0) continue;
      const double t = std::clamp((middle - points[s]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      const double distance = (points[s] + t * d - middle).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        direction = d.normalized();
      }
    }
    along += (b - a).dot(direction);
  }
  return along >= 0;
}

/// The settings of the side of its curve on which the piece lies; null for the model's border.
const SeamSide* sideOf(const Wire& wire, const Piece& piece, const Document& document,
                       const std::vector<PlacedCurve>& curves) {
  const StylingCurve* curve = findStylingCurve(*document.design, wire.curve);
  if (curve == nullptr) return nullptr;
  if (curve->left == curve->right || document.model == nullptr) return &curve->left;
  for (const PlacedCurve& placed : curves)
    if (placed.id == wire.curve)
      // Boundary wires have their piece on the left.
      return runsAlongCurve(piece, wire, *document.model->mesh, placed.path) ? &curve->left
                                                                             : &curve->right;
  return nullptr;
}

/// What is said for the side by hand comes first, then for its kind, its fabric, and all.
double allowanceOf(const SeamSide* side, WireKind kind, const Fabric* fabric,
                   const FinishSettings& finish) {
  if (side != nullptr && side->allowance) return side->allowance->mm();
  const bool isHem = side == nullptr ? kind == WireKind::Border : side->kind == SeamKind::Hem;
  const bool isLapped = side != nullptr && side->kind == SeamKind::Lapped;
  if (isHem && finish.hemAllowance) return finish.hemAllowance->mm();
  if (isLapped && finish.lappedAllowance) return finish.lappedAllowance->mm();
  if (kind == WireKind::Opening && finish.openingAllowance) return finish.openingAllowance->mm();
  if (fabric != nullptr && fabric->allowance) return fabric->allowance->mm();
  return finish.allowance.mm();
}

CornerStyle styleOf(const SeamSide* side, WireKind kind, const FinishSettings& finish) {
  if (side != nullptr && side->corner) return *side->corner;
  const bool isHem = side == nullptr ? kind == WireKind::Border && finish.hemAllowance
                                     : side->kind == SeamKind::Hem;
  return isHem ? CornerStyle::Mirrored : finish.corner;
}

/// Folded darts fill with cloth what would be cut out otherwise; wider ones are cut out.
constexpr double kWidestFoldedDartMm = 120;

/// Marks the runs of darts with an allowance as folded where their mouth is narrow enough.
void foldDarts(SewOutline& sew) {
  for (OutlineRun& run : sew.runs) run.folded = run.kind == WireKind::Dart && run.allowance > 0;
  for (const FoldedDart& dart : foldedDarts(sew)) {
    if (dart.isInner) continue;
    const Outline& loop = sew.loops[dart.loop];
    const OutlineRun& last = sew.runs[dart.firstRun + dart.runCount - 1];
    const Eigen::Vector2d& from = loop[sew.runs[dart.firstRun].first].position;
    const Eigen::Vector2d& to = loop[(last.first + last.edgeCount) % loop.size()].position;
    if ((to - from).norm() <= kWidestFoldedDartMm) continue;
    for (std::size_t r = 0; r < dart.runCount; ++r) sew.runs[dart.firstRun + r].folded = false;
  }
}

/// A little towards the mouth from each tip, so that the stitching hides it.
std::vector<Eigen::Vector2d> drillHoles(const SewOutline& sew) {
  constexpr double kFromTipMm = 12;
  std::vector<Eigen::Vector2d> holes;
  for (const FoldedDart& dart : foldedDarts(sew)) {
    const Outline& loop = sew.loops[dart.loop];
    for (const std::size_t tip : dart.tips) {
      const Eigen::Vector2d& at = loop[tip].position;
      const Eigen::Vector2d before = loop[(tip + loop.size() - 1) % loop.size()].position - at;
      const Eigen::Vector2d after = loop[(tip + 1) % loop.size()].position - at;
      const Eigen::Vector2d axis = before.normalized() + after.normalized();
      const double reach = std::min(kFromTipMm, 0.5 * std::min(before.norm(), after.norm()) +
                                                    0.25 * (before.norm() + after.norm()));
      if (axis.norm() > 1e-9) holes.emplace_back(at + reach * axis.normalized());
    }
  }
  return holes;
}

}  // namespace

Result<std::vector<PatternPiece>> finish(const Document& document,
                                         const std::vector<PlacedCurve>& curves,
                                         const CutResult& cut,
                                         const std::vector<std::shared_ptr<const FlatPiece>>& flats,
                                         const std::vector<const PatternPiece*>& known) {
  const Design& design = *document.design;
  std::vector<PieceInWork> work;
  std::vector<std::vector<CornerStyle>> styles;
  for (std::uint32_t i = 0; i < cut.pieces.size() && i < flats.size(); ++i) {
    if (flats[i] == nullptr) continue;
    const Piece& piece = cut.pieces[i];
    auto sew = makeSewOutline(piece, *flats[i]);
    if (!sew) return sew.error();
    const Fabric* fabric = fabricOf(design, recordOf(design, piece.id));
    styles.emplace_back();
    for (OutlineRun& run : sew->runs) {
      const SeamSide* side = sideOf(piece.wires[run.wire], piece, document, curves);
      run.allowance = std::max(0.0, allowanceOf(side, run.kind, fabric, design.finish));
      styles.back().push_back(styleOf(side, run.kind, design.finish));
    }
    foldDarts(*sew);
    work.push_back({i, &piece, flats[i].get(), std::move(*sew)});
  }

  const SeamNet net(work, cut);
  const std::vector<SewNotch> notches = chooseNotches(net, design.finish.notchSpacing.mm());
  smoothSewLines(work, net);
  const std::vector<std::vector<Corner>> corners = planCorners(net, styles);
  std::vector<PatternPiece> pattern(work.size());
  parallelFor(work.size(), [&](std::size_t at) {
    const auto p = static_cast<std::uint32_t>(at);
    const Piece& piece = *work[p].piece;
    const SewOutline& sew = work[p].sew;
    PatternPiece& out = pattern[p];
    if (work[p].index < known.size() && known[work[p].index] != nullptr) {
      out = *known[work[p].index];
      out.number = static_cast<int>(p) + 1;
      out.of = static_cast<int>(work.size());
      return;
    }
    out.id = piece.id;
    out.name = piece.name.empty() ? piece.id : piece.name;
    out.number = static_cast<int>(p) + 1;
    out.of = static_cast<int>(work.size());
    const PieceRecord* record = recordOf(design, piece.id);
    if (record != nullptr) out.count = record->count;
    if (const Fabric* found = fabricOf(design, record)) {
      out.fabric = found->name.empty() ? found->id : found->name;
      out.oneWay = found->turns == Turns::OneWay;
    }
    out.sewLines = sew.loops;
    out.runs = sew.runs;
    for (std::uint32_t r = 0; r < out.runs.size(); ++r) {
      out.runs[r].seam = net.seam({p, r});
      if (const auto mate = net.mate({p, r})) out.runs[r].mate = work[mate->piece].piece->id;
    }
    out.cutLines = makeCutLines(sew, corners[p]);
    out.findings = checkCutLines(sew, out.cutLines, piece);
    out.notches = placeNotches(notches, p, piece, design.finish, out.cutLines, out.findings);
    out.drillHoles = drillHoles(sew);
    out.internalLines = internalLines(document, curves, piece, *work[p].flat);
    const std::vector<Points2> sewLoops = positions(out.sewLines);
    out.labelPosition = inmostPoint(sewLoops).position;
    out.grain = grainLine(sewLoops, out.labelPosition);
    out.label = labelLines(design, out);
  });
  return pattern;
}

}  // namespace toile
