// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/cut/cut.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "cut/anchors.h"
#include "cut/cut_at.h"
#include "cut/cut_findings.h"
#include "cut/ease.h"
#include "cut/piece_builder.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using cutting::PieceBuild;

VertexData<std::uint32_t> countOpenedEdges(const RefinedMesh& refined) {
  VertexData<std::uint32_t> count(refined.mesh.vertexCount(), 0);
  for (std::size_t e = 0; e < refined.mesh.edgeCount(); ++e) {
    if (!cutting::isOpened(refined, EdgeId(e))) continue;
    ++count[refined.mesh.tail(EdgeId(e))];
    ++count[refined.mesh.head(EdgeId(e))];
  }
  return count;
}

/// Pieces by the first of their records, then those without by where they lie.
std::vector<std::size_t> orderOfPieces(const std::vector<std::vector<int>>& recordsOf) {
  std::vector<std::size_t> order(recordsOf.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (recordsOf[i].empty() || recordsOf[j].empty()) return !recordsOf[i].empty();
    return recordsOf[i].front() < recordsOf[j].front();
  });
  return order;
}

void nameFromRecords(Piece& piece, std::vector<int> records, const Design& design) {
  const PieceRecord& first = design.pieces[static_cast<std::size_t>(records.front())];
  piece.id = first.id;
  piece.name = first.name.empty() ? first.id : first.name;
  piece.include = std::any_of(records.begin(), records.end(), [&](int r) {
    return design.pieces[static_cast<std::size_t>(r)].include;
  });
  piece.recordIndices = std::move(records);
}

/// Elastic lines, and seams that have a range of their own.
double elasticRangeOf(const Wire& wire, const Design& design) {
  if (wire.kind != WireKind::Elastic && wire.kind != WireKind::Seam) return 0;
  const auto curve = std::find_if(design.curves.begin(), design.curves.end(),
                                  [&](const StylingCurve& c) { return c.id == wire.curve; });
  if (curve != design.curves.end() && curve->elasticRange) return curve->elasticRange->value();
  return wire.kind == WireKind::Elastic ? kUsualElasticRange : 0;
}

/// The next "piece-<n>" that no record has.
std::string nextFreeId(const Design& design, int& number) {
  while (true) {
    std::string id = "piece-" + std::to_string(++number);
    if (std::none_of(design.pieces.begin(), design.pieces.end(),
                     [&](const PieceRecord& r) { return r.id == id; })) {
      return id;
    }
  }
}

/// Of the model's own faces, by the exact part of each that the pieces cover.
double includedArea(const Mesh& model, const RefinedMesh& refined,
                    const std::vector<PieceBuild>& builds) {
  std::vector<bool> isIncluded(refined.mesh.faceCount(), false);
  for (const PieceBuild& build : builds) {
    if (!build.piece.include) continue;
    for (const FaceId f : build.refinedFace) isIncluded[f.index()] = true;
  }
  double sum = 0;
  for (std::size_t i = 0; i < isIncluded.size();) {
    const FaceId source = refined.sourceFace[FaceId(i)];
    double part = 0;  // sums of whole multiples of 2^-52, so that a whole face gives exactly 1
    for (; i < isIncluded.size() && refined.sourceFace[FaceId(i)] == source; ++i) {
      if (!isIncluded[i]) continue;
      const Triangle& corners = refined.mesh.vertices(FaceId(i));
      const auto weights = [&](std::size_t k) {
        return barycentricIn(model, refined.onModel[corners[k]], source);
      };
      const Eigen::Vector3d u = weights(1) - weights(0);
      const Eigen::Vector3d v = weights(2) - weights(0);
      part += u[1] * v[2] - u[2] * v[1];
    }
    sum += part * model.area(source);
  }
  return sum;
}

}  // namespace

std::string_view toString(WireKind kind) {
  switch (kind) {
    case WireKind::Seam:
      return "seam";
    case WireKind::Opening:
      return "opening";
    case WireKind::Dart:
      return "dart";
    case WireKind::Feature:
      return "feature";
    case WireKind::Elastic:
      return "elastic";
    case WireKind::Border:
      return "border";
  }
  return "";
}

std::array<double, 3> targetSides(const Piece& piece, FaceId face) {
  if (!piece.targetSides.empty()) return piece.targetSides[face];
  const Mesh& mesh = *piece.mesh;
  std::array<double, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Triangle& t = mesh.vertices(face);
    sides[k] = (mesh.position(t[(k + 1) % 3]) - mesh.position(t[k])).norm();
  }
  return sides;
}

