// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "support/result_printing.h"
#include "toile/pipeline.h"

namespace toile::test {

inline std::filesystem::path exampleDesign(const std::string& name) {
  return std::filesystem::path(TOILE_SOURCE_DIR) / "examples" / name;
}

/// The two-piece sleeve of the examples; a value to change.
inline Document sleeveDocument() {
  const Result<Document> document = openDocument(exampleDesign("bent-sleeve.toile"));
  if (!document) {
    ADD_FAILURE() << document.error();
    return {};
  }
  return *document;
}

/// Tests that look at the finished sleeve: its pattern is made once for all of them.
class SleevePattern : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Result<Pattern> made = makePattern(sleeveDocument());
    ASSERT_TRUE(made) << made.error();
    pattern_ = *made;
  }
  static void TearDownTestSuite() { pattern_.reset(); }
  static inline std::optional<Pattern> pattern_;
};

/// The document with another design on the same model.
inline Document withDesign(const Document& document, Design design) {
  return {std::make_shared<const Design>(std::move(design)), document.model};
}

}  // namespace toile::test
