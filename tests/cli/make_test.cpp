// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/test_data.h"

namespace toile::test {
namespace {

namespace fs = std::filesystem;

const std::string kSleeve = std::string(TOILE_SOURCE_DIR) + "/examples/bent-sleeve.toile";

ProgramResult toile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TOILE_EXECUTABLE);
  return runProgram(arguments);
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, content] : filesIn(folder)) names.push_back(name);
  return names;
}

/// One sentence for people, no result, nothing written.
void expectRefusal(const ProgramResult& result, int status, const std::string& text) {
  EXPECT_EQ(result.status, status);
  EXPECT_EQ(result.out, "");
  const std::size_t at = result.err.find("toile: ");
  ASSERT_NE(at, std::string::npos) << result.err;
  EXPECT_THAT(result.err.substr(at), testing::HasSubstr(text));
  EXPECT_EQ(result.err.find('\n', at), result.err.size() - 1) << result.err;
}

TEST(Make, WritesEveryFileOfTheSample) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const ProgramResult result = toile({"make", kSleeve, "-o", out});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, testing::HasSubstr("2 pieces"));
  EXPECT_THAT(
      namesIn(out),
      testing::ElementsAre("laser.dxf", "lengths.csv", "pattern.dxf", "pattern.pdf", "pattern.plt",
                           "pattern.svg", "pieces/Under-sleeve.obj", "pieces/Under-sleeve.ply",
                           "pieces/Upper-sleeve.obj", "pieces/Upper-sleeve.ply", "preview.png",
                           "report.html", "report.json", "seams.json", "sewing.html", "sewing.pdf",
                           "strain.svg"));
}

TEST(Make, IsByteForByteTheSameWithOneAndTwoThreads) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "2"}) {
    const ProgramResult result =
        toile({"make", kSleeve, "--threads", threads, "-o", folder.path() / threads});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  const auto one = filesIn(folder.path() / "1");
  const auto two = filesIn(folder.path() / "2");
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [name, content] : one) {
    EXPECT_TRUE(two.contains(name)) << name;
    EXPECT_TRUE(two.at(name) == content) << name << " differs";
  }
}

