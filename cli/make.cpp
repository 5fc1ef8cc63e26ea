// SPDX-License-Identifier: GPL-3.0-or-later
// `toile make`: the whole way from a design to cutting files.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "common_options.h"
#include "terminal_progress.h"
#include "toile/core/file.h"
#include "toile/design/design_file.h"
#include "toile/pipeline.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path design;
  std::optional<std::string> body;
  std::filesystem::path folder = "out";
  MakeOptions options;
  bool save = false;
  WriteOptions write;
  std::string dialect = "strict";
};

WriteOptions writeOptions(const Arguments& arguments) {
  WriteOptions options = arguments.write;
  if (arguments.dialect == "rich") options.dxf.dialect = DxfDialect::Rich;
  if (arguments.dialect == "aama") options.dxf.dialect = DxfDialect::Aama;
  return options;
}

std::string describe(const Pattern& pattern, const WrittenPattern& written,
                     const Arguments& arguments) {
  std::string text = fmt::format("{} piece{} in {}", pattern.pieces.size(),
                                 pattern.pieces.size() == 1 ? "" : "s", arguments.folder.string());
  for (const WrittenFile& file : written.files) {
    const std::filesystem::path name = file.path.lexically_relative(arguments.folder);
    if (name.has_parent_path()) continue;
    text += fmt::format("\n  {:<14}{}", name.string(), file.purpose);
  }
  return text + fmt::format("\n  {:<14}{}", "pieces/", "each piece in 3D and flat, with its lines");
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

/// Writes the design with the lines that --auto-cut and --auto-dart have found.
Result<void> saveDesign(const Pattern& pattern, const Document& before,
                        const std::filesystem::path& path) {
  if (pattern.document.design->curves.size() == before.design->curves.size()) return {};
  Design design = *pattern.document.design;
  // The found lines hold points of the mesh: the file has to say which.
  if (!design.models.empty() && !design.models.front().connectivityHash) {
    design.models.front().connectivityHash = pattern.document.model->mesh->connectivityHash();
  }
  return writeFileWhole(path, writeDesign(design));
}

Result<AreaLimit> parseLimit(std::string_view text) {
  if (text == "fabric") return AreaLimit();
  const Result<Ratio> ratio = parseRatio(text);
  if (!ratio) return ratio.error();
  return AreaLimit(*ratio);
}

int run(const Arguments& arguments, const Session& session) {
  if (arguments.save && arguments.body) {
    std::fprintf(stderr,
                 "toile: --save is for the design's own model: lines found on another body do not "
                 "belong in it (toile make --help)\n");
    return kWrongCommandLine;
  }
  if (arguments.save && !arguments.options.autoCut && !arguments.options.autoDart) {
    std::fprintf(stderr,
                 "toile: --save keeps the lines of --auto-cut and --auto-dart; give one of them "
                 "(toile make --help)\n");
    return kWrongCommandLine;
  }
  TerminalProgress progress;
  progress.step("open " + arguments.design.string());
  const Result<Document> document = openDocument(arguments.design, arguments.body, session.units);
  if (!document) return fail(document.error());

  const Result<Pattern> pattern = makePattern(*document, arguments.options, nullptr, &progress);
  if (!pattern) return fail(pattern.error());
  const Result<WrittenPattern> written =
      writePattern(*pattern, arguments.folder, &progress, writeOptions(arguments));
  if (!written) return fail(written.error());
  if (arguments.save) {
    const Result<void> saved = saveDesign(*pattern, *document, arguments.design);
    if (!saved) return fail(saved.error());
  }

  int status = report(written->findings, session);
  for (const std::optional<Error>& failure : pattern->failures) {
    if (failure) fail(*failure);
  }
  if (!pattern->isComplete()) status = kFailed;
  const std::string result = session.json ? describeForPrograms(*pattern, *written)
                                          : describe(*pattern, *written, arguments);
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
  addBody(*command, arguments->body);
  command->add_option("-o,--output", arguments->folder, "Folder for the files")
      ->type_name("DIR")
      ->capture_default_str();
  addPaper(*command, arguments->write.pdf);
  command
      ->add_option("--dxf", arguments->dialect,
                   "pattern.dxf: strict (nothing but pieces), rich (layer tables and colours for "
                   "drawing programs) or aama")
      ->check(CLI::IsMember({"strict", "rich", "aama"}))
      ->capture_default_str();
  command->add_flag("--inches", arguments->write.dxf.inches, "Write pattern.dxf in inches");
  addAutoCut(*command, arguments->options.autoCut);
  addParsed(*command, "--auto-dart", arguments->options.autoDart, parseLimit,
            "Put darts into pieces whose mean area error is greater than this, such as 5%, or than "
            "the stretch limit of their fabric: fabric")
      ->type_name("RATIO");
  addParsed(*command, "--auto-develop", arguments->options.autoDevelop, parseLimit,
            "Process pieces whose mean area error is greater than this, or fabric, boundary held, "
            "until it is not")
      ->type_name("RATIO");
  addParsed(*command, "--symmetrise", arguments->options.symmetrise, parseRatio,
            "Make pieces exactly symmetric that are so within this share of their size, such as "
            "0.5%")
      ->type_name("RATIO");
  command->add_flag("--save", arguments->save,
                    "Write the lines that --auto-cut and --auto-dart find into the design");
}

}  // namespace toile::cli
