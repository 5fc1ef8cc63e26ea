// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/body.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "toile/body/sizes.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"

namespace toile::cli {
namespace {

struct BodyArguments {
  std::map<std::string, std::string> words;  ///< options of setBodyOption()
  std::filesystem::path out, table;
  bool list = false;
};

/// What was made: its name, what was asked for and what it measures in A-pose.
struct MadeBody {
  std::string name;
  std::filesystem::path file;
  BodyOptions options;
  std::vector<Length> measured;
};

Result<void> setWords(const BodyArguments& arguments, bool withSize, BodyOptions& options) {
  for (const auto& [name, text] : arguments.words) {
    if (name == "size" && !withSize) continue;
    const Result<void> set = setBodyOption(options, name, text);
    if (!set) return set.error();
  }
  return {};
}

Result<MadeBody> makeOne(const std::string& name, const BodyOptions& options,
                         const std::filesystem::path& file) {
  const Result<ReferenceModel> model = makeBody(options);
  if (!model) return model.error();
  BodyOptions upright = options;
  upright.posture = Posture::APose;
  const Result<ReferenceModel> standing =
      options.posture == Posture::APose ? model : makeBody(upright);
  if (!standing) return standing.error();
  const std::string text =
      file.extension() == ".obj" ? writeObj(*model->mesh) : writePly(*model->mesh);
  const Result<void> written = writeFileWhole(file, text);
  if (!written) return written.error();
  return MadeBody{name, file, options, measureBody(*standing->mesh)};
}

void print(const std::vector<MadeBody>& bodies, bool asJson) {
  if (asJson) {
    nlohmann::ordered_json json = {
        {"format", "toile-body"}, {"version", 1}, {"bodies", nlohmann::ordered_json::array()}};
    for (const MadeBody& body : bodies) {
      nlohmann::ordered_json entry = {{"file", body.file.string()}};
      if (!body.name.empty()) entry["size"] = body.name;
      for (const BodyMeasureInfo& info : bodyMeasures()) {
        entry["measuresMm"][std::string(info.name)] =
            body.measured[static_cast<std::size_t>(info.measure)].mm();
      }
      json["bodies"].push_back(std::move(entry));
    }
    fmt::print("{}\n", json.dump(2));
    return;
  }
  for (const MadeBody& body : bodies) {
    fmt::print("{}{}\n", body.file.string(), body.name.empty() ? "" : ", size " + body.name);
    for (const BodyMeasureInfo& info : bodyMeasures()) {
      const double mm = body.measured[static_cast<std::size_t>(info.measure)].mm();
      const auto asked = body.options.measures.find(info.measure);
      fmt::print("  {:<16} {:7.1f} mm{}\n", info.name, mm,
                 asked == body.options.measures.end()
                     ? ""
                     : fmt::format("  (asked: {:.1f} mm)", asked->second.mm()));
    }
  }
}

int listRanges(const BodyOptions& options) {
  const Result<std::vector<BodyRange>> ranges = bodyRanges(options);
  if (!ranges) return fail(ranges.error());
  fmt::print("{:<16} {:>8} {:>8} {:>8}  mm, each with the others as given\n", "measure", "expected",
             "least", "most");
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    const BodyRange& range = (*ranges)[static_cast<std::size_t>(info.measure)];
    fmt::print("{:<16} {:8.0f} {:8.0f} {:8.0f}  {}; {}\n", info.name, range.expected.mm(),
               range.least.mm(), range.most.mm(), info.isoName, info.how);
  }
  return kDone;
}

int makeTable(const BodyArguments& arguments, const Session& session) {
  const Result<std::string> text = readFile(arguments.table);
  if (!text) return fail(text.error());
  Result<std::vector<BodySize>> sizes =
      parseSizeTable(*text, arguments.table.string(), session.units);
  if (!sizes) return fail(sizes.error());
  if (const auto wanted = arguments.words.find("size"); wanted != arguments.words.end()) {
    const Result<BodySize> one = findSize(*sizes, wanted->second);
    if (!one) return fail(one.error().during(arguments.table.string()));
    sizes = std::vector<BodySize>{*one};
  }
  // Everything is tried before anything is written.
  for (BodySize& size : *sizes) {
    const Result<void> set = setWords(arguments, false, size.options);
    if (!set) return fail(set.error());
    const Result<ReferenceModel> model = makeBody(size.options);
    if (!model) return fail(model.error().during("size " + size.name));
  }
  const Result<void> folder = makeFolder(arguments.out);
  if (!folder) return fail(folder.error());
  std::vector<MadeBody> made;
  for (const BodySize& size : *sizes) {
    std::string file = size.name;
    for (char& c : file) {
      if (c == '/' || c == '\\' || c == ':' || static_cast<unsigned char>(c) < 32) c = '-';
    }
    const Result<MadeBody> body = makeOne(size.name, size.options, arguments.out / (file + ".ply"));
    if (!body) return fail(body.error().during("size " + size.name));
    made.push_back(*body);
  }
  print(made, session.json);
  return kDone;
}

int runBody(const BodyArguments& arguments, const Session& session) {
  if (!arguments.table.empty() && !arguments.list) {
    if (!arguments.out.empty()) return makeTable(arguments, session);
  } else {
    BodyOptions options;
    const Result<void> set = setWords(arguments, true, options);
    if (!set) return fail(set.error());
    if (arguments.list) return listRanges(options);
    const std::string extension = arguments.out.extension().string();
    if (extension == ".ply" || extension == ".obj") {
      const Result<MadeBody> body = makeOne("", options, arguments.out);
      if (!body) return fail(body.error());
      print({*body}, session.json);
      return kDone;
    }
  }
  fmt::print(stderr,
             "toile: say where to: -o body.ply or body.obj, with --table a folder "
             "(toile body --help)\n");
  return kWrongCommandLine;
}

}  // namespace

void addBody(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<BodyArguments>();
  CLI::App* command = addCommand(app, session, "body", "Make a body from measurements or a size",
                                 [arguments, &session] { return runBody(*arguments, session); });
  const auto addWord = [&](const std::string& name, const std::string& help,
                           const std::string& type) {
    command
        ->add_option_function<std::string>(
            "--" + name,
            [arguments, name](const std::string& text) {
              BodyOptions trial;
              const Result<void> set = setBodyOption(trial, name, text);
              // Sizes of a table of one's own are not known yet.
              if (!set && name != "size") {
                throw CLI::ValidationError("--" + name + ": " + set.error().message);
              }
              arguments->words[name] = text;
            },
            help)
        ->type_name(type);
  };
  command->add_option("-o,--output", arguments->out, "PLY or OBJ file, with --table a folder")
      ->type_name("FILE");
  addWord("size", "EU38F (women), EU50M (men), EU128C (children by height), or of --table", "SIZE");
  command->add_option("--table", arguments->table, "Table of sizes of one's own, CSV")
      ->type_name("FILE");
  command->add_flag("--list", arguments->list, "Print what each measure may be, make nothing");
  addWord("form", "female (default), male or a ratio between, such as 30%", "FORM");
  addWord("childlike", "Child's proportions, 0% to 100%; from the height without it", "RATIO");
  addWord("posture", "a-pose (default), arms-raised, knee-bent or seated", "POSTURE");
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    addWord(std::string(info.name), fmt::format("{}: {}", info.isoName, info.how), "LENGTH");
  }
}

}  // namespace toile::cli
