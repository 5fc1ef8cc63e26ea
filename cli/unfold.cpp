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
#include "toile/develop/darts.h"
#include "toile/mesh/mesh_file.h"

namespace toile::cli {
namespace {

struct UnfoldArguments {
  std::filesystem::path in, out;
  std::string objective = "least-strain";
  std::string weights = "length";
  std::string symmetry = "auto";
  std::string contact = "on";
  UnfoldOptions options;
  std::optional<Ratio> autoDart, elasticRange;
};

/// Of a patch whose faces were re-cut: the face of IN that each comes from, in their order.
std::string sourceFaces(const Patch& patch) {
  std::string out;
  for (const FaceId f : patch.sourceFace.values())
    out += fmt::format("# source-face {}\n", f.index() + 1);
  return out;
}

int runAutoDart(const UnfoldArguments& arguments, const UnfoldOptions& options,
                const MeshFile& file, const Session& session);

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
      {"elastics", nlohmann::ordered_json::array()},
      {"findings", nlohmann::ordered_json::array()}};
  for (const ElasticLine& line : flat.elastic.lines) {
    json["elastics"].push_back(
        {{"curve", line.curve}, {"range", line.range}, {"ratio", line.ratio}});
  }
  for (const Finding& finding : flat.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2) + "\n";
}

void print(const UnfoldArguments& arguments, const FlatPiece& flat, std::size_t faces,
           const Session& session) {
  if (session.json) {
    std::fputs(toJson(flat, faces).c_str(), stdout);
    return;
  }
  fmt::print(
      "{}: {} faces, area error {:.2f} % on average and {:.1f} % at most, wire lengths "
      "within {:.1e}, {} flipped, {} crossings\n",
      arguments.out.string(), faces, 100 * flat.meanAreaError, 100 * flat.maxAreaError,
      flat.check.maxLengthError, flat.check.flippedFaces, flat.check.crossings);
  for (const ElasticLine& line : flat.elastic.lines) {
    fmt::print("  elastic \"{}\": {:+.2f} % of the {:.3g} % allowed\n", line.curve,
               100 * line.ratio, 100 * line.range);
  }
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
  UnfoldOptions options = arguments.options;
  if (arguments.objective == "wirewarping") options.objective = UnfoldObjective::WireWarping;
  if (arguments.weights == "unit") options.weights = WireWeights::Unit;
  options.keepSymmetry = arguments.symmetry == "auto";
  options.keepApart = arguments.contact == "on";
  if (arguments.autoDart) return runAutoDart(arguments, options, *file, session);
  Result<Piece> piece =
      makePiece(arguments.in.stem().string(), file->mesh, file->chains, file->targets);
  if (!piece) return fail(piece.error().during(name));
  for (Wire& wire : piece->wires) {
    if (wire.kind != WireKind::Elastic) continue;
    wire.elasticRange =
        arguments.elasticRange ? arguments.elasticRange->value() : kUsualElasticRange;
  }
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
  print(arguments, *flat, file->mesh.faceCount(), session);
  return report(findings, session);
}

int runAutoDart(const UnfoldArguments& arguments, const UnfoldOptions& options,
                const MeshFile& file, const Session& session) {
  const Result<AutoDart> made =
      autoDart({file.mesh, file.chains, file.targets, {}}, arguments.in.stem().string(),
               *arguments.autoDart, {.unfold = options});
  if (!made) return fail(made.error().during(arguments.in.string()));
  const Patch& patch = made->patch;
  const std::string text =
      writePatchObj(patch.mesh, patch.chains, patch.targets, made->piece, *made->flat);
  const Result<void> written = writeFileWhole(arguments.out, text + sourceFaces(patch));
  if (!written) return fail(written.error());
  print(arguments, *made->flat, patch.mesh.faceCount(), session);
  if (!session.json) {
    fmt::print(
        "  before: {:.2f} %; the lengths alone force {:.2f} %, {:.2f} % was to be expected\n",
        100 * made->errorBefore, 100 * made->forced.bound, 100 * made->forced.estimate);
  }
  std::vector<Finding> findings = file.findings;
  findings.insert(findings.end(), made->findings.begin(), made->findings.end());
  findings.insert(findings.end(), made->flat->findings.begin(), made->flat->findings.end());
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
      ->add_option("--contact", arguments->contact,
                   "on: edges of a piece that would lie on itself are kept apart (default); off")
      ->check(CLI::IsMember({"on", "off"}))
      ->type_name("NAME");
  command
      ->add_option("--area-weight", arguments->options.areaWeight,
                   "Price of area change against shear, 0 to 1000 (default 2)")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("K");
  addParsed(*command, "--elastic-range", arguments->elasticRange, parseRatio,
            "How far the lengths of elastic lines may change (default 5%; 0% keeps them)")
      ->type_name("RATIO");
  addParsed(*command, "--auto-dart", arguments->autoDart, parseRatio,
            "Put in darts until the mean area error is at most this, such as 5%")
      ->type_name("RATIO");
}

}  // namespace toile::cli
