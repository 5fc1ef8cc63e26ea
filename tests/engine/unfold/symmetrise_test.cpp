// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/symmetrise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "support/test_data.h"

namespace toile {
namespace {

/// A crotch-like surface that is its own mirror image in x = 0, meshed with other columns on either
/// side: `left` and `right` of them.
Mesh crotch(int left, int right, int rows, double skew = 0) {
  const auto place = [&](double u, double v) {  // u from -1 to 1
    const double narrow = 1 - 0.45 * v * v;
    const double x = 110 * u * narrow;
    return Eigen::Vector3d(x, 40 * std::sin(2.5 * v) * (1 - 0.6 * u * u) + 15 * u * u + skew * u,
                           150 * v + 25 * u * u * v);
  };
  std::vector<double> columns;
  for (int i = 0; i <= left; ++i) columns.push_back(-1 + static_cast<double>(i) / left);
  for (int i = 1; i <= right; ++i) columns.push_back(std::pow(static_cast<double>(i) / right, 1.2));
  const Mesh flat = test::grid(left + right, rows);
  std::vector<Eigen::Vector3d> positions;
  for (int j = 0; j <= rows; ++j) {
    for (const double u : columns) {
      // Rows that are not level, so that the sides have their points at other heights too.
      const double v = std::clamp(-0.5 + (j + 0.3 * u * std::sin(j * 3.0)) / rows, -0.5, 0.5);
      positions.push_back(place(u, j == 0 || j == rows ? -0.5 + static_cast<double>(j) / rows : v));
    }
  }
  return flat.withPositions(std::move(positions));
}

/// Greatest distance of the outline from its mirror image in an axis of the plane through 0.
double flatAsymmetry(const SymmetricPiece& piece, const FlatPiece& flat) {
  const Eigen::Vector2d a = flat.position[piece.symmetry.axis[0]];
  const Eigen::Vector2d b = flat.position[piece.symmetry.axis[1]];
  const int across = std::abs(a.x() - b.x()) < std::abs(a.y() - b.y()) ? 0 : 1;
  double greatest = std::max(std::abs(a[across]), std::abs(b[across]));
  for (const auto& [right, left] : piece.symmetry.pairs) {
    Eigen::Vector2d image = flat.position[right];
    image[across] = -image[across];
    greatest = std::max(greatest, (flat.position[left] - image).norm());
  }
  return greatest;
}

/// Pairs and axis are the whole outline, and no edge of it is without its image.
void expectWholeOutline(const SymmetricPiece& piece) {
  std::size_t border = 0;
  for (std::size_t v = 0; v < piece.piece.mesh->vertexCount(); ++v) {
    if (piece.piece.mesh->isBorder(VertexId(v))) ++border;
  }
  EXPECT_EQ(border, 2 * piece.symmetry.pairs.size() + piece.symmetry.axis.size());
  VertexId lastRight = piece.symmetry.axis[0], lastLeft = lastRight;
  for (const auto& [right, left] : piece.symmetry.pairs) {
    EXPECT_TRUE(piece.piece.mesh->findEdge(lastRight, right).isValid());
    EXPECT_TRUE(piece.piece.mesh->findEdge(lastLeft, left).isValid());
    lastRight = right;
    lastLeft = left;
  }
}

TEST(Symmetrise, AsymmetricallyMeshedCrotchUnfoldsToItsOwnMirrorImage) {
  const Piece piece = test::patchOf(test::turnedAnyhow(crotch(9, 14, 17)));
  const std::optional<SymmetricPiece> symmetric = symmetrise(piece);
  ASSERT_TRUE(symmetric.has_value());
  EXPECT_GT(symmetric->addedVertices, 10U);
  EXPECT_LT(symmetric->asymmetry, 1.5);
  expectWholeOutline(*symmetric);
  const Result<FlatPiece> flat = unfold(*symmetric), other = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  ASSERT_TRUE(other) << other.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LE(flat->check.maxLengthError, 1e-12);
  EXPECT_EQ(flatAsymmetry(*symmetric, *flat), 0);
  // It is the same piece but for the symmetry.
  EXPECT_LT(flat->meanAreaError, 1.1 * other->meanAreaError + 1e-3);
  double before = 0, after = 0;
  for (const Wire& wire : piece.wires) {
    for (const double target : wire.targetLength) before += target;
  }
  for (const Wire& wire : symmetric->piece.wires) {
    for (const double target : wire.targetLength) after += target;
    EXPECT_EQ(wire.targetLength.size() + 1, wire.vertices.size());
  }
  EXPECT_NEAR(before, after, 1e-9 * before);
  EXPECT_EQ(symmetric->piece.sourceFace.size(), symmetric->piece.mesh->faceCount());
}

TEST(Symmetrise, TakesTheMeanWhereTheSidesDiffer) {
  const std::optional<SymmetricPiece> symmetric = symmetrise(test::patchOf(crotch(9, 14, 17, 1.0)));
  ASSERT_TRUE(symmetric.has_value());
  EXPECT_GT(symmetric->maxLengthChange, 1e-3);
  const Result<FlatPiece> flat = unfold(*symmetric);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_EQ(flatAsymmetry(*symmetric, *flat), 0);
}

TEST(Symmetrise, LeavesASymmetricMeshAsItIs) {
  const Mesh mesh = test::heightField(
      8, 7, 10, [](double x, double y) { return 0.01 * (x - 40) * (x - 40) + 0.3 * y; });
  const Piece piece = test::patchOf(mesh);
  const std::optional<SymmetricPiece> symmetric = symmetrise(piece);
  ASSERT_TRUE(symmetric.has_value());
  EXPECT_EQ(symmetric->addedVertices, 0U);
  EXPECT_EQ(symmetric->piece.mesh, piece.mesh);
  EXPECT_LT(symmetric->maxLengthChange, 1e-12);
  expectWholeOutline(*symmetric);
}

// Symmetric data need no asking; a bump on one side, or a line, takes the symmetry away.
TEST(Symmetrise, UnfoldKeepsASymmetryThatIsThere) {
  const auto height = [](double x, double y) { return 0.01 * (x - 40) * (x - 40) + 0.3 * y; };
  const auto bump = [&](double x, double y) {
    return height(x, y) + 8 * std::exp(-((x - 20) * (x - 20) + (y - 35) * (y - 35)) / 40);
  };
  const auto asymmetry = [](const Piece& piece, const SymmetricPiece& pairs) {
    return flatAsymmetry(pairs, *unfold(piece));
  };
  const Piece even = test::patchOf(test::heightField(8, 7, 10, height));
  const SymmetricPiece pairs = *symmetrise(even);
  EXPECT_EQ(asymmetry(even, pairs), 0);
  EXPECT_GT(asymmetry(test::patchOf(test::heightField(8, 7, 10, bump)), pairs), 1e-3);
  PolygonSoup::Chain line;
  for (std::uint32_t j = 2; j <= 5; ++j) line.vertices.push_back(9 * j + 2);
  EXPECT_GT(asymmetry(test::patchOf(*even.mesh, {line}), pairs), 0);
}

TEST(Symmetrise, RefusesWhatIsNotSymmetric) {
  EXPECT_FALSE(symmetrise(test::patchOf(crotch(9, 14, 17, 40.0))).has_value());
  EXPECT_FALSE(symmetrise(test::patchOf(test::cylinder(50, 100, 20, 5))).has_value());
}

class SymmetricPatch : public testing::TestWithParam<const char*> {};

TEST_P(SymmetricPatch, OfABodyUnfoldsSymmetrically) {
  TOILE_TEST_DATA_OR_SKIP(path, std::string("patches/") + GetParam() + ".obj");
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const std::optional<SymmetricPiece> symmetric = symmetrise(test::patchOf(file->mesh));
  ASSERT_TRUE(symmetric.has_value());
  expectWholeOutline(*symmetric);
  const Result<FlatPiece> flat = unfold(*symmetric);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_EQ(flatAsymmetry(*symmetric, *flat), 0);
  EXPECT_LT(flat->meanAreaError, 0.035);
}

INSTANTIATE_TEST_SUITE_P(All, SymmetricPatch, testing::Values("body_torsofront", "body_torsoback"));

}  // namespace
}  // namespace toile
