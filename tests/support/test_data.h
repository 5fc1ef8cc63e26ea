// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace toile::test {

/// The folder of the shared test data: TOILE_TEST_DATA, else ../shared/data beside the repository.
std::filesystem::path testDataFolder();

/// The path of a file in it, or nothing where the data is absent.
std::optional<std::filesystem::path> findTestData(const std::string& relative);

/// True when absent data is a failure (TOILE_REQUIRE_DATA=1), not a reason to skip.
bool isTestDataRequired();

}  // namespace toile::test

/// Declares `name` as the file of that name, or skips the test, saying so.
#define TOILE_TEST_DATA_OR_SKIP(name, relative)                                                \
  auto name##Found = ::toile::test::findTestData(relative);                                    \
  if (!name##Found) {                                                                          \
    if (::toile::test::isTestDataRequired()) FAIL() << "test data is missing: " << (relative); \
    GTEST_SKIP() << "no test data " << (relative) << "; set TOILE_TEST_DATA to its folder";    \
  }                                                                                            \
  const std::filesystem::path name = *std::move(name##Found)
