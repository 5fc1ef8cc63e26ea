// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "finish/allowance.h"
#include "finish/marking.h"
#include "finish/notches.h"
#include "finish/polygon.h"
#include "finish/seam_net.h"
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

double allowanceOf(const Wire& wire, const Piece& piece, const Document& document,
                   const std::vector<PlacedCurve>& curves) {
  const Design& design = *document.design;
  const double usual = design.finish.allowance.mm();
  const StylingCurve* curve = findStylingCurve(design, wire.curve);
  if (curve == nullptr) return usual;
  const double left = curve->left.allowance.value_or(design.finish.allowance).mm();
  const double right = curve->right.allowance.value_or(design.finish.allowance).mm();
  if (left == right || document.model == nullptr) return left;
  for (const PlacedCurve& placed : curves)
    if (placed.id == wire.curve)
      // Boundary wires have their piece on the left.
      return runsAlongCurve(piece, wire, *document.model->mesh, placed.path) ? left : right;
  return usual;
}

}  // namespace

Result<std::vector<PatternPiece>> finish(
    const Document& document, const std::vector<PlacedCurve>& curves, const CutResult& cut,
    const std::vector<std::shared_ptr<const FlatPiece>>& flats) {
  const Design& design = *document.design;
  std::vector<PieceInWork> work;
  for (std::uint32_t i = 0; i < cut.pieces.size() && i < flats.size(); ++i) {
    if (flats[i] == nullptr) continue;
    const Piece& piece = cut.pieces[i];
    auto sew = makeSewOutline(piece, *flats[i]);
    if (!sew) return sew.error();
    for (OutlineRun& run : sew->runs)
      run.allowance = std::max(0.0, allowanceOf(piece.wires[run.wire], piece, document, curves));
    work.push_back({i, &piece, flats[i].get(), std::move(*sew)});
  }

  const SeamNet net(work, cut);
  const std::vector<SewNotch> notches = chooseNotches(net, design.finish.notchSpacing.mm());
  std::vector<PatternPiece> pattern(work.size());
  parallelFor(work.size(), [&](std::size_t at) {
    const auto p = static_cast<std::uint32_t>(at);
    const Piece& piece = *work[p].piece;
    const SewOutline& sew = work[p].sew;
    PatternPiece& out = pattern[p];
    out.id = piece.id;
    out.name = piece.name.empty() ? piece.id : piece.name;
    out.number = static_cast<int>(p) + 1;
    out.of = static_cast<int>(work.size());
    const PieceRecord* record = recordOf(design, piece.id);
    if (record != nullptr) out.count = record->count;
    if (const Fabric* found = fabricOf(design, record))
      out.fabric = found->name.empty() ? found->id : found->name;
    out.sewLines = sew.loops;
    out.runs = sew.runs;
    for (std::uint32_t r = 0; r < out.runs.size(); ++r) {
      out.runs[r].seam = net.seam({p, r});
      if (const auto mate = net.mate({p, r})) out.runs[r].mate = work[mate->piece].piece->id;
    }
    out.cutLines = makeCutLines(sew);
    out.findings = checkCutLines(sew, out.cutLines, piece);
    out.notches =
        placeNotches(notches, p, piece, design.finish.notchDepth.mm(), out.cutLines, out.findings);
    out.internalLines = internalLines(document, curves, piece, *work[p].flat);
    const std::vector<Points2> sewLoops = positions(out.sewLines);
    out.labelPosition = inmostPoint(sewLoops).position;
    out.grain = grainLine(sewLoops, out.labelPosition);
    out.label = labelLines(design, out);
  });
  return pattern;
}

}  // namespace toile