TEST(Make, TellsProgramsWhatItMade) {
  const TemporaryFolder folder;
  const ProgramResult result = toile({"--json", "make", kSleeve, "-o", folder.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto told = nlohmann::json::parse(result.out);
  EXPECT_EQ(told["complete"], true);
  EXPECT_EQ(told["pieces"], 2);
  // Thirteen for the whole pattern, two for each piece.
  ASSERT_EQ(told["files"].size(), 13U + 2 * 2);
  for (const auto& file : told["files"]) {
    EXPECT_TRUE(fs::exists(file["path"].get<std::string>())) << file;
  }
}

TEST(Make, SavesTheLinesThatItFinds) {
  const TemporaryFolder folder;
  // A sleeve without lines: a tube, of which --auto-cut makes something flat.
  const fs::path design = folder.path() / "tube.toile";
  writeText(design, R"({"toile": 1, "name": "tube", "models": [{"model": "builtin:bent-sleeve@1"}],
    "curves": []})");
  const ProgramResult made =
      toile({"make", design, "--auto-cut", "--save", "-o", folder.path() / "out"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(readText(design), testing::HasSubstr("autocut-"));
  EXPECT_THAT(readText(design), testing::HasSubstr("\"connectivity\""));
  // The saved design makes the same pieces by itself.
  const ProgramResult again = toile({"make", design, "-o", folder.path() / "again"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(readText(folder.path() / "again/pattern.svg"),
            readText(folder.path() / "out/pattern.svg"));
  // Nothing is found any more, and nothing is written.
  const std::string before = readText(design);
  ASSERT_EQ(toile({"make", design, "--auto-cut", "--save", "-o", folder.path() / "out"}).status, 0);
  EXPECT_EQ(readText(design), before);
}

TEST(Make, SavesOnlyWhatItIsToFindOnTheDesignsOwnModel) {
  const TemporaryFolder folder;
  expectRefusal(toile({"make", kSleeve, "--save", "-o", folder.path() / "out"}), 2, "--auto-cut");
  expectRefusal(toile({"make", kSleeve, "--auto-cut", "--save", "--body", "builtin:bent-sleeve@1",
                       "-o", folder.path() / "out"}),
                2, "own model");
}

TEST(Make, RefusesAMissingDesign) {
  const TemporaryFolder folder;
  expectRefusal(toile({"make", folder.path() / "none.toile", "-o", folder.path() / "out"}), 1,
                "none.toile");
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Make, RefusesAMissingModel) {
  const TemporaryFolder folder;
  writeText(folder.path() / "a.toile",
            R"({"toile": 1, "name": "a", "models": [{"model": "none.ply"}], "curves": []})");
  expectRefusal(toile({"make", folder.path() / "a.toile", "-o", folder.path() / "out"}), 1,
                "none.ply");
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Make, AsksForUnits) {
  const TemporaryFolder folder;
  writeText(folder.path() / "m.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n");
  writeText(folder.path() / "a.toile",
            R"({"toile": 1, "name": "a", "models": [{"model": "m.obj"}], "curves": []})");
  expectRefusal(toile({"make", folder.path() / "a.toile", "-o", folder.path() / "out"}), 1,
                "--units");
  const ProgramResult told =
      toile({"make", folder.path() / "a.toile", "--units", "mm", "-o", folder.path() / "out"});
  EXPECT_EQ(told.status, 0) << told.err;
}

TEST(Make, RefusesAMeshThatIsNoSurface) {
  const TemporaryFolder folder;
  // Three triangles at one edge.
  writeText(folder.path() / "m.obj",
            "# toile-units: mm\nv 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 -100 0\nv 0 0 100\n"
            "f 1 2 3\nf 2 1 4\nf 1 2 5\n");
  writeText(folder.path() / "a.toile",
            R"({"toile": 1, "name": "a", "models": [{"model": "m.obj"}], "curves": []})");
  expectRefusal(toile({"make", folder.path() / "a.toile", "-o", folder.path() / "out"}), 1,
                "m.obj");
}

TEST(Make, RefusesACurveThatLeavesTheSilhouette) {
  const TemporaryFolder folder;
  auto design = nlohmann::json::parse(readText(kSleeve));
  design["curves"][0]["way"] = {{"view",
                                 {{"eye", {0, -3000, 300}},
                                  {"target", {0, 0, 300}},
                                  {"up", {0, 0, 1}},
                                  {"height", "1000mm"},
                                  {"perspective", true}}},
                                {"controls", {{0, 0}, {0, 400}, {400, 400}}}};
  writeText(folder.path() / "a.toile", design.dump());
  const ProgramResult result =
      toile({"make", folder.path() / "a.toile", "-o", folder.path() / "out"});
  expectRefusal(result, 1, "front-seam");
  EXPECT_THAT(result.err, testing::HasSubstr("miss the model"));
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Make, RefusesABodyThatIsNoScan) {
  const TemporaryFolder folder;
  writeText(folder.path() / "m.obj",
            "# toile-units: mm\nv 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\n"
            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  expectRefusal(
      toile({"make", kSleeve, "--body", folder.path() / "m.obj", "-o", folder.path() / "out"}), 1,
      "a scan needs 100");
}

TEST(Make, RefusesAnUnwritableFolder) {
  const TemporaryFolder folder;
  writeText(folder.path() / "file", "");
  const ProgramResult result = toile({"make", kSleeve, "-o", folder.path() / "file" / "out"});
  expectRefusal(result, 1, "file/out");
  EXPECT_THAT(namesIn(folder.path()), testing::ElementsAre("file"));
}

TEST(Make, LeavesTheEarlierResultWhenAFileCannotGrow) {
  const TemporaryFolder folder;
  ASSERT_EQ(toile({"make", kSleeve, "-o", folder.path()}).status, 0);
  const auto before = filesIn(folder.path());
  // A limit on file sizes is met the way a full disk is: a write that fails half way.
  struct rlimit old {};
  getrlimit(RLIMIT_FSIZE, &old);
  const struct rlimit small { 20000, old.rlim_max };
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const ProgramResult result = toile({"make", kSleeve, "-o", folder.path()});
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_DFL);
  expectRefusal(result, 1, folder.path().string());
  EXPECT_TRUE(filesIn(folder.path()) == before);
}

TEST(Make, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  const auto mountSmallDisk = [&folder] {
    return mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=100k") == 0;
  };
  // Who is not root may mount in a namespace of his own, as its root.
  const auto enterNamespace = [user = geteuid(), group = getegid()] {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
    return true;
  };
  ASSERT_TRUE(mountSmallDisk() || (enterNamespace() && mountSmallDisk())) << std::strerror(errno);
  const ProgramResult result = toile({"make", kSleeve, "-o", folder.path() / "out"});
  const bool isEmpty = fs::is_empty(folder.path());
  umount(folder.path().c_str());
  expectRefusal(result, 1, "No space left");
  EXPECT_TRUE(isEmpty);
}

TEST(Make, StrictFailsOnFindingsOnly) {
  const TemporaryFolder folder;
  auto design = nlohmann::json::parse(readText(kSleeve));
  EXPECT_EQ(toile({"--strict", "make", kSleeve, "-o", folder.path() / "a"}).status, 0);
  design["pieces"].erase(1);  // a region without a record
  writeText(folder.path() / "a.toile", design.dump());
  const fs::path path = folder.path() / "a.toile";
  const ProgramResult lax = toile({"make", path, "-o", folder.path() / "b"});
  EXPECT_EQ(lax.status, 0) << lax.err;
  EXPECT_THAT(lax.err, testing::HasSubstr("finding: "));
  EXPECT_EQ(toile({"make", path, "--strict", "-o", folder.path() / "c"}).status, 1);
}

/// Part of a model beside a flat sheet of 16 cells (piece "Sheet", faces 0 to 31), as a design.
class TwoParts {
 public:
  TwoParts() {
    for (int j = 0; j <= 4; ++j) {
      for (int i = 0; i <= 4; ++i) vertex(20 * i, 0, 20 * j);
    }
    cells(0, 4);
    design_ = {
        {"toile", 1},
        {"name", "Two parts"},
        {"models", {{{"model", "m.obj"}}}},
        {"curves", nlohmann::json::array()},
        {"pieces", {{{"id", "sheet"}, {"name", "Sheet"}, {"anchor", {{"near", {41, 0, 42}}}}}}}};
  }
  void vertex(double x, double y, double z) { mesh_ += fmt::format("v {} {} {}\n", x, y, z); }
  void face(int a, int b, int c) { mesh_ += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1); }
  /// A square grid over vertices that run row by row.
  void cells(int first, int n) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = first + j * (n + 1) + i, c = a + n + 2;
        face(a, a + 1, c);
        face(a, c, a + n + 1);
      }
    }
  }
  void piece(const std::string& name, const std::array<double, 3>& near) {
    design_["pieces"].push_back({{"id", name}, {"name", name}, {"anchor", {{"near", near}}}});
  }
  void feature(const std::string& id, const std::array<double, 3>& normal, int vertex) {
    design_["curves"].push_back(
        {{"id", id},
         {"kind", "feature"},
         {"way", {{"section", {{"normal", normal}, {"point", {{"vertex", vertex}}}}}}}});
  }
  /// Writes both files and makes the pattern. The part is refused by name and left out of every
  /// cutting file; the sheet is made.
  /// @return the failure as report.json tells it
  nlohmann::json makeAllButOne(const std::string& failing, std::vector<std::string> options = {}) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    writeText(folder.path() / "m.obj", "# toile-units: mm\n" + mesh_);
    writeText(folder.path() / "a.toile", design_.dump());
    options.insert(options.begin(), {"make", folder.path() / "a.toile", "-o", out});
    const ProgramResult result = toile(options);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, testing::HasSubstr("toile: piece \"" + failing + "\": "));
    if (!fs::exists(out / "report.json")) {
      ADD_FAILURE() << result.err;
      return {{"where", nlohmann::json::array()}};
    }
    for (const auto& [name, content] : filesIn(out)) {
      EXPECT_THAT(name, testing::Not(testing::HasSubstr(failing)));
      const bool isDrawing = name.ends_with(".svg") || name.ends_with(".dxf");
      if (!isDrawing || name == "laser.dxf") continue;
      EXPECT_THAT(content, testing::HasSubstr("Sheet")) << name;
      EXPECT_THAT(content, testing::Not(testing::HasSubstr(failing))) << name;
    }
    const nlohmann::json report = nlohmann::json::parse(readText(out / "report.json"));
    EXPECT_EQ(report["complete"], false);
    EXPECT_EQ(report["failures"].size(), 1U);
    const nlohmann::json failure = report["failures"].at(0);
    EXPECT_EQ(failure["piece"], failing);
    EXPECT_THAT(failure["where"],
                testing::Contains(nlohmann::json{{"kind", "piece"}, {"name", failing}}));
    EXPECT_THAT(readText(out / "report.html"),
                testing::HasSubstr(failure["code"].get<std::string>()));
    return failure;
  }

 private:
  std::string mesh_;
  nlohmann::json design_;
};

