// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/design/design.h"

namespace toile::studio {

/// The words of a body for people: "Average woman, EU38F", "customer-12".
[[nodiscard]] QString bodyName(const ModelReference& body);

/// The bodies of a design and the design on each of them. The list is the design's own `models`,
/// the one in use first; what was carried over is kept, so that going back and forth is quick and,
/// where nothing was changed meanwhile, exact.
class Bodies {
 public:
  /// @param folder where models of fitted scans are kept until the design is saved beside them
  explicit Bodies(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The document on another body. A mesh of the design's own connectivity is taken as it is; to
  /// any other, or to a scan, the design's model is fitted first.
  /// @param from where relative references of the document count from
  /// @return the errors of carryToModel() and carryToScan(), Cancelled
  Result<Document> putOn(const Document& document, const ModelReference& body,
                         const std::filesystem::path& from, Progress* progress);

  /// In the same order as the design's list, without the one in use.
  void forget() { known_.clear(); }

 private:
  struct Known {
    Document document;
    std::shared_ptr<const Design> leftFor;  ///< the design that it became when it was left
  };
  Result<Document> carry(const Document& document, const ModelReference& body,
                         const std::filesystem::path& path, Progress* progress);

  std::filesystem::path folder_;
  std::map<std::string, Known> known_;  ///< by reference
};

/// Where fitted models are kept.
[[nodiscard]] std::filesystem::path bodiesFolder();

}  // namespace toile::studio
