// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/dxf.h"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "finish/polygon.h"
#include "support/hand_made_pattern.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "toile/io/dxf_file.h"

namespace toile {
namespace {

constexpr double kSeamToleranceMm = 0.02;  // what the report and the DXF may differ by, per seam

double lengthOf(const Points2& points, bool closed) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  if (closed && !points.empty()) length += (points.front() - points.back()).norm();
  return length;
}

double sewLength(const PatternPiece& piece) {
  double length = 0;
  for (const OutlineRun& run : piece.runs) length += run.length;
  return length;
}

/// Group code and value, as the file has them.
using Groups = std::vector<std::pair<int, std::string>>;

Groups groupsOf(const std::string& text) {
  Groups groups;
  std::istringstream in(text);
  std::string code;
  std::string value;
  while (std::getline(in, code) && std::getline(in, value)) {
    EXPECT_EQ(code.back(), '\r');
    EXPECT_EQ(value.back(), '\r');
    value.pop_back();
    groups.emplace_back(std::stoi(code), value);
  }
  return groups;
}

class LineReader : public DL_CreationAdapter {
 public:
  struct Line {
    std::string block, layer;
    bool closed = false;
    Points2 points;
  };
  std::vector<Line> lines;
  std::vector<std::string> blocks;

  void addBlock(const DL_BlockData& data) override { blocks.push_back(block_ = data.name); }
  void endBlock() override { block_.clear(); }
  void addPolyline(const DL_PolylineData& data) override {
    lines.push_back({block_, attributes.getLayer(), (data.flags & 1) != 0, {}});
  }
  void addVertex(const DL_VertexData& data) override {
    lines.back().points.emplace_back(data.x, data.y);
  }

 private:
  std::string block_;
};

/// The file of a pattern, in a folder of its own.
struct SavedDxf {
  explicit SavedDxf(const Pattern& pattern) : dxf(writeDxf(pattern)) {
    path = folder.path() / "pattern.dxf";
    test::writeText(path, dxf.text);
  }
  test::TemporaryFolder folder;
  DxfFile dxf;
  std::filesystem::path path;
};

nlohmann::json readWithEzdxf(const std::filesystem::path& path) {
  const test::ProgramResult read = test::runProgram(
      {"/usr/bin/python3", TOILE_SOURCE_DIR "/tests/engine/io/read_dxf.py", path.string()});
  EXPECT_EQ(read.status, 0) << read.err;
  return read.status == 0 ? nlohmann::json::parse(read.out) : nlohmann::json();
}

Points2 pointsOf(const nlohmann::json& entity) {
  Points2 points;
  for (const auto& p : entity.at("points"))
    points.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  return points;
}

TEST(Dxf, IsPlainAsciiWithCarriageReturnsAndNoNegativeZero) {
  const DxfFile dxf = writeDxf(test::makeTwoPiecePattern());
  for (std::size_t i = 0; i < dxf.text.size(); ++i) {
    const auto c = static_cast<unsigned char>(dxf.text[i]);
    ASSERT_TRUE(c == '\r' || c == '\n' || (c >= 0x20 && c < 0x7f)) << i;
    if (c == '\n') {
      ASSERT_EQ(dxf.text[i - 1], '\r');
    }
  }
  EXPECT_EQ(dxf.text.find("-0.000\r"), std::string::npos);
  EXPECT_TRUE(dxf.findings.empty());
}

TEST(Dxf, HoldsOnlyPiecesAndTheirInserts) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const Groups groups = groupsOf(writeDxf(pattern).text);
  const std::set<std::string> allowedLayers{"1",  "2",  "3",  "4",  "7", "8",
                                            "14", "15", "84", "85", "87"};
  std::vector<std::string> sections;
  std::set<std::string> entities;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].first == 8) {
      EXPECT_TRUE(allowedLayers.contains(groups[i].second));
    }
    if (groups[i].first == 5) ADD_FAILURE() << "a handle";
    if (groups[i].first != 0) continue;
    if (groups[i].second == "SECTION") sections.push_back(groups[i + 1].second);
    entities.insert(groups[i].second);
  }
  EXPECT_EQ(sections, (std::vector<std::string>{"HEADER", "BLOCKS", "ENTITIES"}));
  EXPECT_EQ(entities,
            (std::set<std::string>{"SECTION", "ENDSEC", "EOF", "BLOCK", "ENDBLK", "INSERT",
                                   "POLYLINE", "VERTEX", "SEQEND", "POINT", "LINE", "TEXT"}));
}