TEST(Make, AClosedPieceStopsNoOther) {
  TwoParts parts;
  for (const auto& [x, y, z] : {std::array{200, 0, 0}, {250, 0, 0}, {200, 50, 0}, {200, 0, 50}}) {
    parts.vertex(x, y, z);
  }
  parts.face(25, 27, 26);
  parts.face(25, 26, 28);
  parts.face(25, 28, 27);
  parts.face(26, 27, 28);
  parts.piece("Ball", {210, 0, 10});
  EXPECT_EQ(parts.makeAllButOne("Ball")["code"], "NotADisk");
  EXPECT_EQ(parts.makeAllButOne("Ball", {"--auto-cut"})["code"], "NotADisk");
}

TEST(Make, AFaceWithoutAreaStopsOnlyItsPieceAndIsNamedOnTheModel) {
  TwoParts parts;
  for (const int x : {200, 210, 220}) parts.vertex(x, 0, 0);
  parts.vertex(200, 0, 10);
  parts.face(25, 26, 28);
  parts.face(26, 27, 28);
  parts.face(25, 27, 26);
  parts.piece("Flap", {202, 0, 2});
  const nlohmann::json failure = parts.makeAllButOne("Flap");
  EXPECT_EQ(failure["code"], "DegenerateFace");
  EXPECT_THAT(failure["message"].get<std::string>(), testing::HasSubstr("the first is face 34;"));
  EXPECT_EQ(failure["where"][0], (nlohmann::json{{"kind", "face"}, {"index", 34}}));
}

