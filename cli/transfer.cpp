// SPDX-License-Identifier: GPL-3.0-or-later
// `toile transfer`: a design carried over to another model.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "design_files.h"
#include "terminal_progress.h"
#include "toile/core/file.h"
#include "toile/pipeline.h"
#include "toile/pipeline/carry.h"
#include "toile/shape/builtin.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path design, out;
  std::string to;
  std::optional<std::filesystem::path> reportFile, landmarks;
  CarryOptions options;
  bool isRaw = false;
};

Result<ReferenceModel> loadModel(const std::string& reference, std::optional<FileUnit> unit) {
  return isBuiltin(reference) ? makeBuiltinModel(reference) : readModel(reference, unit);
}

void print(const CarriedDesign& carried, const Arguments& arguments) {
  if (carried.fit) {
    fmt::print("fit: {:.2f} mm mean distance to the model, {:.1f} % of it not reached\n",
               carried.fit->report.scanToFit.mean, 100 * carried.fit->report.missingShare);
  }
  fmt::print("{:<22} {:>8} {:>8}  {:>12}  {:>9}\n", "line", "was mm", "is mm", "bends", "moved mm");
  for (const TransferredCurve& curve : carried.transfer.curves) {
    fmt::print("{:<22} {:8.1f} {:8.1f}  {:>2} -> {:>2} -> {:>2}  {:9.2f}  {}\n", curve.id,
               curve.lengthBefore.mm(), curve.lengthAfter.mm(), curve.bendsBefore,
               curve.bendsCarried, curve.bendsAfter, curve.deviation.mm(), toString(curve.fairing));
  }
  fmt::print("{}\n", arguments.out.string());
}

int run(Arguments arguments, const Session& session) {
  TerminalProgress progress;
  const Result<Document> document = openDocument(arguments.design, std::nullopt, session.units);
  if (!document) return fail(document.error());
  Result<ReferenceModel> target = loadModel(arguments.to, session.units);
  if (!target) return fail(target.error());
  if (arguments.landmarks) {
    const Result<std::string> text = readFile(*arguments.landmarks);
    if (!text) return fail(text.error());
    auto places = parseScanLandmarks(*text, arguments.landmarks->string());
    if (!places) return fail(places.error());
    arguments.options.fit.landmarks = *std::move(places);
  }
  arguments.options.transfer.fair = !arguments.isRaw;
  Result<CarriedDesign> carried =
      carryToModel(*document, std::make_shared<const ReferenceModel>(*std::move(target)),
                   arguments.options, &progress);
  if (!carried) return fail(carried.error());
  const Document& made = carried->transfer.document;
  if (const auto done = isBuiltin(arguments.to)
                            ? writeDesignFor(*made.design, arguments.to, arguments.out)
                            : writeDesignAndModel(made, arguments.out);
      !done) {
    return fail(done.error());
  }
  const std::string reportText = writeTransferReport(carried->transfer);
  if (arguments.reportFile) {
    const auto done = writeFileWhole(*arguments.reportFile, reportText);
    if (!done) return fail(done.error());
  }
  if (session.json) {
    std::fputs(reportText.c_str(), stdout);
  } else {
    print(*carried, arguments);
  }
  return report(carried->transfer.findings, session);
}

}  // namespace

void addTransfer(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(app, session, "transfer", "Carry a design over to another model",
                                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("DESIGN", arguments->design, "The design, a .toile file")->required();
  command
      ->add_option("--to", arguments->to,
                   "The other model: a mesh file, a .model.json or builtin:...")
      ->type_name("MODEL")
      ->required();
  command
      ->add_option("-o,--output", arguments->out,
                   "The design on that model, a .toile file; the model's mesh and names go beside "
                   "it")
      ->type_name("FILE")
      ->required();
  command->add_option("--report", arguments->reportFile, "JSON file for what became of each line")
      ->type_name("FILE");
  command->add_flag("--raw", arguments->isRaw, "Do not make the lines smooth again");
  command
      ->add_option("--keep", arguments->options.transfer.keep,
                   "A line that is not to be made smooth again; may be given often")
      ->type_name("ID");
  addParsed(*command, "--max-deviation", arguments->options.transfer.maxDeviation, parseLength,
            "How far smoothing may move a line (default 25mm)")
      ->type_name("LENGTH");
  command
      ->add_option("--landmarks", arguments->landmarks,
                   "JSON file of places on a model of other connectivity by the names of the "
                   "design's own")
      ->type_name("FILE");
}

}  // namespace toile::cli
