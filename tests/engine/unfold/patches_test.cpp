// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/parallel.h"
#include "toile/unfold/unfold.h"

namespace toile {
namespace {

/// Mean area error in percent that a patch may have at the default options and with no price on
/// area; measured + 2 to 10 %.
struct Bar {
  const char* patch;
  double meanAreaError;
  double withoutAreaWeight;
};

class SharedPatch : public testing::TestWithParam<Bar> {};

TEST_P(SharedPatch, LiesFlatWithExactLengthsAndLittleStrain) {
  TOILE_TEST_DATA_OR_SKIP(path, std::string("patches/") + GetParam().patch + ".obj");
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const Result<Piece> piece = makePiece("patch", file->mesh, file->chains, file->targets);
  ASSERT_TRUE(piece) << piece.error();
  const Result<FlatPiece> flat = unfold(*piece);
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_TRUE(flat->check.passes());
  EXPECT_LE(flat->check.maxLengthError, 1e-12);
  EXPECT_LE(100 * flat->meanAreaError, GetParam().meanAreaError);
  EXPECT_LE(flat->check.maxTurnError * 180 / std::numbers::pi, 11);
  EXPECT_LE(flat->steps, 10);
  const Result<FlatPiece> plain = unfold(*piece, {.areaWeight = 0});
  ASSERT_TRUE(plain) << plain.error();
  EXPECT_TRUE(plain->check.passes());
  EXPECT_LE(100 * plain->meanAreaError, GetParam().withoutAreaWeight);
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedPatch,
    testing::Values(Bar{"sleeve_1k", 3.7, 6.6}, Bar{"sleeve_10k", 3.7, 6.6},
                    Bar{"saddle_1k", 5.6, 11.0}, Bar{"saddle_10k", 5.6, 11.0},
                    Bar{"body_legfront", 2.0, 3.7}, Bar{"body_torsofront", 2.4, 4.6},
                    Bar{"body_torsoquarter", 1.9, 3.6}, Bar{"body_torsoback", 3.4, 7.5},
                    Bar{"cap_1k", 33.0, 33.0}, Bar{"cap_10k", 33.0, 33.0},
                    Bar{"cyl_10k", 1e-3, 1e-3}, Bar{"cone_10k", 1e-3, 1e-3},
                    // The coarse ones are less developable: their inner vertices have curvature.
                    Bar{"cyl_1k", 6e-3, 1e-2}, Bar{"cone_1k", 6e-3, 1e-2}),
    [](const auto& each) { return std::string(each.param.patch); });

/// The shortest way along inner edges from one vertex of the border to another.
std::vector<std::uint32_t> wayAcross(const Mesh& mesh, VertexId from, VertexId to) {
  constexpr double kAlongTheBorder = 50;  // times as long
  std::vector<double> distance(mesh.vertexCount(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> before(mesh.vertexCount());
  std::set<std::pair<double, std::uint32_t>> queue{{0.0, from.index()}};
  distance[from.index()] = 0;
  while (!queue.empty()) {
    const auto [reached, v] = *queue.begin();
    queue.erase(queue.begin());
    for (const FaceId face : mesh.facesAround(VertexId(v))) {
      for (const VertexId next : mesh.vertices(face)) {
        if (next.index() == v) continue;
        const EdgeId edge = mesh.findEdge(VertexId(v), next);
        const double there =
            reached + mesh.length(edge) * (mesh.isBorder(edge) ? kAlongTheBorder : 1);
        if (there >= distance[next.index()]) continue;
        queue.erase({distance[next.index()], next.index()});
        distance[next.index()] = there;
        before[next.index()] = v;
        queue.insert({there, next.index()});
      }
    }
  }
  std::vector<std::uint32_t> way{to.index()};
  while (way.back() != from.index()) way.push_back(before[way.back()]);
  return way;
}

TEST(SharedPatches, TheSleeveWithTwoInnerLinesStaysExactAtLittleStrain) {
  TOILE_TEST_DATA_OR_SKIP(path, "patches/sleeve_1k.obj");
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const std::vector<HalfedgeId> border = file->mesh.boundaryLoops().front();
  constexpr int kTrials = 25;
  std::mt19937 random(5);
  double worst = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<PolygonSoup::Chain> lines(2);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const std::size_t i = random() % border.size();
      const std::size_t apart = border.size() / 4 + random() % (border.size() / 2);
      lines[k].group = "wire_feature_" + std::to_string(k);
      lines[k].vertices = wayAcross(file->mesh, file->mesh.from(border[i]),
                                    file->mesh.from(border[(i + apart) % border.size()]));
    }
    SCOPED_TRACE(trial);
    const Result<Piece> piece = makePiece("patch", file->mesh, lines);
    ASSERT_TRUE(piece) << piece.error();
    const Result<FlatPiece> flat = unfold(*piece);
    ASSERT_TRUE(flat) << flat.error();
    EXPECT_TRUE(flat->check.passes());
    EXPECT_LE(flat->check.maxLengthError, 1e-12);
    worst = std::max(worst, flat->meanAreaError);
  }
  EXPECT_LE(worst, 0.05);
}

TEST(SharedPatches, ManyThreadsGiveTheSameBits) {
  TOILE_TEST_DATA_OR_SKIP(path, "patches/body_legfront.obj");
  const Result<MeshFile> file = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const Result<Piece> piece = makePiece("patch", file->mesh, file->chains);
  ASSERT_TRUE(piece) << piece.error();
  const auto solve = [&](std::size_t threads) {
    const ThreadLimit limit(threads);
    std::vector<std::vector<Eigen::Vector2d>> answers(4);
    parallelFor(answers.size(),
                [&](std::size_t i) { answers[i] = unfold(*piece)->position.values(); });
    return answers;
  };
  const auto one = solve(1), two = solve(2);
  for (const auto& answers : {one, two}) {
    for (const auto& answer : answers) {
      ASSERT_EQ(answer.size(), one[0].size());
      EXPECT_EQ(std::memcmp(answer.data(), one[0].data(), answer.size() * sizeof(Eigen::Vector2d)),
                0);
    }
  }
}

}  // namespace
}  // namespace toile
