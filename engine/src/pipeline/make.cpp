// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipeline/auto_dart.h"
#include "pipeline/stages.h"
#include "toile/pipeline.h"

namespace toile {
namespace {

/// Darts that a piece may get, one a round.
constexpr int kMaxAutoDartRounds = 8;

void append(std::vector<Finding>& all, const std::vector<Finding>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Unfolds, adds a dart to each piece over the limit and cuts again, while that helps.
Result<void> putInDarts(Pattern& pattern, Symmetries& symmetries, const MakeOptions& options,
                        PatternCache& cache, Progress* progress) {
  MakeOptions plain = options;
  plain.autoDevelop = std::nullopt;
  plain.unfold.keepApart = false;  // a piece that lies on itself shall get a dart
  for (int round = 0; round < kMaxAutoDartRounds; ++round) {
    const std::size_t told = pattern.findings.size();
    stages::unfoldPieces(pattern, symmetries, plain, cache, progress);
    pattern.findings.resize(told);  // they are told of the final pieces
    if (isCancelled(progress)) return stages::cancelled();
    std::vector<Finding> findings;
    const Result<bool> added =
        addProposedDarts(pattern, symmetries, plain, cache, findings, progress);
    if (!added) return added.error();
    // Why a piece stays over the limit is told once, when no more darts come.
    std::erase_if(findings, [&](const Finding& f) { return *added && f.code != "auto-dart"; });
    append(pattern.findings, findings);
    if (!*added) break;
    Result<Symmetries> again = stages::placeAndCut(pattern, options, progress);
    if (!again) return again.error();
    symmetries = *std::move(again);
  }
  return {};
}

}  // namespace

void PatternCache::keepOfLast(std::size_t count) {
  std::erase_if(entries,
                [&](const auto& entry) { return entry.second.lastUsed + count <= patterns; });
}

Result<Pattern> makePattern(const Document& document, const MakeOptions& options,
                            PatternCache* cache, Progress* progress) {
  PatternCache ownCache;
  PatternCache& known = cache != nullptr ? *cache : ownCache;
  Pattern pattern;
  pattern.document = document;
  append(pattern.findings, document.model->findings);
  const auto run = [&]() -> Result<void> {
    Result<Symmetries> symmetries = stages::placeAndCutOpen(pattern, options, progress);
    if (!symmetries) return symmetries.error();
    if (options.autoDart) {
      const Result<void> done = putInDarts(pattern, *symmetries, options, known, progress);
      if (!done) return done;
    }
    append(pattern.findings, pattern.cut.findings);
    if (isCancelled(progress)) return stages::cancelled();
    stages::unfoldPieces(pattern, *symmetries, options, known, progress);
    if (isCancelled(progress)) return stages::cancelled();
    if (Result<void> done = stages::finishPieces(pattern, progress); !done) return done;
    return stages::arrangePieces(pattern, progress);
  };
  if (const Result<void> done = run(); !done) return done.error();
  return pattern;
}

}  // namespace toile
