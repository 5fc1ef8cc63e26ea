// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "support/meshes.h"
#include "support/sample_designs.h"
#include "support/test_data.h"
#include "toile/io/report.h"
#include "toile/pipeline.h"

// Pieces that are made their own mirror images, with their neighbours' seams.
namespace toile::test {
namespace {

/// A crotch-like surface that is its own mirror image in x = 0 but for its mesh: 9 columns on one
/// side, 14 on the other, rows that are not level.
Mesh crotch(double skew) {
  constexpr int kLeft = 9, kRight = 14, kRows = 24;
  std::vector<double> columns;
  for (int i = 0; i <= kLeft; ++i) columns.push_back(-1 + static_cast<double>(i) / kLeft);
  for (int i = 1; i <= kRight; ++i) columns.push_back(std::pow(i / double{kRight}, 1.2));
  std::vector<Eigen::Vector3d> positions;
  for (int j = 0; j <= kRows; ++j) {
    for (const double u : columns) {
      const bool isEnd = j == 0 || j == kRows;
      const double row = isEnd ? j : j + 0.3 * u * std::sin(j * 3.0);
      const double v = std::clamp(row / kRows - 0.5, -0.5, 0.5);
      positions.emplace_back(110 * u * (1 - 0.45 * v * v),
                             40 * std::sin(2.5 * v) * (1 - 0.6 * u * u) + 15 * u * u + skew * u,
                             150 * v + 25 * u * u * v);
    }
  }
  return grid(kLeft + kRight, kRows).withPositions(std::move(positions));
}

/// Parted by two seams from side to side: front, crotch, back.
Document trunks(double skew) {
  const auto at = [](double x, double z) { return NearPosition{{x, 0, z}, {}}; };
  Design design;
  for (const auto& [id, z] : {std::pair{"lower", -28.0}, std::pair{"upper", 26.0}}) {
    StylingCurve seam;
    seam.id = id;
    seam.way =
        SmoothWay{{at(-140, z * 1.4), at(0, z), at(140, z * 1.4)}, SubdivisionRule::Auto, {}, {}};
    design.curves.push_back(seam);
  }
  for (const auto& [id, z] :
       {std::pair{"front", -60.0}, std::pair{"crotch", 0.0}, std::pair{"back", 60.0}}) {
    PieceRecord record;
    record.id = id;
    record.anchor = at(0, z);
    design.pieces.push_back(record);
  }
  return {std::make_shared<const Design>(design),
          std::make_shared<const ReferenceModel>(makeReferenceModel("trunks", crotch(skew)))};
}

Result<Pattern> symmetricPattern(const Document& document, double percent = 2,
                                 PatternCache* cache = nullptr) {
  MakeOptions options;
  options.symmetrise = Ratio::percent(percent);
  return makePattern(document, options, cache);
}

std::size_t indexOf(const Pattern& pattern, const std::string& id) {
  const auto& pieces = pattern.cut.pieces;
  return static_cast<std::size_t>(
      std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.id == id; }) -
      pieces.begin());
}

std::size_t count(const Pattern& pattern, const std::string& code) {
  return static_cast<std::size_t>(std::count_if(pattern.findings.begin(), pattern.findings.end(),
                                                [&](const Finding& f) { return f.code == code; }));
}

/// The outline's vertices in the plane are their own mirror images to the last bit.
void expectSymmetric(const Pattern& pattern, const std::string& id) {
  const std::size_t i = indexOf(pattern, id);
  ASSERT_TRUE(pattern.flats[i]) << id;
  std::set<std::array<double, 2>> outline;
  for (std::size_t v = 0; v < pattern.flats[i]->position.size(); ++v) {
    if (!pattern.cut.pieces[i].mesh->isBorder(VertexId(v))) continue;
    const Eigen::Vector2d& p = pattern.flats[i]->position[VertexId(v)];
    outline.insert({p.x(), p.y()});
  }
  const auto isOwnImage = [&](double x, double y) {
    return std::all_of(outline.begin(), outline.end(), [&](const auto& p) {
      return outline.contains({x * p[0], y * p[1]});
    });
  };
  EXPECT_TRUE(isOwnImage(-1, 1) || isOwnImage(1, -1)) << id;
}

