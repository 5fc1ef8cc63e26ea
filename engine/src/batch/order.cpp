// SPDX-License-Identifier: GPL-3.0-or-later
// One order of a batch.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <new>

#include "batch/outcome.h"
#include "toile/batch/batch.h"
#include "toile/core/file.h"
#include "toile/core/version.h"
#include "toile/pipeline.h"
#include "toile/pipeline/carry.h"
#include "toile/render/render.h"
#include "toile/shape/builtin.h"

namespace toile {

namespace {

namespace fs = std::filesystem;

// Attention, 0..100 (docs/batch.md).
constexpr double kFailed = 100;
constexpr double kPieceMissing = 90;
constexpr double kMostOfDone = 89;
constexpr double kPerFitMm = 10;          ///< mean distance of the fit
constexpr double kPerMissingPercent = 2;  ///< of the body, that the scan does not show
constexpr double kPerStrainPercent = 2;   ///< mean area error of the worst piece, beyond the free
constexpr double kFreeStrainPercent = 5;
constexpr double kPerFinding = 5;

constexpr int kThumbWidth = 320, kThumbHeight = 200;

double attentionOf(const OrderOutcome& outcome, bool isComplete) {
  if (outcome.status == "failed") return kFailed;
  if (!isComplete) return kPieceMissing;
  const auto noteworthy =
      std::count_if(outcome.findings.begin(), outcome.findings.end(),
                    [](const Finding& finding) { return finding.code != "fitted-body"; });
  const double strain = std::max(0.0, 100 * outcome.worstAreaError - kFreeStrainPercent);
  const double sum = kPerFitMm * outcome.fitMean + kPerMissingPercent * 100 * outcome.missingShare +
                     kPerStrainPercent * strain + kPerFinding * static_cast<double>(noteworthy);
  return std::min(kMostOfDone, sum);
}

/// The body of an order, the design on it, and how it came there.
Result<CarriedDesign> carry(const fs::path& design, const BatchOrder& order, Progress* progress) {
  const Result<Document> own = openDocument(design);
  if (!own) return own.error();
  CarryOptions options;
  if (!order.landmarks.empty()) {
    const Result<std::string> text = readFile(order.landmarks);
    if (!text) return text.error();
    auto places = parseScanLandmarks(*text, order.landmarks.string());
    if (!places) return places.error();
    options.fit.landmarks = *std::move(places);
  }
  Result<ReferenceModel> model =
      isBuiltin(order.body) ? makeBuiltinModel(order.body) : readModel(order.body, order.unit);
  const bool isOwn =
      model && model->mesh->connectivityHash() == own->model->mesh->connectivityHash();
  if (isOwn || (model && (isBuiltin(order.body) || order.body.ends_with(".json")))) {
    model->reference = order.body;
    return carryToModel(*own, std::make_shared<const ReferenceModel>(*std::move(model)), options,
                        progress);
  }
  Result<Scan> scan = readScan(order.body, order.unit);
  if (!scan) return model ? scan.error() : model.error();
  return carryToScan(*own, *scan, options, progress);
}

std::map<std::string, double> measure(const ReferenceModel& model) {
  std::map<std::string, double> measures = {
      {"height", model.mesh->boxMax().z() - model.mesh->boxMin().z()}};
  for (const auto& [name, path] : model.curves) measures[name] = length(*model.mesh, path);
  return measures;
}

Result<Pattern> makeFor(const CarriedDesign& carried, const BatchOrder& order, Progress* progress) {
  Document document = carried.transfer.document;
  Design design = *document.design;
  if (!order.customer.empty()) design.order.customer = order.customer;
  if (!order.size.empty()) design.order.size = order.size;
  document.design = std::make_shared<const Design>(std::move(design));
  return makePattern(document, {}, nullptr, progress);
}

/// Writes what there is into a folder of its own.
Result<OrderOutcome> makeIn(const fs::path& folder, const fs::path& design, const BatchOrder& order,
                            Progress* progress) {
  OrderOutcome outcome;
  outcome.name = order.name;
  const auto failed = [&](const Error& error) {
    outcome.status = "failed";
    outcome.reason = error.message;
    outcome.attention = kFailed;
    return outcome;
  };
  if (!order.refusal.empty()) return failed({ErrorCode::FileFormat, order.refusal, {}});
  const Result<CarriedDesign> carried = carry(design, order, progress);
  if (!carried) {
    if (carried.error().code == ErrorCode::Cancelled) return carried.error();
    return failed(carried.error());
  }
  // Left for right would look right and be wrong, and nobody may be there to see the finding.
  for (const Finding& finding : carried->transfer.findings) {
    if (finding.code != "maybe-mirrored") continue;
    return failed({ErrorCode::InvalidArgument,
                   finding.message + "; `toile scan --inward-faces` mends it either way",
                   {}});
  }
  if (carried->fit) {
    outcome.isFitted = true;
    outcome.fitMean = carried->fit->report.scanToFit.mean;
    outcome.fit95 = carried->fit->report.scanToFit.percentile95;
    outcome.missingShare = carried->fit->report.missingShare;
  }
  outcome.measures = measure(*carried->transfer.document.model);
  const Result<Pattern> pattern = makeFor(*carried, order, progress);
  if (!pattern) {
    if (pattern.error().code == ErrorCode::Cancelled) return pattern.error();
    return failed(pattern.error());
  }
  const Result<WrittenPattern> written = writePattern(*pattern, folder, progress);
  if (!written) return written.error();
  const Result<std::string> thumb =
      renderPattern(*pattern, {.width = kThumbWidth, .height = kThumbHeight, .captions = false});
  if (!thumb) return thumb.error();
  if (const auto done = writeFileWhole(folder / "thumb.png", *thumb); !done) return done.error();

  outcome.pieces = pattern->pieces.size();
  outcome.findings = carried->transfer.findings;
  outcome.findings.insert(outcome.findings.end(), written->findings.begin(),
                          written->findings.end());
  for (std::size_t i = 0; i < pattern->flats.size(); ++i) {
    if (pattern->failures[i]) {
      if (!outcome.reason.empty()) outcome.reason += "; ";
      outcome.reason += pattern->failures[i]->message;
    }
    const FlatPiece* flat = pattern->flats[i].get();
    if (flat == nullptr || flat->meanAreaError <= outcome.worstAreaError) continue;
    outcome.worstAreaError = flat->meanAreaError;
    outcome.worstPiece = pattern->cut.pieces[i].name;
  }
  outcome.status = pattern->isComplete() ? "done" : "incomplete";
  outcome.attention = attentionOf(outcome, pattern->isComplete());
  return outcome;
}

/// Puts a finished folder in its place.
Result<void> replaceFolder(const fs::path& made, const fs::path& place, const fs::path& old) {
  std::error_code failed;
  fs::remove_all(old, failed);
  if (fs::exists(place, failed)) fs::rename(place, old, failed);
  if (!failed) fs::rename(made, place, failed);
  if (failed) {
    return Error{ErrorCode::FileUnwritable,
                 fmt::format("cannot put {} in its place: {}", place.string(), failed.message()),
                 {}};
  }
  fs::remove_all(old, failed);
  return {};
}

Result<void> addContent(ContentHasher& hasher, const fs::path& file) {
  const Result<std::string> text = readFile(file);
  if (!text) return text.error();
  hasher.add(*text);
  return {};
}

template <class Fill>
Result<OrderOutcome> writeOrder(const fs::path& design, const BatchOrder& order,
                                const fs::path& out, const Fill& fill) {
  const fs::path work = out / ".work" / order.name, old = out / ".work" / (order.name + ".old");
  std::error_code ignored;
  fs::remove_all(work, ignored);
  if (const auto made = makeFolder(work); !made) return made.error();
  Result<OrderOutcome> outcome = fill(work);
  if (!outcome) {
    fs::remove_all(work, ignored);
    return outcome.error();
  }
  // A body that cannot be read has a key all the same, so that its failure is not tried again
  // before something changes.
  const Result<ContentHash> key = orderKey(design, order);
  if (!key) return key.error();
  const std::string text = detail::writeOutcome(*outcome, *key);
  if (const auto done = writeFileWhole(work / "order.json", text); !done) return done.error();
  if (const auto done = replaceFolder(work, out / order.name, old); !done) return done.error();
  fs::remove(out / ".work", ignored);  // when it is empty
  return outcome;
}

}  // namespace

Result<ContentHash> orderKey(const fs::path& design, const BatchOrder& order) {
  ContentHasher hasher;
  hasher.add(std::string_view("toile-order 1")).add(std::string_view(version()));
  if (const auto added = addContent(hasher, design); !added) return added.error();
  hasher.add(std::string_view(order.customer)).add(std::string_view(order.size));
  hasher.add(std::string_view(order.refusal)).add(order.unit ? toString(*order.unit) : "");
  hasher.add(std::string_view(order.body));
  // The absence of a file is content, too.
  const auto addIfThere = [&hasher](const fs::path& file) {
    const bool isThere = addContent(hasher, file).hasValue();
    hasher.add(isThere);
  };
  if (!isBuiltin(order.body)) addIfThere(order.body);
  if (!order.landmarks.empty()) addIfThere(order.landmarks);
  return hasher.finish();
}

std::optional<OrderOutcome> findOutcome(const fs::path& design, const BatchOrder& order,
                                        const fs::path& out) {
  auto read = detail::readOutcome(out / order.name);
  if (!read) return std::nullopt;
  const Result<ContentHash> key = orderKey(design, order);
  if (!key || key->hex() != read->key) return std::nullopt;
  return std::move(read->outcome);
}

Result<OrderOutcome> makeOrder(const fs::path& design, const BatchOrder& order, const fs::path& out,
                               Progress* progress) {
  return writeOrder(design, order, out, [&](const fs::path& folder) -> Result<OrderOutcome> {
    try {
      return makeIn(folder, design, order, progress);
    } catch (const std::bad_alloc&) {
      OrderOutcome outcome;
      outcome.name = order.name;
      outcome.status = "failed";
      outcome.reason = "the computer has not enough memory for it";
      outcome.attention = kFailed;
      return outcome;
    }
  });
}

Result<OrderOutcome> failOrder(const fs::path& design, const BatchOrder& order, const fs::path& out,
                               const std::string& reason) {
  return writeOrder(design, order, out, [&](const fs::path&) -> Result<OrderOutcome> {
    OrderOutcome outcome;
    outcome.name = order.name;
    outcome.status = "failed";
    outcome.reason = reason;
    outcome.attention = kFailed;
    return outcome;
  });
}

}  // namespace toile
