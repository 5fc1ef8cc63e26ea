// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/content_hash.h"
#include "toile/core/progress.h"
#include "toile/core/result.h"
#include "toile/mesh/mesh_file.h"

namespace toile {

/// One customer: a body, and what stands on the label.
struct BatchOrder {
  std::string name;  ///< of its folder; unique, made fit for file systems
  std::string body;  ///< a mesh file, points without faces, a *.model.json or "builtin:..."
  std::optional<FileUnit> unit;  ///< of a file that does not say it
  std::string customer, size;
  std::filesystem::path landmarks;  ///< places on the scan by name; empty = none
  std::string refusal;              ///< why this row cannot be an order; empty = it can
};

/// Reads the orders of a batch, in their order.
///
/// A folder: each mesh file and *.model.json in it (names that begin with a dot are left out), by
/// name. A list: comma separated, the first line names the columns: "body", and any of "name",
/// "customer", "size", "units", "landmarks"; paths are relative to the list. A row that cannot be
/// read becomes an order with a `refusal`: it never stops the rest.
/// @return FileFormat for a list without a usable first line or without rows; InvalidArgument for a
///   folder without bodies; at most 100 000 orders.
Result<std::vector<BatchOrder>> readOrders(const std::filesystem::path& bodies,
                                           std::optional<FileUnit> unit = std::nullopt);

/// What became of an order; the content of its order.json.
struct OrderOutcome {
  std::string name;
  std::string status;  ///< "done", "incomplete" (pieces are missing), "failed"
  std::string reason;  ///< of a failure, in words
  /// How much it needs a person's eye, 0..100: 100 failed, from 90 pieces missing, below by
  /// distance of the fit, invented surface, strain and findings (docs/batch.md).
  double attention = 0;
  bool isFitted = false;
  double fitMean = 0, fit95 = 0;  ///< mm, scan to fit
  double missingShare = 0;        ///< of the fitted body, without scan near it
  std::size_t pieces = 0;
  double worstAreaError = 0;  ///< greatest mean area error of a piece
  std::string worstPiece;
  std::vector<Finding> findings;
  std::map<std::string, double> measures;  ///< mm: height, and the length of every model curve
};

/// Of all that the result of an order depends on: design, body, landmarks, what stands on the
/// label, version of the program.
Result<ContentHash> orderKey(const std::filesystem::path& design, const BatchOrder& order);

/// The outcome that a former run left in the order's folder, if it was made from the same content.
std::optional<OrderOutcome> findOutcome(const std::filesystem::path& design,
                                        const BatchOrder& order, const std::filesystem::path& out);

/// Makes one order: fit, transfer, fairing, unfolding, checks, files. An independent share of the
/// work: it reads the design and its own body, and writes `out`/`order.name` and nothing else.
///
/// The folder is filled beside its place and renamed: at any moment it is absent, the former one or
/// whole. What fails is written too, with the reason and without cutting files.
/// @return FileUnwritable, Cancelled; whatever is wrong with the order itself is its outcome.
Result<OrderOutcome> makeOrder(const std::filesystem::path& design, const BatchOrder& order,
                               const std::filesystem::path& out, Progress* progress = nullptr);

/// Notes an order as failed whose program came to a bad end.
Result<OrderOutcome> failOrder(const std::filesystem::path& design, const BatchOrder& order,
                               const std::filesystem::path& out, const std::string& reason);

/// Writes `out`/summary.csv and `out`/index.html from the outcomes that are there; an order without
/// one is "open". The page shows what needs attention most first.
/// @return the number of orders that are not done
Result<std::size_t> collectOrders(const std::filesystem::path& design,
                                  const std::vector<BatchOrder>& orders,
                                  const std::filesystem::path& out);

}  // namespace toile
