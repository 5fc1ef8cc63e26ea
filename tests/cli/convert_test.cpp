// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/hand_made_pattern.h"
#include "support/run_program.h"
#include "toile/io/dxf.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

class ConvertCommand : public testing::Test {
 protected:
  void SetUp() override { writeText(in_, writeDxf(makeTwoPiecePattern()).text); }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{TOILE_EXECUTABLE, "convert", in_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  }
  TemporaryFolder folder_;
  std::filesystem::path in_ = folder_.path() / "in.dxf";
};

TEST_F(ConvertCommand, ListsThePieces) {
  const ProgramResult result = run({});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("ELL: cut 2"));
  const auto json = nlohmann::json::parse(run({"--json"}).out);
  EXPECT_NEAR(json["pieces"][0]["sewLengthMm"], 1400, 0.01);
}

TEST_F(ConvertCommand, WritesWhatTheEndingSays) {
  struct Case {
    const char* name;
    const char* begins;
  };
  for (const Case& each : {Case{"out.dxf", "  0\r\nSECTION"}, Case{"out.svg", "<?xml"},
                           Case{"out.pdf", "%PDF"}, Case{"out.plt", "IN;"}}) {
    const std::filesystem::path out = folder_.path() / each.name;
    const ProgramResult result = run({"-o", out.string()});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(readText(out), testing::StartsWith(each.begins));
  }
  const ProgramResult refused = run({"-o", (folder_.path() / "out.doc").string()});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr(".plt"));
}

TEST_F(ConvertCommand, RefusesAFileThatIsCutOff) {
  const std::string whole = readText(in_);
  writeText(in_, whole.substr(0, whole.size() / 2));
  const ProgramResult result = run({"-o", (folder_.path() / "out.svg").string()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("cut off"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.svg"));
}

TEST_F(ConvertCommand, RefusesAFileOf100Megabytes) {
  std::filesystem::resize_file(in_, 100'000'000);
  const ProgramResult result = run({"-o", (folder_.path() / "out.svg").string()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("MB"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.svg"));
}

TEST(CheckSewingCommand, SaysWhetherMatesFit) {
  TemporaryFolder folder;
  const std::string out = folder.path() / "out";
  const ProgramResult made = runProgram(
      {TOILE_EXECUTABLE, "make", TOILE_SOURCE_DIR "/examples/bent-sleeve.toile", "-o", out});
  ASSERT_EQ(made.status, 0) << made.err;
  const ProgramResult fits = runProgram({TOILE_EXECUTABLE, "check-sewing", out});
  EXPECT_EQ(fits.status, 0) << fits.err;
  EXPECT_THAT(fits.out, HasSubstr("0 do not fit"));
  // A point of a sew line moved in the CAD program: an edge is longer than its mate.
  std::string dxf = readText(out + "/pattern.dxf");
  std::size_t at = dxf.find("POLYLINE\r\n  8\r\n14\r\n");
  ASSERT_NE(at, std::string::npos);
  for (int i = 0; i < 3; ++i) at = dxf.find(" 10\r\n", at + 1);
  dxf.insert(at + 5, "9");
  writeText(out + "/pattern.dxf", dxf);
  const ProgramResult misfits = runProgram({TOILE_EXECUTABLE, "check-sewing", out});
  EXPECT_EQ(misfits.status, 1);
}

}  // namespace
}  // namespace toile::test
