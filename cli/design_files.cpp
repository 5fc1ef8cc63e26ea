// SPDX-License-Identifier: GPL-3.0-or-later
#include "design_files.h"

#include "toile/core/file.h"
#include "toile/design/design_file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/model/write_model.h"

namespace toile::cli {
namespace {

Result<void> makeParent(const std::filesystem::path& file) {
  if (!file.has_parent_path()) return {};
  return makeFolder(file.parent_path());
}

}  // namespace

Result<std::string> writeModelBeside(const ReferenceModel& model,
                                     const std::filesystem::path& out) {
  if (auto done = makeParent(out); !done) return done.error();
  std::filesystem::path mesh = out, names = out;
  mesh.replace_extension(".ply");
  names.replace_extension(".model.json");
  if (auto done = writeFileWhole(mesh, writePly(*model.mesh)); !done) return done.error();
  const std::string text = writeModelFile(model, mesh.filename().string());
  if (auto done = writeFileWhole(names, text); !done) return done.error();
  return names.filename().string();
}

Result<void> writeDesignFor(Design design, const std::string& model,
                            const std::filesystem::path& out) {
  if (auto done = makeParent(out); !done) return done;
  design.models.front().reference = model;
  return writeFileWhole(out, writeDesign(design));
}

Result<void> writeDesignAndModel(const Document& document, const std::filesystem::path& out) {
  const Result<std::string> model = writeModelBeside(*document.model, out);
  if (!model) return model.error();
  return writeDesignFor(*document.design, *model, out);
}

}  // namespace toile::cli
