// SPDX-License-Identifier: GPL-3.0-or-later
// The `toile` command. Results go to stdout, everything for people to stderr.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "spelling.h"
#include "toile/core/parallel.h"
#include "toile/core/version.h"

namespace toile::cli {
namespace {

constexpr std::size_t kMaxThreads = 1024;

void addCommonOptions(CLI::App& app, Session& session) {
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", std::string("toile ") + version(), "Print the version");
  app.add_option_function<std::string>(
         "--threads",
         [&session](const std::string& text) {
           const char* end = text.data() + text.size();
           std::size_t count = 0;
           const auto [stop, code] = std::from_chars(text.data(), end, count);
           if (code != std::errc() || stop != end || count == 0 || count > kMaxThreads) {
             throw CLI::ValidationError("--threads: \"" + text +
                                        "\" is no number of threads; give one from 1 to 1024, such "
                                        "as --threads 2, or leave it out for all cores");
           }
           session.threads = count;
         },
         "Use that many threads (default: all cores); the results do not depend on it")
      ->type_name("N");
  addParsed(app, "--units", session.units, parseFileUnit,
            "Unit of model files that do not say it: mm, cm, m, in")
      ->type_name("UNIT");
  app.add_flag("--strict", session.strict, "Exit with status 1 when there are findings");
  app.add_flag("--json", session.json, "Print results for programs");
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  std::vector<const CLI::App*> apps{&app};
  for (CLI::App* chosen : app.get_subcommands()) apps.push_back(chosen);
  for (const CLI::App* each : apps) {
    for (const CLI::Option* option : each->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
  }
  return names;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = findNearest(word, known);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

/// What is wrong with words that nothing on the command line takes.
std::string explainUnknown(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(/*recurse=*/true);
  const auto option = std::ranges::find_if(
      words, [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  const bool hasCommand = !app.get_subcommands().empty();
  if (!hasCommand && !words.empty() && option != words.begin()) {
    const std::string& word = words.front();
    return "there is no command \"" + word + "\"" + suggestion(word, commandNames(app));
  }
  if (option != words.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "there is no option " + name + suggestion(name, optionNames(app));
  }
  return words.empty() ? "the command line is not complete"
                       : "\"" + words.front() + "\" is one argument too many";
}

std::string helpCommand(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? "toile --help" : "toile " + chosen.front()->get_name() + " --help";
}

int refuse(const CLI::App& app, const std::string& sentence) {
  std::fprintf(stderr, "toile: %s (%s)\n", sentence.c_str(), helpCommand(app).c_str());
  return kWrongCommandLine;
}

int runProgram(int argc, char** argv) {
  CLI::App app{"Turns lines drawn on a 3D model into flat pieces that fit together.", "toile"};
  Session session;
  addCommonOptions(app, session);
  addMake(app, session);
  addCheck(app, session);
  addUnfold(app, session);
  addBody(app, session);
  addDevelop(app, session);
  addRender(app, session);
  addStudio(app, session);
  addScan(app, session);
  addFit(app, session);
  addConvert(app, session);
  addCheckSewing(app, session);
  addMap(app, session);
  addNest(app, session);
  addTransfer(app, session);
  addWarp(app, session);
  addBatch(app, session);
  addGrade(app, session);
  app.require_subcommand(0, 1);
  app.footer(
      "`toile COMMAND --help` tells about one command. Exit status: 0 done, 1 the work failed, "
      "2 wrong command line.");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ExtrasError&) {
    return refuse(app, explainUnknown(app));
  } catch (const CLI::ParseError& error) {
    return refuse(app, error.what());
  }
  if (!session.run) return refuse(app, "no command given; start with `toile make DESIGN -o DIR`");

  const ThreadLimit limit(session.threads);
  return session.run();
}

}  // namespace
}  // namespace toile::cli

int main(int argc, char** argv) {
  try {
    return toile::cli::runProgram(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs(
        "toile: the computer has not enough memory for this; try a model with fewer triangles\n",
        stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "toile: an unexpected fault in the program: %s; please report it\n",
                 error.what());
  }
  return toile::cli::kFailed;
}
