// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/design/design_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/design/random_design.h"
#include "support/result_printing.h"
#include "toile/core/file.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

/// A small design that uses most of the format.
constexpr std::string_view kVest = R"({
  "toile": 1,
  "name": "Vest",
  "models": [
    {"model": "builtin:torso@1"}
  ],
  "curves": [
    {
      "id": "side",
      "kind": "seam",
      "way": {
        "smooth": [
          {"landmark": "armpit_l"},
          {"curve": "side_l", "at": 0.5},
          {"section": {"normal": [0, 0, 1], "through": "hip_front"}, "direction": [1, 0, 0]}
        ]
      },
      "left": {"allowance": "15mm", "kind": "lapped"}
    },
    {
      "id": "zip",
      "kind": "opening",
      "mirrorOf": "side"
    },
    {
      "id": "drawn",
      "kind": "feature",
      "closed": true,
      "points": [
        {"vertex": 7},
        {"edge": [3, 9], "t": 0.25},
        {"face": 12, "weights": [0.5, 0.25, 0.25]}
      ]
    }
  ],
  "pieces": [
    {
      "id": "front",
      "anchor": {"line": "side", "at": 0.5},
      "fabric": "shell"
    }
  ],
  "fabrics": [
    {
      "id": "shell",
      "thickness": "0.8mm",
      "ease": "-5%"
    }
  ],
  "finish": {
    "allowance": "10mm",
    "notchDepth": "4mm",
    "notchSpacing": "150mm"
  }
}
)";

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string out(text);
  const std::size_t at = out.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? out : out.replace(at, from.size(), to);
}

TEST(DesignFile, ReadsWhatTheTextSays) {
  const Result<Design> design = parseDesign(kVest, "vest.toile");
  ASSERT_TRUE(design) << design.error().message;
  ASSERT_EQ(design->curves.size(), 3U);
  const StylingCurve& side = design->curves[0];
  const auto& way = std::get<SmoothWay>(side.way);
  EXPECT_EQ(std::get<AtLandmark>(way.controls[0]).name, "armpit_l");
  EXPECT_EQ(std::get<OnModelCurve>(way.controls[1]).fraction, 0.5);
  const auto& section = std::get<OnSection>(way.controls[2]);
  EXPECT_EQ(std::get<AtLandmark>(section.plane.through).name, "hip_front");
  EXPECT_EQ(section.direction, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(side.left.allowance, Length::mm(15));
  EXPECT_EQ(side.left.kind, SeamKind::Lapped);
  EXPECT_EQ(side.right, SeamSide());
  EXPECT_EQ(design->curves[1].kind, CurveKind::Opening);
  EXPECT_EQ(design->curves[1].mirrorOf, "side");
  const StylingCurve& drawn = design->curves[2];
  EXPECT_TRUE(drawn.closed);
  const auto& onEdge = std::get<ModelPoint::OnEdge>(drawn.dataPoints[1].at);
  EXPECT_EQ(onEdge.tail, VertexId(3));
  EXPECT_EQ(onEdge.head, VertexId(9));
  EXPECT_EQ(onEdge.t, 0.25);
  EXPECT_EQ(design->pieces[0].fabric, "shell");
  EXPECT_EQ(design->fabrics[0].ease.girth, Ratio::percent(-5));
  EXPECT_EQ(design->fabrics[0].ease.length, Ratio::percent(-5));
}

TEST(DesignFile, WritesToilesOwnTextUnchanged) {
  const Result<Design> design = parseDesign(kVest, "vest.toile");
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(writeDesign(*design), kVest);
}

TEST(DesignFile, RandomDesignsComeBackBitForBit) {
  std::size_t curves = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const Design design = test::RandomDesign(seed).design();
    const std::string text = writeDesign(design);
    const Result<Design> read = parseDesign(text, "random.toile");
    ASSERT_TRUE(read) << "seed " << seed << ": " << read.error().message << "\n" << text;
    EXPECT_TRUE(*read == design) << "seed " << seed << "\n" << text;
    // The text tells -0 from 0, which == does not.
    ASSERT_EQ(writeDesign(*read), text) << "seed " << seed;
    curves += design.curves.size();
  }
  EXPECT_GT(curves, 500U);
}

