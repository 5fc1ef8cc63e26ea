// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric pieces of the full suit as halves on folded cloth, to the last file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "finish/polygon.h"
#include "support/run_program.h"
#include "support/sample_designs.h"
#include "toile/core/file.h"
#include "toile/io/sewing_files.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

TEST(HalfOnFold, OfTheWetsuitReachesEveryCuttingFile) {
  const Result<Document> document = openDocument(exampleDesign("wetsuit-full.toile"));
  ASSERT_TRUE(document) << document.error();
  Design design = *document->design;
  design.finish.halfOnFold = true;
  const Result<Pattern> pattern = makePattern(withDesign(*document, design));
  ASSERT_TRUE(pattern) << pattern.error();
  TemporaryFolder folder;
  const Result<WrittenPattern> written = writePattern(*pattern, folder.path());
  ASSERT_TRUE(written) << written.error();
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };

  // DXF, read by ezdxf: a mirror line on each half, exactly along an edge of its outline, without
  // notches; twice the half is the whole.
  const ProgramResult read = runProgram(
      {"/usr/bin/python3", TOILE_SOURCE_DIR "/tests/engine/io/read_dxf.py", path("pattern.dxf")});
  ASSERT_EQ(read.status, 0) << read.err;
  const auto file = nlohmann::json::parse(read.out);
  EXPECT_EQ(file["faults"], nlohmann::json::array());
  const auto seams = nlohmann::json::parse(readText(path("seams.json")));
  std::size_t halves = 0;
  for (const auto& piece : seams["pieces"]) {
    const auto& lines = file["blocks"][piece["block"].get<std::string>()];
    const auto mirror = std::find_if(lines.begin(), lines.end(),
                                     [](const auto& line) { return line["layer"] == 6; });
    if (mirror == lines.end()) continue;
    ++halves;
    const auto point = [](const auto& p) {
      return Eigen::Vector2d(p[0].template get<double>(), p[1].template get<double>());
    };
    const Eigen::Vector2d a = point((*mirror)["points"][0]);
    const Eigen::Vector2d b = point((*mirror)["points"][1]);
    Points2 cut;
    double nearest = 1e9;
    for (const auto& line : lines) {
      if (line["layer"] == 1 && line["kind"] == "POLYLINE")
        for (const auto& p : line["points"]) cut.push_back(point(p));
      if (line["layer"] == 4 && line["kind"] == "POINT") {
        const Eigen::Vector2d notch = point(line["points"][0]);
        nearest = std::min(nearest, std::abs(cross((b - a).normalized(), notch - a)));
      }
    }
    EXPECT_GT(nearest, 0.5);
    bool isEdge = false;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      const Eigen::Vector2d& p = cut[k];
      const Eigen::Vector2d& q = cut[(k + 1) % cut.size()];
      isEdge = isEdge || ((p - a).norm() < 2e-3 && (q - b).norm() < 2e-3) ||
               ((p - b).norm() < 2e-3 && (q - a).norm() < 2e-3);
    }
    EXPECT_TRUE(isEdge) << piece["name"];
    for (const PatternPiece& whole : pattern->pieces)
      if (whole.id == piece["id"]) {
        const double wanted = signedArea(positions(whole.cutLines.front()));
        EXPECT_NEAR(2 * std::abs(signedArea(cut)), wanted, 1e-4 * wanted) << whole.name;
      }
  }
  EXPECT_EQ(halves, 2u);  // front and collar

  // The seams of the other half are left out; those that remain fit.
  const Result<DxfDrawing> drawing = readDxf(readText(path("pattern.dxf")));
  ASSERT_TRUE(drawing) << drawing.error();
  const Result<SewingCheck> check = checkSewing(readText(path("seams.json")), *drawing);
  ASSERT_TRUE(check) << check.error();
  EXPECT_THAT(check->findings, testing::IsEmpty());

  const ProgramResult text = runProgram({"pdftotext", path("pattern.pdf"), "-"});
  EXPECT_THAT(text.out, HasSubstr("Cut on fold"));
  EXPECT_THAT(text.out, HasSubstr("place on fold"));
  EXPECT_THAT(readText(path("pattern.svg")), HasSubstr("data-kind=\"fold\""));
}

}  // namespace
}  // namespace toile::test
