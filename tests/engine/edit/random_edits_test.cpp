// SPDX-License-Identifier: GPL-3.0-or-later
// Sequences of 30 random edits on three bodies. TOILE_EDIT_SEQUENCES says how many in all (60).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>

#include "random_edits.h"
#include "support/curve_checks.h"
#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/curve/geodesic.h"
#include "toile/design/design_file.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

constexpr int kEdits = 30;

int sequences() {
  const char* wanted = std::getenv("TOILE_EDIT_SEQUENCES");
  return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 60;
}
/// The first sequence, so that a long sweep can be taken in parts.
int firstSequence() {
  const char* wanted = std::getenv("TOILE_EDIT_FIRST");
  return wanted != nullptr ? std::max(0, std::atoi(wanted)) : 0;
}

/// A ball with a mirror plane, but no pairing of its vertices.
ReferenceModel ball() {
  Eigen::Matrix3d scale = Eigen::Vector3d(200, 140, 100).asDiagonal();
  ReferenceModel model = makeReferenceModel(
      "ball", test::transformed(test::icosphere(1, 3), scale, Eigen::Vector3d::Zero()));
  model.symmetry = Symmetry{};
  return model;
}

/// The built-in body, a body made from a scan (where the test data is, else a torso), a ball.
std::vector<ReferenceModel> bodies() {
  std::vector<ReferenceModel> made{ball()};
  Result<ReferenceModel> builtin = makeBuiltinModel("builtin:body@1?size=EU38F");
  EXPECT_TRUE(builtin) << builtin.error();
  if (builtin) made.push_back(*std::move(builtin));
  const auto file = test::findTestData("bodies/female_average.ply");
  Result<ReferenceModel> third =
      file ? readModel(*file, FileUnit::Millimetre) : makeBuiltinModel("builtin:torso@1");
  EXPECT_TRUE(third) << third.error();
  if (!third) return made;
  if (file) {
    auto partner = findSymmetryPairing(*third->mesh, Eigen::Vector3d::UnitX(), 0, 0.1);
    EXPECT_TRUE(partner);
    if (partner) third->symmetry = makeSymmetry(*third->mesh, *std::move(partner));
  }
  made.push_back(*std::move(third));
  return made;
}

// Also: undo by value (the old document is not touched), save and load give equal bytes.
TEST(RandomEdits, NeverDamageADocument) {
  const std::vector<ReferenceModel> models = bodies();
  ASSERT_EQ(models.size(), 3U);
  std::map<std::string, std::pair<int, int>> done;  // by edit: done, refused
  const auto start = std::chrono::steady_clock::now();
  const int first = firstSequence(), count = sequences();
  for (int sequence = first; sequence < first + count; ++sequence) {
    const ReferenceModel& model = models[static_cast<std::size_t>(sequence % 3)];
    const auto shared = std::make_shared<const ReferenceModel>(model);
    GeodesicLinker linker(model.mesh);
    test::RandomEdits edits(model, static_cast<unsigned>(sequence + 1));
    Document document{std::make_shared<const Design>(), shared};
    std::string context = "sequence " + std::to_string(sequence) + " on " + model.name + ": ";
    // Undo by value: every document of the sequence, and a copy of it from when it was new.
    std::vector<std::pair<Document, Design>> history{{document, *document.design}};
    for (int i = 0; i < kEdits; ++i) {
      test::RandomEdits::Step step = edits.next(document);
      context += step.name + (step.document ? ", " : "!, ");
      (step.document ? done[step.name].first : done[step.name].second) += 1;
      if (!step.document) {
        ASSERT_FALSE(step.document.error().message.empty());
        continue;
      }
      const std::vector<std::string> sharing = test::sharingWith(*document.design, step.curve);
      document = *step.document;
      history.emplace_back(document, *document.design);
      if (step.name == "share" || step.name == "fair") {
        test::expectAllShared(document, linker, context);
      }
      if (!sharing.empty()) {
        test::expectStillShared(document, linker, step.curve, sharing, context);
      }
      // Every edit leaves something that can be placed; looked at more closely now and then.
      if (i % 5 == 4) test::expectSound(document, linker, context);
      if (testing::Test::HasFatalFailure()) return;
    }
    for (const auto& [past, copy] : history) {
      ASSERT_TRUE(*past.design == copy) << context << " changed a document that was handed on";
    }
    for (const StylingCurve& curve : document.design->curves) {
      if (curve.dataPoints.empty() || !model.symmetry) continue;
      test::expectMirrorOfMirror(document, curve.id, context);
      break;
    }
    if (testing::Test::HasFatalFailure()) return;
    const std::string text = writeDesign(*document.design);
    const Result<Design> read = parseDesign(text, "saved");
    ASSERT_TRUE(read) << context << read.error();
    ASSERT_TRUE(*read == *document.design) << context;
    ASSERT_EQ(writeDesign(*read), text) << context;
  }
  for (const auto& [name, counts] : done) {
    std::cout << name << ": " << counts.first << " done, " << counts.second << " refused\n";
    // Every kind of edit must have been tried in earnest; in parts of a sweep some may be refused.
    if (first == 0 && count >= 60) {
      EXPECT_GT(counts.first, 0) << name;
    }
  }
  std::cout << count << " sequences of " << kEdits << " edits, "
            << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
            << " s\n";
}

}  // namespace
}  // namespace toile
