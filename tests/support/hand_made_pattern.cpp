// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/hand_made_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "support/drawn_curves.h"

namespace toile::test {
namespace {

using Cell = std::pair<int, int>;

int lattice(double mm) {
  return static_cast<int>(std::lround(mm / kLatticeMm));
}

/// Says where on the model a piece of its lattice lies.
void putOnModel(Piece& piece, const Mesh& model) {
  for (const Eigen::Vector3d& p : piece.mesh->positions()) {
    const auto at = std::find(model.positions().begin(), model.positions().end(), p);
    piece.onModel.values().push_back(
        {VertexId(static_cast<std::size_t>(at - model.positions().begin()))});
  }
  for (const Triangle& triangle : piece.mesh->triangles()) {
    Triangle on;
    for (std::size_t k = 0; k < 3; ++k) on[k] = std::get<VertexId>(piece.onModel[triangle[k]].at);
    const auto at = std::find(model.triangles().begin(), model.triangles().end(), on);
    piece.sourceFace.values().push_back(
        FaceId(static_cast<std::size_t>(at - model.triangles().begin())));
  }
}

}  // namespace

Piece makeHandMadePiece(const HandMadePiece& plan, double width, double height) {
  std::map<Cell, VertexId> vertexAt;
  std::vector<Eigen::Vector3d> positions;
  const auto vertex = [&](int i, int j) {
    const auto [entry, isNew] = vertexAt.emplace(Cell(i, j), VertexId(positions.size()));
    if (isNew) positions.emplace_back(i * kLatticeMm, 0, j * kLatticeMm);
    return entry->second;
  };
  std::vector<Triangle> triangles;
  for (int j = 0; j < lattice(height); ++j) {
    for (int i = 0; i < lattice(width); ++i) {
      if (!plan.holds((i + 0.5) * kLatticeMm, (j + 0.5) * kLatticeMm)) continue;
      const VertexId a = vertex(i, j);
      const VertexId b = vertex(i + 1, j);
      const VertexId c = vertex(i + 1, j + 1);
      const VertexId d = vertex(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  if (!mesh) std::abort();

  Piece piece;
  piece.id = piece.name = plan.id;
  piece.mesh = std::make_shared<const Mesh>(*std::move(mesh));
  const Mesh& m = *piece.mesh;
  const auto addEdge = [&](Wire& wire, VertexId from, VertexId to) {
    if (wire.vertices.empty()) wire.vertices.push_back(from);
    wire.vertices.push_back(to);
    wire.bodyLength.push_back((m.position(to) - m.position(from)).norm());
    wire.targetLength.push_back(wire.bodyLength.back());
  };
  for (const std::vector<HalfedgeId>& loop : m.boundaryLoops()) {
    const auto kindOf = [&](HalfedgeId h) {
      const Eigen::Vector3d middle = 0.5 * (m.position(m.from(h)) + m.position(m.to(h)));
      return plan.edge(middle.x(), middle.z());
    };
    const auto parts = [&](std::size_t i) {  // whether a wire begins with halfedge i
      const HalfedgeId before = loop[(i + loop.size() - 1) % loop.size()];
      const Eigen::Vector3d& p = m.position(m.from(loop[i]));
      return kindOf(before) != kindOf(loop[i]) ||
             (plan.isJunction && plan.isJunction(p.x(), p.z()));
    };
    std::size_t first = 0;
    while (first < loop.size() && !parts(first)) ++first;
    if (first == loop.size()) first = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t i = (first + k) % loop.size();
      if (k == 0 || parts(i)) {
        Wire& wire = piece.wires.emplace_back();
        std::tie(wire.kind, wire.curve) = kindOf(loop[i]);
      }
      addEdge(piece.wires.back(), m.from(loop[i]), m.to(loop[i]));
    }
  }
  for (const auto& [curve, points] : plan.features) {
    Wire& wire = piece.wires.emplace_back();
    wire.kind = WireKind::Feature;
    wire.curve = curve;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const int steps = std::max(std::abs(lattice(points[i + 1].x() - points[i].x())),
                                 std::abs(lattice(points[i + 1].y() - points[i].y())));
      const auto at = [&](int k) {
        const Eigen::Vector2d p = points[i] + (points[i + 1] - points[i]) * k / steps;
        return vertexAt.at({lattice(p.x()), lattice(p.y())});
      };
      for (int k = 0; k < steps; ++k) addEdge(wire, at(k), at(k + 1));
    }
  }
  return piece;
}

FlatPiece flatOf(const Piece& piece) {
  FlatPiece flat;
  for (const Eigen::Vector3d& p : piece.mesh->positions())
    flat.position.values().emplace_back(p.x(), p.z());
  flat.distortion = FaceData<FaceDistortion>(piece.mesh->faceCount());
  return flat;
}

Pattern makeTwoPiecePattern(double allowanceMm) {
  const auto seamAt300 = [](double u, double v) {
    return u == 300 && v < 200 ? std::pair(WireKind::Seam, std::string("side"))
                               : std::pair(WireKind::Border, std::string("border"));
  };
  // The waist line parts the border of the ell; elsewhere it ends within a boundary wire.
  const auto atWaist = [](double u, double v) { return v == 100 && u == 0; };
  const HandMadePiece ell{
      "ell",
      [](double u, double v) { return u < 300 && (v < 200 || (u < 120 && v < 400)); },
      seamAt300,
      atWaist,
      {{"waist", {{0, 100}, {300, 100}}}}};
  const HandMadePiece panel{"panel",
                            [](double u, double v) { return u > 300 && u < 500 && v < 200; },
                            seamAt300,
                            atWaist,
                            {{"waist", {{300, 100}, {500, 100}}}}};
  const HandMadePiece whole{
      "whole",
      [&](double u, double v) { return ell.holds(u, v) || panel.holds(u, v); },
      [](double, double) { return std::pair(WireKind::Border, std::string("border")); },
      {},
      {{"side", {{300, 0}, {300, 200}}}}};

  auto design = std::make_shared<Design>();
  design->name = "two pieces";
  design->finish.allowance = Length::mm(allowanceMm);
  StylingCurve side;
  side.id = side.name = "side";
  if (allowanceMm > 0) side.right.allowance = Length::mm(6);
  StylingCurve waist;
  waist.id = "waist";
  waist.name = "Waist line";
  waist.kind = CurveKind::Feature;
  design->curves = {side, waist};
  PieceRecord ellRecord;
  ellRecord.id = "ell";
  ellRecord.count = 2;
  design->pieces = {ellRecord};
  Fabric fabric;
  fabric.id = "neo";
  fabric.name = "Neoprene 3 mm";
  design->fabrics = {fabric};
  design->order.size = "M";

  Pattern pattern;
  const Piece model = makeHandMadePiece(whole, 500, 400);
  pattern.document.design = design;
  pattern.document.model = std::make_shared<ReferenceModel>(
      ReferenceModel{"plane", "plane", model.mesh, nullptr, {}, {}, {}, nullptr, {}});
  const std::vector<VertexId>& sideWay = model.wires.back().vertices;
  pattern.curves = {drawn("side", CurveKind::Seam, edgePath(*model.mesh, sideWay))};
  for (const HandMadePiece& plan : {ell, panel}) {
    pattern.cut.pieces.push_back(makeHandMadePiece(plan, 500, 400));
    putOnModel(pattern.cut.pieces.back(), *model.mesh);
    pattern.flats.push_back(std::make_shared<const FlatPiece>(flatOf(pattern.cut.pieces.back())));
    pattern.failures.emplace_back();
    pattern.pieceIndex.push_back(static_cast<std::uint32_t>(pattern.pieceIndex.size()));
  }
  // The sides of the seam run in opposite directions.
  const auto& a = pattern.cut.pieces[0].wires;
  const auto& b = pattern.cut.pieces[1].wires;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (a[i].kind == WireKind::Seam && b[j].kind == WireKind::Seam &&
          pattern.cut.pieces[0].mesh->position(a[i].vertices.front()) ==
              pattern.cut.pieces[1].mesh->position(b[j].vertices.back()))
        pattern.cut.mates.push_back({0, i, 1, j});

  auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  if (!pieces) {
    ADD_FAILURE() << pieces.error().message;
    return pattern;
  }
  pattern.pieces = *std::move(pieces);
  auto layout = arrange(*pattern.document.model, pattern.cut, pattern.flats, pattern.pieces,
                        pattern.pieceIndex);
  if (!layout) {
    ADD_FAILURE() << layout.error().message;
    return pattern;
  }
  pattern.layout = *std::move(layout);
  return pattern;
}

}  // namespace toile::test
