// SPDX-License-Identifier: GPL-3.0-or-later
// `toile fit`: the template's connectivity in the scan's shape.
#include "toile/fit/fit.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "terminal_progress.h"
#include "toile/body/fit_body.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/shape/builtin.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::string model;
  std::filesystem::path scan;
  std::optional<std::filesystem::path> out, reportFile, landmarks;
  std::vector<std::filesystem::path> family;
  Length landmarkError = FitOptions{}.landmarkError;
  bool isKept = false;
};

Result<ReferenceModel> loadModel(const std::string& reference, std::optional<FileUnit> unit) {
  return isBuiltin(reference) ? makeBuiltinModel(reference) : readModel(reference, unit);
}

void print(const Fit& fit) {
  const FitReport& r = fit.report;
  const auto line = [](const char* what, const DistanceSummary& d) {
    fmt::print("  {:<12} mean {:6.2f}  median {:6.2f}  95 % {:6.2f}  largest {:6.1f} mm\n", what,
               d.mean, d.median, d.percentile95, d.largest);
  };
  fmt::print("{}: {}\n", fit.model.name, r.isOk() ? "ok" : "FAILED");
  line("scan to fit", r.scanToFit);
  line("fit to scan", r.fitToScan);
  line("round trip", r.roundTrip);
  if (r.landmarks.largest > 0) line("landmarks", r.landmarks);
  fmt::print("  no scan near {:.1f} % of the model, {:.1f} % of the scan far from it\n",
             100 * r.missingShare, 100 * r.strayShare);
  fmt::print("  {} triangles turned over, {} pairs crossing; scale {:.3f}; family of {}\n",
             r.flippedFaces, r.crossings, r.scale, r.familySize);
  for (const FitRegion& region : r.regions) {
    if (r.regions.size() == 1) break;
    fmt::print("  {:<16} mean {:5.2f}  95 % {:5.2f} mm{}\n", region.name, region.scanToFit.mean,
               region.scanToFit.percentile95,
               region.missingShare < 0.01
                   ? ""
                   : fmt::format("  ({:.0f} % not on the scan)", 100 * region.missingShare));
  }
}

/// The parametric body without measures of its own finds them from the scan.
bool isParametricBody(const Arguments& arguments) {
  return arguments.model == "builtin:body@1" && arguments.family.empty();
}

Result<BodyFit> fitFromFiles(const Arguments& arguments, const Session& session) {
  const Result<Scan> scan = readScan(arguments.scan, session.units);
  if (!scan) return scan.error();
  report(scan->findings, session);
  std::map<std::string, Eigen::Vector3d> landmarks;
  if (arguments.landmarks) {
    const Result<std::string> text = readFile(*arguments.landmarks);
    if (!text) return text.error();
    auto places = parseScanLandmarks(*text, arguments.landmarks->string());
    if (!places) return places.error();
    landmarks = *std::move(places);
  }
  TerminalProgress progress;
  if (isParametricBody(arguments)) {
    BodyFitOptions options;
    options.landmarks = std::move(landmarks);
    options.landmarkError = arguments.landmarkError;
    return fitBody(*scan, options, &progress);
  }
  const Result<ReferenceModel> model = loadModel(arguments.model, session.units);
  if (!model) return model.error();
  FitOptions options;
  options.landmarks = std::move(landmarks);
  options.landmarkError = arguments.landmarkError;
  for (const std::filesystem::path& file : arguments.family) {
    const Result<ReferenceModel> member = loadModel(file.string(), session.units);
    if (!member) return member.error();
    options.family.push_back(member->mesh);
  }
  Result<Fit> fit = fitTemplate(*model, *scan, options, &progress);
  if (!fit) return fit.error();
  return BodyFit{*std::move(fit), {}, {}};
}

int run(const Arguments& arguments, const Session& session) {
  const Result<BodyFit> fitted = fitFromFiles(arguments, session);
  if (!fitted) return fail(fitted.error());
  const Fit* fit = &fitted->fit;
  const bool isGood = fit->report.isOk();
  if (arguments.out && (isGood || arguments.isKept)) {
    const std::string text = arguments.out->extension() == ".obj" ? writeObj(*fit->model.mesh)
                                                                  : writePly(*fit->model.mesh);
    if (const Result<void> done = writeFileWhole(*arguments.out, text); !done) {
      return fail(done.error());
    }
  }
  if (arguments.reportFile) {
    const Result<void> done = writeFileWhole(*arguments.reportFile, writeFitReport(*fit));
    if (!done) return fail(done.error());
  }
  if (session.json) {
    std::fputs(writeFitReport(*fit).c_str(), stdout);
  } else {
    print(*fit);
    for (std::size_t i = 0; i < fitted->measures.size(); ++i) {
      fmt::print("  {:<16} {:7.1f} mm\n", bodyMeasures()[i].name, fitted->measures[i].mm());
    }
  }
  for (const Finding& reason : fit->report.reasons) {
    fmt::print(stderr, "toile: {}: {} [{}]\n", arguments.scan.string(), reason.message,
               reason.code);
  }
  const int status = report(fit->report.findings, session);
  if (isGood) return status;
  if (arguments.out && !arguments.isKept) {
    fmt::print(stderr, "toile: {} is not written; --keep-failed writes it all the same\n",
               arguments.out->string());
  }
  return kFailed;
}

}  // namespace

void addFit(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "fit", "The template's connectivity in the shape of a scan",
                 [arguments, &session] { return run(*arguments, session); });
  command
      ->add_option("TEMPLATE", arguments->model,
                   "The model to be fitted: OBJ, PLY, STL, OFF, *.model.json, builtin:...")
      ->required();
  command->add_option("SCAN", arguments->scan, "A mesh, or points without faces, of such a model")
      ->required();
  command->add_option("-o,--output", arguments->out, "PLY or OBJ file for the fitted mesh")
      ->type_name("FILE");
  command->add_option("--report", arguments->reportFile, "JSON file for the report")
      ->type_name("FILE");
  command
      ->add_option("--family", arguments->family,
                   "Other models on the template's connectivity: how such models differ")
      ->type_name("FILE");
  command
      ->add_option("--landmarks", arguments->landmarks,
                   "JSON file of places on the scan by the template's names")
      ->type_name("FILE");
  addParsed(*command, "--landmark-error", arguments->landmarkError, parseLength,
            "How far those places may be off (default 5mm)")
      ->type_name("LENGTH");
  command->add_flag("--keep-failed", arguments->isKept,
                    "Write the fitted mesh even when it misses the limits");
}

}  // namespace toile::cli
