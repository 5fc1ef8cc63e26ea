// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace toile::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

ProgramResult map(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{TOILE_EXECUTABLE, "map"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return runProgram(words);
}

TEST(Map, DrawsTheMapOfAModel) {
  const TemporaryFolder folder;
  const std::string png = folder.path() / "a.png";
  const ProgramResult result = map({"builtin:torso@1", "-o", png, "--size", "300x200", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(readText(png), StartsWith("\x89PNG"));
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["charts"][0]["name"], "front");
  EXPECT_EQ(json["charts"][1]["side"], "back");
  EXPECT_EQ(map({"builtin:torso@1", "-o", folder.path() / "a.svg"}).status, 0);
  EXPECT_THAT(readText(folder.path() / "a.svg"), HasSubstr("<svg"));
}

TEST(Map, WritesTheMapForAModelFile) {
  const TemporaryFolder folder;
  writeText(folder.path() / "tent.obj",
            "v 0 0 0\nv 100 0 0\nv 0 0 80\nv 100 0 80\nf 1 2 4\nf 1 4 3\n");
  const std::string file = folder.path() / "map.json";
  EXPECT_EQ(map({folder.path() / "tent.obj", "--units", "mm", "-o", file}).status, 0);
  writeText(folder.path() / "tent.model.json",
            R"({"toile-model": 1, "mesh": "tent.obj", "units": "mm", "guidingMap": "map.json"})");
  const std::string again = folder.path() / "again.json";
  const ProgramResult result = map({folder.path() / "tent.model.json", "-o", again});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readText(again), readText(file));
}

TEST(Map, RefusesWhatItCannotDo) {
  const TemporaryFolder folder;
  const ProgramResult gif = map({"builtin:torso@1", "-o", folder.path() / "a.gif"});
  EXPECT_EQ(gif.status, 2);
  EXPECT_THAT(gif.err, HasSubstr(".png, .svg or .json"));
  const ProgramResult border =
      map({"builtin:torso@1", "--borders", "wasit_girth", "-o", folder.path() / "a.png"});
  EXPECT_EQ(border.status, 1);
  EXPECT_THAT(border.err, HasSubstr("did you mean \"waist_girth\"?"));
}

}  // namespace
}  // namespace toile::test
