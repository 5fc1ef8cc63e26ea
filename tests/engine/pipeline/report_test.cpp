// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/sample_designs.h"
#include "toile/io/report.h"

namespace toile::test {
namespace {

/// A reader of piece files that shares nothing with the writer.
struct ParsedPiece {
  std::vector<std::array<double, 3>> v;
  std::vector<std::array<double, 2>> vt;
  std::vector<std::array<std::size_t, 3>> faces;
  std::map<std::string, std::vector<std::size_t>> chains;
  std::map<std::pair<std::string, std::size_t>, double> targets;

  explicit ParsedPiece(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::string group;
    while (std::getline(lines, line)) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "v") {
        v.push_back({});
        for (double& x : v.back()) words >> x;
      } else if (key == "vt") {
        vt.push_back({});
        for (double& x : vt.back()) words >> x;
      } else if (key == "f") {
        faces.push_back({});
        for (std::size_t& corner : faces.back()) {
          std::string pair;
          words >> pair;
          corner = std::stoul(pair) - 1;
          EXPECT_EQ(pair, std::to_string(corner + 1) + "/" + std::to_string(corner + 1));
        }
      } else if (key == "g") {
        words >> group;
      } else if (key == "l") {
        EXPECT_FALSE(chains.contains(group)) << "two chains under " << group;
        for (std::size_t index = 0; words >> index;) chains[group].push_back(index - 1);
      } else if (key == "#") {
        std::string word;
        std::string wire;
        std::size_t edge = 0;
        double length = 0;
        if (words >> word && word == "target" && words >> wire >> edge >> length) {
          targets[{wire, edge}] = length;
        }
      }
    }
  }
  [[nodiscard]] double flatLength(std::size_t a, std::size_t b) const {
    return std::hypot(vt[a][0] - vt[b][0], vt[a][1] - vt[b][1]);
  }
  [[nodiscard]] double bodyLength(std::size_t a, std::size_t b) const {
    return std::hypot(v[a][0] - v[b][0], v[a][1] - v[b][1], v[a][2] - v[b][2]);
  }
};

class SleeveReport : public SleevePattern {};

TEST_F(SleeveReport, AgreesWithThePieceFiles) {
  const auto report = nlohmann::json::parse(writeReportJson(*pattern_));
  ASSERT_EQ(report["pieces"].size(), pattern_->cut.pieces.size());
  double worst = 0;
  for (std::size_t i = 0; i < pattern_->cut.pieces.size(); ++i) {
    const auto& told = report["pieces"][i];
    const ParsedPiece piece(writePieceObj(pattern_->cut.pieces[i], *pattern_->flats[i]));
    EXPECT_EQ(told["vertices"], piece.v.size());
    ASSERT_EQ(piece.v.size(), piece.vt.size());
    EXPECT_EQ(told["faces"], piece.faces.size());
    double flatArea = 0;
    for (const auto& [a, b, c] : piece.faces) {
      const double twice = (piece.vt[b][0] - piece.vt[a][0]) * (piece.vt[c][1] - piece.vt[a][1]) -
                           (piece.vt[b][1] - piece.vt[a][1]) * (piece.vt[c][0] - piece.vt[a][0]);
      EXPECT_GT(twice, 0) << "a face is not counter-clockwise";
      flatArea += twice / 2;
    }
    EXPECT_NEAR(told["area"]["flat"].get<double>() / flatArea, 1, 1e-12);
    EXPECT_EQ(told["wires"].size(), piece.chains.size());
    for (const auto& wire : told["wires"]) {
      const std::string group = wire["group"];
      ASSERT_TRUE(piece.chains.contains(group)) << group;
      const std::vector<std::size_t>& chain = piece.chains.at(group);
      EXPECT_EQ(wire["edges"], chain.size() - 1);
      double body = 0;
      double flat = 0;
      double target = 0;
      for (std::size_t e = 0; e + 1 < chain.size(); ++e) {
        const double edgeBody = piece.bodyLength(chain[e], chain[e + 1]);
        const auto given = piece.targets.find({group, e});
        const double edgeTarget = given == piece.targets.end() ? edgeBody : given->second;
        const double edgeFlat = piece.flatLength(chain[e], chain[e + 1]);
        EXPECT_LE(std::abs(edgeFlat - edgeTarget), 1e-9 * std::max(edgeTarget, 1.0)) << group;
        worst = std::max(worst, std::abs(edgeFlat - edgeTarget) / std::max(edgeTarget, 1.0));
        body += edgeBody;
        target += edgeTarget;
        flat += edgeFlat;
      }
      EXPECT_NEAR(wire["length"]["body"].get<double>(), body, 1e-9 * body) << group;
      EXPECT_NEAR(wire["length"]["target"].get<double>(), target, 1e-9 * target) << group;
      EXPECT_NEAR(wire["length"]["flat"].get<double>(), flat, 1e-9 * flat) << group;
    }
  }
  // hypot and sqrt may differ in the last bit of a length.
  EXPECT_NEAR(report["totals"]["maxEdgeError"].get<double>(), worst, 1e-14);
}

