// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/design_store.h"

#include <memory>

#include "document/bodies.h"
#include "toile/core/file.h"
#include "toile/design/design_file.h"
#include "toile/shape/builtin.h"

namespace toile::studio {

namespace {

Document withoutLines(ReferenceModel model, std::optional<FileUnit> unit,
                      const std::string& reference) {
  Design design;
  ModelReference used;
  used.reference = reference;
  used.unit = unit;
  used.connectivityHash = model.mesh->connectivityHash();
  design.models.push_back(used);
  return {std::make_shared<const Design>(std::move(design)),
          std::make_shared<const ReferenceModel>(std::move(model))};
}

}  // namespace

Result<Document> emptyDocument(const std::string& builtin) {
  Result<ReferenceModel> model = makeBuiltinModel(builtin);
  if (!model) return model.error();
  return withoutLines(std::move(*model), std::nullopt, builtin);
}

Result<Document> emptyDocumentOn(const std::filesystem::path& path, std::optional<FileUnit> unit) {
  Result<ReferenceModel> model = readModel(path, unit);
  if (!model) return model.error();
  return withoutLines(std::move(*model), unit, std::filesystem::absolute(path).string());
}

Result<void> saveDesign(const Document& document, const std::filesystem::path& from,
                        const std::filesystem::path& to) {
  Design design = *document.design;
  const std::filesystem::path folder = std::filesystem::absolute(to).parent_path();
  for (ModelReference& model : design.models) {
    if (isBuiltin(model.reference)) continue;
    std::filesystem::path path = model.reference;
    if (path.is_relative() && !from.empty()) {
      path = std::filesystem::absolute(from).parent_path() / path;
    }
    if (!path.is_absolute()) continue;
    // A model that Toile keeps for the design goes beside it.
    if (path.parent_path() == bodiesFolder()) {
      std::filesystem::path mesh = path;
      mesh.replace_extension().replace_extension(".ply");
      for (const std::filesystem::path& file : {mesh, path}) {
        const std::filesystem::path beside = folder / file.filename();
        if (std::filesystem::exists(beside)) continue;  // its name has its content's hash
        const Result<std::string> content = readFile(file);
        if (!content) return content.error();
        if (const auto done = writeFileWhole(beside, *content); !done) return done;
      }
      path = folder / path.filename();
    }
    const std::filesystem::path near = path.lexically_normal().lexically_relative(folder);
    model.reference = near.empty() ? path.string() : near.string();
  }
  return writeFileWhole(to, writeDesign(design));
}

}  // namespace toile::studio
