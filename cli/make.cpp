// SPDX-License-Identifier: GPL-3.0-or-later
// `toile make`: the whole way from a design to cutting files.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "terminal_progress.h"
#include "toile/pipeline.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path design;
  std::optional<std::string> body;
  std::filesystem::path folder = "out";
  MakeOptions options;
};

std::string describe(const Pattern& pattern, const Arguments& arguments) {
  return fmt::format("{} piece{} in {}", pattern.pieces.size(),
                     pattern.pieces.size() == 1 ? "" : "s", arguments.folder.string());
}

std::string describeForPrograms(const Pattern& pattern, const WrittenPattern& written) {
  nlohmann::ordered_json json;
  json["complete"] = pattern.isComplete();
  json["pieces"] = pattern.pieces.size();
  json["files"] = nlohmann::ordered_json::array();
  for (const WrittenFile& file : written.files) {
    json["files"].push_back({{"path", file.path.string()}, {"purpose", file.purpose}});
  }
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : written.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2);
}

int run(const Arguments& arguments, const Session& session) {
  TerminalProgress progress;
  progress.step("open " + arguments.design.string());
  const Result<Document> document = openDocument(arguments.design, arguments.body, session.units);
  if (!document) return fail(document.error());

  const Result<Pattern> pattern = makePattern(*document, arguments.options, nullptr, &progress);
  if (!pattern) return fail(pattern.error());
  const Result<WrittenPattern> written = writePattern(*pattern, arguments.folder, &progress);
  if (!written) return fail(written.error());

  int status = report(written->findings, session);
  for (const std::optional<Error>& failure : pattern->failures) {
    if (failure) fail(*failure);
  }
  if (!pattern->isComplete()) status = kFailed;
  const std::string result =
      session.json ? describeForPrograms(*pattern, *written) : describe(*pattern, arguments);
  std::printf("%s\n", result.c_str());
  return status;
}

}  // namespace

void addMake(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "make", "The whole way: cut, unfold, check, finish, arrange, write",
                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("DESIGN", arguments->design, "The design, a .toile file")->required();
  command
      ->add_option("--body", arguments->body,
                   "Make it for this model instead of the design's own: a mesh file, a "
                   ".model.json or builtin:...")
      ->type_name("MODEL");
  command->add_option("-o,--output", arguments->folder, "Folder for the files")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--auto-cut", arguments->options.autoCut,
                    "Cut tubes open along the shortest way, so that they can lie flat");
  addParsed(*command, "--auto-dart", arguments->options.autoDart, parseRatio,
            "Put darts into pieces whose mean area error is greater than this, such as 5%")
      ->type_name("RATIO");
  addParsed(*command, "--auto-develop", arguments->options.autoDevelop, parseRatio,
            "Process pieces whose mean area error is greater than this, boundary held, until it is "
            "not")
      ->type_name("RATIO");
}

}  // namespace toile::cli
