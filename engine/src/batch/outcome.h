// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "toile/batch/batch.h"

namespace toile::detail {

/// The order.json of an outcome: "toile-order" version 1 (docs/batch.md). No times, so that the
/// same order gives the same bytes.
[[nodiscard]] std::string writeOutcome(const OrderOutcome& outcome, const ContentHash& key);
/// @return nothing where it is no such file.
struct ReadOutcome {
  OrderOutcome outcome;
  std::string key;
};
[[nodiscard]] std::optional<ReadOutcome> readOutcome(const std::filesystem::path& folder);

}  // namespace toile::detail
