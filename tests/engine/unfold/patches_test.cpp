// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/parallel.h"
#include "toile/unfold/unfold.h"

namespace toile {
namespace {

/// Mean area error in percent that a patch may have at the default options; measured + 2 to 10 %.
struct Bar {
  const char* patch;
  double meanAreaError;
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
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedPatch,
    testing::Values(Bar{"sleeve_1k", 3.7}, Bar{"sleeve_10k", 3.7}, Bar{"saddle_1k", 5.6},
                    Bar{"saddle_10k", 5.6}, Bar{"body_legfront", 2.0}, Bar{"body_torsofront", 2.4},
                    Bar{"body_torsoquarter", 1.9}, Bar{"body_torsoback", 3.4}, Bar{"cap_1k", 33.0},
                    Bar{"cap_10k", 33.0}, Bar{"cyl_10k", 1e-3}, Bar{"cone_10k", 1e-3},
                    // The coarse ones are less developable: their inner vertices have curvature.
                    Bar{"cyl_1k", 6e-3}, Bar{"cone_1k", 6e-3}),
    [](const auto& each) { return std::string(each.param.patch); });

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