TEST_F(SleeveReport, MatesTellEachOther) {
  const auto report = nlohmann::json::parse(writeReportJson(*pattern_));
  std::map<std::string, nlohmann::json> pieceById;
  for (const auto& piece : report["pieces"]) pieceById[piece["id"]] = piece;
  int mates = 0;
  for (const auto& piece : report["pieces"]) {
    for (std::size_t w = 0; w < piece["wires"].size(); ++w) {
      const auto& wire = piece["wires"][w];
      const bool isSewn = !wire["mate"].is_null();
      EXPECT_EQ(isSewn, wire["kind"] == "seam") << wire["group"];
      if (wire["mate"].is_null()) continue;
      ++mates;
      const auto& mate =
          pieceById.at(wire["mate"]["piece"])["wires"][wire["mate"]["wire"].get<std::size_t>()];
      EXPECT_EQ(mate["mate"]["piece"], piece["id"]);
      EXPECT_EQ(mate["mate"]["wire"], w);
      EXPECT_EQ(mate["curve"], wire["curve"]);
      EXPECT_EQ(mate["length"], wire["mate"]["length"]);
      EXPECT_EQ(mate["length"]["target"], wire["length"]["target"]);  // to the last bit
    }
  }
  EXPECT_GE(mates, 4);  // two seams, each seen from both its pieces
}

TEST_F(SleeveReport, TotalsAddUp) {
  const auto report = nlohmann::json::parse(writeReportJson(*pattern_));
  EXPECT_EQ(report["format"], "toile-report");
  EXPECT_EQ(report["version"], kReportFormatVersion);
  EXPECT_EQ(report["complete"], true);
  double area = 0;
  for (const auto& piece : report["pieces"]) area += piece["area"]["body"].get<double>();
  const double included = report["totals"]["includedArea"];
  EXPECT_NEAR(area / included, 1, 1e-12);
  EXPECT_NEAR(report["totals"]["sumOfPieceAreas"].get<double>() / included, 1, 1e-12);
}

TEST_F(SleeveReport, PageTellsPiecesSeamsAndNeedsNoNetwork) {
  const std::string page = writeReportHtml(*pattern_);
  for (const Piece& piece : pattern_->cut.pieces) EXPECT_THAT(page, testing::HasSubstr(piece.name));
  EXPECT_THAT(page, testing::HasSubstr("Front seam"));
  EXPECT_THAT(page, testing::HasSubstr("All pieces are made"));
  for (const char* foreign : {"<script", "src=", "href=", "@import", "url("}) {
    EXPECT_THAT(page, testing::Not(testing::HasSubstr(foreign)));
  }
}

TEST_F(SleeveReport, PageKeepsNamesFromBeingMarkup) {
  Pattern pattern = *pattern_;
  pattern.cut.pieces[0].name = "<b>\"Yoke\" & co</b>\a";
  const std::string page = writeReportHtml(pattern);
  EXPECT_THAT(page, testing::HasSubstr("&lt;b&gt;&quot;Yoke&quot; &amp; co&lt;/b&gt; "));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("<b>\"Yoke\"")));
}

TEST_F(SleeveReport, FailedPiecesAreNamed) {
  Pattern pattern = *pattern_;
  pattern.flats[1] = nullptr;
  pattern.failures[1] = Error{ErrorCode::NotADisk, "it is a tube", {}};
  const auto report = nlohmann::json::parse(writeReportJson(pattern));
  EXPECT_EQ(report["complete"], false);
  EXPECT_EQ(report["pieces"][1]["unfolded"], false);
  EXPECT_TRUE(report["pieces"][1]["file"].is_null());
  EXPECT_TRUE(report["pieces"][1]["area"]["flat"].is_null());
  ASSERT_EQ(report["failures"].size(), 1U);
  EXPECT_EQ(report["failures"][0]["piece"], pattern.cut.pieces[1].id);
  EXPECT_EQ(report["failures"][0]["code"], "NotADisk");
  const std::string page = writeReportHtml(pattern);
  EXPECT_THAT(page, testing::HasSubstr("Not all pieces could be made"));
  EXPECT_THAT(page, testing::HasSubstr("it is a tube"));
}

TEST(PieceFileNames, AreFitForFileSystemsAndUnique) {
  CutResult cut;
  for (const char* name :
       {"Back yoke", "back  yoke", "../../etc/passwd", "", "a/b", "\u524d\u7247"}) {
    Piece piece;
    piece.name = name;
    piece.id = "id";
    cut.pieces.push_back(piece);
  }
  EXPECT_THAT(pieceFileNames(cut),
              testing::ElementsAre("Back-yoke.obj", "back-yoke-2.obj", "etc-passwd.obj", "id.obj",
                                   "a-b.obj", "\u524d\u7247.obj"));
}

}  // namespace
}  // namespace toile::test
