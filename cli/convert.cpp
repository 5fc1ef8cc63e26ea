// SPDX-License-Identifier: GPL-3.0-or-later
// `toile convert`: pattern files of other programs.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "common_options.h"
#include "toile/core/file.h"
#include "toile/io/dxf.h"
#include "toile/io/dxf_file.h"
#include "toile/io/hpgl.h"
#include "toile/io/pdf.h"
#include "toile/io/svg.h"

namespace toile::cli {
namespace {

struct ConvertArguments {
  std::filesystem::path in;
  std::optional<std::filesystem::path> out;
  std::optional<std::string> size;
  PdfOptions pdf;
  bool laser = false;
};

/// The pattern as the ending of the file asks for.
Result<std::string> write(const ConvertArguments& arguments, const DxfDrawing& drawing,
                          const Pattern& pattern) {
  const std::string ending = arguments.out->extension().string();
  if (ending == ".dxf" && !arguments.laser) return writeDxf(drawing);
  const SheetDrawing sheet = drawSheet(pattern);
  if (ending == ".dxf") return writeLaserDxf(sheet);
  if (ending == ".svg") return writeSvg(sheet);
  if (ending == ".pdf") return writePdf(sheet, arguments.pdf);
  if (ending == ".plt" || ending == ".hpgl") return writeHpgl(sheet);
  return Error{ErrorCode::InvalidArgument,
               fmt::format("{}: give a file name that ends in .dxf, .svg, .pdf or .plt",
                           arguments.out->string()),
               {}};
}

double length(const Outline& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (loop[(i + 1) % loop.size()].position - loop[i].position).norm();
  return sum;
}

double area(const Outline& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i].position;
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()].position;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

nlohmann::ordered_json toJson(const PatternPiece& piece) {
  return {{"block", piece.id},
          {"name", piece.name},
          {"count", piece.count},
          {"cutAreaMm2", area(piece.cutLines.front())},
          {"cutLengthMm", length(piece.cutLines.front())},
          {"sewAreaMm2", area(piece.sewLines.front())},
          {"sewLengthMm", length(piece.sewLines.front())},
          {"cutVertices", piece.cutLines.front().size()},
          {"holes", piece.cutLines.size() - 1},
          {"notches", piece.notches.size()},
          {"drillHoles", piece.drillHoles.size()},
          {"innerLines", piece.internalLines.size()}};
}

void printPieces(const std::string& name, const Pattern& pattern, const Session& session) {
  if (session.json) {
    nlohmann::ordered_json json{{"format", "toile-convert"}, {"version", 1}, {"file", name}};
    json["pieces"] = nlohmann::ordered_json::array();
    for (const PatternPiece& piece : pattern.pieces) json["pieces"].push_back(toJson(piece));
    std::fputs((json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(),
               stdout);
    return;
  }
  for (const PatternPiece& piece : pattern.pieces)
    fmt::print("{}: cut {}, {:.1f} cm2, cut line {:.1f} mm, sew line {:.1f} mm, {} notches\n",
               piece.name, piece.count, area(piece.cutLines.front()) / 100,
               length(piece.cutLines.front()), length(piece.sewLines.front()),
               piece.notches.size());
}

int runConvert(const ConvertArguments& arguments, const Session& session) {
  const std::string name = arguments.in.string();
  const Result<std::string> text = readFile(arguments.in, kMostDxfBytes);
  if (!text) return fail(text.error());
  const Result<DxfDrawing> drawing = readDxf(*text, session.units);
  if (!drawing) return fail(drawing.error().during(name));
  Result<Pattern> pattern = patternFrom(*drawing, arguments.in.stem().string(), arguments.size);
  if (!pattern) return fail(pattern.error());
  if (arguments.out) {
    const Result<std::string> bytes = write(arguments, *drawing, *pattern);
    if (!bytes) return fail(bytes.error());
    if (const Result<void> done = writeFileWhole(*arguments.out, *bytes); !done)
      return fail(done.error());
  }
  printPieces(name, *pattern, session);
  return report(pattern->findings, session);
}

}  // namespace

void addConvert(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command =
      addCommand(app, session, "convert", "Read a pattern DXF of any program, write it anew",
                 [arguments, &session] { return runConvert(*arguments, session); });
  command->add_option("IN", arguments->in, "The pattern, a DXF (AAMA or ASTM)")->required();
  command
      ->add_option("-o,--output", arguments->out,
                   "File to write: .dxf as it was read, .svg, .plt, or .pdf in tiles for a printer")
      ->type_name("OUT");
  addPaper(*command, arguments->pdf);
  command->add_flag("--laser", arguments->laser,
                    "Write a .dxf of plain lines for a laser: cut red, mark blue, engrave green");
  command
      ->add_option("--size", arguments->size,
                   "The size to draw, of a file with several (default: the sample size)")
      ->type_name("SIZE");
}

}  // namespace toile::cli