TEST(DesignFile, KeepsUnknownKeysAtEveryLevelWithTheirText) {
  // One unknown key in every object of the text but model points.
  std::string text = R"({"toile":1, "top":[1.50,{"x" : null}],
 "models":[{"model":"builtin:torso@1","k0":0}],
 "curves":[{"id":"a","kind":"dart","k1":1e2,
   "way":{"smooth":[{"landmark":"x","k2":"\u0041"},{"near":[1,2,3],"k3":[ ]},
     {"section":{"normal":[0,0,1],"offset":"1m","k4":{}},"direction":[1,0,0],"k5":false}],"k6":-0},
   "left":{"k7":7}},
  {"id":"b","kind":"mark","way":{"view":{"eye":[0,-1,0],"target":[0,0,0],"up":[0,0,1],
     "height":"1m","perspective":true,"k8":8},"controls":[[1,2]],"k9":9}}],
 "pieces":[{"id":"p","anchor":{"line":"a","at":0,"k10":10},"k11":11}],
 "fabrics":[{"id":"f","k12":12}], "order":{"k13":13}, "finish":{"k14":14}})";
  const Result<Design> design = parseDesign(text, "t");
  ASSERT_TRUE(design) << design.error().message;
  const std::string written = writeDesign(*design);
  for (const char* member :
       {"\"top\": [1.50,{\"x\" : null}]", "\"k0\": 0", "\"k1\": 1e2", "\"k2\": \"\\u0041\"",
        "\"k3\": [ ]", "\"k4\": {}", "\"k5\": false", "\"k6\": -0", "\"k7\": 7", "\"k8\": 8",
        "\"k9\": 9", "\"k10\": 10", "\"k11\": 11", "\"k12\": 12", "\"k13\": 13", "\"k14\": 14"}) {
    EXPECT_THAT(written, HasSubstr(member));
  }
  const Result<Design> again = parseDesign(written, "t");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_TRUE(*again == *design);
}

struct Damage {
  std::string_view from, to;  ///< what is changed in kVest
  std::string_view place;     ///< that the message must name: line or path of the key
  std::string_view says;
};

class DamagedDesign : public testing::TestWithParam<Damage> {};

TEST_P(DamagedDesign, IsRefusedNamingThePlace) {
  const Damage& damage = GetParam();
  const Result<Design> design = parseDesign(replaced(kVest, damage.from, damage.to), "vest.toile");
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().code, ErrorCode::FileFormat);
  EXPECT_THAT(design.error().message, HasSubstr("vest.toile, line "));
  EXPECT_THAT(design.error().message, HasSubstr(std::string(damage.place)));
  EXPECT_THAT(design.error().message, HasSubstr(std::string(damage.says)));
  ASSERT_EQ(design.error().where.size(), 1U);
  EXPECT_EQ(design.error().where[0].kind, Element::Kind::Line);
}

