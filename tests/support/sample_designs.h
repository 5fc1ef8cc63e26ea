// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

/// Tests that look at the finished wetsuit of 20 pieces: made once for all of them.
class WetsuitPattern : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Result<Document> document = openDocument(exampleDesign("wetsuit-full.toile"));
    ASSERT_TRUE(document) << document.error();
    const Result<Pattern> made = makePattern(*document);
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

/// A level seam all round.
inline StylingCurve ringSeam(const std::string& id, double height) {
  StylingCurve curve;
  curve.id = id;
  curve.closed = true;
  AlongSection way;
  way.plane.normal = {0, 0, 1};
  way.plane.through = Length::mm(height);
  curve.way = way;
  return curve;
}

/// The sleeve parted by two level seams: six pieces in three tiers.
inline Document tieredSleeve(const Document& sleeve, double upperSeam, double lowerSeam) {
  Design design = *sleeve.design;
  std::erase_if(design.curves, [](const StylingCurve& c) { return c.id == "elbow-line"; });
  design.curves.push_back(ringSeam("upper-ring", upperSeam));
  design.curves.push_back(ringSeam("lower-ring", lowerSeam));
  return withDesign(sleeve, design);
}

}  // namespace toile::test
