// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/meshes.h"
#include "support/run_program.h"
#include "toile/mesh/mesh_file.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

class DevelopCommand : public testing::Test {
 protected:
  void SetUp() override {
    writeText(in_, writeObj(saddle(10)) + "g wire_feature_mid\nl 6 17 28\n");
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{TOILE_EXECUTABLE, "develop", in_.string(), "-o", out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  TemporaryFolder folder_;
  std::filesystem::path in_ = folder_.path() / "saddle.obj";
  std::filesystem::path out_ = folder_.path() / "developed.obj";
};

TEST_F(DevelopCommand, WritesAPatchThatUnfoldTakes) {
  const ProgramResult result = run({"-t", "0.5"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("t = 0.500"));
  EXPECT_THAT(result.out, HasSubstr("feature \"mid\""));
  const ProgramResult unfolded =
      runProgram({TOILE_EXECUTABLE, "unfold", out_.string(), "-o", in_.string()});
  EXPECT_EQ(unfolded.status, 0) << unfolded.err;
}

TEST_F(DevelopCommand, TellsProgramsBothErrors) {
  const ProgramResult result = run({"--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["t"], 1.0);
  EXPECT_LT(json["meanAreaError"]["againstProcessed"], json["meanAreaError"]["before"]);
  EXPECT_GT(json["meanAreaError"]["againstOriginal"], 0.0);
  EXPECT_EQ(json["features"][0]["curve"], "mid");
  EXPECT_TRUE(json["clearanceMm"].is_null());
}

TEST_F(DevelopCommand, RefusesContradictions) {
  EXPECT_EQ(run({"-t", "0.5", "--max-area-error", "3%"}).status, 2);
  EXPECT_EQ(run({"--gap", "2mm"}).status, 2);
  EXPECT_EQ(run({"-t", "1.5"}).status, 2);
}

}  // namespace
}  // namespace toile::test
