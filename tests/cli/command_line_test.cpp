// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/run_program.h"

namespace toile::test {
namespace {

struct Case {
  const char* name;
  std::vector<std::string> arguments;
  int status;
  std::string out;  ///< must be part of stdout
  std::string err;  ///< must be part of stderr
};

class CommandLine : public testing::TestWithParam<Case> {};

TEST_P(CommandLine, Answers) {
  std::vector<std::string> words{TOILE_EXECUTABLE};
  for (const std::string& argument : GetParam().arguments) words.push_back(argument);
  const ProgramResult result = runProgram(words);
  EXPECT_EQ(result.status, GetParam().status);
  EXPECT_THAT(result.out, testing::HasSubstr(GetParam().out));
  EXPECT_THAT(result.err, testing::HasSubstr(GetParam().err));
  if (result.status == 2) {  // one sentence, nothing else
    EXPECT_THAT(result.err, testing::StartsWith("toile: "));
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(result.out, "");
  } else if (result.status == 0) {
    EXPECT_EQ(result.err, "");
  }
}

const Case kCases[] = {
    {"Version", {"--version"}, 0, "toile 0.", ""},
    {"Help", {"--help"}, 0, "--threads N", ""},
    {"Nothing", {}, 2, "", "no command given"},
    {"MisspeltOption", {"--thraeds", "2"}, 2, "", "no option --thraeds; did you mean --threads?"},
    {"OptionLikeNothing", {"--qqqqqqqq"}, 2, "", "no option --qqqqqqqq ("},
    {"UnknownCommand", {"zzzzzzzzz"}, 2, "", "no command \"zzzzzzzzz\""},
    {"NoThreads", {"--threads", "0"}, 2, "", "--threads: \"0\""},
    {"ThreadsInWords", {"--threads", "two"}, 2, "", "--threads: \"two\""},
    {"OptionWithoutValue", {"--threads"}, 2, "", "--threads"},
    {"UnknownUnit", {"--units", "furlong"}, 2, "", "--units: \"furlong\""},
};

INSTANTIATE_TEST_SUITE_P(Cases, CommandLine, testing::ValuesIn(kCases),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace toile::test
