// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "toile/develop/darts.h"
#include "toile/pipeline.h"

namespace toile {

/// An id that no curve of the design has: `wanted`, or that with a number.
[[nodiscard]] std::string freeCurveId(const Design& design, const std::string& wanted);

struct AddedLines {
  std::vector<std::string> ids;       ///< of the lines on the piece
  std::optional<std::size_t> alsoOn;  ///< the piece that got their mirror images
};
/// Adds the lines of a proposal for a piece to a design, and their mirror images where the piece,
/// or the piece on the other side, is symmetric.
/// @param done pieces that have their lines already: they get no images
AddedLines addLines(Design& design, const Pattern& pattern, std::size_t piece,
                    const DartProposal& proposal, const std::set<std::size_t>& done = {});

}  // namespace toile