double areaOf(const std::array<double, 3>& sides) {
  std::array<double, 3> s = sides;
  std::sort(s.begin(), s.end(), std::greater<>());
  // Kahan's order of Heron's formula, exact for needles too.
  const double product = (s[0] + (s[1] + s[2])) * (s[2] - (s[0] - s[1])) * (s[2] + (s[0] - s[1])) *
                         (s[0] + (s[1] - s[2]));
  return 0.25 * std::sqrt(std::max(product, 0.0));
}

ContentHash contentHash(const Piece& piece) {
  ContentHasher hasher;
  hasher.add(piece.mesh->connectivityHash());
  for (const Eigen::Vector3d& p : piece.mesh->positions()) hasher.add(p.x()).add(p.y()).add(p.z());
  for (const std::array<double, 3>& sides : piece.targetSides.values()) {
    for (const double side : sides) hasher.add(side);
  }
  hasher.add(std::uint64_t{piece.wires.size()});
  for (const Wire& wire : piece.wires) {
    hasher.add(wire.kind).add(wire.curve).add(wire.part);
    hasher.add(std::uint64_t{wire.vertices.size()});
    for (const VertexId v : wire.vertices) hasher.add(v.index());
    for (const double length : wire.bodyLength) hasher.add(length);
    for (const double length : wire.targetLength) hasher.add(length);
    hasher.add(wire.elasticRange);
  }
  return hasher.finish();
}

Result<CutResult> cut(const Document& document, std::span<const PlacedCurve> curves,
                      Progress* progress) {
  return cutting::cutAt(document, curves, {}, progress);
}

Result<CutResult> cutting::cutAt(const Document& document, std::span<const PlacedCurve> curves,
                                 std::span<const SurfacePoint> points, Progress* progress) {
  const Mesh& model = *document.model->mesh;
  if (progress != nullptr) progress->step("cut");
  Result<RefinedMesh> refinement = refineAt(model, curves, points);
  if (!refinement) return refinement.error();
  if (isCancelled(progress)) return Error{ErrorCode::Cancelled, "cutting was cancelled", {}};

  CutResult result;
  const auto owned = std::make_shared<RefinedMesh>(std::move(*refinement));
  result.refined = owned;
  const RefinedMesh& refined = *owned;
  const std::vector<std::vector<FaceId>> regions = cutting::findRegions(refined);
  FaceData<std::uint32_t> regionOfFace(refined.mesh.faceCount());
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (const FaceId f : regions[r]) regionOfFace[f] = r;
  }
  auto recordsOf = cutting::assignRecords(document, {curves.begin(), curves.end()}, refined,
                                          regionOfFace, regions.size());
  if (!recordsOf) return recordsOf.error();

  const VertexData<std::uint32_t> openedAt = countOpenedEdges(refined);
  std::vector<std::optional<Result<PieceBuild>>> built(regions.size());
  parallelFor(regions.size(), [&](std::size_t r) {
    built[r] = cutting::buildPiece(refined, regions[r], openedAt, curves);
  });
  std::vector<PieceBuild> builds;
  int number = 0;
  for (const std::size_t r : orderOfPieces(*recordsOf)) {
    if (!*built[r]) return built[r]->error();
    PieceBuild& build = builds.emplace_back(std::move(**built[r]));
    if ((*recordsOf)[r].empty()) {
      build.piece.id = build.piece.name = nextFreeId(*document.design, number);
    } else {
      nameFromRecords(build.piece, std::move((*recordsOf)[r]), *document.design);
    }
  }

  if (const Result<void> done = cutting::applyEase(document, *owned, builds); !done) {
    return done.error();
  }
  for (PieceBuild& build : builds) {
    for (Wire& wire : build.piece.wires) {
      wire.elasticRange = elasticRangeOf(wire, *document.design);
    }
  }
  result.mates = cutting::findMates(refined, builds);
  result.includedArea = includedArea(model, refined, builds);
  result.findings = cutting::findNoteworthy(document, curves, refined, openedAt, builds);
  if (isCancelled(progress)) return Error{ErrorCode::Cancelled, "cutting was cancelled", {}};
  for (Finding& f : cutting::findUnflattenable(*document.model, builds)) {
    result.findings.push_back(std::move(f));
  }
  for (PieceBuild& build : builds) result.pieces.push_back(std::move(build.piece));
  return result;
}

}  // namespace toile
