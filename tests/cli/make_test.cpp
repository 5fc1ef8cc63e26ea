// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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
