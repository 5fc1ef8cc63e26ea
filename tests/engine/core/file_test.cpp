// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace toile {
namespace {

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("toile-file-test-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::size_t fileCount() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }
  std::filesystem::path folder_;
};

TEST_F(FileTest, ReadsBackWhatItWroteAndLeavesNothingElse) {
  const std::string content("a\0b\r\n", 5);
  ASSERT_TRUE(writeFileWhole(folder_ / "a", "old, and longer than the new one"));
  ASSERT_TRUE(writeFileWhole(folder_ / "a", content));
  EXPECT_EQ(*readFile(folder_ / "a"), content);
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(FileTest, AFullDiskIsAnErrorAndNotAFile) {
  const Result<void> written = writeFileWhole("/dev/full", "content");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::FileUnwritable);
}

TEST_F(FileTest, FollowsALinkAndKeepsItsTargetsPermissions) {
  ASSERT_TRUE(writeFileWhole(folder_ / "real", "one"));
  std::filesystem::permissions(folder_ / "real", std::filesystem::perms(0640));
  std::filesystem::create_symlink(folder_ / "real", folder_ / "link");
  ASSERT_TRUE(writeFileWhole(folder_ / "link", "two"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
  EXPECT_EQ(*readFile(folder_ / "real"), "two");
  EXPECT_EQ(std::filesystem::status(folder_ / "real").permissions(), std::filesystem::perms(0640));
}

TEST_F(FileTest, RefusesWhatCannotBeReadOrWritten) {
  EXPECT_EQ(readFile(folder_ / "none").error().code, ErrorCode::FileNotFound);
  EXPECT_EQ(readFile(folder_).error().code, ErrorCode::FileUnreadable);
  ASSERT_TRUE(writeFileWhole(folder_ / "a", "12345"));
  EXPECT_EQ(readFile(folder_ / "a", 4).error().code, ErrorCode::FileFormat);
  EXPECT_EQ(writeFileWhole(folder_, "x").error().code, ErrorCode::FileUnwritable);
  EXPECT_EQ(writeFileWhole(folder_ / "none" / "x", "x").error().code, ErrorCode::FileUnwritable);
  EXPECT_EQ(makeFolder(folder_ / "a" / "b").error().code, ErrorCode::FileUnwritable);
}

}  // namespace
}  // namespace toile
