// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/symmetrise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"

namespace toile::cli {
namespace {

struct UnfoldArguments {
  std::filesystem::path in, out;
  std::string objective = "least-strain";
  std::string weights = "length";
  std::string symmetry = "auto";
  UnfoldOptions options;
};

std::string toJson(const FlatPiece& flat, std::size_t faces) {
  nlohmann::ordered_json json = {
      {"format", "toile-unfold"},
      {"version", 1},
      {"faces", faces},
      {"meanAreaError", flat.meanAreaError},
      {"maxAreaError", flat.maxAreaError},
      {"steps", flat.steps},
      {"wireStiffness", flat.wireStiffness},
      {"wireBending", flat.wireBending},
      {"check",
       {{"passes", flat.check.passes()},
        {"maxLengthError", flat.check.maxLengthError},
        {"maxClosureGapMm", flat.check.maxClosureGap},
        {"flippedFaces", flat.check.flippedFaces},
        {"crossings", flat.check.crossings},
        {"maxTurnErrorDegrees", flat.check.maxTurnError * 180 / std::numbers::pi}}},
      {"findings", nlohmann::ordered_json::array()}};
  for (const Finding& finding : flat.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2) + "\n";
}

/// The piece with symmetric data if it is symmetric but not to rounding: that unfold() sees itself.
std::optional<SymmetricPiece> nearlySymmetric(const Piece& piece, const UnfoldOptions& options) {
  constexpr double kTolerance = 0.005;
  constexpr double kToRounding = 1e-11;
  const bool hasDart = std::any_of(piece.wires.begin(), piece.wires.end(),
                                   [](const Wire& w) { return w.kind == WireKind::Dart; });
  if (hasDart || options.objective != UnfoldObjective::LeastStrain) return std::nullopt;
  std::optional<SymmetricPiece> symmetric = symmetrise(piece, kTolerance);
  if (symmetric && symmetric->addedVertices == 0 && symmetric->maxLengthChange < kToRounding) {
    return std::nullopt;
  }
  return symmetric;
}

int runUnfold(const UnfoldArguments& arguments, const Session& session) {
  const std::string name = arguments.in.string();
  const Result<MeshFile> file = readMesh(arguments.in, {.unit = session.units});
  if (!file) return fail(file.error());
  const Result<Piece> piece =
      makePiece(arguments.in.stem().string(), file->mesh, file->chains, file->targets);
  if (!piece) return fail(piece.error().during(name));
  UnfoldOptions options = arguments.options;
  if (arguments.objective == "wirewarping") options.objective = UnfoldObjective::WireWarping;
  if (arguments.weights == "unit") options.weights = WireWeights::Unit;
  options.keepSymmetry = arguments.symmetry == "auto";
  const std::optional<SymmetricPiece> symmetric =
      options.keepSymmetry ? nearlySymmetric(*piece, options) : std::nullopt;
  const Result<FlatPiece> flat = symmetric ? unfold(*symmetric, options) : unfold(*piece, options);
  if (!flat) return fail(flat.error().during(name));
  const Result<void> written = writeFileWhole(
      arguments.out, symmetric
                         ? writePatchObj(*symmetric, *flat)
                         : writePatchObj(file->mesh, file->chains, file->targets, *piece, *flat));
  if (!written) return fail(written.error());

  std::vector<Finding> findings = file->findings;
  if (symmetric) {
    findings.push_back(
        {"made-symmetric",
         fmt::format("the outline is within {:.2g} mm of its mirror image and was made symmetric: "
                     "{} points added, lengths changed by {:.2g} % at most",
                     symmetric->asymmetry, symmetric->addedVertices,
                     100 * symmetric->maxLengthChange),
         {}});
  }
  findings.insert(findings.end(), flat->findings.begin(), flat->findings.end());
  if (session.json) {
    std::fputs(toJson(*flat, file->mesh.faceCount()).c_str(), stdout);
  } else {
    fmt::print(
        "{}: {} faces, area error {:.2f} % on average and {:.1f} % at most, wire lengths "
        "within {:.1e}, {} flipped, {} crossings\n",
        arguments.out.string(), file->mesh.faceCount(), 100 * flat->meanAreaError,
        100 * flat->maxAreaError, flat->check.maxLengthError, flat->check.flippedFaces,
        flat->check.crossings);
  }
  return report(findings, session);
}

}  // namespace

void addUnfold(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<UnfoldArguments>();
  CLI::App* command =
      addCommand(app, session, "unfold", "Lay one surface patch flat with exact wire lengths",
                 [arguments, &session] { return runUnfold(*arguments, session); });
  command->add_option("IN", arguments->in, "Model file of the patch; chains (`l`) become wires")
      ->required();
  command->add_option("-o,--output", arguments->out, "OBJ file to write, with `vt` in mm")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--objective", arguments->objective,
                   "least-strain: of the cloth (default); wirewarping: bend the wires the least")
      ->check(CLI::IsMember({"least-strain", "wirewarping"}))
      ->type_name("NAME");
  command
      ->add_option("--weights", arguments->weights,
                   "How corners count in wirewarping: by length of wire (default), or unit")
      ->check(CLI::IsMember({"length", "unit"}))
      ->type_name("NAME");
  command
      ->add_option("--symmetry", arguments->symmetry,
                   "auto: a nearly symmetric piece comes out symmetric (default); off")
      ->check(CLI::IsMember({"auto", "off"}))
      ->type_name("NAME");
  command
      ->add_option("--area-weight", arguments->options.areaWeight,
                   "Price of area change against shear, 0 to 1000 (default 2)")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("K");
}

}  // namespace toile::cli
