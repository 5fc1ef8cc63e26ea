// SPDX-License-Identifier: GPL-3.0-or-later
// Sequences of 30 random edits on three bodies. TOILE_EDIT_SEQUENCES says how many in all (60).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>

#include "random_edits.h"
#include "support/meshes.h"
#include "support/result_printing.h"
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

/// A ball of odd size: with a mirror plane but without a pairing.
ReferenceModel ball() {
  Eigen::Matrix3d scale = Eigen::Vector3d(200, 140, 100).asDiagonal();
  ReferenceModel model = makeReferenceModel(
      "ball", test::transformed(test::icosphere(1, 3), scale, Eigen::Vector3d(0.3, 0, 0)));
  model.symmetry = Symmetry{};
  return model;
}

std::vector<ReferenceModel> bodies() {
  std::vector<ReferenceModel> made{ball()};
  for (const char* name : {"builtin:torso@1", "builtin:bent-sleeve@1"}) {
    Result<ReferenceModel> model = makeBuiltinModel(name);
    EXPECT_TRUE(model) << model.error();
    if (model) made.push_back(*std::move(model));
  }
  return made;
}

/// On the surface within 1e-12 of its size, and locally shortest between data points.
void expectSound(const Document& document, GeodesicLinker& linker, const std::string& context) {
  const Mesh& mesh = *document.model->mesh;
  const double size = (mesh.boxMax() - mesh.boxMin()).norm();
  std::vector<std::string> ids;
  for (const StylingCurve& curve : document.design->curves) ids.push_back(curve.id);
  const auto placed = placeCurves(*document.design, *document.model, ids, linker);
  ASSERT_TRUE(placed) << context << ": " << placed.error();
  for (const PlacedCurve& curve : *placed) {
    ASSERT_TRUE(isValid(mesh, curve.path)) << context << ": " << curve.id;
    for (std::size_t i = 0; i < curve.path.faceOfSegment.size(); ++i) {
      // The middle of each segment is the point of its face that it names.
      const SurfacePoint& a = curve.path.points[i];
      const SurfacePoint& b = curve.path.points[(i + 1) % curve.path.points.size()];
      const FaceId face = curve.path.faceOfSegment[i];
      const SurfacePoint middle = makeSurfacePoint(
          mesh, face, 0.5 * (barycentricIn(mesh, a, face) + barycentricIn(mesh, b, face)));
      const double off =
          (position(mesh, middle) - 0.5 * (position(mesh, a) + position(mesh, b))).norm();
      ASSERT_LE(off, 1e-12 * size) << context << ": " << curve.id;
    }
    // Links are locally shortest: parts of the path from data point to data point.
    std::size_t from = 0;
    for (std::size_t d = 1; d < curve.dataPoints.size(); ++d) {
      std::size_t to = from + 1;
      while (to < curve.path.points.size() && !(curve.path.points[to] == curve.dataPoints[d])) ++to;
      ASSERT_LT(to, curve.path.points.size())
          << context << ": " << curve.id << " leaves out a point";
      if (to > from + 1 &&
          document.design->curves[static_cast<std::size_t>(&curve - placed->data())].mirrorOf ==
              std::nullopt) {
        SurfacePath link;
        link.points.assign(curve.path.points.begin() + static_cast<std::ptrdiff_t>(from),
                           curve.path.points.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        link.faceOfSegment.assign(
            curve.path.faceOfSegment.begin() + static_cast<std::ptrdiff_t>(from),
            curve.path.faceOfSegment.begin() + static_cast<std::ptrdiff_t>(to));
        // Beside a segment of 1e-15 mm rounding decides what its angle is.
        double shortest = size;
        for (std::size_t k = 0; k + 1 < link.points.size(); ++k) {
          shortest = std::min(
              shortest,
              (position(mesh, link.points[k]) - position(mesh, link.points[k + 1])).norm());
        }
        if (shortest < 1e-6) {
          from = to;
          continue;
        }
        ASSERT_LE(geodesicDefect(mesh, link), 1e-6) << context << ": " << curve.id;
      }
      from = to;
    }
  }
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
    std::string story;
    for (int i = 0; i < kEdits; ++i) {
      const Design before = *document.design;
      test::RandomEdits::Step step = edits.next(document);
      story += step.name + (step.document ? ", " : "!, ");
      const std::string context =
          "sequence " + std::to_string(sequence) + " on " + model.name + ": " + story;
      ASSERT_TRUE(before == *document.design) << context << " changed what it was given";
      (step.document ? done[step.name].first : done[step.name].second) += 1;
      if (!step.document) {
        ASSERT_FALSE(step.document.error().message.empty());
        continue;
      }
      document = *step.document;
      // Every edit leaves something that can be placed; looked at more closely now and then.
      if (i % 3 == 2 || i + 1 == kEdits) expectSound(document, linker, context);
      if (testing::Test::HasFatalFailure()) return;
    }
    const std::string text = writeDesign(*document.design);
    const Result<Design> read = parseDesign(text, "saved");
    ASSERT_TRUE(read) << story << read.error();
    ASSERT_TRUE(*read == *document.design) << story;
    ASSERT_EQ(writeDesign(*read), text) << story;
  }
  for (const auto& [name, counts] : done) {
    std::cout << name << ": " << counts.first << " done, " << counts.second << " refused\n";
    // Every kind of edit must have been tried in earnest.
    if (count >= 60) {
      EXPECT_GT(counts.first, 0) << name;
    }
  }
  std::cout << count << " sequences of " << kEdits << " edits, "
            << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
            << " s\n";
}

}  // namespace
}  // namespace toile
