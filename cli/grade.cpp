// SPDX-License-Identifier: GPL-3.0-or-later
// `toile grade`: one design in many sizes.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "terminal_progress.h"
#include "toile/batch/grade.h"
#include "toile/core/file.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path design, table, out;
  std::vector<std::string> sizes;
  std::string base;
};

Result<std::vector<BodySize>> chosenSizes(const Arguments& arguments, const Session& session) {
  std::vector<BodySize> known = standardSizes();
  if (!arguments.table.empty()) {
    const Result<std::string> text = readFile(arguments.table);
    if (!text) return text.error();
    Result<std::vector<BodySize>> own =
        parseSizeTable(*text, arguments.table.string(), session.units);
    if (!own) return own.error();
    if (arguments.sizes.empty()) return own;
    known = *std::move(own);
  }
  std::vector<BodySize> chosen;
  for (const std::string& name : arguments.sizes) {
    Result<BodySize> size = findSize(known, name);
    if (!size) return size.error();
    chosen.push_back(*std::move(size));
  }
  if (chosen.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 "say which sizes: --sizes EU36F,EU38F,EU40F or --table sizes.csv",
                 {}};
  }
  return chosen;
}

int run(const Arguments& arguments, const Session& session) {
  const Result<std::vector<BodySize>> sizes = chosenSizes(arguments, session);
  if (!sizes) return fail(sizes.error());
  TerminalProgress progress;
  const Result<Document> document = openDocument(arguments.design, std::nullopt, session.units);
  if (!document) return fail(document.error());
  const std::string base =
      arguments.base.empty() ? (*sizes)[sizes->size() / 2].name : arguments.base;
  const Result<std::vector<GradedSize>> graded = gradeDesign(*document, *sizes, base, &progress);
  if (!graded) return fail(graded.error());
  const Result<std::vector<Finding>> findings = writeGrading(*graded, arguments.out, &progress);
  if (!findings) return fail(findings.error());
  if (session.json) {
    nlohmann::ordered_json json = {{"base", base},
                                   {"sizes", nlohmann::ordered_json::array()},
                                   {"svg", (arguments.out / "nested.svg").string()},
                                   {"dxf", (arguments.out / "nested.dxf").string()},
                                   {"table", (arguments.out / "grade.csv").string()}};
    for (const GradedSize& size : *graded) json["sizes"].push_back(size.name);
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{} sizes, base {}; {}\n", graded->size(), base,
               (arguments.out / "nested.svg").string());
  }
  return report(*findings, session);
}

}  // namespace

void addGrade(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(app, session, "grade", "One design in many sizes, nested",
                                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("DESIGN", arguments->design, "The design, a .toile file")->required();
  command
      ->add_option("--sizes", arguments->sizes,
                   "Sizes of EN 13402 such as EU36F,EU38F, or of --table; all of a table without")
      ->delimiter(',')
      ->type_name("SIZE,...");
  command->add_option("--table", arguments->table, "Table of sizes of one's own, CSV")
      ->type_name("FILE");
  command->add_option("--base", arguments->base, "The base size (default: the middle one)")
      ->type_name("SIZE");
  command->add_option("-o,--output", arguments->out, "Folder for the sizes and the nest")
      ->type_name("DIR")
      ->required();
}

}  // namespace toile::cli
