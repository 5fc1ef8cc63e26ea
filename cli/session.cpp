// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.h"

#include <cstdio>
#include <utility>

namespace toile::cli {

CLI::App* addCommand(CLI::App& app, Session& session, const std::string& name,
                     const std::string& help, std::function<int()> run) {
  CLI::App* command = app.add_subcommand(name, help);
  command->fallthrough();  // the common options may follow the sub-command
  command->callback([&session, run = std::move(run)] { session.run = run; });
  return command;
}

int fail(const Error& error) {
  std::fprintf(stderr, "toile: %s\n", error.message.c_str());
  return kFailed;
}

int report(std::span<const Finding> findings, const Session& session) {
  for (const Finding& finding : findings) {
    std::fprintf(stderr, "finding: %s [%s]\n", finding.message.c_str(), finding.code.c_str());
  }
  return session.strict && !findings.empty() ? kFailed : kDone;
}

}  // namespace toile::cli
