// SPDX-License-Identifier: GPL-3.0-or-later
// `toile nest`: markers, the pieces of one or more orders on their materials.
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
#include "toile/io/dxf.h"
#include "toile/io/hpgl.h"
#include "toile/io/pdf.h"
#include "toile/io/svg.h"
#include "toile/pipeline.h"
#include "toile/pipeline/marker.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> designs;
  std::vector<std::string> bodies;
  std::filesystem::path folder = "out";
  std::optional<std::filesystem::path> hide;
  std::optional<Length> gap, margin;
  MarkerOptions options;
  PdfOptions pdf{.paper = PdfPaper::OneSheet};
  bool autoCut = false;
};

std::vector<Eigen::Vector2d> readPolygon(const nlohmann::json& json) {
  constexpr double kFarthestMm = 1e6;
  std::vector<Eigen::Vector2d> polygon;
  for (const nlohmann::json& point : json) {
    polygon.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
    if (!(polygon.back().cwiseAbs().maxCoeff() <= kFarthestMm)) throw std::out_of_range("far");
  }
  return polygon;
}

/// {"outline": [[x, y], ...], "faults": [[[x, y], ...], ...]}, mm.
Result<NestMaterial> readHide(const std::filesystem::path& path) {
  constexpr std::size_t kMostBytes = std::size_t{16} << 20U;
  const Result<std::string> text = readFile(path, kMostBytes);
  if (!text) return text.error();
  try {
    const nlohmann::json json = nlohmann::json::parse(*text);
    NestMaterial material;
    material.hide = readPolygon(json.at("outline"));
    if (json.contains("faults"))
      for (const nlohmann::json& fault : json.at("faults"))
        material.faults.push_back(readPolygon(fault));
    return material;
  } catch (const std::exception&) {
    return Error{ErrorCode::FileFormat,
                 path.string() +
                     ": a hide is {\"outline\": [[x, y], ...], \"faults\": [[[x, y], "
                     "...], ...]} in mm, counter-clockwise, x and y from 0 on",
                 {}};
  }
}

/// Every design on every body; a design that names its own body stands alone.
Result<std::vector<Pattern>> makeOrders(const Arguments& arguments, const Session& session,
                                        Progress& progress, int& status) {
  std::vector<Pattern> orders;
  for (const std::filesystem::path& design : arguments.designs) {
    std::vector<std::optional<std::string>> bodies(arguments.bodies.begin(),
                                                   arguments.bodies.end());
    if (bodies.empty()) bodies.emplace_back();
    for (const std::optional<std::string>& body : bodies) {
      progress.step("make " + design.string() + (body ? " for " + *body : ""));
      const Result<Document> document = openDocument(design, body, session.units);
      if (!document) return document.error();
      MakeOptions options;
      options.autoCut = arguments.autoCut;
      Result<Pattern> pattern = makePattern(*document, options);
      if (!pattern) return pattern.error().during(design.string());
      if (const int told = report(pattern->findings, session); told != kDone) status = told;
      for (const std::optional<Error>& failure : pattern->failures)
        if (failure) status = fail(*failure);
      orders.push_back(*std::move(pattern));
    }
  }
  return orders;
}

/// A name for a file: letters, digits, - and _ stay.
std::string fileWord(const std::string& id) {
  std::string out;
  for (const char c : id) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '-' || c == '_';
    out += isPlain ? c : '_';
  }
  return out;
}

/// A marker in every format: name and content of each file.
using Files = std::vector<std::pair<std::string, Result<std::string>>>;
Files filesOf(const Marker& marker, const Arguments& arguments) {
  const std::string name = marker.fabric.empty() ? "marker" : "marker-" + fileWord(marker.fabric);
  PdfOptions pdf = arguments.pdf;
  // A page of PDF ends at 5 m.
  const bool isLong = (marker.sheet.max - marker.sheet.min).maxCoeff() > kMostPdfSheetMm;
  if (isLong && pdf.paper == PdfPaper::OneSheet) pdf.paper = PdfPaper::A0;
  return {{name + ".svg", writeSvg(marker.sheet)},
          {name + ".dxf", writeLaserDxf(marker.sheet)},
          {name + ".plt", writeHpgl(marker.sheet)},
          {name + ".pdf", writePdf(marker.sheet, pdf)}};
}