INSTANTIATE_TEST_SUITE_P(
    Table, DamagedDesign,
    testing::Values(
        // The text
        Damage{"\"name\": \"Vest\",", "\"name\": \"Vest\"", "line 4, column 3", "\",\" or \"}\""},
        Damage{"\"Vest\"", "\"Vest", "line 3", "line end or control character"},
        Damage{"\"Vest\"", "\"V\\xest\"", "line 3", "an escape"},
        Damage{"\"Vest\"", "\"V\\ud800est\"", "line 3", "surrogate"},
        Damage{"\"Vest\"", "\"V\xFF\"", "line 3, column", "UTF-8"},
        Damage{"\"Vest\"", "\"V\xC0\xAF\"", "line 3, column", "UTF-8"},
        Damage{"\"Vest\"", "nul", "line 3, column 11", "expected a value"},
        Damage{"0.25}", "0.25]", "line 31", "\",\" or \"}\""},
        Damage{"0.25}", "00.25}", "line 31", "begin with 0"},
        Damage{"0.25}", "1e999}", "line 31", "too large"},
        Damage{"0.25}", ".25}", "line 31", "expected a value"},
        Damage{"0.25}", "1.}", "line 31", "a digit"},
        Damage{"0.25}", "NaN}", "line 31", "expected a value"},
        Damage{"\"closed\": true", "\"id\": \"drawn\"", "line 28", "stands here twice"},
        Damage{"}\n}\n", "}\n}\nx", "line 56", "nothing may follow"},
        // Pieces placed by hand, cloth
        Damage{"\"finish\": {",
               "\"layout\": [{\"piece\": \"a\"}, {\"piece\": \"a\"}],\n  \"finish\": {",
               "/layout/1", "placed twice"},
        Damage{"\"finish\": {",
               "\"layout\": [{\"piece\": \"a\", \"move\": [1e6, 0]}],\n  \"finish\": {",
               "/layout/0/move", "at most 100 m"},
        Damage{"\"0.8mm\",", "\"0.8mm\", \"turns\": \"sideways\",", "/fabrics/0/turns",
               "\"sideways\" is not known"},
        // Version
        Damage{"\"toile\": 1,", "", "line 1, the whole", "needs the key \"toile\""},
        Damage{"\"toile\": 1,", "\"toille\": 1,", "the whole", "is \"toille\" meant"},
        Damage{"\"toile\": 1", "\"toile\": 2", "line 2, /toile", "newer Toile"},
        Damage{"\"toile\": 1", "\"toile\": 0", "/toile", "1 or more"},
        Damage{"\"toile\": 1", "\"toile\": \"1\"", "/toile", "whole number"},
        // Types
        Damage{"\"Vest\"", "7", "line 3, /name", "text in quotes"},
        Damage{"{\"model\": \"builtin:torso@1\"}", "\"builtin:torso@1\"", "/models/0", "object"},
        Damage{"\"closed\": true", "\"closed\": 1", "line 28, /curves/2/closed", "true or false"},
        Damage{"\"points\": [", "\"points\": {}, \"x\": [", "/curves/2/points", "list"},
        Damage{"{\"vertex\": 7}", "7", "/curves/2/points/0", "object"},
        Damage{"{\"vertex\": 7}", "{\"vertex\": 7.5}", "/curves/2/points/0/vertex", "whole number"},
        Damage{"{\"vertex\": 7}", "{\"vertex\": -7}", "/curves/2/points/0/vertex", "whole number"},
        Damage{"{\"vertex\": 7}", "{\"vertex\": 4294967295}", "/curves/2/points/0/vertex",
               "4294967294"},
        Damage{"\"15mm\"", "15", "/curves/0/left/allowance", "text in quotes"},
        Damage{"\"15mm\"", "\"15\"", "/curves/0/left/allowance", "length with its unit"},
        Damage{"[0, 0, 1]", "[0, 1]", "/curves/0/way/smooth/2/section/normal", "list of 3"},
        Damage{"[0, 0, 1]", "[0, 0, \"1\"]", "/section/normal/2", "a number"},
        // Values
        Damage{"\"kind\": \"seam\"", "\"kind\": \"seem\"", "line 10, /curves/0/kind",
               "did you mean \"seam\""},
        Damage{"\"kind\": \"seam\",", "", "line 8, /curves/0", "needs the key \"kind\""},
        Damage{"\"id\": \"zip\"", "\"id\": \"side\"", "/curves/1", "used twice"},
        Damage{"\"id\": \"zip\"", "\"id\": \"zip 1\"", "/curves/1/id", "an id is made of"},
        Damage{"\"mirrorOf\": \"side\"", "\"mirrorOf\": \"sied\"", "/curves/1",
               "did you mean \"side\""},
        Damage{"\"mirrorOf\": \"side\"", "\"mirrorOf\": \"zip\"", "/curves/1", "of itself"},
        Damage{"\"mirrorOf\": \"side\"", "\"name\": \"x\"", "line 20, /curves/1",
               "needs a \"way\""},
        Damage{"\"line\": \"side\"", "\"line\": \"sidee\"", "/pieces/0", "no curve \"sidee\""},
        Damage{"\"fabric\": \"shell\"", "\"fabric\": \"shelf\"", "/pieces/0",
               "did you mean \"shell\""},
        Damage{"\"at\": 0.5}", "\"at\": 1.5}", "/curves/0/way/smooth/1/at", "between 0 and 1"},
        Damage{"\"at\": 0.5}", "\"att\": 0.5}", "/curves/0/way/smooth/1", "is \"att\" meant"},
        Damage{"{\"landmark\": \"armpit_l\"}", "{\"landmrk\": \"armpit_l\"}",
               "line 13, /curves/0/way/smooth/0", "a place has one of"},
        Damage{"\"smooth\": [", "\"smoth\": [", "/curves/0/way", "a way has one of"},
        Damage{"[0, 0, 1]", "[0, 0, 0]", "/section/normal", "must not be zero"},
        Damage{"\"through\": \"hip_front\"", "\"through\": \"hip_front\", \"offset\": \"1mm\"",
               "/curves/0/way/smooth/2/section", "one of"},
        Damage{"\"edge\": [3, 9]", "\"edge\": [9, 3]", "/curves/2/points/1/edge", "smaller"},
        Damage{"\"t\": 0.25", "\"t\": 1", "/curves/2/points/1/t", "below 1"},
        Damage{"[0.5, 0.25, 0.25]", "[0.5, 0.25, 0.26]", "/curves/2/points/2/weights", "add up"},
        Damage{"[0.5, 0.25, 0.25]", "[0.5, 0.5, 0]", "/curves/2/points/2/weights", "above 0"},
        Damage{"{\"vertex\": 7}", "{\"vertex\": 7, \"w\": 1}", "/curves/2/points/0/w",
               "no such key"},
        Damage{"\"ease\": \"-5%\"", "\"ease\": \"-95%\"", "/fabrics/0/ease", "between"},
        Damage{"\"thickness\": \"0.8mm\"", "\"weights\": {\"shear\": 0}",
               "/fabrics/0/weights/shear", "between"},
        Damage{"\"fabric\": \"shell\"", "\"twin\": {\"of\": \"front\"}", "/pieces/0",
               "no twin of itself"},
        Damage{"\"fabric\": \"shell\"", "\"twin\": {\"of\": \"frond\"}", "/pieces/0",
               "did you mean \"front\""},
        Damage{"\"fabric\": \"shell\"", "\"twin\": {\"of\": \"front\", \"mode\": \"same\"}",
               "/pieces/0/twin/mode", "identical"},
        Damage{"\"fabric\": \"shell\"", "\"grain\": {\"along\": \"w\"}", "/pieces/0/grain/along",
               "is not known here"},
        Damage{"\"thickness\": \"0.8mm\"", "\"colour\": \"red\"", "/fabrics/0/colour", "#1a2b3c"},
        Damage{"\"notchSpacing\": \"150mm\"", "\"notchSpacing\": \"0mm\"", "/finish/notchSpacing",
               "between 20mm and 10000mm"},
        Damage{"\"allowance\": \"10mm\"", "\"allowance\": \"-1mm\"", "/finish/allowance",
               "between 0mm and 300mm"},
        // A unit that slipped: "10m" for "10mm".
        Damage{"\"allowance\": \"10mm\"", "\"allowance\": \"1000m\"", "/finish/allowance",
               "between 0mm and 300mm"},
        Damage{"\"notchDepth\": \"4mm\"", "\"hemAllowance\": \"1000m\"", "/finish/hemAllowance",
               "between 0mm and 300mm"},
        Damage{"\"notchDepth\": \"4mm\"", "\"lappedAllowance\": \"1000m\"",
               "/finish/lappedAllowance", "between 0mm and 300mm"},
        Damage{"\"notchDepth\": \"4mm\"", "\"openingAllowance\": \"1000m\"",
               "/finish/openingAllowance", "between 0mm and 300mm"},
        Damage{"\"15mm\"", "\"15m\"", "/curves/0/left/allowance", "between 0mm and 300mm"},
        Damage{"\"thickness\": \"0.8mm\"", "\"allowance\": \"10m\"", "/fabrics/0/allowance",
               "between 0mm and 300mm"},
        Damage{"\"notchDepth\": \"4mm\"", "\"notchDepth\": \"4m\"", "/finish/notchDepth",
               "between 0mm and 50mm"},
        Damage{"\"notchDepth\": \"4mm\"", "\"notchWidth\": \"0mm\"", "/finish/notchWidth",
               "between 0.5mm and 50mm"},
        Damage{"\"150mm\"", "\"150m\"", "/finish/notchSpacing", "between 20mm and 10000mm"},
        Damage{"\"anchor\": {\"line\": \"side\", \"at\": 0.5},",
               "\"anchor\": {\"near\": [1, 2, 3]}, \"count\": 0,", "/pieces/0/count",
               "1 or more"}));

