// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/cut_findings.h"

#include <fmt/format.h>

#include <algorithm>

namespace toile::cutting {
namespace {

double areaOf(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) sum += mesh.area(FaceId(f));
  return sum;
}

constexpr std::size_t kMaxNamedPieces = 24;

/// One finding for all regions without a record: a first sketch has many.
void findUnnamed(std::span<const PieceBuild> builds, std::vector<Finding>& findings) {
  Finding finding{"unnamed-piece", "", {}};
  std::size_t count = 0;
  std::string names;
  for (const PieceBuild& build : builds) {
    const Piece& piece = build.piece;
    if (!piece.recordIndices.empty()) continue;
    if (++count > kMaxNamedPieces) continue;
    finding.where.push_back(Element::piece(piece.id));
    names += fmt::format("{}{} ({:.0f} cm2)", names.empty() ? "" : ", ", piece.id,
                         areaOf(*piece.mesh) / 100);
  }
  if (count == 0) return;
  finding.message = fmt::format(
      "{} without a record in the design: {}{}; give {} a name and an anchor, or leave "
      "{} out",
      count == 1 ? std::string("a piece") : fmt::format("{} pieces", count), names,
      count > kMaxNamedPieces ? ", ..." : "", count == 1 ? "it" : "them",
      count == 1 ? "it" : "them");
  findings.push_back(std::move(finding));
}

void findTwoAnchors(const Design& design, const Piece& piece, std::vector<Finding>& findings) {
  if (piece.recordIndices.size() < 2) return;
  Finding finding{"two-anchors", "", {}};
  std::string others;
  for (const int r : piece.recordIndices) {
    const std::string& id = design.pieces[static_cast<std::size_t>(r)].id;
    finding.where.push_back(Element::piece(id));
    if (id != piece.id) others += (others.empty() ? "\"" : ", \"") + id + '"';
  }
  finding.message = fmt::format(
      "piece \"{}\" holds the anchors of {} too; draw a seam between them or remove a record",
      piece.id, others);
  findings.push_back(std::move(finding));
}

/// The pieces that hold the two sides of an edge of the refined mesh, by face.
FaceData<std::uint32_t> pieceOfFace(const RefinedMesh& refined,
                                    std::span<const PieceBuild> builds) {
  FaceData<std::uint32_t> pieceOf(refined.mesh.faceCount());
  for (std::uint32_t p = 0; p < builds.size(); ++p) {
    for (const FaceId f : builds[p].refinedFace) pieceOf[f] = p;
  }
  return pieceOf;
}

}  // namespace

std::vector<Finding> findNoteworthy(const Document& document, std::span<const PlacedCurve> curves,
                                    const RefinedMesh& refined,
                                    const VertexData<std::uint32_t>& openedAt,
                                    std::span<const PieceBuild> builds) {
  std::vector<Finding> findings;
  for (const PieceBuild& build : builds) {
    findTwoAnchors(*document.design, build.piece, findings);
  }
  findUnnamed(builds, findings);
  const Mesh& mesh = refined.mesh;
  const FaceData<std::uint32_t> pieceOf = pieceOfFace(refined, builds);
  std::vector<bool> hasEdges(curves.size(), false);
  for (std::size_t i = 0; i < mesh.edgeCount(); ++i) {
    const EdgeId e(i);
    if (!refined.cutEdge[e].isValid()) continue;
    const CutEdge& cutEdge = refined.cutEdges[refined.cutEdge[e].index()];
    if (cutEdge.curve == kNoCurve) continue;
    hasEdges[cutEdge.curve] = true;
    if (cutEdge.kind != WireKind::Seam && cutEdge.kind != WireKind::Opening) continue;
    for (const VertexId v : {mesh.tail(e), mesh.head(e)}) {
      if (openedAt[v] != 1) continue;
      const std::string& curve = curves[cutEdge.curve].id;
      const Piece& piece = builds[pieceOf[mesh.face(mesh.halfedge(e))]].piece;
      if (!piece.include) continue;  // a cut may run out where nothing is made
      findings.push_back(
          {"open-cut-end",
           fmt::format("{} \"{}\" ends inside piece \"{}\" and only slits it; lead it to another "
                       "cut, or make it a dart",
                       toString(cutEdge.kind), curve, piece.id),
           {Element::curve(curve), Element::piece(piece.id)}});
    }
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (hasEdges[c] || !isWire(curves[c].kind)) continue;
    findings.push_back({"hidden-curve",
                        fmt::format("curve \"{}\" lies on others or on the border all the way, "
                                    "which take its place; remove it or move it",
                                    curves[c].id),
                        {Element::curve(curves[c].id)}});
  }
  return findings;
}

std::vector<Finding> findUnflattenable(const ReferenceModel& model,
                                       std::span<const PieceBuild> builds) {
  std::vector<Finding> findings;
  for (const PieceBuild& build : builds) {
    const Piece& piece = build.piece;
    if (!piece.include) continue;
    const PieceTopology shape = topology(piece);
    if (shape.canLieFlat()) continue;
    const Element where = Element::piece(piece.id);
    if (shape.boundaryLoops == 0) {
      findings.push_back(
          {"closed-without-cut",
           fmt::format("piece \"{}\" is a closed surface; draw seams that divide it", piece.id),
           {where}});
      continue;
    }
    std::string proposal = "draw seams that open it";
    if (const auto cuts = proposeCuts(piece, model); cuts && !cuts->empty()) {
      proposal = fmt::format(
          "draw a seam between its open ends, or take the {} proposed by "
          "--auto-cut",
          cuts->size() == 1 ? "one" : fmt::format("{} ones", cuts->size()));
    }
    const bool hasHandle =
        shape.eulerCharacteristic != 2 - static_cast<std::int64_t>(shape.boundaryLoops);
    findings.push_back({hasHandle ? "handle-without-cut" : "tube-without-cut",
                        fmt::format("piece \"{}\" {} and cannot lie flat; {}", piece.id,
                                    hasHandle ? std::string("has a handle")
                                              : fmt::format("is a tube with {} open ends",
                                                            shape.boundaryLoops - shape.holes),
                                    proposal),
                        {where}});
  }
  return findings;
}

}  // namespace toile::cutting
