// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/pipeline.h"

namespace toile {
namespace {

namespace fs = std::filesystem;

/// A folder with the wetsuit and its body.model.json, which names the test data where they are.
class WetsuitFolder {
 public:
  explicit WetsuitFolder(const fs::path& bodies)
      : path_(fs::path(testing::TempDir()) / ("toile-wetsuit-" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    fs::copy_file(fs::path(TOILE_SOURCE_DIR) / "tests/designs/wetsuit.toile", design(),
                  fs::copy_options::overwrite_existing);
    std::ofstream model(path_ / "body.model.json");
    model << "{\"toile-model\": 1, \"name\": \"female_average\", \"units\": \"mm\",\n"
          << "\"mesh\": " << bodies / "female_average.ply"
          << ",\n"
          << "\"curves\": " << bodies / "curves.json"
          << ",\n"
          << "\"landmarks\": " << bodies / "landmarks.json"
          << ",\n"
          << "\"symmetry\": {\"normal\": [1, 0, 0], \"offset\": 0}}\n";
  }
  ~WetsuitFolder() { fs::remove_all(path_); }
  WetsuitFolder(const WetsuitFolder&) = delete;
  WetsuitFolder& operator=(const WetsuitFolder&) = delete;
  [[nodiscard]] fs::path design() const { return path_ / "wetsuit.toile"; }

 private:
  fs::path path_;
};

struct Case {
  const char* body;
  double meanStrain;  ///< bound on the area-weighted mean of max(|s1 - 1|, |1 - s2|)
};
void PrintTo(const Case& test, std::ostream* out) {
  *out << test.body;
}

class Wetsuit : public testing::TestWithParam<Case> {};

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) sum += mesh.area(FaceId(f));
  return sum;
}

/// Rule 2 of the design from the positions alone.
void expectExactLengths(const Piece& piece, const FlatPiece& flat) {
  for (const Wire& wire : piece.wires) {
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const double length =
          (flat.position[wire.vertices[i + 1]] - flat.position[wire.vertices[i]]).norm();
      const double target = wire.targetLength[i];
      ASSERT_LE(std::abs(length - target), 1e-9 * std::max(target, 1.0))
          << piece.id << ", " << wire.curve << " edge " << i;
    }
  }
}

void expectCounterClockwise(const Piece& piece, const FlatPiece& flat) {
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
    const Triangle& corners = piece.mesh->vertices(FaceId(f));
    const Eigen::Vector2d a = flat.position[corners[1]] - flat.position[corners[0]];
    const Eigen::Vector2d b = flat.position[corners[2]] - flat.position[corners[0]];
    ASSERT_GT(a.x() * b.y() - a.y() * b.x(), 0) << piece.id << ", face " << f;
  }
}

TEST_P(Wetsuit, EveryPieceIsExact) {
  TOILE_TEST_DATA_OR_SKIP(path, std::string("bodies/") + GetParam().body + ".ply");
  const WetsuitFolder folder(fs::absolute(path).parent_path());
  const Result<Document> document =
      openDocument(folder.design(), fs::absolute(path).string(), FileUnit::Millimetre);
  ASSERT_TRUE(document) << document.error();
  const Result<Pattern> pattern = makePattern(*document);
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  for (const auto& failure : pattern->failures) {
    if (failure) ADD_FAILURE() << *failure;
  }
  for (const Finding& finding : pattern->cut.findings) {
    ADD_FAILURE() << finding.code << ": " << finding.message;
  }

  std::set<std::string> names;
  double included = 0, left = 0, strain = 0;
  for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
    const Piece& piece = pattern->cut.pieces[i];
    EXPECT_EQ(piece.recordIndices.size(), 1U) << piece.id;
    (piece.include ? included : left) += area(*piece.mesh);
    if (!piece.include) continue;
    names.insert(piece.id);
    EXPECT_TRUE(topology(piece).isDisk()) << piece.id;
    ASSERT_TRUE(pattern->flats[i]) << piece.id;
    const FlatPiece& flat = *pattern->flats[i];
    EXPECT_TRUE(flat.check.passes()) << piece.id;
    expectExactLengths(piece, flat);
    expectCounterClockwise(piece, flat);
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      const FaceDistortion& d = flat.distortion[FaceId(f)];
      strain += piece.mesh->area(FaceId(f)) *
                std::max(std::abs(d.stretchMax - 1), std::abs(1 - d.stretchMin));
    }
  }
  EXPECT_EQ(names.size(), 24U);
  EXPECT_LE(strain / included, GetParam().meanStrain);
  const double whole = area(*document->model->mesh);
  EXPECT_LE(std::abs(included + left - whole), 1e-12 * whole);
  EXPECT_LE(std::abs(included - pattern->cut.includedArea), 1e-12 * included);
}

TEST_P(Wetsuit, SeamsFitTogetherBitForBit) {
  TOILE_TEST_DATA_OR_SKIP(path, std::string("bodies/") + GetParam().body + ".ply");
  const WetsuitFolder folder(fs::absolute(path).parent_path());
  const Result<Document> document =
      openDocument(folder.design(), fs::absolute(path).string(), FileUnit::Millimetre);
  ASSERT_TRUE(document) << document.error();
  const Result<std::vector<PlacedCurve>> curves = placeCurves(*document->design, *document->model);
  ASSERT_TRUE(curves) << curves.error();
  const Result<CutResult> result = cut(*document, *curves);
  ASSERT_TRUE(result) << result.error();
  std::set<std::pair<std::uint32_t, std::uint32_t>> mated;
  for (const SeamMates& mates : result->mates) {
    const std::vector<double>& a = result->pieces[mates.pieceA].wires[mates.wireA].targetLength;
    std::vector<double> b = result->pieces[mates.pieceB].wires[mates.wireB].targetLength;
    std::reverse(b.begin(), b.end());
    EXPECT_EQ(a, b) << result->pieces[mates.pieceA].id << " - " << result->pieces[mates.pieceB].id;
    mated.insert({mates.pieceA, mates.wireA});
    mated.insert({mates.pieceB, mates.wireB});
  }
  // Every seam but the hems at neck, wrists and ankles has a mate.
  const std::set<std::string> hems{"collar-top", "wrist-l", "wrist-r", "ankle-l", "ankle-r"};
  std::size_t seams = 0;
  for (std::size_t p = 0; p < result->pieces.size(); ++p) {
    const Piece& piece = result->pieces[p];
    for (std::size_t w = 0; piece.include && w < piece.wires.size(); ++w) {
      const Wire& wire = piece.wires[w];
      if (wire.kind != WireKind::Seam) continue;
      ++seams;
      const bool isMated =
          mated.contains({static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(w)});
      EXPECT_EQ(isMated, !hems.contains(wire.curve)) << piece.id << ", " << wire.curve;
    }
  }
  EXPECT_GT(seams, 100U);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Wetsuit,
                         testing::Values(Case{"female_average", 0.04}, Case{"male_heavy", 0.036},
                                         Case{"female_tall_slim_cycling", 0.046}));

}  // namespace
}  // namespace toile
