// SPDX-License-Identifier: GPL-3.0-or-later
// `toile check-sewing`: sews the pieces of a cutting file virtually.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "toile/core/file.h"
#include "toile/io/sewing_files.h"

namespace toile::cli {
namespace {

struct SewingArguments {
  std::filesystem::path folder;
  std::optional<std::filesystem::path> drawing;
};

void print(const SewingCheck& check, const Session& session) {
  double worst = 0;
  double notch = 0;
  std::size_t notches = 0;
  for (const SewingCheck::Seam& seam : check.seams) {
    worst = std::max(worst, std::abs(seam.lengthA - seam.lengthB));
    notch = std::max(notch, seam.notchOff);
    notches += seam.notches;
  }
  if (!session.json) {
    fmt::print(
        "{} seams sewn, mates within {:.4f} mm; {} pairs of notches meet within {:.4f} mm; {} "
        "do not fit\n",
        check.seams.size(), worst, notches, notch, check.findings.size());
    return;
  }
  nlohmann::ordered_json json{{"format", "toile-check-sewing"},
                              {"version", 1},
                              {"maxMateDifference", worst},
                              {"maxNotchDifference", notch}};
  json["seams"] = nlohmann::ordered_json::array();
  for (const SewingCheck::Seam& seam : check.seams)
    json["seams"].push_back({{"edges", {seam.edgeA, seam.edgeB}},
                             {"lengths", {seam.lengthA, seam.lengthB}},
                             {"target", seam.target},
                             {"notches", seam.notches},
                             {"notchDifference", seam.notchOff}});
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : check.findings)
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  std::fputs((json.dump(2) + "\n").c_str(), stdout);
}

int runCheckSewing(const SewingArguments& arguments, const Session& session) {
  const std::filesystem::path seams = arguments.folder / "seams.json";
  const std::filesystem::path drawing =
      arguments.drawing.value_or(arguments.folder / "pattern.dxf");
  const Result<std::string> seamsText = readFile(seams, kMostDxfBytes);
  if (!seamsText) return fail(seamsText.error());
  const Result<std::string> dxfText = readFile(drawing, kMostDxfBytes);
  if (!dxfText) return fail(dxfText.error());
  const Result<DxfDrawing> read = readDxf(*dxfText, session.units);
  if (!read) return fail(read.error().during(drawing.string()));
  const Result<SewingCheck> check = checkSewing(*seamsText, *read);
  if (!check) return fail(check.error());
  print(*check, session);
  report(check->findings, session);
  return check->findings.empty() ? kDone : kFailed;
}

}  // namespace

void addCheckSewing(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<SewingArguments>();
  CLI::App* command = addCommand(
      app, session, "check-sewing", "Sew the pieces of a cutting file virtually: do the mates fit?",
      [arguments, &session] { return runCheckSewing(*arguments, session); });
  command->add_option("DIR", arguments->folder, "Folder that toile make wrote")->required();
  command
      ->add_option("--dxf", arguments->drawing,
                   "Another cutting file of the same pattern, such as one that came back from a "
                   "CAD program (default: pattern.dxf of the folder)")
      ->type_name("FILE");
}

}  // namespace toile::cli
