// SPDX-License-Identifier: GPL-3.0-or-later
// `toile develop`: a surface patch in a shape that lies flat better.
#include "toile/develop/develop.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "commands.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/model/reference_model.h"

namespace toile::cli {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Arguments {
  std::filesystem::path in, out;
  std::optional<std::filesystem::path> outsideOf;
  DevelopOptions options;
};

std::string toJson(const DevelopedPiece& developed) {
  const DevelopReport& r = developed.report;
  nlohmann::ordered_json json = {
      {"format", "toile-develop"},
      {"version", 1},
      {"t", developed.amount},
      {"meanAreaError",
       {{"before", r.errorBefore},
        {"againstProcessed", r.errorAgainstProcessed},
        {"againstOriginal", r.errorAgainstOriginal}}},
      {"angleDefect",
       {{"maxBefore", r.maxDefectBefore},
        {"max", r.maxDefect},
        {"totalBefore", r.totalDefectBefore},
        {"total", r.totalDefect}}},
      {"roughnessDegrees",
       {{"before", r.roughnessBefore * kDegrees}, {"after", r.roughness * kDegrees}}},
      {"maxNormalTurnDegrees", r.maxNormalTurn * kDegrees},
      {"maxMoveMm", r.maxMove},
      {"clearanceMm", r.clearance ? nlohmann::ordered_json(*r.clearance) : nullptr},
      {"features", nlohmann::ordered_json::array()},
      {"passes", developed.flat->check.passes()},
      {"findings", nlohmann::ordered_json::array()}};
  for (const FeatureChange& f : r.features) {
    json["features"].push_back(
        {{"curve", f.curve}, {"part", f.part}, {"beforeMm", f.before}, {"afterMm", f.after}});
  }
  for (const Finding& finding : developed.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2) + "\n";
}

void print(const std::filesystem::path& out, const DevelopedPiece& developed) {
  const DevelopReport& r = developed.report;
  fmt::print(
      "{}: t = {:.3f}, area error {:.2f} % -> {:.2f} % (against the surface as it was {:.2f} %)\n"
      "  angle sums miss 2 pi by {:.2g} rad at most (before {:.2g}), by {:.3g} rad in all (before "
      "{:.3g})\n"
      "  a vertex moved by {:.1f} mm at most, a face turned by {:.0f} degrees, roughness {:.1f} -> "
      "{:.1f} degrees\n",
      out.string(), developed.amount, 100 * r.errorBefore, 100 * r.errorAgainstProcessed,
      100 * r.errorAgainstOriginal, r.maxDefect, r.maxDefectBefore, r.totalDefect,
      r.totalDefectBefore, r.maxMove, r.maxNormalTurn * kDegrees, r.roughnessBefore * kDegrees,
      r.roughness * kDegrees);
  for (const FeatureChange& f : r.features) {
    fmt::print("  feature \"{}\": {:.1f} -> {:.1f} mm ({:+.2f} %)\n", f.curve, f.before, f.after,
               100 * (f.after / f.before - 1));
  }
  if (r.clearance) fmt::print("  nearest to the body: {:.2f} mm\n", *r.clearance);
}

/// The file's targets; those of lines inside the patch in the same proportion to the new lengths.
std::map<std::string, double> targetsOn(const MeshFile& file, const Mesh& shaped) {
  std::map<std::string, double> targets = file.targets;
  for (const PolygonSoup::Chain& chain : file.chains) {
    for (std::size_t i = 0; i + 1 < chain.vertices.size(); ++i) {
      const auto target = targets.find(fmt::format("{} {}", chain.group, i));
      if (target == targets.end()) continue;
      const EdgeId edge =
          file.mesh.findEdge(VertexId(chain.vertices[i]), VertexId(chain.vertices[i + 1]));
      target->second *= shaped.length(edge) / file.mesh.length(edge);
    }
  }
  return targets;
}

int run(Arguments& arguments, const Session& session) {
  const std::string name = arguments.in.string();
  const Result<MeshFile> file = readMesh(arguments.in, {.unit = session.units});
  if (!file) return fail(file.error());
  std::optional<ReferenceModel> body;
  if (arguments.outsideOf) {
    Result<ReferenceModel> model = readModel(*arguments.outsideOf, session.units);
    if (!model) return fail(model.error());
    body = *std::move(model);
    arguments.options.outsideOf = body->index;
  }
  const Result<Piece> piece =
      makePiece(arguments.in.stem().string(), file->mesh, file->chains, file->targets);
  if (!piece) return fail(piece.error().during(name));
  const Result<DevelopedPiece> developed = develop(*piece, arguments.options);
  if (!developed) return fail(developed.error().during(name));

  // Vertices that a dart doubled come after the file's own.
  const std::vector<Eigen::Vector3d>& at = developed->piece.mesh->positions();
  const auto own = static_cast<std::ptrdiff_t>(file->mesh.vertexCount());
  const Mesh shaped = file->mesh.withPositions({at.begin(), at.begin() + own});
  const Result<void> written =
      writeFileWhole(arguments.out, writePatchObj(shaped, file->chains, targetsOn(*file, shaped),
                                                  developed->piece, *developed->flat));
  if (!written) return fail(written.error());
  if (session.json) {
    std::fputs(toJson(*developed).c_str(), stdout);
  } else {
    print(arguments.out, *developed);
  }
  std::vector<Finding> findings = file->findings;
  findings.insert(findings.end(), developed->findings.begin(), developed->findings.end());
  findings.insert(findings.end(), developed->flat->findings.begin(),
                  developed->flat->findings.end());
  return report(findings, session);
}

}  // namespace

void addDevelop(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(app, session, "develop",
                                 "Bend one surface patch, border held, so that it lies flat better",
                                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("IN", arguments->in, "Model file of the patch; chains (`l`) become wires")
      ->required();
  command
      ->add_option("-o,--output", arguments->out,
                   "OBJ file to write: the processed patch, with `vt` in mm")
      ->required()
      ->type_name("FILE");
  CLI::Option* amount = command
                            ->add_option("-t,--amount", arguments->options.amount,
                                         "How far to go, 0 (not at all) to 1 (default)")
                            ->check(CLI::Range(0.0, 1.0))
                            ->type_name("T");
  addParsed(*command, "--max-area-error", arguments->options.maxAreaError, parseRatio,
            "Go only as far as this mean area error in the plane needs, such as 3%")
      ->excludes(amount)
      ->type_name("RATIO");
  CLI::Option* outside =
      command
          ->add_option("--outside-of", arguments->outsideOf, "A body that the patch must not enter")
          ->type_name("MODEL");
  addParsed(*command, "--gap", arguments->options.gap, parseLength,
            "Least distance from that body (default 0mm)")
      ->needs(outside)
      ->type_name("LENGTH");
}

}  // namespace toile::cli
