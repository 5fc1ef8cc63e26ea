// SPDX-License-Identifier: GPL-3.0-or-later
// `toile map`: the guiding map of a model, as a picture and for its model file.
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
#include "toile/model/guiding_map.h"
#include "toile/pipeline.h"
#include "toile/render/map_picture.h"
#include "toile/shape/builtin.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::string in;
  std::optional<std::string> body;
  std::vector<std::string> borders;
  std::filesystem::path out;
  MapPictureOptions options;
};

struct Made {
  Result<std::string> content;
  std::vector<Finding> findings;
  nlohmann::ordered_json charts = nlohmann::ordered_json::array();
};

void tellCharts(const ReferenceModel& model, Made& made) {
  const std::shared_ptr<const GuidingMap> map = guidingMap(model);
  for (std::uint32_t c = 0; c < map->charts.size(); ++c) {
    double area = 0;
    std::size_t faces = 0;
    for (std::size_t f = 0; f < map->chartOf.size(); ++f) {
      if (map->chartOf[FaceId(f)] != c) continue;
      area += model.mesh->area(FaceId(f));
      ++faces;
    }
    made.charts.push_back({{"name", map->charts[c].name},
                           {"side", map->charts[c].side == MapSide::Back ? "back" : "front"},
                           {"faces", faces},
                           {"area-mm2", area}});
  }
}

Made mapOfDesign(const Arguments& arguments, const Session& session, Progress& progress) {
  const Result<Document> document = openDocument(arguments.in, arguments.body, session.units);
  if (!document) return {document.error(), {}, {}};
  const Result<Pattern> pattern = makePattern(*document, {}, nullptr, &progress);
  if (!pattern) return {pattern.error(), {}, {}};
  progress.step("draw the picture");
  Made made{drawMapLayout(*pattern, arguments.options), pattern->findings, {}};
  tellCharts(*document->model, made);
  return made;
}

Made mapOfModel(const Arguments& arguments, const Session& session, Progress& progress) {
  Result<ReferenceModel> model = isBuiltin(arguments.in) ? makeBuiltinModel(arguments.in)
                                                         : readModel(arguments.in, session.units);
  if (!model) return {model.error(), {}, {}};
  progress.step("make the guiding map");
  if (!arguments.borders.empty()) {
    Result<GuidingMap> map = makeGuidingMap(*model, arguments.borders);
    if (!map) return {map.error(), {}, {}};
    model->map = std::make_shared<GuidingMapSlot>(*std::move(map));
  }
  const bool isFile = arguments.out.extension() == ".json";
  Made made{isFile ? Result<std::string>(writeGuidingMap(*model->mesh, *guidingMap(*model)))
                   : drawGuidingMap(*model, arguments.options),
            model->findings,
            {}};
  tellCharts(*model, made);
  return made;
}

int run(Arguments& arguments, const Session& session) {
  const bool isDesign = std::filesystem::path(arguments.in).extension() == ".toile";
  const std::string kind = arguments.out.extension().string();
  if (kind != ".png" && kind != ".svg" && kind != ".json")
    return refuse(arguments.out.string() + ": the map can be written as .png, .svg or .json",
                  "map");
  if (isDesign && kind == ".json")
    return refuse("a .json holds the map of a model, and " + arguments.in + " is a design", "map");
  if (isDesign && !arguments.borders.empty())
    return refuse("--borders is for models, and " + arguments.in + " is a design", "map");
  if (arguments.body && !isDesign)
    return refuse("--body is for designs, and " + arguments.in + " is a model", "map");
  if (kind == ".svg") arguments.options.format = PictureFormat::Svg;
  TerminalProgress progress;
  progress.step("open " + arguments.in);
  const Made made = isDesign ? mapOfDesign(arguments, session, progress)
                             : mapOfModel(arguments, session, progress);
  if (!made.content) return fail(made.content.error());
  const Result<void> written = writeFileWhole(arguments.out, *made.content);
  if (!written) return fail(written.error());
  const int status = report(made.findings, session);
  if (session.json) {
    const nlohmann::ordered_json json = {{"file", arguments.out.string()}, {"charts", made.charts}};
    std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::string names;
    for (const auto& chart : made.charts)
      names += (names.empty() ? "" : ", ") + chart["name"].get<std::string>();
    std::printf("%zu chart%s: %s\n", made.charts.size(), made.charts.size() == 1 ? "" : "s",
                names.c_str());
  }
  return status;
}

}  // namespace

void addMap(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "map", "The guiding map of a model, which layouts go by",
                 [arguments, &session] { return run(*arguments, session); });
  command
      ->add_option("FILE", arguments->in,
                   "A model: OBJ, PLY, STL, OFF, *.model.json, builtin:...; or a .toile design, "
                   "which shows its pieces on the map and moved apart")
      ->required();
  command
      ->add_option("--borders", arguments->borders,
                   "Names of the model's curves, with commas between, that part the charts "
                   "(default: sharp turns; then front from back)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("CURVES");
  command
      ->add_option("-o,--output", arguments->out,
                   "A picture, .png or .svg; or .json: the map itself, for \"guidingMap\" of a "
                   "model file")
      ->type_name("FILE")
      ->required();
  addBody(*command, arguments->body);
  addPictureSize(*command, arguments->options.width, arguments->options.height);
}

}  // namespace toile::cli