// Every edge of a dome is a line: all its triangles are rigid, and it cannot lie flat.
TEST(Make, LinesThatContradictEachOtherStopOnlyTheirPieceAndAreNamed) {
  TwoParts parts;
  const auto vertex = [](int i, int j) { return 25 + 7 * j + i; };
  for (int j = 0; j <= 6; ++j) {
    for (int i = 0; i <= 6; ++i) {
      const double x = -60 + 20 * i, z = -60 + 20 * j;
      parts.vertex(300 + x, -std::sqrt(1e4 - x * x - z * z), z);
    }
  }
  parts.cells(25, 6);
  parts.piece("Dome", {301, -100, 3});
  for (int k = 1; k <= 5; ++k) {
    parts.feature(fmt::format("x{}", k), {1, 0, 0}, vertex(k, 3));
    parts.feature(fmt::format("z{}", k), {0, 0, 1}, vertex(3, k));
    parts.feature(fmt::format("d{}", k), {1, 0, -1}, vertex(k, 3));
  }
  const nlohmann::json failure = parts.makeAllButOne("Dome");
  EXPECT_EQ(failure["code"], "LengthsInfeasible");
  EXPECT_THAT(failure["where"],
              testing::Contains(nlohmann::json{{"kind", "curve"}, {"name", "d3"}}));
  for (const nlohmann::json& element : failure["where"]) {
    EXPECT_NE(element["kind"], "edge") << "of the piece's own mesh";
    if (element["kind"] == "face") {
      EXPECT_GE(element["index"], 32) << "a face of the sheet";
    }
  }
}

TEST(Make, NamesThePieceThatCannotLieFlat) {
  const TemporaryFolder folder;
  auto design = nlohmann::json::parse(readText(kSleeve));
  design["curves"] = nlohmann::json::array();
  design["pieces"] = nlohmann::json::array();
  writeText(folder.path() / "a.toile", design.dump());
  const fs::path path = folder.path() / "a.toile";
  const ProgramResult failed = toile({"make", path, "-o", folder.path() / "b"});
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.err, testing::HasSubstr("toile: piece "));
  const ProgramResult cut = toile({"make", path, "--auto-cut", "-o", folder.path() / "c"});
  EXPECT_EQ(cut.status, 0) << cut.err;
}

}  // namespace
}  // namespace toile::test
