// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/meshes.h"
#include "support/run_program.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

test::ProgramResult check(std::vector<std::string> words) {
  words.insert(words.begin(), {TOILE_EXECUTABLE, "check"});
  return test::runProgram(words);
}

TEST(CheckCommand, SaysThatNothingIsWrong) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "tube.obj";
  test::writeText(path, writeObj(test::cylinder(50, 100, 12, 4)));
  const test::ProgramResult result = check({path});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("open, 1 part, 2 border loops"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("nothing is wrong"), std::string::npos) << result.out;
}

TEST(CheckCommand, NamesTheElementsOfARefusedSurface) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "fin.obj";
  test::writeText(path,
                  "v 0 0 0\nv 99 0 0\nv 0 99 0\nv 0 -99 0\nv 0 0 99\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  const test::ProgramResult plain = check({path, "--units", "mm"});
  EXPECT_EQ(plain.status, 1);
  EXPECT_NE(plain.err.find("1 edge with more than two faces, between vertices 0 and 1"),
            std::string::npos)
      << plain.err;
  const test::ProgramResult forPrograms = check({path, "--units", "mm", "--json"});
  EXPECT_EQ(forPrograms.status, 1);
  const nlohmann::json json = nlohmann::json::parse(forPrograms.out);
  EXPECT_EQ(json.at("refusal").at("code"), "NotManifold");
  EXPECT_EQ(json.at("refusal").at("where").size(), 2U);
  const test::ProgramResult withoutUnits = check({path});
  EXPECT_EQ(withoutUnits.status, 1);
  EXPECT_NE(withoutUnits.err.find("--units"), std::string::npos) << withoutUnits.err;
}

TEST(CheckCommand, WritesACleanCopy) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "mixed.obj";
  const std::string clean = folder.path() / "clean.ply";
  test::writeText(path,
                  "v 0 0 0\nv 99 0 0\nv 0 99 0\nv 99 99 0\nv 5 5 5\nf 1 2 3\nf 2 3 4\nf 1 2 2\n");
  EXPECT_EQ(check({path, "--units", "mm"}).status, 1);
  const test::ProgramResult repaired = check({path, "--units", "mm", "--repair", clean});
  EXPECT_EQ(repaired.status, 0) << repaired.err;
  EXPECT_EQ(check({clean}).status, 0) << "the copy says its unit and has no fault";
  EXPECT_EQ(check({path, "--units", "mm", "--repair", clean + ".xyz"}).status, 1);
}

}  // namespace
}  // namespace toile
