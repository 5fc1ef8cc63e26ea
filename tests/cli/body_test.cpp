// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

test::ProgramResult body(std::vector<std::string> words) {
  words.insert(words.begin(), {TOILE_EXECUTABLE, "body"});
  return test::runProgram(words);
}

TEST(BodyCommand, WritesABodyThatMeasuresWhatWasAskedFor) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "b.ply";
  const test::ProgramResult result =
      body({"--chest", "920mm", "--waist", "74cm", "-o", path, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json["bodies"][0]["measuresMm"]["chest"].get<double>(), 920, 2);
  EXPECT_NEAR(json["bodies"][0]["measuresMm"]["waist"].get<double>(), 740, 2);
  const Result<MeshFile> mesh = readMesh(path);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->mesh.faceCount(), 39680U);
}

TEST(BodyCommand, WritesEverySizeOfATable) {
  const test::TemporaryFolder folder;
  const std::string table = folder.path() / "own.csv";
  test::writeText(table, "size,chest\nS,84cm\nM/L,90cm\n");
  const std::string out = folder.path() / "bodies";
  const test::ProgramResult result = body({"--table", table, "-o", out});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(out + "/S.ply"));
  EXPECT_TRUE(std::filesystem::exists(out + "/M-L.ply"));
}

TEST(BodyCommand, RefusesWhatIsImpossible) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "b.ply";
  const test::ProgramResult result = body({"--neck", "900mm", "-o", path});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("nearest"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(body({"--chest", "920", "-o", path}).status, 2);
  EXPECT_EQ(body({"--chest", "920mm"}).status, 2);
  EXPECT_EQ(body({"--chst", "920mm", "-o", path}).status, 2);
}

TEST(BodyCommand, ListsTheRanges) {
  const test::ProgramResult result = body({"--list", "--form", "male"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("armscye"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace toile
