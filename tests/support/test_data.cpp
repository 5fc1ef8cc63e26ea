// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/test_data.h"

#include <cstdlib>

namespace toile::test {

std::filesystem::path testDataFolder() {
  if (const char* folder = std::getenv("TOILE_TEST_DATA")) return folder;
  return std::filesystem::path(TOILE_SOURCE_DIR) / ".." / "shared" / "data";
}

std::optional<std::filesystem::path> findTestData(const std::string& relative) {
  const std::filesystem::path path = testDataFolder() / relative;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

bool isTestDataRequired() {
  const char* value = std::getenv("TOILE_REQUIRE_DATA");
  return value != nullptr && std::string(value) == "1";
}

}  // namespace toile::test
