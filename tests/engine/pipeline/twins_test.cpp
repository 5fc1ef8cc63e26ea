// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/sample_designs.h"
#include "toile/io/report.h"
#include "toile/pipeline.h"

// Pieces that are made the mirror images of others.
namespace toile::test {
namespace {

Document vest() {
  const Result<Document> document = openDocument(exampleDesign("torso-vest.toile"));
  EXPECT_TRUE(document) << document.error();
  return *document;
}

/// The vest on a torso that is broader on its left, its lines the mirror images of each other.
Document crookedVest() {
  const Document straight = vest();
  const Mesh& mesh = *straight.model->mesh;
  std::vector<Eigen::Vector3d> positions = mesh.positions();
  for (Eigen::Vector3d& p : positions) {
    if (p.x() > 0) p.x() *= 1.06;
    p.y() += 8 * std::sin(p.x() / 90);
  }
  const Result<ReferenceModel> model =
      withMesh(*straight.model, "crooked", mesh.withPositions(std::move(positions)));
  EXPECT_TRUE(model) << model.error();
  return {straight.design, std::make_shared<const ReferenceModel>(*model)};
}

Document withTwin(const Document& document, const std::string& twin, const std::string& of,
                  TwinMode mode) {
  Design design = *document.design;
  for (PieceRecord& record : design.pieces) {
    if (record.id == twin) record.twin = Twin{of, mode, {}};
  }
  return withDesign(document, design);
}

std::size_t indexOf(const Pattern& pattern, const std::string& id) {
  const auto& pieces = pattern.cut.pieces;
  return static_cast<std::size_t>(
      std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.id == id; }) -
      pieces.begin());
}

/// Both outlines are mirror images to the last bit, all targets kept, and the mates' are equal.
void expectTwins(const Pattern& pattern, const std::string& a, const std::string& b) {
  ASSERT_TRUE(pattern.isComplete());
  const std::size_t i = indexOf(pattern, a), j = indexOf(pattern, b);
  const auto& first = pattern.flats[i]->position.values();
  const auto& second = pattern.flats[j]->position.values();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    EXPECT_EQ(first[v].x(), -second[v].x());
    EXPECT_EQ(first[v].y(), second[v].y());
  }
  for (const std::size_t p : {i, j}) {
    for (const Wire& wire : pattern.cut.pieces[p].wires) {
      for (std::size_t e = 0; e < wire.targetLength.size(); ++e) {
        const auto& at = pattern.flats[p]->position;
        const double flat = (at[wire.vertices[e + 1]] - at[wire.vertices[e]]).norm();
        EXPECT_NEAR(flat, wire.targetLength[e], 1e-9 * std::max(1.0, flat));
      }
    }
    EXPECT_EQ(pattern.flats[p]->check.flippedFaces, 0U);
  }
  for (const SeamMates& mates : pattern.cut.mates) {
    std::vector<double> target = pattern.cut.pieces[mates.pieceA].wires[mates.wireA].targetLength;
    std::reverse(target.begin(), target.end());
    EXPECT_EQ(target, pattern.cut.pieces[mates.pieceB].wires[mates.wireB].targetLength);
  }
}

double asymmetry(const Pattern& pattern, const std::string& a, const std::string& b) {
  const auto length = [&](const std::string& id) {
    double sum = 0;
    for (const Wire& wire : pattern.cut.pieces[indexOf(pattern, id)].wires) {
      for (const double target : wire.targetLength) sum += isBoundary(wire.kind) ? target : 0;
    }
    return sum;
  };
  return std::abs(length(a) / length(b) - 1);
}

TEST(Twins, OnAStraightModelAreIdenticalToTheLastBit) {
  const Result<Pattern> pattern =
      makePattern(withTwin(vest(), "side-back-r", "side-back-l", TwinMode::Identical));
  ASSERT_TRUE(pattern) << pattern.error();
  ASSERT_EQ(pattern->twinOf.size(), pattern->cut.pieces.size());
  EXPECT_TRUE(pattern->twinOf[indexOf(*pattern, "side-back-r")].has_value());
  expectTwins(*pattern, "side-back-l", "side-back-r");
  PatternCache cache;
  const Document document = withTwin(vest(), "side-back-r", "side-back-l", TwinMode::Identical);
  ASSERT_TRUE(makePattern(document, {}, &cache));
  EXPECT_EQ(writeReportJson(*makePattern(document, {}, &cache)), writeReportJson(*pattern));
}

TEST(Twins, OnACrookedModelTakeOneSideOrTheMean) {
  const Result<Pattern> own = makePattern(crookedVest());
  ASSERT_TRUE(own) << own.error();
  ASSERT_GT(asymmetry(*own, "side-back-l", "side-back-r"), 1e-3) << "the model is crooked";
  double lengths[2] = {};
  for (const TwinMode mode : {TwinMode::Identical, TwinMode::Mean}) {
    const Result<Pattern> pattern =
        makePattern(withTwin(crookedVest(), "side-back-r", "side-back-l", mode));
    ASSERT_TRUE(pattern) << pattern.error();
    ASSERT_TRUE(pattern->twinOf[indexOf(*pattern, "side-back-r")].has_value());
    expectTwins(*pattern, "side-back-l", "side-back-r");
    for (const Wire& wire : pattern->cut.pieces[indexOf(*pattern, "side-back-r")].wires) {
      if (wire.curve != "side-seam-r") continue;
      for (const double target : wire.targetLength) {
        lengths[mode == TwinMode::Mean ? 1 : 0] += target;
      }
    }
  }
  const auto seam = [&](const std::string& piece, const std::string& curve) {
    double sum = 0;
    for (const Wire& wire : own->cut.pieces[indexOf(*own, piece)].wires) {
      if (wire.curve != curve) continue;
      for (const double target : wire.targetLength) sum += target;
    }
    return sum;
  };
  const double left = seam("side-back-l", "side-seam-l");
  const double right = seam("side-back-r", "side-seam-r");
  EXPECT_NEAR(lengths[0], left, 1e-9 * left);
  EXPECT_NEAR(lengths[1], 0.5 * (left + right), 1e-9 * left);
}

TEST(Twins, ThatAreNoMirrorImagesStayTrueToTheirSides) {
  const Result<Pattern> own = makePattern(vest());
  const Result<Pattern> pattern =
      makePattern(withTwin(vest(), "side-back-r", "front-l", TwinMode::Identical));
  ASSERT_TRUE(own && pattern);
  const auto& findings = pattern->findings;
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                          [](const Finding& f) { return f.code == "no-twins"; }));
  for (std::size_t i = 0; i < own->flats.size(); ++i) {
    if (!own->flats[i]) continue;
    EXPECT_EQ(own->flats[i]->position.values(), pattern->flats[i]->position.values());
  }
}

}  // namespace
}  // namespace toile::test
