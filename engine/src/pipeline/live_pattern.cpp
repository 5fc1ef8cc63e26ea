// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline/live_pattern.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "pipeline/stages.h"
#include "pipeline/unfold_options.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

/// Full answers back of which solved pieces are kept, for undo.
constexpr std::size_t kRemembered = 64;

}  // namespace

bool LiveAnswer::isFull() const {
  return std::none_of(pieces.begin(), pieces.end(), [](const LivePiece& piece) {
    return piece.state == LivePiece::State::Preview;
  });
}

struct LivePattern::State {
  MakeOptions options;
  PatternCache cache;
  std::map<std::string, std::unique_ptr<UnfoldPreview>> previews;  ///< by piece id
  std::size_t previewed = 0;
  std::size_t reused = 0;
  /// A piece of the last answer.
  struct Shown {
    std::shared_ptr<const FlatPiece> flat;
    PatternPiece piece;
    Placement placement;
  };
  std::map<std::string, Shown> shown;  ///< by piece id
  std::shared_ptr<const ReferenceModel> model;

  Result<Pattern> preview(const Document& document, std::set<std::size_t>& touched,
                          Progress* progress);
  [[nodiscard]] std::vector<const PatternPiece*> untouched(const Pattern& pattern) const;
  Result<void> keepPlaces(Pattern& pattern, Progress* progress) const;
  LiveAnswer answer(Pattern pattern, const std::set<std::size_t>& touched);
};

Result<Pattern> LivePattern::State::preview(const Document& document,
                                            std::set<std::size_t>& touched, Progress* progress) {
  Pattern pattern;
  pattern.document = document;
  pattern.findings = document.model->findings;
  const Result<Symmetries> symmetries = stages::placeAndCutOpen(pattern, options, progress);
  if (!symmetries) return symmetries.error();
  pattern.findings.insert(pattern.findings.end(), pattern.cut.findings.begin(),
                          pattern.cut.findings.end());
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  std::vector<const PatternCache::Entry*> entries(pieces.size(), nullptr);
  std::vector<std::pair<std::size_t, UnfoldPreview*>> work;
  for (const std::size_t i : stages::workOrder(pattern.cut)) {
    const UnfoldOptions own = unfoldOptionsOf(*document.design, pieces[i], options.unfold);
    const auto found = cache.entries.find(
        stages::cacheKey(pattern, i, symmetryOf(pattern, *symmetries, i), options));
    if (found != cache.entries.end()) {
      entries[i] = &found->second;
      continue;
    }
    std::unique_ptr<UnfoldPreview>& known = previews[pieces[i].id];
    if (!known) known = std::make_unique<UnfoldPreview>(own);
    work.emplace_back(i, known.get());
    touched.insert(i);
  }
  stages::takeEntries(pattern, entries);
  if (isCancelled(progress)) return stages::cancelled();
  std::vector<std::optional<Result<FlatPiece>>> quick(work.size());
  parallelFor(work.size(), [&](std::size_t turn) {
    quick[turn] = work[turn].second->update(pieces[work[turn].first], progress);
  });
  if (isCancelled(progress)) return stages::cancelled();
  for (std::size_t turn = 0; turn < work.size(); ++turn) {
    const std::size_t i = work[turn].first;
    Result<FlatPiece>& flat = *quick[turn];
    if (!flat) {
      pattern.failures[i] = flat.error().during(stages::quoted(pieces[i]));
      continue;
    }
    for (Finding finding : flat->findings) {
      finding.message = stages::quoted(pieces[i]) + ": " + finding.message;
      pattern.findings.push_back(std::move(finding));
    }
    pattern.flats[i] = std::make_shared<const FlatPiece>(*std::move(flat));
  }
  if (const Result<void> done = stages::finishPieces(pattern, progress, untouched(pattern));
      !done) {
    return done.error();
  }
  if (const Result<void> done = keepPlaces(pattern, progress); !done) return done.error();
  previewed += work.size();
  return pattern;
}

/// Per piece of the cut how it was finished, if its plane is still the same. Marks that a touched
/// neighbour moves along the seam follow with the full answer.
std::vector<const PatternPiece*> LivePattern::State::untouched(const Pattern& pattern) const {
  std::vector<const PatternPiece*> known(pattern.cut.pieces.size(), nullptr);
  if (pattern.document.model != model) return known;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto before = shown.find(pattern.cut.pieces[i].id);
    if (before == shown.end() || before->second.flat != pattern.flats[i]) continue;
    known[i] = &before->second.piece;
  }
  return known;
}

/// Pieces stay where they were: a flat piece turns about its middle. Where one is new, all are
/// arranged.
Result<void> LivePattern::State::keepPlaces(Pattern& pattern, Progress* progress) const {
  Layout layout;
  bool isFirst = true;
  for (const PatternPiece& piece : pattern.pieces) {
    const auto before = shown.find(piece.id);
    if (pattern.document.model != model || before == shown.end()) {
      return stages::arrangePieces(pattern, progress);
    }
    const Placement& place = before->second.placement;
    layout.placements.push_back(place);
    for (const OutlinePoint& point : piece.cutLines.front()) {
      const Eigen::Vector2d p = place.apply(point.position);
      layout.min = isFirst ? p : layout.min.cwiseMin(p).eval();
      layout.max = isFirst ? p : layout.max.cwiseMax(p).eval();
      isFirst = false;
    }
  }
  pattern.layout = std::move(layout);
  return {};
}

LiveAnswer LivePattern::State::answer(Pattern pattern, const std::set<std::size_t>& touched) {
  LiveAnswer answer;
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    LivePiece& piece = answer.pieces.emplace_back();
    if (!pieces[i].include) continue;
    if (!pattern.flats[i]) {
      piece.state = LivePiece::State::Failed;
      continue;
    }
    piece.state = touched.contains(i) ? LivePiece::State::Preview : LivePiece::State::Full;
    const auto before = shown.find(pieces[i].id);
    piece.isReused = before != shown.end() && before->second.flat == pattern.flats[i];
    if (piece.isReused) ++reused;
  }
  shown.clear();
  for (std::size_t k = 0; k < pattern.pieces.size(); ++k) {
    const PatternPiece& piece = pattern.pieces[k];
    shown[piece.id] = {pattern.flats[pattern.pieceIndex[k]], piece, pattern.layout.placements[k]};
  }
  std::erase_if(previews, [&](const auto& entry) { return !shown.contains(entry.first); });
  model = pattern.document.model;
  answer.pattern = std::move(pattern);
  return answer;
}

LivePattern::LivePattern(const MakeOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
}
LivePattern::~LivePattern() = default;

Result<LiveAnswer> LivePattern::update(const Document& document, Quality quality,
                                       Progress* progress) {
  std::set<std::size_t> touched;
  Result<Pattern> pattern = quality == Quality::Full
                                ? makePattern(document, state_->options, &state_->cache, progress)
                                : state_->preview(document, touched, progress);
  if (!pattern) return pattern.error();
  if (quality == Quality::Full) state_->cache.keepOfLast(kRemembered);
  return state_->answer(*std::move(pattern), touched);
}

LivePattern::Counts LivePattern::counts() const {
  return {state_->cache.solved, state_->previewed, state_->reused};
}

}  // namespace toile