TEST(DesignFile, RefusesEveryTruncation) {
  // Without the last brace the text is no longer whole; the line end after it may go.
  for (std::size_t length = 0; length + 2 <= kVest.size(); ++length) {
    const Result<Design> design = parseDesign(kVest.substr(0, length), "cut.toile");
    ASSERT_FALSE(design) << "cut after " << length << " bytes";
    ASSERT_EQ(design.error().code, ErrorCode::FileFormat);
  }
}

TEST(DesignFile, SurvivesAnyChangedByte) {
  std::size_t read = 0, refused = 0;
  for (std::size_t i = 0; i < kVest.size(); ++i) {
    for (const char c : {'\0', '"', '{', ']', '9', '\xff', ','}) {
      std::string text(kVest);
      text[i] = c;
      const Result<Design> design = parseDesign(text, "changed.toile");
      (design ? read : refused) += 1;
      if (design) {
        ASSERT_TRUE(parseDesign(writeDesign(*design), "again")) << text;
      }
    }
  }
  EXPECT_GT(read, 100U);
  EXPECT_GT(refused, 1000U);
}

TEST(DesignFile, RefusesDeepNestingAndTooManyValues) {
  const std::string deep(100000, '[');
  const Result<Design> nested = parseDesign("{\"toile\":1,\"x\":" + deep, "deep.toile");
  ASSERT_FALSE(nested);
  EXPECT_THAT(nested.error().message, HasSubstr("nested too deeply"));
  std::string many = "{\"toile\":1,\"x\":[0";
  for (int i = 0; i < 4'000'100; ++i) many += ",0";
  const Result<Design> filled = parseDesign(many + "]}", "many.toile");
  ASSERT_FALSE(filled);
  EXPECT_THAT(filled.error().message, HasSubstr("too many values"));
}

