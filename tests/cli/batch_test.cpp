// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "support/cut_scan.h"
#include "support/run_program.h"
#include "support/test_data.h"
#include "toile/mesh/mesh_file.h"
#include "toile/model/reference_model.h"

extern char** environ;  // NOLINT: of the C library

namespace toile::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kWetsuit = std::string(TOILE_SOURCE_DIR) + "/examples/wetsuit-full.toile";

ProgramResult toile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TOILE_EXECUTABLE);
  return runProgram(arguments);
}

/// Two good orders, one whose body is no body, one whose row is damaged.
fs::path writeList(const fs::path& folder) {
  writeText(folder / "chair.obj", "# toile-units: mm\nv 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n");
  writeText(folder / "list.csv",
            "name,body,customer,units\n"
            "anna,builtin:body@1?size=EU42F,\"Anna, of Toile\",\n"
            "chair,chair.obj,,\n"
            "ben,builtin:body@1?size=EU50M,,\n"
            "broken,\"no end\n");
  return folder / "list.csv";
}

class Batch : public testing::Test {
 protected:
  /// The whole batch, made once for all tests.
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    list_ = writeList(folder_->path());
    whole_ = folder_->path() / "whole";
    result_ = toile({"batch", kWetsuit, "--bodies", list_, "-o", whole_, "-j", "2"});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline fs::path list_, whole_;
  static inline ProgramResult result_;
};

TEST_F(Batch, OneBadOrderNeverStopsTheRest) {
  EXPECT_EQ(result_.status, 1);
  EXPECT_THAT(result_.out, HasSubstr("2 of 4 orders done"));
  EXPECT_THAT(result_.err, HasSubstr("chair: failed: "));
  EXPECT_THAT(result_.err, HasSubstr("line 5: a quote is not closed"));
  for (const char* name : {"anna", "ben"}) {
    EXPECT_TRUE(fs::exists(whole_ / name / "pattern.dxf")) << name;
    EXPECT_THAT(readText(whole_ / name / "order.json"), HasSubstr("\"status\": \"done\""));
  }
  EXPECT_FALSE(fs::exists(whole_ / "chair" / "pattern.dxf"));
  EXPECT_THAT(readText(whole_ / "anna" / "pattern.pdf").size(), testing::Gt(1000U));
  EXPECT_FALSE(fs::exists(whole_ / ".work"));
}

TEST_F(Batch, OverviewShowsWhatNeedsAttentionFirst) {
  const std::string page = readText(whole_ / "index.html");
  EXPECT_LT(page.find("chair"), page.find("anna"));
  EXPECT_THAT(page, HasSubstr("anna/thumb.png"));
  EXPECT_THAT(page, Not(HasSubstr("chair/thumb.png")));
  const std::string table = readText(whole_ / "summary.csv");
  EXPECT_THAT(table, HasSubstr("waist_girth_mm"));
  EXPECT_THAT(table, HasSubstr("anna,done,"));
  EXPECT_THAT(table, HasSubstr("chair,failed,100,"));
}

TEST_F(Batch, SharesAndCollectGiveTheSameBytes) {
  const fs::path out = folder_->path() / "shares";
  for (const char* task : {"2", "0", "3", "1"}) {
    toile({"batch", kWetsuit, "--bodies", list_, "-o", out, "--task", task});
  }
  const ProgramResult collected =
      toile({"batch", kWetsuit, "--bodies", list_, "-o", out, "--collect"});
  EXPECT_EQ(collected.status, 1);
  EXPECT_EQ(filesIn(out), filesIn(whole_));
}

