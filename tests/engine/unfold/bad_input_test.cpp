// SPDX-License-Identifier: GPL-3.0-or-later
// What no plane can be made of: each is refused, and the elements are named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "toile/unfold/unfold.h"

namespace toile {
namespace {

bool names(const Error& error, const Element& element) {
  return std::find(error.where.begin(), error.where.end(), element) != error.where.end();
}

/// A plane piece with a line through its middle.
Piece withLine() {
  return test::patchOf(test::grid(4, 2), {{"wire_feature_waist", {5, 6, 7, 8, 9}}});
}

TEST(BadInput, AWireEdgeWithoutAPositiveLengthIsNamed) {
  for (const double length : {0.0, -3.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    SCOPED_TRACE(length);
    Piece piece = withLine();
    const auto wire = std::find_if(piece.wires.begin(), piece.wires.end(),
                                   [](const Wire& w) { return w.curve == "waist"; });
    ASSERT_NE(wire, piece.wires.end());
    wire->targetLength[1] = length;
    const Result<FlatPiece> flat = unfold(piece);
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().code, ErrorCode::InvalidArgument);
    EXPECT_TRUE(names(flat.error(), Element::curve("waist")));
    EXPECT_TRUE(names(flat.error(), Element::edge(piece.mesh->findEdge(VertexId(6), VertexId(7)))));
  }
}

// A line that crosses another between two vertices would have to leave the edges of the mesh.
TEST(BadInput, ALineThatCrossesAnotherWithoutANodeIsNamed) {
  Piece piece = withLine();
  Wire across = piece.wires.front();
  across.curve = "across";
  across.kind = WireKind::Feature;
  across.vertices = {VertexId(2), VertexId(12)};
  across.targetLength = {20};
  across.bodyLength = {20};
  piece.wires.push_back(across);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::InvalidArgument);
  EXPECT_TRUE(names(flat.error(), Element::curve("across")));
  EXPECT_TRUE(names(flat.error(), Element::vertex(VertexId(2))));
}

// Two of a triangle's sides together are shorter than its third: no lengths of the plane.
TEST(BadInput, LengthsThatContradictEachOtherAreNamed) {
  const Mesh mesh = test::grid(4, 4);
  Piece piece = test::patchOf(
      mesh, {{"wire_feature_a", {6, 7}}, {"wire_feature_b", {7, 12}}, {"wire_feature_c", {6, 12}}});
  for (Wire& wire : piece.wires) {
    if (wire.curve == "c") wire.targetLength[0] *= 3;
  }
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::LengthsInfeasible);
  EXPECT_TRUE(std::any_of(flat.error().where.begin(), flat.error().where.end(),
                          [](const Element& e) { return e.kind == Element::Kind::Curve; }));
}

TEST(BadInput, APositionThatIsNoNumberIsNamed) {
  const Mesh mesh = test::grid(2, 2);
  std::vector<Eigen::Vector3d> positions = mesh.positions();
  positions[4].y() = std::nan("");
  const Result<Mesh> broken = makeMesh(positions, mesh.triangles());
  ASSERT_FALSE(broken);
  EXPECT_TRUE(names(broken.error(), Element::vertex(VertexId(4))));
}

TEST(BadInput, AnEmptyFileIsRefused) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "toile_empty_patch.obj";
  std::ofstream(path).close();
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  std::filesystem::remove(path);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::FileFormat);
  EXPECT_NE(file.error().message.find(path.filename().string()), std::string::npos) << file.error();
}

}  // namespace
}  // namespace toile