TEST(DesignFile, SaysWhichFileIsMissing) {
  const Result<Design> design = readDesign("no-such-folder/vest.toile");
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().code, ErrorCode::FileNotFound);
  EXPECT_THAT(design.error().message, HasSubstr("vest.toile"));
}

TEST(DesignFile, ExamplesAreInToilesOwnForm) {
  std::size_t count = 0;
  for (const char* folder : {"/examples", "/tests/designs"}) {
    const std::filesystem::path path = std::string(TOILE_SOURCE_DIR) + folder;
    if (!std::filesystem::exists(path)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      if (entry.path().extension() != ".toile") continue;
      const Result<std::string> text = readFile(entry.path());
      ASSERT_TRUE(text) << text.error().message;
      const Result<Design> design = parseDesign(*text, entry.path().string());
      ASSERT_TRUE(design) << design.error().message;
      EXPECT_EQ(writeDesign(*design), *text) << entry.path();
      ++count;
    }
  }
  EXPECT_GT(count, 0U);
}

TEST(ModelPoint, IsLosslessForEveryKindOfPoint) {
  const Result<Mesh> mesh =
      makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
               {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(3)}});
  ASSERT_TRUE(mesh) << mesh.error().message;
  std::vector<SurfacePoint> points{{VertexId(3)},
                                   {SurfacePoint::InFace{FaceId(1), {0.1, 0.2, 1 - 0.1 - 0.2}}}};
  for (std::size_t i = 0; i < mesh->edgeCount(); ++i) {
    points.push_back({SurfacePoint::OnEdge{EdgeId(i), 0.1 + 0.2}});
  }
  for (const SurfacePoint& point : points) {
    const Result<SurfacePoint> back = toSurfacePoint(*mesh, toModelPoint(*mesh, point));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, point);
  }
}

TEST(ModelPoint, RefusesWhatTheMeshDoesNotHave) {
  const Result<Mesh> mesh =
      makeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
               {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(3)}});
  ASSERT_TRUE(mesh);
  const auto code = [&](const ModelPoint& point) {
    const Result<SurfacePoint> result = toSurfacePoint(*mesh, point);
    return result ? std::string("accepted") : std::string(toString(result.error().code));
  };
  EXPECT_EQ(code({VertexId(4)}), "ModelMismatch");
  EXPECT_EQ(code({ModelPoint::OnEdge{VertexId(1), VertexId(3), 0.5}}), "ModelMismatch");
  EXPECT_EQ(code({ModelPoint::OnEdge{VertexId(2), VertexId(9), 0.5}}), "ModelMismatch");
  EXPECT_EQ(code({SurfacePoint::InFace{FaceId(2), {0.5, 0.25, 0.25}}}), "ModelMismatch");
  EXPECT_EQ(code({ModelPoint::OnEdge{VertexId(0), VertexId(1), 1.0}}), "CurveInvalid");
  EXPECT_EQ(code({SurfacePoint::InFace{FaceId(0), {0.5, 0.5, 0.5}}}), "CurveInvalid");
}

}  // namespace
}  // namespace toile
