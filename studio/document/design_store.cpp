// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/design_store.h"

#include <memory>

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
    const std::filesystem::path near = path.lexically_normal().lexically_relative(folder);
    model.reference = near.empty() ? path.string() : near.string();
  }
  return writeFileWhole(to, writeDesign(design));
}

}  // namespace toile::studio