TEST(Dxf, IsReadByEzdxfWithoutFaults) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedDxf saved(pattern);
  const nlohmann::json file = readWithEzdxf(saved.path);
  ASSERT_FALSE(file.is_null());
  EXPECT_EQ(file["faults"], nlohmann::json::array());
  EXPECT_EQ(file["other"], nlohmann::json::array());
  EXPECT_EQ(file["inserts"], nlohmann::json::parse(R"([["ELL_M",0,0],["PANEL_M",0,0]])"));
  const std::vector<std::string> style = file["style"];
  EXPECT_NE(std::find(style.begin(), style.end(), "Units:METRIC"), style.end());
  ASSERT_EQ(file["blocks"].size(), 2u);

  for (std::size_t i = 0; i < 2; ++i) {
    const PatternPiece& piece = pattern.pieces[i];
    const nlohmann::json& block = file["blocks"][i == 0 ? "ELL_M" : "PANEL_M"];
    std::map<int, std::vector<nlohmann::json>> on;
    std::vector<std::string> texts;
    for (const nlohmann::json& entity : block) {
      on[entity["layer"].get<int>()].push_back(entity);
      if (entity["kind"] == "TEXT" && entity["layer"] == 1) texts.push_back(entity["text"]);
      if (entity["kind"] == "TEXT") {
        EXPECT_GT(entity["height"].get<double>(), 0);
      }
    }
    EXPECT_EQ(texts[0], i == 0 ? "Piece Name:ELL" : "Piece Name:PANEL");
    EXPECT_EQ(texts[1], "Size:M");
    EXPECT_EQ(texts[2], i == 0 ? "Quantity:2,0" : "Quantity:1,0");
    EXPECT_EQ(texts[3], "Material:Neoprene 3 mm");

    const auto outline = std::find_if(block.begin(), block.end(), [](const auto& e) {
      return e["kind"] == "POLYLINE" && e["layer"] == 1;
    });
    ASSERT_NE(outline, block.end());
    const Points2 cut = pointsOf(*outline);
    EXPECT_TRUE((*outline)["closed"].get<bool>());
    EXPECT_NE(cut.front(), cut.back());
    // Clockwise with y up: right side of the cloth up.
    EXPECT_NEAR(signedArea(cut), -signedArea(positions(piece.cutLines[0])), 1);
    ASSERT_EQ(on[14].size(), 1u);
    EXPECT_NEAR(lengthOf(pointsOf(on[14][0]), true), sewLength(piece), kSeamToleranceMm);
    EXPECT_EQ(on[84][0]["points"], (*outline)["points"]);
    EXPECT_EQ(on[87][0]["points"], on[14][0]["points"]);
    ASSERT_EQ(on[7].size(), 1u);
    EXPECT_EQ(on[7][0]["kind"], "LINE");

    // Every vertex is a turn or curve point, once, and every such point is a vertex.
    std::set<std::pair<double, double>> vertices;
    for (const nlohmann::json& entity : block)
      if (entity["kind"] == "POLYLINE")
        for (const auto& p : entity["points"]) vertices.emplace(p[0], p[1]);
    std::set<std::pair<double, double>> marked;
    for (const int layer : {2, 3})
      for (const auto& e : on[layer]) {
        const bool isNew = marked.emplace(e["points"][0][0], e["points"][0][1]).second;
        EXPECT_TRUE(isNew);
      }
    EXPECT_EQ(vertices, marked);
    // The waist ends on the sew line, which passes smoothly there.
    EXPECT_EQ(on[2].size(), i == 0 ? 6u + 6u : 4u + 4u);

    ASSERT_EQ(on[4].size(), piece.notches.size());
    for (const auto& e : on[4]) {
      EXPECT_TRUE(vertices.contains({e["points"][0][0], e["points"][0][1]}));
      const double angle = e["angle"].get<double>() * std::numbers::pi / 180;
      const Eigen::Vector2d tip =
          pointsOf(e)[0] + e["z"].get<double>() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      EXPECT_TRUE(isInside({cut}, tip));
      EXPECT_GE(e["z"].get<double>(), 2);
    }
  }
}

