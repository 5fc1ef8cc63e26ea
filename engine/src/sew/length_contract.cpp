// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "sew/edges.h"
#include "toile/core/content_hash.h"
#include "toile/design/design_file.h"
#include "toile/sew/sewing.h"

namespace toile {
namespace {

std::string curveName(const Design& design, const std::string& id) {
  for (const StylingCurve& curve : design.curves)
    if (curve.id == id && !curve.name.empty()) return curve.name;
  return id;
}

/// The outline of a piece, edge by edge.
void addEdges(const Pattern& pattern, std::size_t index, const SewingPlan& plan,
              std::vector<LengthLine>& lines) {
  const PatternPiece& piece = pattern.pieces[index];
  const Piece& cut = pattern.cut.pieces[pattern.pieceIndex[index]];
  for (const std::vector<std::uint32_t>& group : edgeGroups(piece)) {
    const OutlineRun& first = piece.runs[group.front()];
    LengthLine line;
    line.piece = piece.id;
    line.curve = first.curve;
    line.kind = toString(first.kind);
    line.name = curveName(*pattern.document.design, first.curve);
    for (const std::uint32_t r : group) {
      const Wire& wire = cut.wires[piece.runs[r].wire];
      const double share = shareOf(piece.runs[r], wire);
      line.body += share * total(wire.bodyLength);
      line.target += share * total(wire.targetLength);
      line.pattern += drawnLength(piece, piece.runs[r]);
    }
    line.difference = line.pattern - line.target;
    for (const SewEdge& edge : plan.edges) {
      if (edge.piece != index || edge.runs != group) continue;
      line.edge = edge.code;
      if (&plan.edges[edge.mate] == &edge) continue;
      const SewEdge& mate = plan.edges[edge.mate];
      line.matePiece = pattern.pieces[mate.piece].id;
      line.mate = mate.length;
      line.difference = line.pattern - line.mate;
    }
    lines.push_back(std::move(line));
  }
}

/// Features and elastic lines, whose parts between crossings count together, and marks.
void addInnerLines(const Pattern& pattern, std::size_t index, std::vector<LengthLine>& lines) {
  const PatternPiece& piece = pattern.pieces[index];
  const std::uint32_t cutIndex = pattern.pieceIndex[index];
  const Piece& cut = pattern.cut.pieces[cutIndex];
  const FlatPiece& flat = *pattern.flats[cutIndex];
  std::map<std::pair<std::string, WireKind>, LengthLine> byCurve;
  for (const Wire& wire : cut.wires) {
    if (isBoundary(wire.kind)) continue;
    LengthLine& line = byCurve[{wire.curve, wire.kind}];
    line.piece = piece.id;
    line.curve = wire.curve;
    line.kind = toString(wire.kind);
    line.name = curveName(*pattern.document.design, wire.curve);
    line.rule = wire.kind == WireKind::Elastic ? LengthRule::Range : LengthRule::Keep;
    line.body += total(wire.bodyLength);
    line.target += total(wire.targetLength);
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i)
      line.pattern +=
          (flat.position[wire.vertices[i + 1]] - flat.position[wire.vertices[i]]).norm();
  }
  for (auto& [key, line] : byCurve) {
    line.difference = line.pattern - line.target;
    lines.push_back(std::move(line));
  }
  for (const InternalLine& mark : piece.internalLines) {
    if (mark.kind != CurveKind::Mark) continue;
    LengthLine line;
    line.piece = piece.id;
    line.curve = mark.curve;
    line.kind = toString(mark.kind);
    line.name = mark.name;
    line.rule = LengthRule::Free;
    for (std::size_t i = 0; i + 1 < mark.points.size(); ++i)
      line.pattern += (mark.points[i + 1] - mark.points[i]).norm();
    lines.push_back(std::move(line));
  }
}

}  // namespace

std::string_view toString(LengthRule rule) {
  switch (rule) {
    case LengthRule::Keep:
      return "keep";
    case LengthRule::Range:
      return "range";
    case LengthRule::Free:
      return "free";
  }
  return "";
}

std::vector<LengthLine> lengthContract(const Pattern& pattern) {
  std::vector<LengthLine> lines;
  if (pattern.pieceIndex.size() != pattern.pieces.size()) return lines;
  const SewingPlan plan = planSewing(pattern);
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
    addEdges(pattern, i, plan, lines);
    addInnerLines(pattern, i, lines);
  }
  return lines;
}

ContentHash inputsHash(const Document& document) {
  ContentHasher hasher;
  hasher.add(writeDesign(*document.design));
  if (document.model) {
    const Mesh& mesh = *document.model->mesh;
    for (const Eigen::Vector3d& p : mesh.positions()) hasher.add(p.x()).add(p.y()).add(p.z());
    hasher.add(mesh.connectivityHash());
  }
  return hasher.finish();
}

}  // namespace toile
