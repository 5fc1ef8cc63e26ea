// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/advice.h"

#include "pipeline/proposed_lines.h"
#include "pipeline/stages.h"
#include "pipeline/unfold_options.h"

namespace toile {
namespace {

Result<void> checkIndex(const Pattern& pattern, std::size_t piece) {
  if (piece < pattern.cut.pieces.size()) return {};
  return Error{ErrorCode::InvalidArgument, "the pattern has no such piece", {}};
}

Eigen::Vector3d normalAt(const Mesh& mesh, const SurfacePoint& point) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const FaceId face : facesOf(mesh, point)) normal += mesh.normal(face);
  return normal.normalized();
}

Eigen::Vector2d inPlane(const Mesh& mesh, const FlatPiece& flat, const SurfacePoint& point) {
  const FaceId face = facesOf(mesh, point).front();
  const Eigen::Vector3d weights = barycentricIn(mesh, point, face);
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) {
    place += weights[k] * flat.position[mesh.vertices(face)[static_cast<std::size_t>(k)]];
  }
  return place;
}

}  // namespace

Result<std::vector<DartProposal>> adviseDarts(const Pattern& pattern, std::size_t index,
                                              Progress* progress) {
  if (const auto known = checkIndex(pattern, index); !known) return known.error();
  const Piece& piece = pattern.shapedPiece(index);
  const Design& design = *pattern.document.design;
  DartOptions options;
  options.unfold = unfoldOptionsOf(design, piece, {});
  options.limit = AreaLimit().of(design, piece.id);
  std::shared_ptr<const FlatPiece> flat = pattern.flats[index];
  if (!flat) {
    // Refused because it lies on itself: where, only its plane tells.
    Result<FlatPiece> again = unfold(piece, options.unfold, progress);
    if (!again) return again.error().during(stages::quoted(piece));
    flat = std::make_shared<const FlatPiece>(*std::move(again));
  }
  return adviseDarts(piece, *flat, options, progress);
}

std::vector<ProposedLine> proposedLines(const Pattern& pattern, std::size_t index,
                                        const DartProposal& proposal) {
  const Mesh& mesh = *pattern.cut.pieces[index].mesh;
  std::vector<SurfacePath> paths = proposal.companions;
  paths.insert(paths.begin(), proposal.path);
  std::vector<ProposedLine> lines;
  for (const SurfacePath& path : paths) {
    ProposedLine& line = lines.emplace_back();
    for (const SurfacePoint& point : path.points) {
      line.onBody.push_back(position(mesh, point));
      line.normals.push_back(normalAt(mesh, point));
      if (const auto& flat = pattern.flats[index]) {
        line.inPlane.push_back(inPlane(mesh, *flat, point));
      }
    }
  }
  return lines;
}

Result<Edited> withProposal(const Pattern& pattern, std::size_t index,
                            const DartProposal& proposal) {
  if (const auto known = checkIndex(pattern, index); !known) return known.error();
  Design design = *pattern.document.design;
  Edited edited;
  edited.curves = addLines(design, pattern, index, proposal).ids;
  edited.document = {std::make_shared<const Design>(std::move(design)), pattern.document.model};
  return edited;
}

Result<Edited> withShortestCuts(const Pattern& pattern, std::size_t index) {
  if (const auto known = checkIndex(pattern, index); !known) return known.error();
  const Piece& piece = pattern.cut.pieces[index];
  if (topology(piece).canLieFlat()) {
    return Error{ErrorCode::InvalidArgument,
                 stages::quoted(piece) + " lies flat without a cut",
                 {Element::piece(piece.id)}};
  }
  Result<std::vector<StylingCurve>> cuts = proposeCuts(piece, *pattern.document.model);
  if (!cuts) return cuts.error().during(stages::quoted(piece));
  if (cuts->empty()) {
    return Error{ErrorCode::InvalidArgument,
                 stages::quoted(piece) + " has no open end to cut from; draw seams that divide it",
                 {Element::piece(piece.id)}};
  }
  Design design = *pattern.document.design;
  Edited edited;
  for (StylingCurve& curve : *cuts) {
    curve.id = freeCurveId(design, curve.id);
    edited.curves.push_back(curve.id);
    design.curves.push_back(std::move(curve));
  }
  edited.document = {std::make_shared<const Design>(std::move(design)), pattern.document.model};
  return edited;
}

Result<DevelopedPiece> tryDeveloping(const Pattern& pattern, std::size_t index, double amount,
                                     Progress* progress) {
  if (const auto known = checkIndex(pattern, index); !known) return known.error();
  const Piece& piece = pattern.cut.pieces[index];
  const Design& design = *pattern.document.design;
  DevelopOptions options;
  options.amount = amount;
  options.unfold = unfoldOptionsOf(design, piece, {});
  const PieceRecord* record = recordOf(design, piece.id);
  if (record != nullptr && record->develop && record->develop->gap) {
    options.outsideOf = pattern.document.model->index;
    options.gap = *record->develop->gap;
  }
  return develop(piece, options, progress);
}

}  // namespace toile
