// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "pipeline/auto_dart.h"
#include "toile/core/content_hash.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

// A cut can leave a piece that still is no disk (a trouser leg with its foot); each round opens
// every such piece once more.
constexpr int kMaxAutoCutRounds = 4;
/// Darts that a piece may get, one a round.
constexpr int kMaxAutoDartRounds = 8;

void tell(Progress* progress, const std::string& step) {
  if (progress != nullptr) progress->step(step);
}

Error cancelled() {
  return {ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
}

/// What people call a piece in messages.
std::string quoted(const Piece& piece) {
  return fmt::format("piece \"{}\"", piece.name.empty() ? piece.id : piece.name);
}

void append(std::vector<Finding>& all, const std::vector<Finding>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What a flat piece is a function of.
ContentHash cacheKey(const Piece& piece, const UnfoldOptions& options) {
  return ContentHasher()
      .add(contentHash(piece))
      .add(options.objective)
      .add(options.weights)
      .add(options.areaWeight)
      .add(options.wireStiffness)
      .add(options.maxSteps)
      .add(options.keepSymmetry)
      .finish();
}

Result<void> placeAndCut(Pattern& pattern, Progress* progress) {
  const Design& design = *pattern.document.design;
  tell(progress, fmt::format("place {} curve{} on the model", design.curves.size(),
                             design.curves.size() == 1 ? "" : "s"));
  Result<std::vector<PlacedCurve>> curves = placeCurves(design, *pattern.document.model);
  if (!curves) return curves.error();
  if (isCancelled(progress)) return cancelled();
  Result<CutResult> result = cut(pattern.document, *curves, progress);
  if (!result) return result.error();
  pattern.curves = std::move(*curves);
  pattern.cut = std::move(*result);
  return {};
}

/// Adds the proposed cuts of every piece that cannot lie flat. @return whether there were any
Result<bool> addProposedCuts(Pattern& pattern, std::vector<Finding>& findings) {
  Design design = *pattern.document.design;
  std::set<std::string> known;
  for (const StylingCurve& curve : design.curves) known.insert(curve.id);
  bool added = false;
  for (const Piece& piece : pattern.cut.pieces) {
    if (!piece.include || topology(piece).canLieFlat()) continue;
    const Result<std::vector<StylingCurve>> cuts = proposeCuts(piece, *pattern.document.model);
    if (!cuts) return cuts.error().during(quoted(piece));
    for (StylingCurve curve : *cuts) {
      const std::string wanted = curve.id;
      for (int n = 2; !known.insert(curve.id).second; ++n) {
        curve.id = fmt::format("{}-{}", wanted, n);
      }
      findings.push_back({"auto-cut",
                          fmt::format("{} could not lie flat and was cut open along \"{}\", the "
                                      "shortest way; draw a seam to choose another place",
                                      quoted(piece), curve.id),
                          {Element::piece(piece.id), Element::curve(curve.id)}});
      design.curves.push_back(std::move(curve));
      added = true;
    }
  }
  if (added) pattern.document.design = std::make_shared<const Design>(std::move(design));
  return added;
}

std::string whyRefused(const UnfoldCheck& check) {
  if (check.flippedFaces > 0) {
    return fmt::format("{} of its triangles fold over in the plane", check.flippedFaces);
  }
  if (check.crossings > 0) {
    return fmt::format("its lines cross each other {} times in the plane", check.crossings);
  }
  if (check.maxLengthError > 1e-9) {
    return fmt::format("its lines miss their lengths by up to {:.1e} of their length",
                       check.maxLengthError);
  }
  return fmt::format("its outline does not close by {:.1e} mm", check.maxClosureGap);
}

/// Pieces with the most faces first, so that the last one to end is a small one.
std::vector<std::size_t> workOrder(const CutResult& cut) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (cut.pieces[i].include) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&cut](std::size_t a, std::size_t b) {
    return cut.pieces[a].mesh->faceCount() > cut.pieces[b].mesh->faceCount();
  });
  return order;
}