TEST_F(Batch, IsResumedAfterAKillWithTheSameBytesAndNoWorkTwice) {
  const fs::path out = folder_->path() / "killed";
  std::vector<std::string> words = {
      TOILE_EXECUTABLE, "batch", kWetsuit, "--bodies", list_, "-o", out, "-j", "1"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = -1;
  ASSERT_EQ(posix_spawn(&process, TOILE_EXECUTABLE, nullptr, nullptr, argv.data(), environ), 0);
  // One order is made, a later one is not.
  for (int i = 0; i < 12'000 && !fs::exists(out / "anna" / "order.json"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(kill(process, SIGKILL), 0);
  int status = 0;
  waitpid(process, &status, 0);
  ASSERT_TRUE(fs::exists(out / "anna" / "order.json"));
  ASSERT_FALSE(fs::exists(out / "ben" / "order.json")) << "it was not killed half-way";
  const auto made = fs::last_write_time(out / "anna" / "order.json");
  const ProgramResult resumed = toile({"batch", kWetsuit, "--bodies", list_, "-o", out});
  EXPECT_THAT(resumed.out, HasSubstr("2 of 4 orders done"));
  EXPECT_EQ(fs::last_write_time(out / "anna" / "order.json"), made);
  EXPECT_EQ(filesIn(out), filesIn(whole_));
}

// Each can be read, and would make pieces: none may become a pattern, but of the diver whose scan
// ends at wrists and ankles, as the suit does.
TEST_F(Batch, BodiesOfAnotherKindFailAndSayWhy) {
  TOILE_TEST_DATA_OR_SKIP(chair, "toys/armchair.ply");
  TOILE_TEST_DATA_OR_SKIP(foot, "feet/foot_male_average_l.ply");
  TOILE_TEST_DATA_OR_SKIP(man, "bodies/male_average.ply");
  const Mesh body = *readModel(man, FileUnit::Millimetre).value().mesh;
  const auto write = [&](const char* name, const auto& move) {
    std::vector<Eigen::Vector3d> places;
    for (const Eigen::Vector3d& p : body.positions()) places.push_back(move(p));
    writeText(folder_->path() / name, writePly(body.withPositions(std::move(places))));
  };
  write("metres.ply", [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p / 1000); });
  write("mirrored.ply",
        [](const Eigen::Vector3d& p) { return Eigen::Vector3d(-p.x(), p.y(), p.z()); });
  const Scan diver = cutScan(body, [](const Eigen::Vector3d& p) {
    return p.z() > 90 && (std::abs(p.x()) < 400 || p.y() > -205);
  });
  writeText(folder_->path() / "diver.ply",
            writePly(makeMesh(diver.points, diver.triangles).value()));
  writeText(folder_->path() / "kinds.csv",
            "name,body,units\nchair," + chair.string() + ",mm\nfoot," + foot.string() +
                ",mm\nmetres,metres.ply,mm\nmirrored,mirrored.ply,mm\n"
                "ben,builtin:body@1?size=EU50M,\ndiver,diver.ply,mm\n");
  const fs::path out = folder_->path() / "kinds";
  const ProgramResult result =
      toile({"batch", kWetsuit, "--bodies", folder_->path() / "kinds.csv", "-o", out, "-j", "2"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("2 of 6 orders done"));
  EXPECT_TRUE(fs::exists(out / "ben" / "pattern.dxf"));
  EXPECT_TRUE(fs::exists(out / "diver" / "pattern.dxf"));
  EXPECT_THAT(
      readText(out / "index.html"),
      HasSubstr("<li>there is no scan of the left hand, left foot, right hand, right foot"));
  for (const auto& [name, reason] : {std::pair{"chair", "another kind of model"},
                                     {"foot", "another kind of model"},
                                     {"metres", "m taken for mm"},
                                     {"mirrored", "it may be mirrored"}}) {
    EXPECT_THAT(result.err, HasSubstr(std::string(name) + ": failed: "));
    const std::string order = readText(out / name / "order.json");
    EXPECT_THAT(order, HasSubstr("\"status\": \"failed\""));
    EXPECT_THAT(order, HasSubstr(reason));
    EXPECT_FALSE(fs::exists(out / name / "pattern.dxf")) << name;
  }
}

TEST_F(Batch, ListsThatCannotBeReadAreRefused) {
  const fs::path bad = folder_->path() / "bad.csv";
  writeText(bad, "name,bodie\nanna,a.ply\n");
  const ProgramResult result =
      toile({"batch", kWetsuit, "--bodies", bad, "-o", folder_->path() / "none"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("did you mean \"body\""));
  EXPECT_FALSE(fs::exists(folder_->path() / "none"));
}

}  // namespace
}  // namespace toile::test
