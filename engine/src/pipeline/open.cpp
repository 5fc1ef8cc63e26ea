// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "toile/design/design_file.h"
#include "toile/pipeline.h"
#include "toile/pipeline/carry.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

Result<ReferenceModel> loadModel(const std::string& reference, const std::filesystem::path& folder,
                                 std::optional<FileUnit> unit) {
  if (isBuiltin(reference)) return makeBuiltinModel(reference);
  const std::filesystem::path path(reference);
  return readModel(path.is_absolute() ? path : folder / path, unit);
}

bool isMeshFile(const std::string& reference) {
  return !isBuiltin(reference) && !reference.ends_with(".json");
}

bool hasNames(const ReferenceModel& model) {
  return !model.curves.empty() || !model.landmarks.empty();
}

/// What was done to bring the design there, for those who only see a document.
Finding describe(const Fit& fit, const std::string& body) {
  return {"fitted-body",
          fmt::format("the design's model was fitted to {}: {:.1f} mm mean distance, 95 % within "
                      "{:.1f} mm; {:.1f} % of it has no scan near it",
                      body, fit.report.scanToFit.mean, fit.report.scanToFit.percentile95,
                      100 * fit.report.missingShare),
          {}};
}

/// The design on a mesh file without names: on the connectivity of the design's own model as it
/// is, otherwise on the own model fitted to it.
Result<Document> openOnMesh(Design design, const std::filesystem::path& folder,
                            const std::string& body, std::optional<FileUnit> unit,
                            const Result<ReferenceModel>& model) {
  const ModelReference& own = design.models.front();
  const Result<ReferenceModel> names = loadModel(own.reference, folder, own.unit ? own.unit : unit);
  if (!names) return names.error().during("the design's own model, whose names are needed");
  if (model && names->mesh->connectivityHash() == model->mesh->connectivityHash()) {
    Result<ReferenceModel> named = withMesh(*names, model->name, *model->mesh);
    if (!named) return named.error();
    named->reference = body;
    named->findings = model->findings;
    return Document{std::make_shared<const Design>(std::move(design)),
                    std::make_shared<const ReferenceModel>(*std::move(named))};
  }
  // Also points without faces, and surfaces with faults that no mesh can be made of.
  const Result<Scan> scan = readScan(body, unit);
  if (!scan) return model ? scan.error() : model.error();
  const Document document{std::make_shared<const Design>(std::move(design)),
                          std::make_shared<const ReferenceModel>(*names)};
  Result<CarriedDesign> carried = carryToScan(document, *scan);
  if (!carried) return carried.error();
  ReferenceModel fitted = *carried->transfer.document.model;
  fitted.name = std::filesystem::path(body).stem().string();
  fitted.reference = body;
  fitted.findings.push_back(describe(*carried->fit, body));
  for (const Finding& finding : carried->transfer.findings) fitted.findings.push_back(finding);
  return Document{carried->transfer.document.design,
                  std::make_shared<const ReferenceModel>(std::move(fitted))};
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
  const ModelReference* own = design->models.empty() ? nullptr : &design->models.front();
  const Result<ReferenceModel> model =
      body ? loadModel(*body, {}, unit)
           : loadModel(own->reference, folder, own->unit ? own->unit : unit);
  if (body && own != nullptr && isMeshFile(*body) && (!model || !hasNames(*model))) {
    if (!model && model.error().code == ErrorCode::FileNotFound) return model.error();
    return openOnMesh(*std::move(design), folder, *body, unit, model);
  }
  if (!model) return model.error();
  return Document{std::make_shared<const Design>(std::move(*design)),
                  std::make_shared<const ReferenceModel>(*model)};
}

}  // namespace toile
