// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/progress.h"
#include "toile/design/design.h"
#include "toile/layout/pattern.h"
#include "toile/unfold/unfold.h"

/// Start reading here: Toile in one sentence.
///
///     ReferenceModel + Design -> cut -> Piece -> unfold -> FlatPiece
///                             -> finish -> PatternPiece -> arrange -> Layout -> write
///
/// makePattern() is that sentence as code; openDocument() comes before it, writePattern() after it.
namespace toile {

struct MakeOptions {
  UnfoldOptions unfold;
  bool autoCut = false;  ///< cut tubes open by the proposed shortest cut
};

/// Flat pieces by content: what an edit did not touch is not solved again. Answers have no history:
/// with or without a cache the bytes are the same. Not for use by two threads at once.
class PatternCache {
 public:
  std::map<ContentHash, std::shared_ptr<const FlatPiece>> flats;
  std::size_t solved = 0;  ///< pieces unfolded so far through this cache
  std::size_t reused = 0;  ///< pieces taken from it
};

/// Makes the pattern of a document. A piece that cannot be unfolded does not stop the others.
///
/// @return the pattern; an Error only when no piece can be made at all (curves that cannot be
/// placed,
///   a cut that fails, Cancelled).
/// @par Cost  3 s for a wetsuit on 25k triangles is the bound; bench/pipeline_bench.cpp tells
Result<Pattern> makePattern(const Document& document, const MakeOptions& options = {},
                            PatternCache* cache = nullptr, Progress* progress = nullptr);

/// Reads a design and the model it is used on: its own first model, or `body` in its place. A body
/// of other connectivity is refused (ModelMismatch) when the design holds surface points.
Result<Document> openDocument(const std::filesystem::path& design,
                              const std::optional<std::filesystem::path>& body = std::nullopt,
                              std::optional<FileUnit> unit = std::nullopt);

/// One file of the result and what it is for.
struct WrittenFile {
  std::filesystem::path path;
  std::string purpose;
};

/// Writes pattern.dxf, .svg, .pdf, preview.png, report.html, report.json, pieces/*.obj into the
/// folder: all of them, or on an error none of this run's.
Result<std::vector<WrittenFile>> writePattern(const Pattern& pattern,
                                              const std::filesystem::path& folder,
                                              Progress* progress = nullptr);

}  // namespace toile
