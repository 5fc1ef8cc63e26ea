// SPDX-License-Identifier: GPL-3.0-or-later
// `toile studio`: starts the desktop program, which is a binary of its own so that the command does
// without a desktop toolkit.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::string file;
};

int run(const Arguments& arguments) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::string program = (self.parent_path() / "toile-studio").string();
  std::vector<std::string> words{program};
  if (!arguments.file.empty()) words.insert(words.end(), {"--", arguments.file});
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  return fail({ErrorCode::FileNotFound,
               "the desktop program could not be started (" + program + ": " +
                   std::strerror(errno) + "); ./run studio builds it",
               {}});
}

}  // namespace

void addStudio(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "studio", "The desktop program: draw on the body, see the pattern",
                 [arguments] { return run(*arguments); });
  command->add_option("FILE", arguments->file, "A design (.toile) to open");
}

}  // namespace toile::cli
