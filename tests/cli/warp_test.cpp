// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/dress_block.h"
#include "support/run_program.h"
#include "toile/mesh/mesh_file.h"
#include "toile/shape/builtin.h"

namespace toile::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kWoman = "builtin:body@1?size=EU38F", kOther = "builtin:body@1?size=EU46F";

ProgramResult toile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TOILE_EXECUTABLE);
  return runProgram(arguments);
}

/// A skirt on the block: cut off at the waist, with a line at the hip.
constexpr const char* kSkirt = R"({
  "toile": 1, "name": "Skirt",
  "models": [{"model": "block.ply"}],
  "curves": [
    {"id": "waist", "kind": "seam", "closed": true,
     "way": {"section": {"normal": [0, 0, 1], "offset": "1050mm"}}},
    {"id": "hip", "kind": "feature", "closed": true,
     "way": {"section": {"normal": [0, 0, 1], "offset": "950mm"}}}
  ],
  "pieces": []
})";

class WarpCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const ReferenceModel woman = makeBuiltinModel(kWoman).value();
    writeText(folder_->path() / "block.ply", writePly(dressBlock(woman, 30)));
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path file(const std::string& name) { return folder_->path() / name; }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(WarpCommand, WritesTheProductAroundTheOtherBody) {
  const ProgramResult result =
      toile({"warp", file("block.ply"), "--from", kWoman, "--to", kOther, "--girth", "hip_girth",
             "--girth", "waist_girth:ease=40mm", "--girth", "middle:z=980mm", "-o",
             file("out/block.ply"), "--report", file("report.json")});
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("block: ok"));
  const auto json = nlohmann::json::parse(readText(file("report.json")));
  ASSERT_EQ(json["girths"].size(), 3U);
  EXPECT_NEAR(json["girths"][1]["easeMm"]["after"].get<double>(), 40, 1);
  EXPECT_TRUE(fs::exists(file("out/block.ply")));
}

// The same plane said in two ways gives the same girth; one that leans is kept like any other.
TEST_F(WarpCommand, TakesAGirthThroughThreePlaces) {
  const ProgramResult result =
      toile({"warp", file("block.ply"), "--from", kWoman, "--to", kOther, "--girth",
             "level:z=980mm", "--girth", "same:through=0,-100,980/100,0,980/0,100,980", "--girth",
             "slant:through=0,-100,960/150,0,980/0,100,1000", "-o", file("slant.ply"), "--report",
             file("slant.json")});
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  const auto girths = nlohmann::json::parse(readText(file("slant.json")))["girths"];
  ASSERT_EQ(girths.size(), 3U);
  EXPECT_EQ(girths[0]["easeMm"], girths[1]["easeMm"]);
  EXPECT_NE(girths[0]["easeMm"], girths[2]["easeMm"]);
  for (const auto& girth : girths) EXPECT_LT(girth["largestErrorMm"].get<double>(), 1);
}

TEST_F(WarpCommand, KeepsAPartOfSpaceRigid) {
  const ProgramResult result =
      toile({"warp", file("block.ply"), "--from", kWoman, "--to", "builtin:body@1?size=EU40F",
             "--rigid", "z<890mm", "-o", file("out/rigid.ply")});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
}

TEST_F(WarpCommand, TakesTheDesignAlong) {
  writeText(file("skirt.toile"), kSkirt);
  const ProgramResult result = toile({"warp", file("skirt.toile"), "--from", kWoman, "--to", kOther,
                                      "--girth", "hip_girth", "-o", file("her/skirt.toile")});
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_TRUE(fs::exists(file("her/skirt.model.json")));
  const ProgramResult own = toile({"make", file("skirt.toile"), "--auto-cut", "-o", file("a")});
  ASSERT_EQ(own.status, 0) << own.err;
  const ProgramResult made =
      toile({"make", file("her/skirt.toile"), "--auto-cut", "-o", file("b")});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_NE(readText(file("a/lengths.csv")), readText(file("b/lengths.csv")));
}

TEST_F(WarpCommand, WritesNothingThatMissesItsGirths) {
  const ProgramResult result =
      toile({"warp", file("block.ply"), "--from", kWoman, "--to", kOther, "--girth",
             "hip_girth:ease=20mm", "--girth", "hip_girth:ease=50mm", "-o", file("bad.ply")});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[warp-ease]"));
  EXPECT_THAT(result.err, HasSubstr("is not written"));
  EXPECT_FALSE(fs::exists(file("bad.ply")));
}

TEST_F(WarpCommand, RefusesWhatItDoesNotUnderstand) {
  struct Case {
    std::vector<std::string> more;
    int status;
    std::string text;
  };
  for (const Case& each : {
           Case{{"--girth", "wiast_girth"}, 1, "did you mean \"waist_girth\""},
           Case{{"--girth", "middle"}, 1, "its girths: ankle_girth_l"},
           Case{{"--girth", "slant:through=navel/crotch"}, 2, "is not understood"},
           Case{{"--girth", "slant:through=navel/navel/crotch"}, 1, "lie in one line"},
           Case{{"--girth", "slant:through=navle/crotch/0,0,0"}, 1, "\"navle\" is neither a place"},
           Case{{"--girth", "waist:q=9mm"}, 2, "\"q=9mm\" is not understood"},
           Case{{"--girth", "above:z=9m"}, 1, "does not go round"},
           Case{{"--rigid", "z<9"}, 2, "--rigid"},
           Case{{"--rigid", "sole"}, 1, "has no design"},
       }) {
    std::vector<std::string> words = {"warp", file("block.ply"), "--from", kWoman, "--to", kOther,
                                      "-o",   file("none.ply")};
    words.insert(words.end(), each.more.begin(), each.more.end());
    const ProgramResult result = toile(words);
    EXPECT_EQ(result.status, each.status) << each.more[1];
    EXPECT_THAT(result.err, HasSubstr(each.text));
  }
  EXPECT_FALSE(fs::exists(file("none.ply")));
}

// The fit of the one body to the other is refused before anything is warped.
TEST_F(WarpCommand, RefusesABodyOfAnotherKind) {
  const ProgramResult result = toile({"warp", file("block.ply"), "--from", kWoman, "--to",
                                      "builtin:bent-sleeve@1", "-o", file("none.ply")});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("does not fit"));
}

}  // namespace
}  // namespace toile::test
