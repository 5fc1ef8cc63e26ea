// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_check.h"
#include "toile/pipeline.h"

namespace toile::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::filesystem::path in;
  std::optional<std::filesystem::path> repaired;
};

Json toJson(const std::vector<Element>& where) {
  Json list = Json::array();
  for (const Element& element : where) {
    Json entry = {{"kind", toString(element.kind)}};
    if (element.name.empty()) {
      entry["index"] = element.index;
    } else {
      entry["name"] = element.name;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

void printJson(const std::string& file, const std::vector<std::string>& facts,
               const std::vector<Finding>& findings, const std::optional<Error>& refusal) {
  Json json = {{"format", "toile-check"}, {"version", 1}, {"file", file}, {"facts", facts}};
  json["findings"] = Json::array();
  for (const Finding& finding : findings) {
    json["findings"].push_back(
        {{"code", finding.code}, {"message", finding.message}, {"where", toJson(finding.where)}});
  }
  if (refusal) {
    json["refusal"] = {{"code", toString(refusal->code)},
                       {"message", refusal->message},
                       {"where", toJson(refusal->where)}};
  }
  std::fputs((json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n").c_str(), stdout);
}

/// 1 whenever there is something to say.
int conclude(const std::string& file, const std::vector<std::string>& facts,
             const std::vector<Finding>& findings, const std::optional<Error>& refusal,
             const Session& session) {
  if (session.json) {
    printJson(file, facts, findings, refusal);
  } else {
    for (const std::string& fact : facts) fmt::print("{}: {}\n", file, fact);
    for (const Finding& finding : findings) {
      fmt::print("{}: {} [{}]\n", file, finding.message, finding.code);
    }
    if (findings.empty() && !refusal) fmt::print("{}: nothing is wrong with it\n", file);
  }
  if (refusal) return fail(*refusal);
  return findings.empty() ? kDone : kFailed;
}

int checkDesign(const CheckArguments& arguments, const Session& session) {
  if (arguments.repaired) {
    return fail({ErrorCode::Unsupported, "--repair is for models, and this is a design", {}});
  }
  const Result<Document> document = openDocument(arguments.in, std::nullopt, session.units);
  if (!document) return fail(document.error());
  return conclude(arguments.in.string(), {}, document->model->findings, std::nullopt, session);
}

int writeRepaired(const CheckArguments& arguments, const Session& session) {
  const std::string extension = arguments.repaired->extension().string();
  if (extension != ".obj" && extension != ".ply") {
    return fail({ErrorCode::InvalidArgument,
                 fmt::format("--repair {}: give a file name that ends in .obj or .ply",
                             arguments.repaired->string()),
                 {}});
  }
  const Result<MeshFile> file = repairMesh(arguments.in, {.unit = session.units});
  if (!file) return fail(file.error());
  const Result<void> written = writeFileWhole(
      *arguments.repaired, extension == ".obj" ? writeObj(file->mesh) : writePly(file->mesh));
  if (!written) return fail(written.error());
  return report(file->findings, session);
}

int runCheck(const CheckArguments& arguments, const Session& session) {
  if (arguments.in.extension() == ".toile") return checkDesign(arguments, session);
  if (arguments.repaired) return writeRepaired(arguments, session);
  if (arguments.in.extension() == ".json") {
    const Result<ReferenceModel> model = readModel(arguments.in, session.units);
    if (!model) return fail(model.error());
    return conclude(arguments.in.string(), {}, model->findings, std::nullopt, session);
  }
  const Result<MeshCheck> check = checkMesh(arguments.in, {.unit = session.units});
  if (!check) return fail(check.error());
  return conclude(arguments.in.string(), check->facts, check->findings, check->refusal, session);
}

}  // namespace

void addCheck(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      addCommand(app, session, "check", "Say what is wrong with a model or a design",
                 [arguments, &session] { return runCheck(*arguments, session); });
  command->add_option("FILE", arguments->in, "Model (OBJ, PLY, STL, OFF, *.model.json) or design")
      ->required();
  command
      ->add_option("--repair", arguments->repaired,
                   "Write a clean copy of the model to this file, OBJ or PLY")
      ->type_name("OUT");
}

}  // namespace toile::cli