/// How a piece is to be processed; nothing where it stays as it was cut.
std::optional<DevelopOptions> developOptions(const Pattern& pattern, const Piece& piece,
                                             const MakeOptions& options) {
  const PieceRecord* record = recordOf(*pattern.document.design, piece.id);
  DevelopOptions develop;
  develop.unfold = options.unfold;
  if (record != nullptr && record->develop) {
    const DevelopSetting& setting = *record->develop;
    develop.maxAreaError = setting.maxAreaError;
    if (setting.amount) develop.amount = setting.amount->value();
    if (setting.gap) {
      develop.outsideOf = pattern.document.model->index;
      develop.gap = *setting.gap;
    }
    return develop;
  }
  if (!options.autoDevelop) return std::nullopt;
  develop.maxAreaError = options.autoDevelop;
  return develop;
}

/// Rule 1 of lengths: the cut's edges own what the processing made of them.
void takeProcessedTargets(Pattern& pattern) {
  std::shared_ptr<RefinedMesh> refined;
  for (std::size_t i = 0; i < pattern.developed.size(); ++i) {
    if (!pattern.developed[i]) continue;
    if (!refined) refined = std::make_shared<RefinedMesh>(*pattern.cut.refined);
    std::vector<Wire>& wires = pattern.cut.pieces[i].wires;
    for (std::size_t w = 0; w < wires.size(); ++w) {
      if (isBoundary(wires[w].kind)) continue;
      wires[w].targetLength = pattern.developed[i]->piece.wires[w].targetLength;
      for (std::size_t e = 0; e < wires[w].cutEdges.size(); ++e) {
        refined->cutEdges[wires[w].cutEdges[e].index()].targetLength = wires[w].targetLength[e];
      }
    }
  }
  if (refined) pattern.cut.refined = std::move(refined);
}

void unfoldPieces(Pattern& pattern, const MakeOptions& make, PatternCache* cache,
                  Progress* progress) {
  const UnfoldOptions& options = make.unfold;
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  pattern.flats.assign(pieces.size(), nullptr);
  pattern.failures.assign(pieces.size(), std::nullopt);
  pattern.developed.assign(pieces.size(), nullptr);
  const std::vector<std::size_t> order = workOrder(pattern.cut);
  std::vector<ContentHash> keys(pieces.size());
  std::vector<char> isCached(pieces.size(), 0);
  if (cache != nullptr) {
    for (const std::size_t i : order) {
      if (developOptions(pattern, pieces[i], make)) continue;
      keys[i] = cacheKey(pieces[i], options);
      const auto found = cache->flats.find(keys[i]);
      if (found == cache->flats.end()) continue;
      pattern.flats[i] = found->second;
      isCached[i] = 1;
      ++cache->reused;
    }
  }

  std::atomic<std::size_t> begun = 0;
  parallelFor(order.size(), [&](std::size_t turn) {
    const std::size_t i = order[turn];
    const std::size_t number = ++begun;
    if (isCached[i] != 0 || isCancelled(progress)) return;
    tell(progress,
         fmt::format("unfold {} ({} of {})", pieces[i].name.empty() ? pieces[i].id : pieces[i].name,
                     number, order.size()));
    if (const auto processing = developOptions(pattern, pieces[i], make)) {
      Result<DevelopedPiece> developed = develop(pieces[i], *processing, progress);
      if (!developed) {
        pattern.failures[i] = developed.error().during(quoted(pieces[i]));
        return;
      }
      pattern.flats[i] = developed->flat;
      if (developed->amount > 0 || !developed->findings.empty()) {
        pattern.developed[i] = std::make_shared<const DevelopedPiece>(*std::move(developed));
      }
      return;
    }
    Result<FlatPiece> flat = unfold(pieces[i], options, progress);
    if (flat) {
      pattern.flats[i] = std::make_shared<const FlatPiece>(std::move(*flat));
    } else {
      pattern.failures[i] = flat.error().during(quoted(pieces[i]));
    }
  });

  for (const std::size_t i : order) {
    if (cache != nullptr && isCached[i] == 0) {
      ++cache->solved;
      if (keys[i] != ContentHash() && pattern.flats[i])
        cache->flats.emplace(keys[i], pattern.flats[i]);
    }
    if (!pattern.flats[i]) continue;
    if (pattern.developed[i]) {
      for (Finding finding : pattern.developed[i]->findings) {
        finding.message = quoted(pieces[i]) + ": " + finding.message;
        finding.where.push_back(Element::piece(pieces[i].id));
        pattern.findings.push_back(std::move(finding));
      }
    }
    for (Finding finding : pattern.flats[i]->findings) {
      finding.message = quoted(pieces[i]) + ": " + finding.message;
      pattern.findings.push_back(std::move(finding));
    }
    if (pattern.flats[i]->check.passes()) continue;
    pattern.failures[i] =
        Error{ErrorCode::NotConverged,
              fmt::format("{} cannot be cut out: {}; move or remove a line inside it, or part it "
                          "by a seam or a dart",
                          quoted(pieces[i]), whyRefused(pattern.flats[i]->check)),
              {Element::piece(pieces[i].id)}};
    pattern.flats[i] = nullptr;
  }
  takeProcessedTargets(pattern);
}

