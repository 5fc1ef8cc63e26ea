// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/test_data.h"

namespace toile::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kWetsuit = std::string(TOILE_SOURCE_DIR) + "/examples/wetsuit-full.toile";

ProgramResult toile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TOILE_EXECUTABLE);
  return runProgram(arguments);
}

TEST(TransferCommand, WritesADesignThatCanBeMade) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "man" / "suit.toile";
  const ProgramResult result =
      toile({"transfer", kWetsuit, "--to", "builtin:body@1?size=EU50M", "-o", out, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "toile-transfer");
  EXPECT_TRUE(json["findings"].empty());
  const ProgramResult made = toile({"make", out, "-o", folder.path() / "cut"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("20 pieces"));
}

TEST(TransferCommand, RefusesAModelOfAnotherKind) {
  TOILE_TEST_DATA_OR_SKIP(chair, "toys/armchair.ply");
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "chair.toile";
  const ProgramResult result =
      toile({"--units", "mm", "transfer", kWetsuit, "--to", chair, "-o", out});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("does not fit armchair"));
  EXPECT_FALSE(fs::exists(out));
}

TEST(TransferCommand, MakesADesignForAScanWithHoles) {
  TOILE_TEST_DATA_OR_SKIP(scan, "scans/male_heavy_holes.ply");
  const std::string design = std::string(TOILE_SOURCE_DIR) + "/tests/designs/wetsuit.toile";
  const TemporaryFolder folder;
  const ProgramResult result =
      toile({"--units", "mm", "make", design, "--body", scan, "-o", folder.path() / "cut"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("[fitted-body]"));
  EXPECT_THAT(result.err, HasSubstr("[fit-filled-in]"));
  EXPECT_THAT(result.out, HasSubstr("24 pieces"));
}

}  // namespace
}  // namespace toile::test
