// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/design/design.h"

namespace toile {

/// Nodes of curves closer than this are one node.
inline constexpr double kMergeDistanceMm = 0.01;

/// What a wire edge is, on the model and in a piece.
enum class WireKind { Seam, Opening, Dart, Feature, Elastic, Border };
[[nodiscard]] std::string_view toString(WireKind kind);  ///< "seam", ... as in wire_<kind>_<id>
[[nodiscard]] constexpr bool isBoundary(WireKind kind) {
  return kind != WireKind::Feature && kind != WireKind::Elastic;
}

/// Of elastic lines that do not say how elastic they are.
inline constexpr double kUsualElasticRange = 0.05;

/// One edge of the cut: a seam edge, feature edge or edge of the model's border. The one owner of
/// its lengths; the sides of a seam refer to the same object.
struct CutEdge {
  double bodyLength = 0;    ///< mm, on the model
  double targetLength = 0;  ///< mm, what the flat edges must have (design.md, rule 1)
  WireKind kind = WireKind::Border;
  std::uint32_t curve = 0;  ///< index of the styling curve; kNoCurve for the model's border
  bool backward = false;    ///< the curve runs from the edge's head to its tail
};
inline constexpr std::uint32_t kNoCurve = 0xffffffffU;

/// The model's mesh refined so that every curve runs along edges. Its vertices are those of the
/// model, then nodes on edges, then nodes in faces, each in the order of where they lie; its faces
/// come in the order of their source faces.
struct RefinedMesh {
  Mesh mesh;                         ///< one vertex per node; nothing is opened yet
  VertexData<SurfacePoint> onModel;  ///< where each vertex lies on the model
  FaceData<FaceId> sourceFace;       ///< the model face that holds the face
  EdgeData<CutEdgeId> cutEdge;       ///< invalid for plain mesh edges
  std::vector<CutEdge> cutEdges;
};

/// A maximal chain of wire edges of one curve in a piece, between junctions.
///
/// Boundary wires (isBoundary) run with the piece on their left; inner wires in the direction of
/// their curve. A dart in the piece gives boundary wires on both its sides.
struct Wire {
  WireKind kind = WireKind::Seam;
  std::string curve;  ///< id of the styling curve; "border" for the model's border
  int part = 0;       ///< counts the runs of that curve in this piece from 0
  std::vector<VertexId>
      vertices;  ///< of the piece's mesh, along mesh edges; first == last if closed
  std::vector<double> bodyLength;  ///< mm, per edge, copied from the CutEdge
  std::vector<double>
      targetLength;  ///< mm, per edge, copied from the CutEdge: bitwise equal in mates
  std::vector<CutEdgeId> cutEdges;  ///< per edge; empty for a piece that was not cut from a model
  /// How far the targets may still be changed, all of the curve's by one ratio: between 1 - range
  /// and 1 + range times. 0 = they are to be kept.
  double elasticRange = 0;
};

/// A region of the model bounded by seams.
///
/// Everything but `cutEdges` and mates depends on the piece alone: vertices and faces are numbered
/// by where they lie on the model, so that an edit elsewhere leaves the piece bitwise the same.
struct Piece {
  std::string id;  ///< of its record, or "piece-<n>" for a new one
  std::string name;
  std::shared_ptr<const Mesh> mesh;  ///< 3D, mm; opened along boundary wires
  VertexData<SurfacePoint> onModel;
  FaceData<FaceId> sourceFace;
  /// The sides that each face is to have before it is strained, mm, from its corner 0 on: where
  /// ease or thickness makes them others than those of the mesh. Empty = those of the mesh.
  FaceData<std::array<double, 3>> targetSides;
  std::vector<Wire> wires;         ///< boundary wires in order around the loops, then inner wires
  std::vector<int> recordIndices;  ///< piece records whose anchors lie here; empty = new
  bool include = true;
};

/// The sides of a face that its strain is counted from, mm, from its corner 0 on.
[[nodiscard]] std::array<double, 3> targetSides(const Piece& piece, FaceId face);
/// The area of a triangle of those sides.
[[nodiscard]] double areaOf(const std::array<double, 3>& sides);

/// Of the content that unfolding sees: positions, faces, wires with kinds and targets.
[[nodiscard]] ContentHash contentHash(const Piece& piece);

/// Two boundary wires that are sewn together, edge by edge in opposite directions.
struct SeamMates {
  std::uint32_t pieceA = 0, wireA = 0;
  std::uint32_t pieceB = 0, wireB = 0;  ///< may be the same piece (a dart, a tube's seam)
};

struct CutResult {
  std::shared_ptr<const RefinedMesh> refined;
  std::vector<Piece> pieces;     ///< by record order, then new ones by their smallest source face
  std::vector<SeamMates> mates;  ///< of Seam and Dart wires whose both sides are in included pieces
  double includedArea = 0;       ///< mm^2, of the model under the included pieces
  std::vector<Finding>
      findings;  ///< tube-without-cut, two-anchors, unnamed-piece, open-cut-end, ...
};

/// Refines the mesh along the curves: exact per-face constrained Delaunay triangulation over one
/// node table in integer barycentric coordinates, so that neighbouring faces agree and no T-vertex
/// exists. Nodes closer than kMergeDistanceMm become one, curves that pass a node closer than half
/// of that are led through it. Where curves share an edge the strongest kind keeps it (seam before
/// opening, dart, elastic, feature), then the first curve; the model's border stays border. Marks
/// are left out.
/// @return CurveInvalid for a path that is not on the mesh.
/// @par Cost  linear in the triangles plus, per crossed face, quadratic in its segments
Result<RefinedMesh> refine(const Mesh& mesh, std::span<const PlacedCurve> curves);

/// Cuts the model into pieces along the placed curves, gives them their records, and the edges the
/// target lengths that ease and thickness of the pieces ask for: along a seam the mean of both
/// sides, so that mates stay equal.
Result<CutResult> cut(const Document& document, std::span<const PlacedCurve> curves,
                      Progress* progress = nullptr);

/// Boundary loops of a piece's mesh minus one, and handles: what keeps it from being a disk.
struct PieceTopology {
  std::size_t boundaryLoops = 0;
  std::int64_t eulerCharacteristic = 0;
  /// Loops that a flat piece can keep closed as holes (their turning is that of a hole: an
  /// armhole).
  std::size_t holes = 0;
  [[nodiscard]] bool isDisk() const { return boundaryLoops == 1 && eulerCharacteristic == 1; }
  /// A disk, possibly with holes.
  [[nodiscard]] bool canLieFlat() const {
    return boundaryLoops >= 1 && holes + 1 >= boundaryLoops &&
           eulerCharacteristic == 2 - static_cast<std::int64_t>(boundaryLoops);
  }
};
[[nodiscard]] PieceTopology topology(const Piece& piece);

/// Shortest cuts that make the piece lie flat: seams for tubes (loop to loop), on the middle or in
/// pairs where it is nearly symmetric; curves to add with ids "autocut-<piece>-<n>".
Result<std::vector<StylingCurve>> proposeCuts(const Piece& piece, const ReferenceModel& model);

}  // namespace toile
