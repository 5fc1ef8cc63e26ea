// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "toile/design/design_file.h"
#include "toile/pipeline.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

Result<ReferenceModel> loadModel(const std::string& reference, const std::filesystem::path& folder,
                                 std::optional<FileUnit> unit) {
  if (isBuiltin(reference)) return makeBuiltinModel(reference);
  const std::filesystem::path path(reference);
  return readModel(path.is_absolute() ? path : folder / path, unit);
}

bool hasNames(const ReferenceModel& model) {
  return !model.curves.empty() || !model.landmarks.empty();
}

Result<ReferenceModel> loadBody(const std::string& body, const Design& design,
                                const std::filesystem::path& folder, std::optional<FileUnit> unit) {
  Result<ReferenceModel> model = loadModel(body, {}, unit);
  if (!model || hasNames(*model) || design.models.empty()) return model;
  const ModelReference& own = design.models.front();
  const Result<ReferenceModel> names = loadModel(own.reference, folder, own.unit ? own.unit : unit);
  if (!names) return names.error().during("the design's own model, whose names are needed");
  if (names->mesh->connectivityHash() != model->mesh->connectivityHash()) {
    return Error{
        ErrorCode::ModelMismatch,
        fmt::format("{} has another connectivity ({} vertices, {} triangles) than the model "
                    "of the design, {} ({} vertices, {} triangles); carrying a design over "
                    "to such a model is not part of this version, choose a body on the "
                    "same mesh",
                    body, model->mesh->vertexCount(), model->mesh->faceCount(), own.reference,
                    names->mesh->vertexCount(), names->mesh->faceCount()),
        {}};
  }
  Result<ReferenceModel> named = withMesh(*names, model->name, *model->mesh);
  if (named) {
    named->reference = body;
    named->findings = model->findings;
  }
  return named;
}

}  // namespace

Result<Document> openDocument(const std::filesystem::path& path,
                              const std::optional<std::string>& body,
                              std::optional<FileUnit> unit) {
  Result<Design> design = readDesign(path);
  if (!design) return design.error();
  const std::filesystem::path folder = path.parent_path();
  if (!body && design->models.empty()) {
    return Error{
        ErrorCode::InvalidArgument, path.string() + " names no model; say one with --body", {}};
  }
  Result<ReferenceModel> model = [&] {
    if (body) return loadBody(*body, *design, folder, unit);
    const ModelReference& own = design->models.front();
    return loadModel(own.reference, folder, own.unit ? own.unit : unit);
  }();
  if (!model) return model.error();
  return Document{std::make_shared<const Design>(std::move(*design)),
                  std::make_shared<const ReferenceModel>(std::move(*model))};
}

}  // namespace toile
