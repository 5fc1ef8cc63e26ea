// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/recovery.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <chrono>
#include <thread>

#include "document/design_store.h"
#include "toile/design/design_file.h"

namespace toile::studio {
namespace {

TEST(Recovery, WorkOfAKilledProgramIsFoundAndOfALivingOneIsNot) {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.path().toStdString();
  Result<Document> work = emptyDocument("builtin:torso@1");
  ASSERT_TRUE(work);
  auto design = *work->design;
  design.name = "half done";
  work->design = std::make_shared<const Design>(design);

  const pid_t child = fork();
  if (child == 0) {
    Recovery recovery(path);
    if (!recovery.keep(*work, {}, "/somewhere/top.toile")) _exit(1);
    for (;;) pause();
  }
  const Recovery mine(path);
  for (int i = 0; i < 100 && std::distance(std::filesystem::directory_iterator(path), {}) < 4;
       ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_FALSE(mine.findLeftWork()) << "its program lives";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);

  const auto left = mine.findLeftWork();
  ASSERT_TRUE(left);
  EXPECT_EQ(left->original, "/somewhere/top.toile");
  const Result<Design> read = readDesign(left->backup);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "half done");
  Recovery::discard(*left);
  EXPECT_FALSE(mine.findLeftWork());
}

TEST(Recovery, LeavesNothingWhenTheProgramEndsAsItShould) {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.path().toStdString();
  {
    Recovery recovery(path);
    ASSERT_TRUE(recovery.keep(*emptyDocument("builtin:torso@1"), {}, {}));
  }
  EXPECT_FALSE(Recovery(path).findLeftWork());
}

}  // namespace
}  // namespace toile::studio
