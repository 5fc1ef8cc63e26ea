// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

const std::string kSleeve = std::string(TOILE_SOURCE_DIR) + "/examples/bent-sleeve.toile";

ProgramResult nest(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{TOILE_EXECUTABLE, "nest"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return runProgram(words);
}

TEST(Nest, WritesAMarkerOfSeveralOrders) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{kSleeve,
                                           "--body",
                                           "builtin:bent-sleeve@1",
                                           "--body",
                                           "builtin:bent-sleeve@1?length=500mm",
                                           "--copies",
                                           "2",
                                           "--pairs",
                                           "--effort",
                                           "1",
                                           "--json",
                                           "-o",
                                           folder.path() / "a"};
  const ProgramResult result = nest(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  double copies = 0;
  for (const nlohmann::json& marker : json["markers"]) {
    EXPECT_GT(marker["utilisation"], 0.3);
    EXPECT_GE(marker["length"], marker["boundLength"]);
    copies += static_cast<double>(marker["pieces"].size());
  }
  EXPECT_EQ(copies, 2 * 2 * 2 * 2);  // bodies, pieces, copies, pairs
  EXPECT_EQ(readText(folder.path() / "a/markers.json"), result.out);
  // The same bytes again.
  EXPECT_EQ(nest(arguments).out, result.out);
}

TEST(Nest, NamesThePieceThatIsWiderThanTheRoll) {
  const TemporaryFolder folder;
  const ProgramResult result =
      nest({kSleeve, "--width", "50mm", "--effort", "0", "-o", folder.path() / "a"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("wide across the grain and the material has 50 mm"));
}

TEST(Nest, RefusesNegativeSizes) {
  const TemporaryFolder folder;
  for (const char* option : {"--width", "--length", "--gap", "--margin", "--overlap"}) {
    const ProgramResult result =
        nest({kSleeve, std::string(option) + "=-5mm", "--effort", "0", "-o", folder.path() / "a"});
    EXPECT_NE(result.status, 0) << option;
    EXPECT_NE(result.err, "") << option;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a")) << option;
  }
  EXPECT_EQ(nest({kSleeve, "--copies", "-1"}).status, 2);
}

TEST(Nest, RefusesAWrongCommandLine) {
  EXPECT_EQ(nest({kSleeve, "--turns", "sideways"}).status, 2);
  EXPECT_EQ(nest({kSleeve, "--effort", "99"}).status, 2);
  EXPECT_EQ(nest({kSleeve, "--width", "wide"}).status, 2);
  EXPECT_EQ(nest({}).status, 2);
  const TemporaryFolder folder;
  writeText(folder.path() / "hide.json", R"({"outline": [[0, 0], ["a", 1]]})");
  const ProgramResult result =
      nest({kSleeve, "--hide", folder.path() / "hide.json", "-o", folder.path() / "a"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("\"outline\""));
}

}  // namespace
}  // namespace toile::test
