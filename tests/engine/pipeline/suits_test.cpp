// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/design/design_file.h"
#include "toile/pipeline.h"

// The two wetsuits of the examples, on the built-in body and on every body of the test data.
namespace toile {
namespace {

namespace fs = std::filesystem;

struct Suit {
  const char* file;
  std::set<std::string> middle;  ///< pieces across the middle of the body
  std::set<std::string> paired;  ///< without the -l and -r
  std::set<std::string> hems;    ///< curves without the -l and -r
};

const Suit kFull{
    "wetsuit-full.toile",
    {"front", "collar"},
    {"back", "sleeve", "underarm", "side", "back-leg", "thigh", "knee", "shin", "calf"},
    {"collar-top", "wrist", "ankle"}};
const Suit kShort{"wetsuit-short.toile",
                  {"collar", "front-lower", "back"},
                  {"yoke", "front", "side", "seat", "thigh"},
                  {"collar-top", "sleeve-hem", "leg-hem"}};

struct Case {
  const Suit* suit;
  const char* body;
  double areaError;  ///< bound on every piece's mean area error, measured and rounded up
};
void PrintTo(const Case& test, std::ostream* out) {
  *out << test.suit->file << " on " << test.body;
}

/// A body of the test data with its names, as a `*.model.json` in the folder of temporary files.
class ModelFile {
 public:
  explicit ModelFile(const fs::path& mesh)
      : path_(fs::path(testing::TempDir()) /
              ("toile-suits-" + std::to_string(getpid()) + ".model.json")) {
    std::ofstream(path_) << "{\"toile-model\": 1, \"units\": \"mm\", \"mesh\": " << mesh
                         << ", \"curves\": " << mesh.parent_path() / "curves.json"
                         << ", \"landmarks\": " << mesh.parent_path() / "landmarks.json"
                         << "}\n";
  }
  ~ModelFile() { fs::remove(path_); }
  ModelFile(const ModelFile&) = delete;
  ModelFile& operator=(const ModelFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

Result<Document> openSuit(const Suit& suit, const std::string& body) {
  return openDocument(fs::path(TOILE_SOURCE_DIR) / "examples" / suit.file, body);
}

/// The other side's name: "-l" for "-r" and the other way round; others as they are.
std::string partner(std::string name) {
  const auto has = [&](std::string_view end) { return name.ends_with(end); };
  if (has("-l")) return name.replace(name.size() - 1, 1, "r");
  if (has("-r")) return name.replace(name.size() - 1, 1, "l");
  return name;
}
std::string withoutSide(const std::string& name) {
  return partner(name) == name ? name : name.substr(0, name.size() - 2);
}

std::set<std::string> expectedPieces(const Suit& suit) {
  std::set<std::string> names = suit.middle;
  for (const std::string& name : suit.paired) names.insert({name + "-l", name + "-r"});
  return names;
}

void expectWholeSuit(const Suit& suit, const Pattern& pattern, double areaError) {
  EXPECT_TRUE(pattern.isComplete());
  for (const auto& failure : pattern.failures) {
    if (failure) ADD_FAILURE() << *failure;
  }
  for (const Finding& finding : pattern.cut.findings) {
    ADD_FAILURE() << finding.code << ": " << finding.message;
  }
  std::set<std::string> made;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    EXPECT_EQ(piece.recordIndices.size(), 1U) << piece.id;
    if (!piece.include) continue;
    made.insert(piece.id);
    EXPECT_TRUE(topology(piece).isDisk()) << piece.id;
    ASSERT_TRUE(pattern.flats[i]) << piece.id;
    EXPECT_TRUE(pattern.flats[i]->check.passes()) << piece.id;
    EXPECT_LE(pattern.flats[i]->meanAreaError, areaError) << piece.id;
  }
  EXPECT_EQ(made, expectedPieces(suit));
}

/// Every seam but the hems is sewn to a piece of the suit.
void expectSewn(const Suit& suit, const CutResult& cut) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> mated;
  for (const SeamMates& mates : cut.mates) {
    mated.insert({mates.pieceA, mates.wireA});
    mated.insert({mates.pieceB, mates.wireB});
  }
  for (std::uint32_t p = 0; p < cut.pieces.size(); ++p) {
    const Piece& piece = cut.pieces[p];
    for (std::uint32_t w = 0; piece.include && w < piece.wires.size(); ++w) {
      if (piece.wires[w].kind != WireKind::Seam) continue;
      const std::string& curve = piece.wires[w].curve;
      EXPECT_EQ(mated.contains({p, w}), !suit.hems.contains(withoutSide(curve)))
          << piece.id << ", " << curve;
    }
  }
}

class SuitOnBody : public testing::TestWithParam<Case> {};

TEST_P(SuitOnBody, EveryPiecePassesEveryCheck) {
  TOILE_TEST_DATA_OR_SKIP(mesh, std::string("bodies/") + GetParam().body + ".ply");
  const ModelFile model(fs::absolute(mesh));
  const Suit& suit = *GetParam().suit;
  const Result<Document> document = openSuit(suit, model.path());
  ASSERT_TRUE(document) << document.error();
  const Result<Pattern> pattern = makePattern(*document);
  ASSERT_TRUE(pattern) << pattern.error();
  expectWholeSuit(suit, *pattern, GetParam().areaError);
  expectSewn(suit, pattern->cut);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, SuitOnBody,
    testing::Values(Case{&kFull, "female_average", 0.04}, Case{&kFull, "male_average", 0.04},
                    Case{&kFull, "female_tall_slim", 0.04}, Case{&kFull, "male_heavy", 0.04},
                    Case{&kFull, "child_10y", 0.04}, Case{&kFull, "elderly", 0.04},
                    Case{&kFull, "female_average_arms_raised", 0.04},
                    Case{&kFull, "male_average_knee_bent", 0.05},
                    Case{&kFull, "female_tall_slim_cycling", 0.05},
                    Case{&kShort, "female_average", 0.04}, Case{&kShort, "male_average", 0.04},
                    Case{&kShort, "female_tall_slim", 0.04}, Case{&kShort, "male_heavy", 0.04},
                    Case{&kShort, "child_10y", 0.04}, Case{&kShort, "elderly", 0.045},
                    Case{&kShort, "female_average_arms_raised", 0.04},
                    Case{&kShort, "male_average_knee_bent", 0.045},
                    Case{&kShort, "female_tall_slim_cycling", 0.045}));

class SuitOnBuiltinBody : public testing::TestWithParam<Case> {};

TEST_P(SuitOnBuiltinBody, EveryPiecePassesEveryCheck) {
  const Suit& suit = *GetParam().suit;
  const Result<Document> document = openSuit(suit, GetParam().body);
  ASSERT_TRUE(document) << document.error();
  const Result<Pattern> pattern = makePattern(*document);
  ASSERT_TRUE(pattern) << pattern.error();
  expectWholeSuit(suit, *pattern, GetParam().areaError);
  expectSewn(suit, pattern->cut);
}

constexpr const char* kWoman = "builtin:body@1";
constexpr const char* kMan = "builtin:body@1?form=male&height=1850mm&chest=1150mm&waist=850mm";
constexpr const char* kChild = "builtin:body@1?height=1200mm";
constexpr const char* kArmsRaised = "builtin:body@1?posture=arms-raised";
constexpr const char* kKneeBent = "builtin:body@1?posture=knee-bent";
constexpr const char* kSeated = "builtin:body@1?form=male&posture=seated";

INSTANTIATE_TEST_SUITE_P(
    Bodies, SuitOnBuiltinBody,
    testing::Values(Case{&kFull, kWoman, 0.04}, Case{&kFull, kMan, 0.04},
                    Case{&kFull, kChild, 0.04}, Case{&kFull, kArmsRaised, 0.04},
                    Case{&kFull, kKneeBent, 0.07}, Case{&kFull, kSeated, 0.07},
                    Case{&kShort, kWoman, 0.04}, Case{&kShort, kMan, 0.04},
                    Case{&kShort, kChild, 0.04}, Case{&kShort, kArmsRaised, 0.045},
                    Case{&kShort, kKneeBent, 0.045}, Case{&kShort, kSeated, 0.06}));

/// Total target length of each curve's runs in each piece.
std::map<std::pair<std::string, std::string>, double> lengthsByCurve(const CutResult& cut) {
  std::map<std::pair<std::string, std::string>, double> lengths;
  for (const Piece& piece : cut.pieces) {
    for (const Wire& wire : piece.wires) {
      double& sum = lengths[{piece.id, wire.curve}];
      for (const double target : wire.targetLength) sum += target;
    }
  }
  return lengths;
}

/// @param tolerance of the difference of two lengths, for each mm
void expectSymmetric(const Suit& suit, const std::string& body, double tolerance) {
  const Result<Document> document = openSuit(suit, body);
  ASSERT_TRUE(document) << document.error();
  const Result<std::vector<PlacedCurve>> curves = placeCurves(*document->design, *document->model);
  ASSERT_TRUE(curves) << curves.error();
  const Result<CutResult> result = cut(*document, *curves);
  ASSERT_TRUE(result) << result.error();
  const auto lengths = lengthsByCurve(*result);
  for (const auto& [key, length] : lengths) {
    const auto other = lengths.find({partner(key.first), partner(key.second)});
    ASSERT_NE(other, lengths.end()) << key.first << ", " << key.second;
    EXPECT_NEAR(length, other->second, tolerance * length) << key.first << ", " << key.second;
  }
}

TEST(Suits, LeftAndRightAreEqual) {
  expectSymmetric(kFull, kWoman, 1e-9);
  expectSymmetric(kShort, kWoman, 1e-9);
}

// Here the corners of a face and of its mirror image come in another order, and where a line ends
// on another the cut rounds the node to the whole numbers of its face.
TEST(Suits, LeftAndRightAreEqualOnABodyOfTheTestData) {
  TOILE_TEST_DATA_OR_SKIP(mesh, "bodies/female_average.ply");
  const ModelFile model(fs::absolute(mesh));
  expectSymmetric(kFull, model.path(), 1e-7);
  expectSymmetric(kShort, model.path(), 1e-7);
}

TEST(Suits, KeepTheLinesOfTheBody) {
  for (const Suit* suit : {&kFull, &kShort}) {
    const Result<Design> design = readDesign(fs::path(TOILE_SOURCE_DIR) / "examples" / suit->file);
    ASSERT_TRUE(design) << design.error();
    std::map<std::string, CurveKind> kinds;
    for (const StylingCurve& curve : design->curves) kinds[curve.id] = curve.kind;
    for (const char* line : {"bust-line", "waist-line", "hip-line"}) {
      EXPECT_EQ(kinds[std::string(line) + "-l"], CurveKind::Feature) << suit->file << ", " << line;
      EXPECT_EQ(kinds[std::string(line) + "-r"], CurveKind::Feature) << suit->file << ", " << line;
    }
    EXPECT_EQ(kinds["centre-front"], CurveKind::Feature) << suit->file;
    EXPECT_EQ(kinds["zip"], CurveKind::Opening) << suit->file;
  }
}

TEST(Suits, NameLeftAndRight) {
  for (const Suit* suit : {&kFull, &kShort}) {
    const Result<Design> design = readDesign(fs::path(TOILE_SOURCE_DIR) / "examples" / suit->file);
    ASSERT_TRUE(design) << design.error();
    std::map<std::string, std::string> names;
    for (const PieceRecord& piece : design->pieces) names[piece.id] = piece.name;
    for (const auto& [id, name] : names) {
      if (!id.ends_with("-l")) continue;
      ASSERT_THAT(name, testing::EndsWith(" left"));
      EXPECT_EQ(names[partner(id)], name.substr(0, name.size() - 4) + "right");
    }
  }
}

}  // namespace
}  // namespace toile
