// SPDX-License-Identifier: GPL-3.0-or-later
// `toile scan`: a clean closed model from what a scanner gives.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "terminal_progress.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/render/render.h"
#include "toile/scan/clean_scan.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path in, out;
  std::optional<std::filesystem::path> reportFile, picture;
  CleanOptions options;
  std::optional<Length> edge;
};

Result<ScanKind> parseKind(std::string_view text) {
  if (text == "body") return ScanKind::Body;
  if (text == "object") return ScanKind::Object;
  return Error{ErrorCode::InvalidArgument,
               fmt::format("\"{}\" is no kind of scan; body or object", text),
               {}};
}

Result<InwardFaces> parseInwardFaces(std::string_view text) {
  if (text == "turned") return InwardFaces::Turned;
  if (text == "mirrored") return InwardFaces::Mirrored;
  return Error{ErrorCode::InvalidArgument,
               fmt::format("\"{}\" does not say why faces look inwards; turned or mirrored", text),
               {}};
}

void print(const CleanedScan& cleaned) {
  const CleanReport& r = cleaned.report;
  const Mesh& mesh = *cleaned.model.mesh;
  fmt::print("{}: {} triangles with edges of {:.3g} mm, {:.0f} mm high\n", cleaned.model.name,
             mesh.faceCount(), r.edge, r.height);
  fmt::print("  scan to model  mean {:.2f}  95 % {:.2f}  largest {:.1f} mm\n", r.scanToModel.mean,
             r.scanToModel.percentile95, r.scanToModel.largest);
  fmt::print("  left out: {} lone points, {} loose parts\n", r.lonePoints, r.flyingParts);
  fmt::print("  invented: {:.0f} cm2, {:.1f} % of the surface\n", r.inventedArea / 100,
             100 * r.inventedShare);
  for (const InventedPatch& patch : r.invented) {
    fmt::print("    {:7.1f} cm2  {} (at {:.0f}, {:.0f}, {:.0f})\n", patch.area / 100, patch.place,
               patch.centre.x(), patch.centre.y(), patch.centre.z());
  }
}

Result<void> writeFiles(const Arguments& arguments, const CleanedScan& cleaned,
                        Progress& progress) {
  const Mesh& mesh = *cleaned.model.mesh;
  const std::string text = arguments.out.extension() == ".obj" ? writeObj(mesh) : writePly(mesh);
  if (Result<void> done = writeFileWhole(arguments.out, text); !done) return done;
  if (arguments.reportFile) {
    Result<void> done = writeFileWhole(*arguments.reportFile, writeCleanReport(cleaned));
    if (!done) return done;
  }
  if (!arguments.picture) return {};
  progress.step("draw the picture");
  RenderOptions look;
  look.style = RenderStyle::Plain;
  look.views = {{"from above", Angle::degrees(25), Angle::degrees(30)},
                {"from below", Angle::degrees(-25), Angle::degrees(-30)}};
  const Result<std::string> png = renderModel(cleaned.model, look, &progress);
  if (!png) return png.error();
  return writeFileWhole(*arguments.picture, *png);
}

int run(const Arguments& arguments, const Session& session) {
  CleanOptions options = arguments.options;
  options.edge = arguments.edge;
  const Result<Scan> scan = readRawScan(arguments.in, session.units, options.kind);
  if (!scan) return fail(scan.error());
  TerminalProgress progress;
  const Result<CleanedScan> cleaned = cleanScan(*scan, options, &progress);
  if (!cleaned) return fail(cleaned.error());
  const Result<void> written = writeFiles(arguments, *cleaned, progress);
  if (!written) return fail(written.error());
  if (session.json) {
    std::fputs(writeCleanReport(*cleaned).c_str(), stdout);
  } else {
    print(*cleaned);
  }
  return report(cleaned->report.findings, session);
}

}  // namespace

void addScan(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "scan", "A clean closed model from a scan with holes and noise",
                 [arguments, &session] { return run(*arguments, session); });
  command
      ->add_option("IN", arguments->in,
                   "What the scanner wrote: a mesh (OBJ, PLY, STL, OFF) or points without faces")
      ->required();
  command->add_option("-o,--output", arguments->out, "PLY or OBJ file for the model")
      ->type_name("FILE")
      ->required();
  addParsed(*command, "--kind", arguments->options.kind, parseKind,
            "What was scanned: body (the default) or object")
      ->type_name("KIND");
  addParsed(*command, "--edge", arguments->edge, parseLength,
            "Edge length of the model's triangles (default: 8mm for a body, a 200th of an object's "
            "diagonal)")
      ->type_name("LENGTH");
  addParsed(*command, "--inward-faces", arguments->options.inwardFaces, parseInwardFaces,
            "Why the faces of the file look inwards, when asked: turned or mirrored")
      ->type_name("WHY");
  command->add_option("--report", arguments->reportFile, "JSON file for the report")
      ->type_name("FILE");
  command
      ->add_option("--picture", arguments->picture,
                   "PNG file for a picture with lines around what was invented")
      ->type_name("FILE");
}

}  // namespace toile::cli
