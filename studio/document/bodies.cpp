// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/bodies.h"

#include <QCoreApplication>
#include <QStandardPaths>
#include <algorithm>

#include "toile/core/content_hash.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/model/write_model.h"
#include "toile/pipeline/carry.h"
#include "toile/shape/builtin.h"

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Bodies)
};

/// The model of a body that needs no fit: built in, or a file of the same connectivity.
Result<ReferenceModel> load(const ModelReference& body, const std::filesystem::path& path) {
  return isBuiltin(body.reference) ? makeBuiltinModel(body.reference) : readModel(path, body.unit);
}

}  // namespace

std::filesystem::path bodiesFolder() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
  return std::filesystem::path(data.toStdString()) / "bodies";
}

QString bodyName(const ModelReference& body) {
  const QString reference = QString::fromStdString(body.reference);
  if (!isBuiltin(body.reference)) {
    std::filesystem::path stem = std::filesystem::path(body.reference).stem();
    if (stem.extension() == ".model") stem = stem.stem();
    return QString::fromStdString(stem.string());
  }
  const qsizetype size = reference.indexOf(QStringLiteral("size="));
  if (size >= 0) return reference.mid(size + 5).section('&', 0, 0);
  return reference.startsWith(QStringLiteral("builtin:body")) ? Words::tr("Average woman")
                                                              : reference.mid(8).section('@', 0, 0);
}

Result<Document> Bodies::carry(const Document& document, const ModelReference& body,
                               const std::filesystem::path& path, Progress* progress) {
  Result<ReferenceModel> model = load(body, path);
  const bool isSame =
      model && model->mesh->connectivityHash() == document.model->mesh->connectivityHash();
  if (isSame) {
    Result<CarriedDesign> carried = carryToModel(
        document, std::make_shared<const ReferenceModel>(std::move(*model)), {}, progress);
    if (!carried) return carried.error();
    return carried->transfer.document;
  }
  if (!model && isBuiltin(body.reference)) return model.error();
  // A scan may have holes and loose parts that readModel() refuses.
  Result<Scan> scan = model ? Result<Scan>(makeScan(path.filename().string(), *model->mesh))
                            : readScan(path, body.unit);
  if (!scan) return scan.error();
  Result<CarriedDesign> carried = carryToScan(document, *scan, {}, progress);
  if (!carried) return carried.error();
  return carried->transfer.document;
}

Result<Document> Bodies::putOn(const Document& document, const ModelReference& body,
                               const std::filesystem::path& from, Progress* progress) {
  const std::string left = document.design->models.front().reference;
  const auto found = known_.find(body.reference);
  std::optional<Document> result;
  if (found != known_.end() && found->second.leftFor == document.design) {
    result = found->second.document;
  } else {
    Result<Document> carried = Error{ErrorCode::NotConverged, "", {}};
    if (found != known_.end()) {
      // Its model is here already, a fitted one too.
      Result<CarriedDesign> again =
          carryToModel(document, found->second.document.model, {}, progress);
      carried = again ? Result<Document>(again->transfer.document) : again.error();
    } else {
      std::filesystem::path path = body.reference;
      if (path.is_relative() && !from.empty()) {
        path = std::filesystem::absolute(from).parent_path() / path;
      }
      carried = carry(document, body, path, progress);
    }
    if (!carried) return carried.error();
    Design design = *carried->design;
    ModelReference used = body;
    used.connectivityHash = carried->model->mesh->connectivityHash();
    design.models = {used};
    for (const ModelReference& other : document.design->models) {
      if (other.reference != body.reference) design.models.push_back(other);
    }
    // A file has no names, and a scan not this connectivity: what is designed on is kept with them.
    if (!isBuiltin(body.reference)) {
      const std::string name = bodyName(body).toStdString();
      if (auto done = makeFolder(folder_); !done) return done.error();
      const std::string ply = writePly(*carried->model->mesh);
      const std::string hash = ContentHasher().add(std::string_view(ply)).finish().hex();
      const std::filesystem::path mesh = folder_ / (name + "-" + hash.substr(0, 12) + ".ply");
      std::filesystem::path file = mesh;
      file.replace_extension(".model.json");
      if (auto done = writeFileWhole(mesh, ply); !done) {
        return done.error();
      }
      const std::string text = writeModelFile(*carried->model, mesh.filename().string());
      if (auto done = writeFileWhole(file, text); !done) return done.error();
      design.models.front().reference = file.string();
      design.models.front().unit.reset();
    }
    result = Document{std::make_shared<const Design>(std::move(design)), carried->model};
  }
  known_[left] = {document, result->design};
  known_[result->design->models.front().reference] = {*result, result->design};
  return *result;
}

}  // namespace toile::studio