TEST(Dxf, HasTheLengthsThatDxflibReads) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedDxf saved(pattern);
  LineReader reader;
  ASSERT_TRUE(DL_Dxf().in(saved.path.string(), &reader));
  ASSERT_EQ(reader.blocks, (std::vector<std::string>{"ELL_M", "PANEL_M"}));
  for (std::size_t i = 0; i < 2; ++i) {
    const PatternPiece& piece = pattern.pieces[i];
    const Placement& placement = pattern.layout.placements[i];
    const auto line = std::find_if(reader.lines.begin(), reader.lines.end(), [&](const auto& l) {
      return l.block == reader.blocks[i] && l.layer == "14";
    });
    ASSERT_NE(line, reader.lines.end());
    EXPECT_TRUE(line->closed);
    // Each run by itself, from the vertex where it begins to the one where it ends.
    const auto find = [&](const Eigen::Vector2d& flat) {
      const Eigen::Vector2d p = placement.apply(flat);
      for (std::size_t k = 0; k < line->points.size(); ++k)
        if ((line->points[k] - p).norm() < 1e-3) return k;
      ADD_FAILURE() << "no vertex at the end of a run";
      return std::size_t{0};
    };
    for (const OutlineRun& run : piece.runs) {
      const Outline& loop = piece.sewLines[run.loop];
      const std::size_t from = find(loop[run.first].position);
      const std::size_t to = find(loop[(run.first + run.edgeCount) % loop.size()].position);
      double length = 0;
      const std::size_t count = line->points.size();
      // The file goes round the other way.
      for (std::size_t k = to; k != from; k = (k + 1) % count)
        length += (line->points[(k + 1) % count] - line->points[k]).norm();
      EXPECT_NEAR(length, run.length, kSeamToleranceMm);
    }
  }
}

TEST(Dxf, HasTheLengthsThatGdalReads) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const SavedDxf saved(pattern);
  const test::ProgramResult read = test::runProgram(
      {"ogrinfo", "-ro", "-q", "-al", saved.path.string(), "--config", "DXF_MERGE_BLOCK_GEOMETRIES",
       "FALSE", "-dialect", "SQLITE", "-sql",
       // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one long query
       "SELECT ST_Length(geometry) AS len, ST_IsClosed(geometry) AS closed FROM entities WHERE "
       "Layer = '14' AND Text IS NULL"});
  ASSERT_EQ(read.status, 0) << read.err;
  std::vector<double> lengths;
  std::istringstream lines(read.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("closed (") != std::string::npos) {
      EXPECT_EQ(line.substr(line.rfind('=')), "= 1");
    }
    if (line.find("len (") == std::string::npos) continue;
    lengths.push_back(std::stod(line.substr(line.rfind('=') + 1)));
  }
  ASSERT_EQ(lengths.size(), 2u) << read.out;
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(lengths[i], sewLength(pattern.pieces[i]), kSeamToleranceMm);
}

TEST(Dxf, IsDrawnByLibreCad) {
  const test::ProgramResult found = test::runProgram({"which", "librecad"});
  ASSERT_EQ(found.status, 0) << "librecad is not installed; ./test installs it";
  const SavedDxf saved(test::makeTwoPiecePattern());
  // Its settings go to a folder of the test's; its status is 0 whatever happens.
  test::runProgram({"env", "QT_QPA_PLATFORM=offscreen", "HOME=" + saved.folder.path().string(),
                    "XDG_RUNTIME_DIR=" + saved.folder.path().string(), "timeout", "100", "librecad",
                    "dxf2pdf", "-a", "-m", "-t", saved.folder.path().string(),
                    saved.path.string()});
  const std::filesystem::path picture = saved.folder.path() / "pattern.pdf";
  ASSERT_TRUE(std::filesystem::exists(picture));
  EXPECT_GT(std::filesystem::file_size(picture), 1000u);
}

TEST(Dxf, WithoutAllowanceHasNoSewLayer) {
  const std::string text = writeDxf(test::makeTwoPiecePattern(0)).text;
  for (const auto& [code, value] : groupsOf(text))
    if (code == 8) {
      EXPECT_TRUE(value != "14" && value != "87");
    }
}

TEST(Dxf, NamesArePlainShortAndUnique) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.pieces[0].name = "Ärmel, linke Vorderhälfte";
  pattern.pieces[1].name = "ärmel  linke vorderhalfte (neu)";
  const SavedDxf saved(pattern);
  EXPECT_EQ(saved.dxf.findings.size(), 2u);
  const nlohmann::json file = readWithEzdxf(saved.path);
  EXPECT_TRUE(file["blocks"].contains("ARMEL_LINKE_VORDERHA_M")) << file["inserts"];
  EXPECT_TRUE(file["blocks"].contains("ARMEL_LINKE_VORDER-2_M"));
}

