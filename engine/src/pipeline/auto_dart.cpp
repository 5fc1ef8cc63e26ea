// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/auto_dart.h"

#include <fmt/format.h>

#include <set>

#include "pipeline/proposed_lines.h"
#include "pipeline/stages.h"
#include "pipeline/unfold_options.h"
#include "toile/develop/darts.h"

namespace toile {
Result<bool> addProposedDarts(Pattern& pattern, const Symmetries& symmetries,
                              const MakeOptions& options, const PatternCache& cache,
                              std::vector<Finding>& findings, Progress* progress) {
  Design design = *pattern.document.design;
  bool added = false;
  std::set<std::size_t> done;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    const std::optional<Ratio> limit = options.autoDart->of(*pattern.document.design, piece.id);
    if (!piece.include || done.contains(i) || !limit) continue;
    const auto known = cache.entries.find(
        stages::cacheKey(pattern, i, symmetryOf(pattern, symmetries, i), options));
    if (known == cache.entries.end() || !known->second.flat) continue;
    const FlatPiece& flat = *known->second.flat;
    if (flat.meanAreaError <= limit->value() && flat.check.crossings == 0) continue;
    if (progress != nullptr) progress->step("look for a dart in " + piece.name);
    const UnfoldOptions own = unfoldOptionsOf(*pattern.document.design, piece, options.unfold);
    const auto proposals = adviseDarts(piece, flat, {.unfold = own, .limit = limit}, progress);
    if (!proposals) return proposals.error().during("piece \"" + piece.name + "\"");
    if (proposals->empty()) {
      findings.push_back(
          {"no-dart-helps",
           fmt::format("piece \"{}\": {:.2f} % mean area error is left where {:.3g} % "
                       "is wanted; no dart or cut helps by a tenth",
                       piece.name, 100 * flat.meanAreaError, limit->percent()),
           {Element::piece(piece.id)}});
      continue;
    }
    const DartProposal& best = proposals->front();
    const AddedLines lines = addLines(design, pattern, i, best, done);
    if (lines.alsoOn) done.insert(*lines.alsoOn);
    added = true;
    findings.push_back(
        {"auto-dart",
         fmt::format("piece \"{}\": \"{}\"{}: {}; mean area error {:.2f} -> {:.2f} %", piece.name,
                     fmt::join(lines.ids, "\", \""), lines.alsoOn ? " and its mirror image" : "",
                     describe(best), 100 * best.errorBefore, 100 * best.errorAfter),
         {Element::piece(piece.id), Element::curve(lines.ids.front())}});
  }
  if (added) pattern.document.design = std::make_shared<const Design>(std::move(design));
  return added;
}

}  // namespace toile
