// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/result.h"
#include "toile/core/units.h"

namespace toile::cli {

/// Exit status of the program (docs/commands.md).
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongCommandLine = 2;

/// What every sub-command shares: the options that stand before or after its name, and what the
/// chosen one has to do.
struct Session {
  std::size_t threads = 0;  ///< 0 = all cores
  bool strict = false;      ///< findings fail
  bool json = false;        ///< stdout for programs
  std::optional<FileUnit> units;
  std::function<int()> run;  ///< set by the sub-command that was asked for
};

/// A step of setting up the command line: adds one sub-command with its options.
///
/// In cli/<name>.cpp, declared in cli/commands.h and listed in main.cpp:
///
///     void addUnfold(CLI::App& app, Session& session) {
///       auto arguments = std::make_shared<Arguments>();
///       CLI::App* command = addCommand(app, session, "unfold", "One surface patch to the plane",
///                                      [arguments, &session] { return run(*arguments, session);
///                                      });
///       command->add_option("IN", arguments->in, "...")->required();
///     }
CLI::App* addCommand(CLI::App& app, Session& session, const std::string& name,
                     const std::string& help, std::function<int()> run);

/// An option whose text is read by one of the engine's parse functions, so that its message says
/// what is expected: `addParsed(*command, "--allowance", value, parseLength, "...")`.
template <class T, class Target>
CLI::Option* addParsed(CLI::App& command, const std::string& name, Target& target,
                       Result<T> (*parse)(std::string_view), const std::string& help) {
  return command.add_option_function<std::string>(
      name,
      [&target, parse, name](const std::string& text) {
        Result<T> value = parse(text);
        if (!value) throw CLI::ValidationError(name + ": " + value.error().message);
        target = *value;
      },
      help);
}

/// The same for an option that may be given often.
template <class T>
CLI::Option* addParsedList(CLI::App& command, const std::string& name, std::vector<T>& target,
                           Result<T> (*parse)(std::string_view), const std::string& help) {
  return command.add_option_function<std::vector<std::string>>(
      name,
      [&target, parse, name](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          Result<T> value = parse(text);
          if (!value) throw CLI::ValidationError(name + ": " + value.error().message);
          target.push_back(*std::move(value));
        }
      },
      help);
}

/// Prints `toile: <sentence>` on stderr. @return kFailed
int fail(const Error& error);
/// Prints every finding on stderr. @return kFailed with --strict and at least one, otherwise kDone
int report(std::span<const Finding> findings, const Session& session);

}  // namespace toile::cli