/// Flat lengths are the targets, those of mates are the same numbers, the cut owns them.
void expectExactLengths(const Pattern& pattern) {
  ASSERT_TRUE(pattern.isComplete());
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    for (const Wire& wire : pattern.cut.pieces[i].wires) {
      for (std::size_t e = 0; e < wire.targetLength.size(); ++e) {
        EXPECT_EQ(pattern.cut.refined->cutEdges[wire.cutEdges[e].index()].targetLength,
                  wire.targetLength[e]);
        if (!pattern.flats[i]) continue;
        const auto& at = pattern.flats[i]->position;
        const double flat = (at[wire.vertices[e + 1]] - at[wire.vertices[e]]).norm();
        EXPECT_NEAR(flat, wire.targetLength[e], 1e-9 * std::max(1.0, flat));
      }
    }
  }
  for (const SeamMates& mates : pattern.cut.mates) {
    std::vector<double> target = pattern.cut.pieces[mates.pieceA].wires[mates.wireA].targetLength;
    std::reverse(target.begin(), target.end());
    EXPECT_EQ(target, pattern.cut.pieces[mates.pieceB].wires[mates.wireB].targetLength);
  }
}

double outline(const Pattern& pattern, const std::string& id, bool ofTargets) {
  double sum = 0;
  for (const Wire& wire : pattern.cut.pieces[indexOf(pattern, id)].wires) {
    for (const double length : ofTargets ? wire.targetLength : wire.bodyLength) sum += length;
  }
  return sum;
}

TEST(SymmetricPieces, ACrotchMeshedInAnotherWayOnEachSideIsItsOwnMirrorImage) {
  const Result<Pattern> plain = makePattern(trunks(0)), pattern = symmetricPattern(trunks(0));
  ASSERT_TRUE(plain) << plain.error();
  ASSERT_TRUE(pattern) << pattern.error();
  for (const char* id : {"front", "crotch", "back"}) expectSymmetric(*pattern, id);
  expectExactLengths(*pattern);
  EXPECT_EQ(count(*pattern, "made-symmetric"), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& id = pattern->cut.pieces[i].id;
    EXPECT_GT(outline(*pattern, id, false), 300);
    EXPECT_NEAR(outline(*pattern, id, true), outline(*pattern, id, false), 1e-9);
    // It is the same piece, with points added.
    EXPECT_NEAR(outline(*pattern, id, false), outline(*plain, id, false), 1e-4);
    EXPECT_GT(pattern->cut.pieces[i].mesh->vertexCount(), plain->cut.pieces[i].mesh->vertexCount());
    // Chords of 9 and of 14 columns differ by up to one percent, which the mean shares out.
    EXPECT_NEAR(pattern->flats[i]->meanAreaError, plain->flats[i]->meanAreaError, 6e-3) << id;
  }
}

TEST(SymmetricPieces, TakeTheMeanOfSidesThatDifferAndNothingBeyondTheTolerance) {
  const Result<Pattern> slight = symmetricPattern(trunks(0.8));
  ASSERT_TRUE(slight) << slight.error();
  for (const char* id : {"front", "crotch", "back"}) expectSymmetric(*slight, id);
  expectExactLengths(*slight);
  EXPECT_NEAR(outline(*slight, "crotch", true), outline(*slight, "crotch", false), 1e-9);
  const Result<Pattern> plain = makePattern(trunks(80)), crooked = symmetricPattern(trunks(80));
  ASSERT_TRUE(plain && crooked);
  EXPECT_EQ(count(*crooked, "made-symmetric"), 0U);
  EXPECT_EQ(writeReportJson(*crooked), writeReportJson(*plain));
  EXPECT_FALSE(symmetricPattern(trunks(0), 30));
}

TEST(SymmetricPieces, HaveNoHistoryAndKeepTheirSymmetryWhenProcessed) {
  Document document = trunks(0.8);
  Design design = *document.design;
  design.pieces[1].develop = DevelopSetting{Ratio::of(0.3), {}, {}, {}};
  document = withDesign(document, design);
  PatternCache cache;
  ASSERT_TRUE(makePattern(document, {}, &cache));
  const Result<Pattern> first = symmetricPattern(document, 2, &cache);
  const Result<Pattern> second = symmetricPattern(document, 2, &cache);
  const Result<Pattern> alone = symmetricPattern(document);
  ASSERT_TRUE(first && second && alone);
  ASSERT_TRUE(alone->developed[1]);
  expectSymmetric(*alone, "crotch");
  expectExactLengths(*alone);
  EXPECT_EQ(writeReportJson(*first), writeReportJson(*alone));
  EXPECT_EQ(writeReportJson(*second), writeReportJson(*alone));
}

