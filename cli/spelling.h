// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace toile::cli {

/// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

/// The known word that was most likely meant; nothing when none is near (more than half of the
/// letters would change).
[[nodiscard]] std::optional<std::string> findNearest(std::string_view word,
                                                     std::span<const std::string> known);

}  // namespace toile::cli
