// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "toile/mesh/mesh_file.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

/// A tent of 2 x 2 cells with a line over the ridge.
constexpr const char* kTent =
    "v 0 0 0\nv 10 0 4\nv 20 0 0\nv 0 10 0\nv 10 10 4\nv 20 10 0\nv 0 20 0\nv 10 20 4\nv 20 20 0\n"
    "f 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\nf 4 5 8\nf 4 8 7\nf 5 6 9\nf 5 9 8\n"
    "g wire_feature_ridge\nl 2 5 8\n";

class UnfoldCommand : public testing::Test {
 protected:
  void SetUp() override { writeText(in_, kTent); }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{TOILE_EXECUTABLE, "unfold", in_.string(), "-o", out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  TemporaryFolder folder_;
  std::filesystem::path in_ = folder_.path() / "tent.obj";
  std::filesystem::path out_ = folder_.path() / "flat.obj";
};

TEST_F(UnfoldCommand, WritesThePatchWithItsPlane) {
  const ProgramResult result = run({"--units", "mm"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("8 faces, area error 0.00 %"));
  const std::string text = readText(out_);
  EXPECT_THAT(text, HasSubstr("# toile-units: mm\nv 0 0 0\n"));
  EXPECT_THAT(text, HasSubstr("f 1/1 2/2 5/5\n"));
  EXPECT_THAT(text, HasSubstr("g wire_feature_ridge\nl 2 5 8\n"));
}

TEST_F(UnfoldCommand, PutsInDartsAndTellsWhereFacesComeFrom) {
  writeText(in_, writeObj(sphereCap(100, 3, 0)));
  const ProgramResult result = run({"--auto-dart", "8%"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("autodart-1"));
  EXPECT_THAT(result.out, HasSubstr("the lengths alone force"));
  const std::string text = readText(out_);
  EXPECT_THAT(text, HasSubstr("g wire_dart_autodart-1\nl "));
  EXPECT_THAT(text, HasSubstr("# source-face 1\n"));
}

// A ridge that is to be 3 % longer than its cloth takes that back when it may, by one ratio.
TEST_F(UnfoldCommand, GivesElasticLinesTheLengthThatStrainsTheClothLeast) {
  std::string tent = kTent;
  tent.replace(tent.find("wire_feature_ridge"), 18, "wire_elastic_ridge");
  writeText(in_, tent + "# target wire_elastic_ridge 0 10.3\n# target wire_elastic_ridge 1 10.3\n");
  for (const auto& [range, ratio] : {std::pair("5%", 10 / 10.3 - 1), {"1%", -0.01}, {"0%", 0.0}}) {
    SCOPED_TRACE(range);
    const ProgramResult result = run({"--units", "mm", "--json", "--elastic-range", range});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json elastics = nlohmann::json::parse(result.out)["elastics"];
    ASSERT_EQ(elastics.size(), ratio == 0 ? 0U : 1U);
    if (ratio != 0) {
      EXPECT_EQ(elastics[0]["curve"], "ridge");
      EXPECT_NEAR(elastics[0]["ratio"].get<double>(), ratio, 1e-5);
    }
    // The file says what the lengths are now.
    const Result<MeshFile> flat = readMesh(out_);
    ASSERT_TRUE(flat) << flat.error();
    for (const char* edge : {"wire_elastic_ridge 0", "wire_elastic_ridge 1"}) {
      EXPECT_NEAR(flat->targets.at(edge), 10.3 * (1 + ratio), 1e-3);
    }
  }
}

TEST_F(UnfoldCommand, TellsProgramsTheCheck) {
  const ProgramResult result = run({"--units", "mm", "--json", "--area-weight", "0"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["faces"], 8);
  EXPECT_EQ(json["check"]["passes"], true);
  EXPECT_LE(json["check"]["maxLengthError"].get<double>(), 1e-12);
}

TEST_F(UnfoldCommand, WarpsTheWiresOnWish) {
  const ProgramResult strained = run({"--units", "mm", "--json"});
  const ProgramResult warped =
      run({"--units", "mm", "--json", "--objective", "wirewarping", "--weights", "unit"});
  ASSERT_EQ(warped.status, 0) << warped.err;
  EXPECT_EQ(nlohmann::json::parse(strained.out)["wireBending"], 0.0);
  const nlohmann::json json = nlohmann::json::parse(warped.out);
  EXPECT_GT(json["wireBending"].get<double>(), 0);
  EXPECT_EQ(json["check"]["passes"], true);
}

TEST_F(UnfoldCommand, RefusesWithOneSentenceAndWritesNothing) {
  struct Case {
    std::vector<std::string> words;
    int status;
    std::string sentence;
  };
  for (const Case& each : std::initializer_list<Case>{
           {{}, 1, "--units"},
           {{"--units", "mm", "--objective", "other"}, 2, "other"},
           {{"--units", "mm", "--weights", "other"}, 2, "other"},
           {{"--units", "mm", "--area-weight", "-1"}, 2, "--area-weight"}}) {
    const ProgramResult result = run(each.words);
    EXPECT_EQ(result.status, each.status) << result.err;
    EXPECT_THAT(result.err, HasSubstr(each.sentence));
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
  writeText(in_, std::string(kTent) + "l 1 9\n");
  const ProgramResult stray = run({"--units", "mm"});
  EXPECT_EQ(stray.status, 1);
  EXPECT_THAT(stray.err, HasSubstr("no edge of the mesh joins"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(UnfoldCommand, RefusesMeshesThatNoPlaneCanBeMadeOfAndNamesWhere) {
  struct Case {
    std::string mesh, sentence;
  };
  const std::string square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3\nf 1 3 4\n";
  for (const Case& each : std::initializer_list<Case>{
           {"", "is empty"},
           {"v 0 0 0\nv 10 nan 0\nv 0 10 0\nf 1 2 3\n", "line 2: \"nan\""},
           {"v 0 0 0\nv 10 0 0\nv 20 0 0\nv 0 10 0\nf 1 2 4\nf 2 3 4\nf 1 3 2\n", "face 2"},
           // A border edge of no length.
           {square + "v 0 10 0\nf 3 5 4\n", "face 2"},
           {square + "g wire_feature_across\nl 2 4\n", "\"across\""},
           {"v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
            "closed"}}) {
    writeText(in_, each.mesh);
    const ProgramResult result = run({"--units", "mm"});
    EXPECT_EQ(result.status, 1) << each.mesh;
    EXPECT_THAT(result.err, HasSubstr(each.sentence));
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
}

}  // namespace
}  // namespace toile::test
