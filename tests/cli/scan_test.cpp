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

ProgramResult toile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TOILE_EXECUTABLE);
  return runProgram(arguments);
}

TEST(ScanCommand, WritesAClosedModelItsReportAndAPicture) {
  TOILE_TEST_DATA_OR_SKIP(cow, "toys/spot.ply");
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "cow.ply";
  const fs::path picture = folder.path() / "cow.png";
  const ProgramResult result = toile({"--units", "mm", "scan", cow, "--kind", "object", "--edge",
                                      "6mm", "-o", out, "--picture", picture, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["format"], "toile-scan");
  EXPECT_EQ(json["components"], 1);
  EXPECT_LT(json["scanToModelMm"]["mean"], 1);  // horns and ears are as thin as the edges are long
  EXPECT_TRUE(fs::exists(picture));
  // Its unit is in the file; the check finds nothing.
  const ProgramResult checked = toile({"check", out});
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST(ScanCommand, AsksForTheUnitAndTheKind) {
  TOILE_TEST_DATA_OR_SKIP(chair, "toys/armchair.ply");
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "chair.ply";
  const ProgramResult unit = toile({"scan", chair, "-o", out});
  EXPECT_EQ(unit.status, 1);
  EXPECT_THAT(unit.err, HasSubstr("--units mm makes it"));
  const ProgramResult kind = toile({"--units", "mm", "scan", chair, "-o", out});
  EXPECT_EQ(kind.status, 1);
  EXPECT_THAT(kind.err, HasSubstr("--kind object"));
  EXPECT_FALSE(fs::exists(out));
  const ProgramResult wrong = toile({"scan", chair, "-o", out, "--kind", "person"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("body or object"));
}

}  // namespace
}  // namespace toile::test
