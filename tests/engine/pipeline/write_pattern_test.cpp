// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/file_set.h"
#include "support/result_printing.h"
#include "support/run_program.h"

namespace toile::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> contentOf(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(FileSet, WritesAllIntoNewFolders) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "a" / "b";
  FileSet files;
  files.add("one.txt", "1");
  files.add("pieces/two.txt", std::string("\0\xff", 2));
  const Result<void> done = files.write(folder, {});
  ASSERT_TRUE(done) << done.error();
  EXPECT_THAT(contentOf(folder), testing::ElementsAre("one.txt", "pieces", "pieces/two.txt"));
  EXPECT_EQ(readText(folder / "one.txt"), "1");
  EXPECT_EQ(readText(folder / "pieces/two.txt"), std::string("\0\xff", 2));
}

TEST(FileSet, LeavesTheEarlierResultWhenOneFileCannotBeWritten) {
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  writeText(folder / "one.txt", "earlier");
  fs::create_directory(folder / "two.txt");  // in the way
  FileSet files;
  files.add("one.txt", "new");
  files.add("two.txt", "new");
  files.add("pieces/three.txt", "new");
  const Result<void> done = files.write(folder, {"old.txt"});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::FileUnwritable);
  EXPECT_THAT(done.error().message, testing::HasSubstr("two.txt"));
  EXPECT_THAT(contentOf(folder), testing::ElementsAre("one.txt", "two.txt"));
  EXPECT_EQ(readText(folder / "one.txt"), "earlier");
}

TEST(FileSet, TakesAwayTheFoldersItMadeWhenItFails) {
  const TemporaryFolder temporary;
  writeText(temporary.path() / "file", "");
  FileSet files;
  files.add("one.txt", "1");
  files.add("pieces/two.txt", "2");
  const Result<void> done = files.write(temporary.path() / "file" / "below", {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::FileUnwritable);
  EXPECT_THAT(contentOf(temporary.path()), testing::ElementsAre("file"));
}

TEST(FileSet, NeverReplacesADevice) {
  const TemporaryFolder temporary;
  fs::create_symlink("/dev/full", temporary.path() / "one.txt");
  FileSet files;
  files.add("one.txt", "1");
  const Result<void> done = files.write(temporary.path(), {});
  ASSERT_FALSE(done);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_THAT(contentOf(temporary.path()), testing::ElementsAre("one.txt"));
}

TEST(FileSet, RemovesOnlyOutdatedFiles) {
  const TemporaryFolder temporary;
  writeText(temporary.path() / "old.txt", "");
  writeText(temporary.path() / "mine.txt", "");
  FileSet files;
  files.add("one.txt", "1");
  ASSERT_TRUE(files.write(temporary.path(), {"old.txt", "one.txt"}));
  EXPECT_THAT(contentOf(temporary.path()), testing::ElementsAre("mine.txt", "one.txt"));
}

TEST(ReportedFiles, GivesOnlyPlainPieceNames) {
  const TemporaryFolder temporary;
  const fs::path report = temporary.path() / "report.json";
  EXPECT_TRUE(reportedFiles(report).empty());
  writeText(report, R"({"format":"toile-report","pieces":[{"file":"pieces/a.obj"},{"file":null},
      {"file":"pieces/../../b.obj"},{"file":"/etc/c.obj"},{"file":"pieces/d.txt"},7]})");
  EXPECT_THAT(reportedFiles(report), testing::ElementsAre("pieces/a.obj", "pieces/a.ply"));
  for (const char* other : {"{\"format\":7}", "[", "{\"format\":\"toile-report\",\"pieces\":3}"}) {
    writeText(report, other);
    EXPECT_TRUE(reportedFiles(report).empty()) << other;
  }
}

}  // namespace
}  // namespace toile::test
