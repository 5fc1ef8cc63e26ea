// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "pipeline/elastics.h"
#include "pipeline/proposed_lines.h"
#include "pipeline/symmetric_lines.h"
#include "pipeline/symmetric_pieces.h"
#include "pipeline/twins.h"
#include "pipeline/unfold_options.h"
#include "toile/core/content_hash.h"
#include "toile/core/parallel.h"

namespace toile::stages {
namespace {

// A cut can leave a piece that still is no disk (a trouser leg with its foot); each round opens
// every such piece once more.
constexpr int kMaxAutoCutRounds = 4;

void tell(Progress* progress, const std::string& step) {
  if (progress != nullptr) progress->step(step);
}

void append(std::vector<Finding>& all, const std::vector<Finding>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Adds the proposed cuts of every piece that cannot lie flat. One for which there are none fails
/// by itself, as the finding of its cut tells. @return whether there were any
bool addProposedCuts(Pattern& pattern, std::vector<Finding>& findings) {
  Design design = *pattern.document.design;
  bool added = false;
  for (const Piece& piece : pattern.cut.pieces) {
    if (!piece.include || topology(piece).canLieFlat()) continue;
    const Result<std::vector<StylingCurve>> cuts = proposeCuts(piece, *pattern.document.model);
    if (!cuts) continue;
    for (StylingCurve curve : *cuts) {
      curve.id = freeCurveId(design, curve.id);
      findings.push_back({"auto-cut",
                          fmt::format("{} could not lie flat and was cut open along \"{}\"; draw a "
                                      "seam to choose another place",
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

/// A processed piece as it comes from the cache, with the names and numbers that the piece has in
/// this document.
std::shared_ptr<const DevelopedPiece> named(const std::shared_ptr<const DevelopedPiece>& developed,
                                            const Piece& piece) {
  if (!developed) return nullptr;
  auto own = std::make_shared<DevelopedPiece>(*developed);
  Piece shaped = piece;
  shaped.mesh = std::move(own->piece.mesh);
  shaped.targetSides = std::move(own->piece.targetSides);
  for (std::size_t w = 0; w < shaped.wires.size(); ++w) {
    shaped.wires[w].targetLength = std::move(own->piece.wires[w].targetLength);
  }
  own->piece = std::move(shaped);
  return own;
}

Result<FlatPiece> unfoldAs(const PieceSymmetry* symmetry, const Piece& piece,
                           const UnfoldOptions& options, Progress* progress) {
  if (symmetry == nullptr) return unfold(piece, options, progress);
  SymmetricPiece symmetric;
  symmetric.piece = piece;
  symmetric.symmetry = *symmetry;
  return unfold(symmetric, options, progress);
}

PatternCache::Entry solve(const Piece& piece, const PieceSymmetry* symmetry,
                          const UnfoldOptions& options,
                          const std::optional<DevelopOptions>& processing, Progress* progress) {
  PatternCache::Entry entry;
  if (processing) {
    Result<DevelopedPiece> developed = develop(piece, *processing, progress);
    if (!developed) {
      entry.error = developed.error();
      return entry;
    }
    if (symmetry != nullptr) {
      Result<FlatPiece> flat = unfoldAs(symmetry, developed->piece, options, progress);
      if (flat) developed->flat = std::make_shared<const FlatPiece>(*std::move(flat));
    }
    entry.flat = developed->flat;
    if (developed->amount > 0 || !developed->findings.empty()) {
      entry.developed = std::make_shared<const DevelopedPiece>(*std::move(developed));
    }
    return entry;
  }
  Result<FlatPiece> flat = unfoldAs(symmetry, piece, options, progress);
  if (flat) {
    entry.flat = std::make_shared<const FlatPiece>(*std::move(flat));
  } else {
    entry.error = flat.error();
  }
  return entry;
}

/// Elements of a piece's mesh are told as the faces of the model that they are parts of.
void nameOnModel(const Piece& piece, std::vector<Element>& where) {
  std::vector<Element> named;
  for (const Element& element : where) {
    Element told = element;
    const auto tell = [&](FaceId face) { told = Element::face(piece.sourceFace[face]); };
    switch (element.kind) {
      case Element::Kind::Face:
        tell(FaceId(element.index));
        break;
      case Element::Kind::Edge:
        tell(piece.mesh->face(piece.mesh->halfedge(EdgeId(element.index))));
        break;
      case Element::Kind::Vertex:
        tell(piece.mesh->facesAround(VertexId(element.index)).front());
        break;
      default:
        break;
    }
    if (std::find(named.begin(), named.end(), told) == named.end()) named.push_back(told);
  }
  named.push_back(Element::piece(piece.id));
  where = std::move(named);
}

}  // namespace

Error cancelled() {
  return {ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
}

std::string quoted(const Piece& piece) {
  return fmt::format("piece \"{}\"", piece.name.empty() ? piece.id : piece.name);
}

Result<Symmetries> placeAndCut(Pattern& pattern, const MakeOptions& options, Progress* progress) {
  const Design& design = *pattern.document.design;
  tell(progress, fmt::format("place {} curve{} on the model", design.curves.size(),
                             design.curves.size() == 1 ? "" : "s"));
  Result<std::vector<PlacedCurve>> curves = placeCurves(design, *pattern.document.model);
  if (!curves) return curves.error();
  if (isCancelled(progress)) return cancelled();
  makeLinesSymmetric(pattern.document, options.symmetrise.has_value(), *curves);
  Result<CutResult> result = cut(pattern.document, *curves, progress);
  if (!result) return result.error();
  pattern.curves = std::move(*curves);
  pattern.cut = std::move(*result);
  std::erase_if(pattern.findings, [](const Finding& finding) {  // of a cut before
    return finding.code == "made-symmetric" || finding.code == "not-symmetric" ||
           finding.code == "no-twins";
  });
  Symmetries symmetries;
  if (options.symmetrise) {
    Result<Symmetries> made = makePiecesSymmetric(pattern, *options.symmetrise, progress);
    if (!made) return made.error();
    symmetries = *std::move(made);
  }
  makeTwins(pattern);
  return symmetries;
}

Result<Symmetries> placeAndCutOpen(Pattern& pattern, const MakeOptions& options,
                                   Progress* progress) {
  Result<Symmetries> symmetries = placeAndCut(pattern, options, progress);
  for (int round = 0; symmetries && options.autoCut && round < kMaxAutoCutRounds; ++round) {
    if (!addProposedCuts(pattern, pattern.findings)) break;
    symmetries = placeAndCut(pattern, options, progress);
  }
  return symmetries;
}

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

std::optional<DevelopOptions> developOptions(const Pattern& pattern, const Piece& piece,
                                             const MakeOptions& options) {
  const PieceRecord* record = recordOf(*pattern.document.design, piece.id);
  DevelopOptions develop;
  develop.unfold = unfoldOptionsOf(*pattern.document.design, piece, options.unfold);
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
  develop.maxAreaError = options.autoDevelop->of(*pattern.document.design, piece.id);
  if (!develop.maxAreaError) return std::nullopt;
  return develop;
}

ContentHash cacheKey(const Pattern& pattern, std::size_t index, const PieceSymmetry* symmetry,
                     const MakeOptions& makeOptions) {
  const Piece& piece = pattern.cut.pieces[index];
  const UnfoldOptions options =
      unfoldOptionsOf(*pattern.document.design, piece, makeOptions.unfold);
  const std::optional<DevelopOptions> develop = developOptions(pattern, piece, makeOptions);
  ContentHasher hasher;
  if (symmetry != nullptr) {
    for (const auto& [right, left] : symmetry->pairs) hasher.add(right.index()).add(left.index());
  }
  hasher.add(contentHash(piece))
      .add(options.objective)
      .add(options.weights)
      .add(options.areaWeight)
      .add(options.wireStiffness)
      .add(options.maxSteps)
      .add(options.keepSymmetry)
      .add(options.keepApart)
      .add(options.cloth.has_value())
      .add(develop.has_value());
  if (options.cloth) {
    const Cloth& cloth = *options.cloth;
    hasher.add(cloth.weights.along).add(cloth.weights.across).add(cloth.weights.shear);
    for (const auto& limit : {cloth.stretchAlong, cloth.stretchAcross, cloth.shear}) {
      hasher.add(limit ? limit->value() : -1.0);
    }
    hasher.add(cloth.grain.along).add(cloth.grain.turn.radians());
  }
  if (develop) {
    hasher.add(develop->maxAreaError.has_value())
        .add(develop->maxAreaError ? develop->maxAreaError->value() : develop->amount)
        .add(develop->maxSteps)
        .add(develop->outsideOf != nullptr)
        .add(develop->gap.mm());
    if (develop->outsideOf) {
      const Mesh& around = develop->outsideOf->mesh();
      hasher.add(around.connectivityHash());
      for (const Eigen::Vector3d& p : around.positions()) hasher.add(p.x()).add(p.y()).add(p.z());
    }
  }
  return hasher.finish();
}

void takeEntries(Pattern& pattern, const std::vector<const PatternCache::Entry*>& entries) {
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  pattern.flats.assign(pieces.size(), nullptr);
  pattern.failures.assign(pieces.size(), std::nullopt);
  pattern.developed.assign(pieces.size(), nullptr);
  for (const std::size_t i : workOrder(pattern.cut)) {
    if (entries[i] == nullptr) continue;
    const PatternCache::Entry& entry = *entries[i];
    pattern.flats[i] = entry.flat;
    pattern.developed[i] = named(entry.developed, pieces[i]);
    if (entry.error) {
      pattern.failures[i] = entry.error->during(quoted(pieces[i]));
      nameOnModel(pieces[i], pattern.failures[i]->where);
    }
    if (!entry.flat) continue;
    if (entry.developed) {
      for (Finding finding : entry.developed->findings) {
        finding.message = quoted(pieces[i]) + ": " + finding.message;
        finding.where.push_back(Element::piece(pieces[i].id));
        pattern.findings.push_back(std::move(finding));
      }
    }
    for (Finding finding : entry.flat->findings) {
      finding.message = quoted(pieces[i]) + ": " + finding.message;
      nameOnModel(pieces[i], finding.where);
      pattern.findings.push_back(std::move(finding));
    }
    if (entry.flat->check.passes()) continue;
    pattern.failures[i] =
        Error{ErrorCode::NotConverged,
              fmt::format("{} cannot be cut out: {}; move or remove a line inside it, or part it "
                          "by a seam or a dart",
                          quoted(pieces[i]), whyRefused(entry.flat->check)),
              {Element::piece(pieces[i].id)}};
    pattern.flats[i] = nullptr;
  }
  takeProcessedTargets(pattern);
}

void unfoldPieces(Pattern& pattern, const Symmetries& symmetries, const MakeOptions& options,
                  PatternCache& cache, Progress* progress) {
  settleElastics(pattern, options, progress);
  const Design& design = *pattern.document.design;
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  const std::vector<std::size_t> order = workOrder(pattern.cut);
  ++cache.patterns;
  std::vector<ContentHash> keys(pieces.size());
  std::vector<PatternCache::Entry> fresh(pieces.size());
  std::vector<const PatternCache::Entry*> entries(pieces.size(), nullptr);
  std::vector<std::optional<DevelopOptions>> processing(pieces.size());
  for (const std::size_t i : order) processing[i] = developOptions(pattern, pieces[i], options);
  // A twin's answer is its original's; processed ones are processed each by itself.
  const auto isMirrored = [&](std::size_t i) {
    return !pattern.twinOf.empty() && pattern.twinOf[i] && !processing[i] &&
           !processing[*pattern.twinOf[i]];
  };
  for (const std::size_t i : order) {
    if (isMirrored(i)) continue;
    keys[i] = cacheKey(pattern, i, symmetryOf(pattern, symmetries, i), options);
    const auto found = cache.entries.find(keys[i]);
    if (found == cache.entries.end()) continue;
    found->second.lastUsed = cache.patterns;
    entries[i] = &found->second;
    ++cache.reused;
  }

  std::atomic<std::size_t> begun = 0;
  parallelFor(order.size(), [&](std::size_t turn) {
    const std::size_t i = order[turn];
    const std::size_t number = ++begun;
    if (entries[i] != nullptr || isMirrored(i) || isCancelled(progress)) return;
    tell(progress,
         fmt::format("unfold {} ({} of {})", pieces[i].name.empty() ? pieces[i].id : pieces[i].name,
                     number, order.size()));
    fresh[i] = solve(pieces[i], symmetryOf(pattern, symmetries, i),
                     unfoldOptionsOf(design, pieces[i], options.unfold), processing[i], progress);
  });
  for (const std::size_t i : order) {
    if (entries[i] != nullptr || isMirrored(i)) continue;
    ++cache.solved;
    entries[i] = &fresh[i];
    if (!fresh[i].flat && (!fresh[i].error || fresh[i].error->code == ErrorCode::Cancelled)) {
      continue;
    }
    fresh[i].lastUsed = cache.patterns;
    entries[i] = &cache.entries.insert_or_assign(keys[i], std::move(fresh[i])).first->second;
  }
  for (const std::size_t i : order) {
    if (!isMirrored(i) || entries[*pattern.twinOf[i]] == nullptr) continue;
    fresh[i] = *entries[*pattern.twinOf[i]];
    if (fresh[i].flat) {
      fresh[i].flat = std::make_shared<const FlatPiece>(mirrorImage(*fresh[i].flat));
    }
    entries[i] = &fresh[i];
  }
  takeEntries(pattern, entries);
}

Result<void> finishPieces(Pattern& pattern, Progress* progress,
                          const std::vector<const PatternPiece*>& known) {
  tell(progress, "finish the pieces: allowance, notches, grain");
  Result<std::vector<PatternPiece>> pieces =
      finish(pattern.document, pattern.curves, pattern.cut, pattern.flats, known);
  if (!pieces) return pieces.error();
  pattern.pieces = std::move(*pieces);
  pattern.pieceIndex.clear();
  for (std::size_t i = 0; i < pattern.flats.size(); ++i) {
    if (pattern.flats[i]) pattern.pieceIndex.push_back(static_cast<std::uint32_t>(i));
  }
  for (const PatternPiece& piece : pattern.pieces) append(pattern.findings, piece.findings);
  return {};
}

Result<void> arrangePieces(Pattern& pattern, Progress* progress) {
  tell(progress, "arrange them on the sheet");
  Result<Layout> layout =
      arrange(*pattern.document.model, pattern.cut, pattern.flats, pattern.pieces,
              pattern.pieceIndex, pattern.document.design->layout);
  if (!layout) return layout.error();
  pattern.layout = std::move(*layout);
  append(pattern.findings, pattern.layout.findings);
  return {};
}

}  // namespace toile::stages
