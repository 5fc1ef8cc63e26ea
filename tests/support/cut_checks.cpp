// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/cut_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace toile::test {

double areaOf(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) sum += mesh.area(FaceId(f));
  return sum;
}

double lengthOf(const Wire& wire) {
  double sum = 0;
  for (const double length : wire.bodyLength) sum += length;
  return sum;
}

void expectSoundWires(const CutResult& result) {
  for (const Piece& piece : result.pieces) {
    const Mesh& mesh = *piece.mesh;
    std::set<HalfedgeId> boundary;
    for (const auto& loop : mesh.boundaryLoops()) boundary.insert(loop.begin(), loop.end());
    bool innerSeen = false;
    for (const Wire& wire : piece.wires) {
      ASSERT_GE(wire.vertices.size(), 2U);
      ASSERT_EQ(wire.bodyLength.size() + 1, wire.vertices.size());
      ASSERT_EQ(wire.targetLength.size(), wire.bodyLength.size());
      ASSERT_EQ(wire.cutEdges.size(), wire.bodyLength.size());
      innerSeen = innerSeen || !isBoundary(wire.kind);
      EXPECT_NE(innerSeen, isBoundary(wire.kind)) << "boundary wires come first";
      for (std::size_t i = 0; i < wire.bodyLength.size(); ++i) {
        const EdgeId e = mesh.findEdge(wire.vertices[i], wire.vertices[i + 1]);
        ASSERT_TRUE(e.isValid()) << piece.id << " wire " << wire.curve;
        EXPECT_NEAR(wire.bodyLength[i], mesh.length(e), 1e-12 * mesh.length(e));
        const CutEdge& owner = result.refined->cutEdges[wire.cutEdges[i].index()];
        EXPECT_EQ(wire.bodyLength[i], owner.bodyLength);
        EXPECT_EQ(wire.targetLength[i], owner.targetLength);
        EXPECT_EQ(mesh.isBorder(e), isBoundary(wire.kind));
        if (!mesh.isBorder(e)) continue;
        const HalfedgeId h = mesh.halfedge(e);
        ASSERT_EQ(mesh.from(h), wire.vertices[i]) << "the piece lies on the right";
        EXPECT_EQ(boundary.erase(h), 1U) << "an edge of two wires";
      }
    }
    EXPECT_TRUE(boundary.empty()) << boundary.size() << " boundary edges without wire";
  }
  for (const SeamMates& m : result.mates) {
    const Piece& a = result.pieces[m.pieceA];
    const Piece& b = result.pieces[m.pieceB];
    const Wire& wa = a.wires[m.wireA];
    const Wire& wb = b.wires[m.wireB];
    EXPECT_EQ(wa.curve, wb.curve);
    EXPECT_EQ(wa.kind, wb.kind);
    auto reversed = wb.targetLength;
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(wa.targetLength, reversed);
    ASSERT_EQ(wa.vertices.size(), wb.vertices.size());
    for (std::size_t i = 0; i < wa.vertices.size(); ++i) {
      EXPECT_EQ(a.onModel[wa.vertices[i]], b.onModel[wb.vertices[wb.vertices.size() - 1 - i]]);
    }
  }
}

void expectGluesBack(const Mesh& model, const CutResult& result) {
  const Mesh& fine = result.refined->mesh;
  using Corner = std::array<double, 3>;
  const auto key = [](const Mesh& mesh, FaceId f) {
    std::array<Corner, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.position(mesh.vertices(f)[k]);
      corners[k] = {p.x(), p.y(), p.z()};
    }
    return corners;
  };
  std::multiset<std::array<Corner, 3>> faces;
  for (std::size_t f = 0; f < fine.faceCount(); ++f) faces.insert(key(fine, FaceId(f)));
  double area = 0;
  double boundary = 0;
  std::int64_t euler = 0;
  for (const Piece& piece : result.pieces) {
    EXPECT_EQ(piece.mesh->componentCount(), 1U);
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      const auto found = faces.find(key(*piece.mesh, FaceId(f)));
      ASSERT_NE(found, faces.end()) << "a face of " << piece.id << " is not the model's";
      faces.erase(found);
    }
    area += areaOf(*piece.mesh);
    euler += piece.mesh->eulerCharacteristic();
    for (const Wire& w : piece.wires) boundary += isBoundary(w.kind) ? lengthOf(w) : 0;
  }
  EXPECT_TRUE(faces.empty());
  EXPECT_NEAR(area, areaOf(model), 1e-12 * areaOf(model));

  double cutLength = 0;
  double border = 0;
  std::set<VertexId> onCut;
  std::int64_t cutEdges = 0;
  for (std::size_t i = 0; i < fine.edgeCount(); ++i) {
    const CutEdgeId id = result.refined->cutEdge[EdgeId(i)];
    if (!id.isValid() || !isBoundary(result.refined->cutEdges[id.index()].kind)) continue;
    const bool isBorder = fine.isBorder(EdgeId(i));
    (isBorder ? border : cutLength) += result.refined->cutEdges[id.index()].bodyLength;
    onCut.insert({fine.tail(EdgeId(i)), fine.head(EdgeId(i))});
    ++cutEdges;
  }
  EXPECT_NEAR(boundary, 2 * cutLength + border, 1e-12 * (1 + boundary));
  // Opened along a graph of V vertices and E edges a surface gains what the graph lacks: the open
  // surface is what is left without it.
  const auto graph = static_cast<std::int64_t>(onCut.size()) - cutEdges;
  EXPECT_EQ(euler, fine.eulerCharacteristic() - graph);
}

}  // namespace toile::test
