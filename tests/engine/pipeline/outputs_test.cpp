// SPDX-License-Identifier: GPL-3.0-or-later
// The files of the wetsuit, read by programs that know nothing of Toile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "finish/polygon.h"
#include "io/body_view.h"
#include "support/run_program.h"
#include "support/sample_designs.h"
#include "toile/core/file.h"
#include "toile/io/dxf_file.h"
#include "toile/io/sewing_files.h"

namespace toile::test {
namespace {

using testing::HasSubstr;

class WetsuitFiles : public WetsuitPattern {
 protected:
  static void SetUpTestSuite() {
    WetsuitPattern::SetUpTestSuite();
    ASSERT_TRUE(pattern_);
    folder_ = std::make_unique<TemporaryFolder>();
    const Result<WrittenPattern> written = writePattern(*pattern_, folder_->path());
    ASSERT_TRUE(written) << written.error();
  }
  static void TearDownTestSuite() {
    folder_.reset();
    WetsuitPattern::TearDownTestSuite();
  }
  static std::string path(const std::string& name) { return folder_->path() / name; }
  static std::string run(const std::vector<std::string>& words) {
    const ProgramResult result = runProgram(words);
    EXPECT_EQ(result.status, 0) << words[0] << ": " << result.err;
    return result.out;
  }
  static testing::AssertionResult has(const std::string& program) {
    if (runProgram({"which", program}).status == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << program << " is not installed; ./test installs it";
  }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(WetsuitFiles, HaveTheLengthsOfTheContract) {
  const Result<std::string> page = writePdf(drawSheet(*pattern_), {.paper = PdfPaper::OneSheet});
  ASSERT_TRUE(page) << page.error();
  writeText(path("one.pdf"), *page);
  run({"pdftocairo", "-svg", path("one.pdf"), path("one.svg")});
  const auto measured = nlohmann::json::parse(
      run({"/usr/bin/python3", TOILE_SOURCE_DIR "/tests/engine/pipeline/measure_outputs.py",
           folder_->path().string()}));
  EXPECT_GT(measured["edges"].get<int>(), 60);
  EXPECT_EQ(measured["edges"], measured["paths"]);
  EXPECT_LE(measured["dxf"].get<double>(), 0.02);
  EXPECT_LE(measured["svg"].get<double>(), 0.02);
  EXPECT_LE(measured["pdf"].get<double>(), 0.02);
  EXPECT_LE(measured["hpgl"].get<double>(), 0.2);
  EXPECT_GE(measured["outlines"].get<int>(), 10);
  // The pattern keeps what it says to keep, and mates are alike.
  EXPECT_LE(measured["kept"].get<double>(), kSmoothingMm + 1e-4);
  EXPECT_LE(measured["mates"].get<double>(), kSmoothingMm + 1e-4);
  for (const char* name : {"dxf", "svg", "pdf", "hpgl", "kept", "mates"})
    RecordProperty(name, std::to_string(measured[name].get<double>()));
}

TEST_F(WetsuitFiles, SewTogetherVirtually) {
  const Result<DxfDrawing> drawing = readDxf(*readFile(path("pattern.dxf")));
  ASSERT_TRUE(drawing) << drawing.error();
  const Result<SewingCheck> check = checkSewing(*readFile(path("seams.json")), *drawing);
  ASSERT_TRUE(check) << check.error();
  EXPECT_THAT(check->findings, testing::IsEmpty());
  EXPECT_EQ(check->seams.size(), planSewing(*pattern_).steps.size());
  std::size_t notches = 0;
  for (const SewingCheck::Seam& seam : check->seams) {
    EXPECT_NEAR(seam.lengthA, seam.lengthB, 0.02) << seam.edgeA;
    EXPECT_NEAR(seam.lengthA, seam.target, 0.02) << seam.edgeA;
    notches += seam.notches;
  }
  EXPECT_GT(notches, 40u);
}

TEST_F(WetsuitFiles, HaveThePerimetersThatGdalReads) {
  ASSERT_TRUE(has("ogrinfo"));
  const std::string out =
      run({"ogrinfo", "-ro", "-q", "-al", path("pattern.dxf"), "--config",
           "DXF_MERGE_BLOCK_GEOMETRIES", "FALSE", "-dialect", "SQLITE", "-sql",
           // NOLINTNEXTLINE(bugprone-suspicious-missing-comma): one long query
           "SELECT SUM(ST_Length(geometry)) AS len, MIN(ST_IsClosed(geometry)) AS closed FROM "
           "entities WHERE Layer IN ('1', '11') AND Text IS NULL"});
  double wanted = 0;
  for (const PatternPiece& piece : pattern_->pieces)
    for (const Outline& loop : piece.cutLines)
      for (std::size_t i = 0; i < loop.size(); ++i)
        wanted += (loop[(i + 1) % loop.size()].position - loop[i].position).norm();
  const std::size_t at = out.find("len (Real) = ");
  ASSERT_NE(at, std::string::npos) << out;
  EXPECT_NEAR(std::stod(out.substr(at + 13)), wanted,
              0.02 * static_cast<double>(pattern_->pieces.size()));
  EXPECT_THAT(out, HasSubstr("= 1"));
}

TEST_F(WetsuitFiles, AreWithoutFaultForEzdxf) {
  const auto file = nlohmann::json::parse(run(
      {"/usr/bin/python3", TOILE_SOURCE_DIR "/tests/engine/io/read_dxf.py", path("pattern.dxf")}));
  EXPECT_EQ(file["faults"], nlohmann::json::array());
  EXPECT_EQ(file["blocks"].size(), pattern_->pieces.size());
  EXPECT_EQ(file["inserts"].size(), pattern_->pieces.size());
}

/// The corners of a text, in a font as wide as those of CAD programs are.
Points2 cornersOf(const DxfEntity& text) {
  const double angle = text.angle.value_or(0) * std::numbers::pi / 180;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const double width = 0.8 * text.height * static_cast<double>(text.text.size());
  const Eigen::Vector2d up = text.height * Eigen::Vector2d(-along.y(), along.x());
  const Eigen::Vector2d at = text.points.front();
  return {at, at + width * along, at + width * along + up, at + up};
}

TEST_F(WetsuitFiles, HaveTextsInsideThePiecesAndNotchesOffTheirCorners) {
  const Result<DxfDrawing> drawing = readDxf(*readFile(path("pattern.dxf")));
  ASSERT_TRUE(drawing) << drawing.error();
  std::size_t codes = 0;
  for (const DxfBlock& block : drawing->blocks) {
    Points2 cut;
    std::vector<Eigen::Vector2d> corners;
    for (const DxfEntity& entity : block.entities) {
      if (entity.layer == "1" && entity.kind == DxfEntity::Kind::Polyline) cut = entity.points;
      if (entity.layer == "2") corners.push_back(entity.points.front());
    }
    const EdgeGrid grid({cut});
    for (const DxfEntity& entity : block.entities) {
      if (entity.layer == "4") {
        for (const Eigen::Vector2d& corner : corners)
          EXPECT_GT((corner - entity.points.front()).norm(), 3) << block.name;
      }
      if (entity.kind != DxfEntity::Kind::Text) continue;
      // The label may be no smaller than can be read, even if it reaches the allowance so.
      for (const Eigen::Vector2d& p : cornersOf(entity)) {
        const double outside = isInside({cut}, p) ? 0 : grid.nearest(p).distance;
        EXPECT_LE(outside, entity.layer == "8" ? 4 : 1) << block.name << ": " << entity.text;
      }
      codes += entity.layer == "15" && entity.angle ? 1 : 0;
    }
  }
  EXPECT_GT(codes, 60u);
}

TEST_F(WetsuitFiles, DrawEachInnerLineOfAPieceWhole) {
  for (const PatternPiece& piece : pattern_->pieces)
    for (const InternalLine& a : piece.internalLines)
      for (const InternalLine& b : piece.internalLines) {
        if (&a == &b || a.curve != b.curve || a.closed || b.closed) continue;
        EXPECT_NE(a.points.front(), b.points.front()) << piece.name << ": " << a.name;
        EXPECT_NE(a.points.front(), b.points.back()) << piece.name << ": " << a.name;
        EXPECT_NE(a.points.back(), b.points.back()) << piece.name << ": " << a.name;
      }
}

TEST_F(WetsuitFiles, AreDrawnByLibreCad) {
  ASSERT_TRUE(has("librecad"));
  const std::string home = folder_->path();
  for (const char* name : {"pattern", "laser"}) {
    runProgram({"env", "QT_QPA_PLATFORM=offscreen", "HOME=" + home, "XDG_RUNTIME_DIR=" + home,
                "timeout", "100", "librecad", "dxf2pdf", "-a", "-m", "-t", home + "/cad",
                path(name + std::string(".dxf"))});
    const std::filesystem::path picture = folder_->path() / "cad" / (name + std::string(".pdf"));
    ASSERT_TRUE(std::filesystem::exists(picture)) << name;
    EXPECT_GT(std::filesystem::file_size(picture), 10000u) << name;
  }
}

TEST_F(WetsuitFiles, HaveTheSizeThatInkscapesImporterReads) {
  const std::string importer = "/usr/share/inkscape/extensions/dxf_input.py";
  ASSERT_TRUE(std::filesystem::exists(importer)) << "Inkscape is not installed; ./test installs it";
  // One unit of the drawing is a millimetre, and Inkscape has 96 dots an inch.
  const std::string svg = run({"/usr/bin/python3", importer, "--scalemethod=manual", "--scale=1.0",
                               "--encoding=latin_1", path("laser.dxf")});
  std::size_t paths = 0;
  double widest = 0;
  for (std::size_t at = svg.find(" d=\"M"); at != std::string::npos;
       at = svg.find(" d=\"M", at + 1)) {
    ++paths;
    std::istringstream in(svg.substr(at + 5, svg.find('"', at + 4) - at - 5));
    for (std::string word; in >> word;) {
      const auto x = parseDouble(word.substr(0, word.find(',')));
      if (x) widest = std::max(widest, *x);
    }
  }
  EXPECT_GT(paths, 100u);
  const Eigen::Vector2d size = pattern_->layout.max - pattern_->layout.min;
  EXPECT_NEAR(widest * 25.4 / 96, size.x(), 0.2);
}

TEST_F(WetsuitFiles, ArePlottedAtTrueSizeByHp2xx) {
  ASSERT_TRUE(has("hp2xx"));
  const std::string eps = path("plot.eps");
  runProgram({"hp2xx", "-q", "-t", "-m", "eps", "-f", eps, path("pattern.plt")});
  const std::string text = readText(eps);
  const std::size_t at = text.find("%%BoundingBox:");
  ASSERT_NE(at, std::string::npos);
  std::istringstream in(text.substr(at + 14));
  double left = 0;
  double bottom = 0;
  double right = 0;
  double top = 0;
  in >> left >> bottom >> right >> top;
  constexpr double kMmPerPoint = 25.4 / 72;
  const Eigen::Vector2d size = pattern_->layout.max - pattern_->layout.min;
  // X is the longer side. The box is whole points, and it counts the pen's width.
  EXPECT_NEAR((right - left) * kMmPerPoint, size.maxCoeff(), 2);
  EXPECT_NEAR((top - bottom) * kMmPerPoint, size.minCoeff(), 2);
}

TEST_F(WetsuitFiles, PrintOnEveryPaperAtTrueSize) {
  struct Paper {
    const char* name;
    const char* box;
  };
  for (const Paper& paper : {Paper{"a4", "595.28   841.89"}, Paper{"letter", "612.00   792.00"},
                             Paper{"a3", "841.89  1190.55"}, Paper{"a0", "2383.94  3370.39"}}) {
    const Result<PdfPaper> chosen = parsePdfPaper(paper.name);
    ASSERT_TRUE(chosen);
    const Result<std::string> pdf =
        writePdf(drawSheet(*pattern_), {.paper = *chosen, .overlap = 12});
    ASSERT_TRUE(pdf) << pdf.error();
    const std::string file = path(paper.name + std::string(".pdf"));
    writeText(file, *pdf);
    const std::string info = run({"pdfinfo", "-f", "1", "-l", "1", "-box", file});
    EXPECT_THAT(info, HasSubstr(paper.box)) << paper.name;
    const std::string text = run({"pdftotext", "-f", "1", "-l", "1", file, "-"});
    EXPECT_THAT(text, HasSubstr("100 mm"));
    EXPECT_THAT(text, HasSubstr("4 in"));
    EXPECT_THAT(text, HasSubstr("dashed line"));
  }
}

/// Lengths in mm of the closed outlines that poppler finds in a one-page PDF.
std::vector<double> outlinesThatPopplerReads(const std::string& svg) {
  std::vector<double> lengths;
  for (std::size_t at = svg.find("<path"); at != std::string::npos;
       at = svg.find("<path", at + 1)) {
    const std::string path = svg.substr(at, svg.find("/>", at) - at);
    const std::size_t way = path.find(" d=\"");
    if (way == std::string::npos || path.find("stroke-width:1.70") == std::string::npos) continue;
    std::istringstream in(path.substr(way + 4, path.find('"', way + 4) - way - 4));
    double length = 0;
    Eigen::Vector2d first(0, 0);
    Eigen::Vector2d last(0, 0);
    bool isClosed = false;
    for (std::string word; in >> word;) {
      if (word == "Z") {
        length += (first - last).norm();
        isClosed = true;
        break;
      }
      Eigen::Vector2d p;
      in >> p.x() >> p.y();
      if (word == "M") {
        first = p;
      } else {
        length += (p - last).norm();
      }
      last = p;
    }
    if (isClosed) lengths.push_back(length * 25.4 / 72);
  }
  return lengths;
}

TEST_F(WetsuitFiles, HaveTheLengthsThatPopplerReads) {
  ASSERT_TRUE(has("pdftocairo"));
  const Result<std::string> pdf = writePdf(drawSheet(*pattern_), {.paper = PdfPaper::OneSheet});
  ASSERT_TRUE(pdf) << pdf.error();
  writeText(path("one.pdf"), *pdf);
  run({"pdftocairo", "-svg", path("one.pdf"), path("one.svg")});
  const std::vector<double> found = outlinesThatPopplerReads(readText(path("one.svg")));
  std::size_t loops = 0;
  for (const PatternPiece& piece : pattern_->pieces) {
    for (const Outline& loop : piece.cutLines) {
      double wanted = 0;
      for (std::size_t i = 0; i < loop.size(); ++i)
        wanted += (loop[(i + 1) % loop.size()].position - loop[i].position).norm();
      double off = 1e9;
      for (const double length : found) off = std::min(off, std::abs(length - wanted));
      EXPECT_LE(off, 0.02) << piece.name;
      ++loops;
    }
  }
  EXPECT_EQ(found.size(), loops);
}

TEST_F(WetsuitFiles, SewingSheetShowsEveryPieceOnTheBody) {
  const BodyViews body = bodyViews(*pattern_);
  ASSERT_EQ(body.viewOf.size(), pattern_->pieces.size());
  const std::map<std::string, std::string> from = {{"Side panel left", "the left"},
                                                   {"Side panel right", "the right"},
                                                   {"Front", "the front"},
                                                   {"Calf left", "behind"}};
  const auto areaOf = [](const std::vector<Points2>& loops) {
    double area = 0;
    for (const Points2& loop : loops) area += signedArea(loop);  // holes run the other way
    return area;
  };
  for (const BodyView& view : body.views) {
    // What is seen of the pieces lies on the silhouette, each place of it once.
    double pieces = 0;
    for (const std::vector<Points2>& loops : view.pieces) {
      pieces += areaOf(loops);
      for (const Points2& loop : loops) {
        EXPECT_GE(boxOf(loop).min.minCoeff(), 0);
        EXPECT_LE((boxOf(loop).max - view.size).maxCoeff(), 0);
      }
    }
    EXPECT_LE(pieces, 1.01 * areaOf(view.body)) << view.from;
    EXPECT_GE(pieces, 0.6 * areaOf(view.body)) << view.from;
  }
  for (std::size_t i = 0; i < pattern_->pieces.size(); ++i) {
    const BodyView& view = body.views[body.viewOf[i]];
    const Piece& piece = pattern_->cut.pieces[pattern_->pieceIndex[i]];
    double whole = 0;
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) whole += piece.mesh->area(FaceId(f));
    const double seen = areaOf(view.pieces[i]) * view.mmPerUnit * view.mmPerUnit;
    EXPECT_GE(seen, 0.25 * whole) << pattern_->pieces[i].name << " from " << view.from;
    EXPECT_LE(seen, 1.02 * whole) << pattern_->pieces[i].name << " from " << view.from;
    const auto expected = from.find(pattern_->pieces[i].name);
    if (expected != from.end()) {
      EXPECT_EQ(view.from, expected->second);
    }
  }
}

TEST_F(WetsuitFiles, SewingSheetNamesEveryStepAndPiece) {
  const std::string text = run({"pdftotext", "-layout", path("sewing.pdf"), "-"});
  const std::string html = readText(path("sewing.html"));
  const SewingPlan plan = planSewing(*pattern_);
  for (const SewStep& step : plan.steps) {
    const std::string codes = plan.edges[step.edgeA].code + " + " + plan.edges[step.edgeB].code;
    EXPECT_THAT(text, HasSubstr(codes));
    EXPECT_THAT(html, HasSubstr(codes));
  }
  for (const PatternPiece& piece : pattern_->pieces) EXPECT_THAT(html, HasSubstr(piece.name));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,"));
}

}  // namespace
}  // namespace toile::test