int run(Arguments& arguments, const Session& session) {
  TerminalProgress progress;
  MarkerOptions& options = arguments.options;
  if (arguments.gap) options.nest.gap = arguments.gap->mm();
  if (arguments.margin) options.nest.margin = arguments.margin->mm();
  if (arguments.hide) {
    Result<NestMaterial> hide = readHide(*arguments.hide);
    if (!hide) return fail(hide.error());
    options.hide = *std::move(hide);
  }
  int status = kDone;
  const Result<std::vector<Pattern>> orders = makeOrders(arguments, session, progress, status);
  if (!orders) return fail(orders.error());
  progress.step("nest the pieces");
  options.nest.onBetter = [&progress](double length) {
    progress.step(fmt::format("nest the pieces: {:.0f} mm", length));
  };
  const Result<std::vector<Marker>> markers = makeMarkers(*orders, options, &progress);
  if (!markers) return fail(markers.error());

  progress.step("write the files");
  // Nothing is written before all of it is there.
  std::vector<Files> files;
  for (const Marker& marker : *markers) {
    files.push_back(filesOf(marker, arguments));
    for (const auto& [name, content] : files.back())
      if (!content) return fail(content.error().during(name));
    if (const int told = report(marker.findings, session); told != kDone) status = told;
  }
  if (const Result<void> made = makeFolder(arguments.folder); !made) return fail(made.error());
  for (const Files& ofMarker : files) {
    for (const auto& [name, content] : ofMarker)
      if (const Result<void> done = writeFileWhole(arguments.folder / name, *content); !done)
        return fail(done.error());
  }
  const std::string figures = writeMarkersJson(*markers);
  if (const Result<void> done = writeFileWhole(arguments.folder / "markers.json", figures); !done)
    return fail(done.error());
  if (session.json) {
    std::printf("%s", figures.c_str());
    return status;
  }
  for (const Marker& marker : *markers) {
    const Nesting& nesting = marker.nesting;
    const std::string sheets =
        nesting.sheets > 1 ? fmt::format(" on sheet {} of", nesting.sheets) : "";
    std::printf("%s\n",
                fmt::format("{}{}{} pieces,{} {:.0f} mm of {:.0f} mm width, {:.1f} % used",
                            marker.name, marker.name.empty() ? "" : ": ", nesting.places.size(),
                            sheets, nesting.length, marker.width, 100 * nesting.utilisation)
                    .c_str());
  }
  return status;
}

}  // namespace

void addNest(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(app, session, "nest",
                                 "A marker: the pieces of one or more orders on their material",
                                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("DESIGN", arguments->designs, "The designs, .toile files")->required();
  command
      ->add_option("--body", arguments->bodies,
                   "Make each design for this model instead of its own; several: for each of them")
      ->allow_extra_args(false)
      ->type_name("MODEL");
  command->add_option("-o,--output", arguments->folder, "Folder for the files")
      ->type_name("DIR")
      ->capture_default_str();
  addParsed(*command, "--width", arguments->options.width, parseLength,
            "Width of the roll or sheet (default: the fabric's, else 1400mm)")
      ->type_name("LENGTH");
  addParsed(*command, "--length", arguments->options.length, parseLength,
            "Sheets of that length instead of a roll")
      ->type_name("LENGTH");
  command
      ->add_option("--hide", arguments->hide,
                   "A hide instead: JSON with \"outline\" and \"faults\" in mm")
      ->type_name("FILE");
  addParsed(*command, "--gap", arguments->gap, parseLength,
            "Least distance between cut lines (default: 5mm)")
      ->type_name("LENGTH");
  addParsed(*command, "--margin", arguments->margin, parseLength,
            "Least distance from the edges of the material (default: 0mm)")
      ->type_name("LENGTH");
  addChoice<Turns>(*command, "--turns", arguments->options.turns,
                   {{"one-way", Turns::OneWay}, {"two-way", Turns::TwoWay}, {"any", Turns::Any}},
                   "How pieces may lie, instead of what the fabric says (nap, grain, neither)");
  command->add_flag("--fold", arguments->options.fold,
                    "Lay the cloth double: symmetric pieces are cut on its fold, mirrored ones "
                    "together");
  addPaper(*command, arguments->pdf);
  command->add_option("--copies", arguments->options.copies, "Copies of each order")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--pairs", arguments->options.pairs,
                    "Each piece also turned over, as for left and right shoes");
  command
      ->add_option("--effort", arguments->options.nest.effort,
                   "0: the first marker found; each further level takes about twice as long")
      ->check(CLI::Range(0, kMostEffort))
      ->capture_default_str();
  addAutoCut(*command, arguments->autoCut);
}

}  // namespace toile::cli
