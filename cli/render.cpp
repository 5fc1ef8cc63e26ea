// SPDX-License-Identifier: GPL-3.0-or-later
// `toile render`: a picture of a design on its model, or of a model alone.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "common_options.h"
#include "places.h"
#include "terminal_progress.h"
#include "toile/core/file.h"
#include "toile/pipeline.h"
#include "toile/render/render.h"
#include "toile/shape/builtin.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::string in;
  std::optional<std::string> body;
  std::filesystem::path out;
  bool autoCut = false;
  std::optional<std::string> at;  ///< a landmark, or a place
  std::optional<Length> height;
  RenderOptions options;
};

void readViews(const std::vector<std::string>& lists, std::vector<RenderView>& views) {
  views.clear();
  if (lists == std::vector<std::string>{"none"}) return;
  for (const std::string& list : lists) {
    const Result<std::vector<RenderView>> more = parseViews(list);
    if (!more) throw CLI::ValidationError("--view: " + more.error().message);
    views.insert(views.end(), more->begin(), more->end());
  }
}

/// The options with the close-up that --at and --height ask for.
Result<RenderOptions> optionsOn(const Arguments& arguments, const ReferenceModel& model) {
  RenderOptions options = arguments.options;
  if (!arguments.at) return options;
  RenderCloseUp closeUp;
  if (arguments.height) closeUp.height = *arguments.height;
  const Result<Eigen::Vector3d> middle = findPlace(model, *arguments.at);
  if (!middle) return middle.error().during("--at");
  closeUp.middle = *middle;
  options.closeUp = closeUp;
  return options;
}

struct Drawn {
  Result<std::string> png;
  std::vector<Finding> findings;
  std::vector<Error> failures;  ///< pieces that the picture cannot show flat
};

Drawn drawDesign(const Arguments& arguments, const Session& session, Progress& progress) {
  const Result<Document> document = openDocument(arguments.in, arguments.body, session.units);
  if (!document) return {document.error(), {}, {}};
  const Result<RenderOptions> wanted = optionsOn(arguments, *document->model);
  if (!wanted) return {wanted.error(), {}, {}};
  MakeOptions options;
  options.autoCut = arguments.autoCut;
  const Result<Pattern> pattern = makePattern(*document, options, nullptr, &progress);
  if (!pattern) return {pattern.error(), {}, {}};
  progress.step("draw the picture");
  Drawn drawn{renderPattern(*pattern, *wanted, &progress), pattern->findings, {}};
  for (const std::optional<Error>& failure : pattern->failures) {
    if (failure) drawn.failures.push_back(*failure);
  }
  return drawn;
}

Drawn drawModel(const Arguments& arguments, const Session& session, Progress& progress) {
  const Result<ReferenceModel> model = isBuiltin(arguments.in)
                                           ? makeBuiltinModel(arguments.in)
                                           : readModel(arguments.in, session.units);
  if (!model) return {model.error(), {}, {}};
  const Result<RenderOptions> wanted = optionsOn(arguments, *model);
  if (!wanted) return {wanted.error(), {}, {}};
  progress.step("draw the picture");
  return {renderModel(*model, *wanted, &progress), model->findings, {}};
}

int run(const Arguments& arguments, const Session& session) {
  const bool isDesign = std::filesystem::path(arguments.in).extension() == ".toile";
  if (arguments.body && !isDesign) {
    return refuse("--body is for designs, and " + arguments.in + " is a model", "render");
  }
  if (arguments.height && !arguments.at) {
    return refuse("--height is for close-ups; say --at what", "render");
  }
  RenderOptions options = arguments.options;
  if (arguments.height) options.closeUp = RenderCloseUp{{0, 0, 0}, *arguments.height};
  if (const Result<void> fine = checkOptions(options); !fine) {
    return refuse(fine.error().message, "render");
  }
  TerminalProgress progress;
  progress.step("open " + arguments.in);
  const Drawn drawn =
      isDesign ? drawDesign(arguments, session, progress) : drawModel(arguments, session, progress);
  if (!drawn.png) return fail(drawn.png.error());
  const Result<void> written = writeFileWhole(arguments.out, *drawn.png);
  if (!written) return fail(written.error());
  int status = report(drawn.findings, session);
  for (const Error& failure : drawn.failures) status = fail(failure);
  if (session.json) {
    const nlohmann::ordered_json json = {{"picture", arguments.out.string()},
                                         {"width", arguments.options.width},
                                         {"height", arguments.options.height},
                                         {"complete", drawn.failures.empty()}};
    std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  }
  return status;
}

}  // namespace

void addRender(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "render", "A picture of a design on its model, or of a model",
                 [arguments, &session] { return run(*arguments, session); });
  command
      ->add_option("FILE", arguments->in,
                   "A .toile design, or a model: OBJ, PLY, STL, OFF, *.model.json, builtin:...")
      ->required();
  addBody(*command, arguments->body);
  command->add_option("-o,--output", arguments->out, "The PNG to write")
      ->type_name("PNG")
      ->required();
  RenderOptions& options = arguments->options;
  command
      ->add_option_function<std::vector<std::string>>(
          "--view",
          [&options](const std::vector<std::string>& texts) { readViews(texts, options.views); },
          "Views side by side, with commas between: front, back, left, right, three-quarter, "
          "three-quarter-back, top, or azimuth,elevation in degrees; none for the pieces alone "
          "(default: front,back)")
      ->allow_extra_args(false)
      ->type_name("VIEWS");
  addPictureSize(*command, options.width, options.height);
  command
      ->add_option("--at", arguments->at,
                   "A close-up: a landmark of the model, or x,y,z in mm, stands in the middle")
      ->type_name("PLACE");
  addParsed(*command, "--height", arguments->height, parseLength,
            "How much of the model a close-up shows from top to bottom (default: 300mm)")
      ->type_name("LENGTH");
  addChoice<RenderStyle>(*command, "--style", options.style,
                         {{"product", RenderStyle::Product}, {"plain", RenderStyle::Plain}},
                         "The finished thing, or the design's lines on pale panels");
  addChoice<RenderLines>(
      *command, "--lines", options.lines,
      {{"all", RenderLines::All}, {"seams", RenderLines::Seams}, {"none", RenderLines::None}},
      "Which lines are drawn on the model");
  addChoice<RenderPieces>(*command, "--pieces", options.pieces,
                          {{"cloth", RenderPieces::Cloth},
                           {"strain", RenderPieces::Strain},
                           {"none", RenderPieces::None}},
                          "The pieces beside it, in their colours or coloured by strain");
  addChoice<StrainMap>(*command, "--strain", options.strain,
                       {{"area", StrainMap::Area},
                        {"along", StrainMap::Along},
                        {"across", StrainMap::Across},
                        {"shear", StrainMap::Shear},
                        {"area-error", StrainMap::AreaError}},
                       "What --pieces strain tells: of the area, along or across the grain, shear, "
                       "or the article's map of area from 0 to 100 %");
  addParsed(*command, "--explode", options.explode, parseRatio,
            "How far the pieces stand off the model, 0% to 200%")
      ->type_name("PERCENT");
  command->add_flag("!--no-captions", options.captions, "Leave out names of design and views");
  addAutoCut(*command, arguments->autoCut);
}

}  // namespace toile::cli