/// The crotch of a pair of trousers as in the article's figure 12, on a body whose triangles know
/// nothing of its symmetry.
TEST(SymmetricPieces, TheCrotchOfARemeshedBodyIsItsOwnMirrorImage) {
  TOILE_TEST_DATA_OR_SKIP(body, "scans/female_average_remesh.ply");
  const Result<ReferenceModel> model = readModel(body, FileUnit::Millimetre);
  ASSERT_TRUE(model) << model.error();
  Design design;
  StylingCurve outline;
  outline.id = "outline";
  SmoothWay way;
  outline.closed = true;
  for (const auto& [x, y, z] : {std::array{0.0, -180.0, 900.0},
                                {75.0, -170.0, 880.0},
                                {80.0, -120.0, 800.0},
                                {60.0, -60.0, 745.0},
                                {70.0, 20.0, 790.0},
                                {50.0, 80.0, 850.0},
                                {0.0, 70.0, 880.0},
                                {-50.0, 80.0, 850.0},
                                {-70.0, 20.0, 790.0},
                                {-60.0, -60.0, 745.0},
                                {-80.0, -120.0, 800.0},
                                {-75.0, -170.0, 880.0}}) {
    way.controls.emplace_back(NearPosition{{x, y, z}, {}});
  }
  outline.way = way;
  design.curves.push_back(outline);
  PieceRecord record;
  record.id = "crotch";
  record.anchor = NearPosition{{0, -64, 774}, {}};
  design.pieces.push_back(record);
  record.id = "rest";
  record.anchor = NearPosition{{0, -100, 1200}, {}};
  record.include = false;
  design.pieces.push_back(record);
  const Document document{std::make_shared<const Design>(design),
                          std::make_shared<const ReferenceModel>(*model)};
  const Result<Pattern> pattern = symmetricPattern(document);
  ASSERT_TRUE(pattern) << pattern.error();
  expectSymmetric(*pattern, "crotch");
  expectExactLengths(*pattern);
  const std::size_t crotch = indexOf(*pattern, "crotch");
  EXPECT_GT(pattern->cut.pieces[crotch].mesh->faceCount(), 500U);
  EXPECT_TRUE(pattern->flats[crotch]->check.passes());
}

/// A torso that is broader on its left: a paired mesh, however crooked.
TEST(SymmetricPieces, OnACrookedModelThePairingOfVerticesSays) {
  const Result<Document> vest = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(vest) << vest.error();
  std::vector<Eigen::Vector3d> positions = vest->model->mesh->positions();
  for (Eigen::Vector3d& p : positions) {
    if (p.x() > 0) p.x() *= 1.06;
    p.y() += 8 * std::sin(p.x() / 90);
  }
  const Result<ReferenceModel> model =
      withMesh(*vest->model, "crooked", vest->model->mesh->withPositions(std::move(positions)));
  ASSERT_TRUE(model) << model.error();
  const Document crooked{vest->design, std::make_shared<const ReferenceModel>(*model)};
  const Result<Pattern> pattern = symmetricPattern(crooked, 0.1);
  ASSERT_TRUE(pattern) << pattern.error();
  expectSymmetric(*pattern, "back");
  expectExactLengths(*pattern);
  // With twins beside it, which share its seams.
  Design design = *crooked.design;
  for (PieceRecord& record : design.pieces) {
    if (record.id == "side-back-r") record.twin = Twin{"side-back-l", TwinMode::Mean, {}};
  }
  const Result<Pattern> twins = symmetricPattern(withDesign(crooked, design), 0.1);
  ASSERT_TRUE(twins) << twins.error();
  EXPECT_EQ(count(*twins, "no-twins"), 0U);
  expectSymmetric(*twins, "back");
  expectExactLengths(*twins);
}

}  // namespace
}  // namespace toile::test
