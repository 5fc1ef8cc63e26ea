// SPDX-License-Identifier: GPL-3.0-or-later
// `toile map`: the guiding map of a model, as a picture and for its model file.
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
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

void readSize(const std::string& text, MapPictureOptions& options) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, options.height);
    if (height.ec == std::errc() && height.ptr == end) return;
  }
  throw CLI::ValidationError("--size: \"" + text +
                             "\" is no size; write width and height in px, such as 1600x1000");
}

int refuse(const std::string& sentence) {
  std::fprintf(stderr, "toile: %s (toile map --help)\n", sentence.c_str());
  return kWrongCommandLine;
}

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
    return refuse(arguments.out.string() + ": the map can be written as .png, .svg or .json");
  if (isDesign && kind == ".json")
    return refuse("a .json holds the map of a model, and " + arguments.in + " is a design");
  if (isDesign && !arguments.borders.empty())
    return refuse("--borders is for models, and " + arguments.in + " is a design");
  if (arguments.body && !isDesign)
    return refuse("--body is for designs, and " + arguments.in + " is a model");
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
      ->add_option("--body", arguments->body,
                   "Show the design on this model instead of its own: a mesh file, a .model.json "
                   "or builtin:...")
      ->type_name("MODEL");
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
  MapPictureOptions& options = arguments->options;
  command
      ->add_option_function<std::string>(
          "--size", [&options](const std::string& text) { readSize(text, options); },
          "Width and height in px (default: 1600x1000)")
      ->type_name("WxH");
}

}  // namespace toile::cli