/// Unfolds, adds a dart to each piece over the limit and cuts again, while that helps.
Result<void> putInDarts(Pattern& pattern, const MakeOptions& options, PatternCache& cache,
                        Progress* progress) {
  MakeOptions plain = options;
  plain.autoDevelop = std::nullopt;
  for (int round = 0; round < kMaxAutoDartRounds; ++round) {
    const std::size_t told = pattern.findings.size();
    unfoldPieces(pattern, plain, &cache, progress);
    pattern.findings.resize(told);  // they are told of the final pieces
    if (isCancelled(progress)) return cancelled();
    std::vector<Finding> findings;
    const Result<bool> added = addProposedDarts(pattern, options, findings, progress);
    if (!added) return added.error();
    // Why a piece stays over the limit is told once, when no more darts come.
    std::erase_if(findings, [&](const Finding& f) { return *added && f.code != "auto-dart"; });
    append(pattern.findings, findings);
    if (!*added) break;
    if (const Result<void> done = placeAndCut(pattern, progress); !done) return done.error();
  }
  return {};
}

Result<void> finishAndArrange(Pattern& pattern, Progress* progress) {
  tell(progress, "finish the pieces: allowance, notches, grain");
  Result<std::vector<PatternPiece>> pieces =
      finish(pattern.document, pattern.curves, pattern.cut, pattern.flats);
  if (!pieces) return pieces.error();
  pattern.pieces = std::move(*pieces);
  for (std::size_t i = 0; i < pattern.flats.size(); ++i) {
    if (pattern.flats[i]) pattern.pieceIndex.push_back(static_cast<std::uint32_t>(i));
  }
  for (const PatternPiece& piece : pattern.pieces) append(pattern.findings, piece.findings);
  tell(progress, "arrange them on the sheet");
  Result<Layout> layout = arrange(*pattern.document.model, pattern.cut, pattern.flats,
                                  pattern.pieces, pattern.pieceIndex);
  if (!layout) return layout.error();
  pattern.layout = std::move(*layout);
  append(pattern.findings, pattern.layout.findings);
  return {};
}

}  // namespace

Result<Pattern> makePattern(const Document& document, const MakeOptions& options,
                            PatternCache* cache, Progress* progress) {
  Pattern pattern;
  pattern.document = document;
  append(pattern.findings, document.model->findings);
  if (const Result<void> done = placeAndCut(pattern, progress); !done) return done.error();
  for (int round = 0; options.autoCut && round < kMaxAutoCutRounds; ++round) {
    const Result<bool> added = addProposedCuts(pattern, pattern.findings);
    if (!added) return added.error();
    if (!*added) break;
    if (const Result<void> done = placeAndCut(pattern, progress); !done) return done.error();
  }
  PatternCache ownCache;
  if (options.autoDart) {
    PatternCache& known = cache != nullptr ? *cache : ownCache;
    if (const Result<void> done = putInDarts(pattern, options, known, progress); !done) {
      return done.error();
    }
    cache = &known;
  }
  append(pattern.findings, pattern.cut.findings);
  if (isCancelled(progress)) return cancelled();

  unfoldPieces(pattern, options, cache, progress);
  if (isCancelled(progress)) return cancelled();
  if (const Result<void> done = finishAndArrange(pattern, progress); !done) return done.error();
  return pattern;
}

}  // namespace toile
