// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace toile::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kSleeve = std::string(TOILE_SOURCE_DIR) + "/examples/bent-sleeve.toile";

class Render : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult run(const std::string& in,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{TOILE_EXECUTABLE, "render", in, "-o", out_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  /// Width and height from the head of the PNG that was written.
  [[nodiscard]] std::pair<int, int> size() const {
    const std::string png = readText(out_);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    const auto number = [&png](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i) {
        value = 256 * value + static_cast<unsigned char>(png[i]);
      }
      return value;
    };
    return {number(16), number(20)};
  }
  TemporaryFolder folder_;
  fs::path out_ = folder_.path() / "a.png";
};

TEST_F(Render, DrawsADesign) {
  const ProgramResult result = run(kSleeve, {"--size", "320x200"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(size(), std::pair(320, 200));
}

TEST_F(Render, DrawsAModelAlone) {
  EXPECT_EQ(run("builtin:torso@1", {"--size", "300x300", "--view", "top"}).status, 0);
  EXPECT_EQ(size(), std::pair(300, 300));
  writeText(folder_.path() / "tent.obj", "v 0 0 0\nv 10 0 4\nv 0 10 0\nf 1 2 3\n");
  const std::string tent = folder_.path() / "tent.obj";
  EXPECT_EQ(run(tent, {"--size", "64x48", "--units", "mm"}).status, 0);
  EXPECT_EQ(size(), std::pair(64, 48));
  const ProgramResult result = run(tent);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--units"));
}

TEST_F(Render, EveryOptionChangesThePicture) {
  const std::vector<std::string> small = {"--size", "240x160"};
  ASSERT_EQ(run(kSleeve, small).status, 0);
  const std::string usual = readText(out_);
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--view", "back,10,20"},
                                               {"--view", "none"},
                                               {"--style", "plain"},
                                               {"--lines", "none"},
                                               {"--pieces", "strain"},
                                               {"--pieces", "strain", "--strain", "across"},
                                               {"--pieces", "none"},
                                               {"--explode", "30%"},
                                               {"--at", "0,0,200"},
                                               {"--at", "0,0,200", "--height", "120mm"},
                                               {"--no-captions"}}) {
    std::vector<std::string> words = small;
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run(kSleeve, words);
    EXPECT_EQ(result.status, 0) << more[0] << result.err;
    EXPECT_FALSE(readText(out_) == usual) << more[0] << ' ' << more.back();
  }
  // Given twice, views add up; spelled out, the defaults are the defaults.
  ASSERT_EQ(run(kSleeve, {"--size", "240x160", "--view", "front", "--view", "back", "--style",
                          "product", "--lines", "all", "--pieces", "cloth", "--explode", "0%"})
                .status,
            0);
  EXPECT_TRUE(readText(out_) == usual);
}

TEST_F(Render, IsByteForByteTheSameWithOneAndTwoThreads) {
  ASSERT_EQ(run(kSleeve, {"--size", "320x200", "--threads", "1"}).status, 0);
  const std::string one = readText(out_);
  ASSERT_EQ(run(kSleeve, {"--size", "320x200", "--threads", "2"}).status, 0);
  EXPECT_TRUE(one == readText(out_));
}

TEST_F(Render, RefusesWrongCommandLines) {
  for (const auto& [more, text] :
       {std::pair<std::vector<std::string>, std::string>{{"--view", "frnt"}, "\"frnt\""},
        {{"--view", "none", "--pieces", "none"}, "nothing to show"},
        {{"--size", "100"}, "1600x1000"},
        {{"--size", "100x"}, "1600x1000"},
        {{"--size", "5x5"}, "16 to 16000"},
        {{"--size", "99999999999x5"}, "1600x1000"},
        {{"--style", "shiny"}, "product, plain"},
        {{"--lines", "some"}, "all, seams, none"},
        {{"--pieces", "all"}, "cloth, strain, none"},
        {{"--explode", "300%"}, "0 to 200 %"},
        {{"--explode", "far"}, "--explode"},
        {{"--height", "200mm"}, "--at"},
        {{"--at", "0,0,200", "--height", "0mm"}, "more than 0"},
        {{"--at", "0,0,200", "--height", "9"}, "--height"},
        {{"--vew", "front"}, "--view"}}) {
    const ProgramResult result = run(kSleeve, more);
    EXPECT_EQ(result.status, 2) << more[0] << ' ' << more.back();
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_FALSE(fs::exists(out_)) << more[0];
  }
  EXPECT_EQ(run("builtin:torso@1", {"--body", "builtin:torso@1"}).status, 2);
  EXPECT_EQ(runProgram({TOILE_EXECUTABLE, "render", kSleeve}).status, 2) << "no -o";
}

TEST_F(Render, ClosesUpOnALandmarkOrAPlace) {
  const std::vector<std::string> words = {"--size", "64x64", "--no-captions", "--at"};
  const auto at = [&](const std::string& place) {
    std::vector<std::string> all = words;
    all.push_back(place);
    return run("builtin:torso@1", all);
  };
  const ProgramResult named = at("crotch");
  EXPECT_EQ(named.status, 0) << named.err;
  const ProgramResult result = at("elbow");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("\"elbow\""), HasSubstr("crotch")));
  EXPECT_EQ(at("1,2").status, 1);
  EXPECT_EQ(at("1,2,3,4").status, 1);
}

TEST_F(Render, FailsOnWhatItCannotRead) {
  for (const char* in : {"none.toile", "none.ply", "builtin:none@1"}) {
    const ProgramResult result = run(in, {"--units", "mm"});
    EXPECT_EQ(result.status, 1) << in;
    EXPECT_THAT(result.err, HasSubstr("none"));
    EXPECT_FALSE(fs::exists(out_)) << in;
  }
}

TEST_F(Render, ShowsWhatIsMadeAndNamesWhatIsNot) {
  // A tube without a seam cannot lie flat: the picture shows the model, the status tells.
  writeText(folder_.path() / "tube.toile",
            R"({"toile": 1, "name": "tube", "models": [{"model": "builtin:bent-sleeve@1"}],
                "curves": []})");
  const std::string tube = folder_.path() / "tube.toile";
  const ProgramResult result = run(tube, {"--size", "200x100", "--json"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(nlohmann::json::parse(result.out)["complete"], false);
  EXPECT_EQ(size(), std::pair(200, 100));
  EXPECT_EQ(run(tube, {"--size", "200x100", "--auto-cut"}).status, 0);
}

}  // namespace
}  // namespace toile::test