TEST(Dxf, HolesAreCutouts) {
  Pattern pattern = test::makeTwoPiecePattern();
  Outline hole;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(50, 50), Eigen::Vector2d(50, 80),
                                   Eigen::Vector2d(80, 80), Eigen::Vector2d(80, 50)})
    hole.push_back({p, true});
  pattern.pieces[0].cutLines.push_back(hole);
  const nlohmann::json file = readWithEzdxf(SavedDxf(pattern).path);
  int cutouts = 0;
  for (const auto& e : file["blocks"]["ELL_M"]) {
    // NOLINTNEXTLINE(misc-redundant-expression): the macro compares twice
    if (e["layer"] == 11 || e["layer"] == 86) {
      ++cutouts;
      EXPECT_TRUE(e["closed"].get<bool>());
      EXPECT_NEAR(signedArea(pointsOf(e)), -900, 1e-6);
    }
  }
  EXPECT_EQ(cutouts, 2);
}

TEST(Dxf, HalfHasItsMirrorLineOnTheOutline) {
  Pattern pattern = test::makeTwoPiecePattern();
  Design design = *pattern.document.design;
  for (StylingCurve& curve : design.curves) curve.right.allowance.reset();
  pattern.document.design = std::make_shared<const Design>(design);
  auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  ASSERT_TRUE(pieces) << pieces.error();
  pattern.pieces = *std::move(pieces);
  ASSERT_TRUE(foldInHalf(pattern.pieces[1], pattern.cut.pieces[1], *pattern.flats[1]));
  const nlohmann::json file = readWithEzdxf(SavedDxf(pattern).path);
  nlohmann::json mirror;
  nlohmann::json outline;
  std::set<std::string> annotation;
  for (const auto& e : file["blocks"]["PANEL_M"]) {
    if (e["layer"] == 6) mirror = e;
    if (e["layer"] == 1 && e["kind"] == "POLYLINE") outline = e;
    if (e["layer"] == 15) annotation.insert(e["text"]);
  }
  ASSERT_EQ(mirror["kind"], "LINE");
  // Digit for digit: ends of the edge of the cut line that lies on the fold.
  const auto& points = outline["points"];
  for (const auto& end : mirror["points"])
    EXPECT_EQ(std::count(points.begin(), points.end(), end), 1) << end;
  EXPECT_TRUE(annotation.contains("Cut on fold"));
  for (const auto& e : file["blocks"]["ELL_M"]) EXPECT_NE(e["layer"], 6);
}

TEST(Dxf, NotchesOfEveryKindComeBack) {
  struct Kind {
    NotchKind kind;
    const char* layer;
  };
  for (const Kind& each :
       {Kind{NotchKind::Slit, "4"}, Kind{NotchKind::V, "4"}, Kind{NotchKind::T, "80"},
        Kind{NotchKind::Castle, "81"}, Kind{NotchKind::Check, "82"}, Kind{NotchKind::U, "83"}}) {
    Pattern pattern = test::makeTwoPiecePattern();
    Design design = *pattern.document.design;
    design.finish.notchKind = each.kind;
    design.finish.notchWidth = Length::mm(5);
    pattern.document.design = std::make_shared<const Design>(design);
    auto pieces = finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
    ASSERT_TRUE(pieces) << pieces.error();
    pattern.pieces = *std::move(pieces);
    const Result<DxfDrawing> drawing = readDxf(writeDxf(pattern).text);
    ASSERT_TRUE(drawing) << drawing.error();
    const Result<Pattern> again = patternFrom(*drawing, "again");
    ASSERT_TRUE(again) << again.error();
    for (std::size_t i = 0; i < 2; ++i) {
      const std::vector<Notch>& written = pattern.pieces[i].notches;
      std::size_t onLayer = 0;
      for (const DxfEntity& entity : drawing->blocks[i].entities)
        if (entity.layer == each.layer) ++onLayer;
      EXPECT_EQ(onLayer, written.size()) << each.layer;
      ASSERT_EQ(again->pieces[i].notches.size(), written.size());
      for (std::size_t k = 0; k < written.size(); ++k) {
        const Notch& notch = again->pieces[i].notches[k];
        EXPECT_EQ(notch.kind, each.kind);
        EXPECT_NEAR(notch.depth, written[k].depth, 1e-3);
        EXPECT_NEAR(notch.width, each.kind == NotchKind::Slit ? 0 : 5, 1e-3);
      }
    }
  }
}

TEST(Dxf, IsTheSameEveryTime) {
  EXPECT_EQ(writeDxf(test::makeTwoPiecePattern()).text, writeDxf(test::makeTwoPiecePattern()).text);
}

}  // namespace
}  // namespace toile
