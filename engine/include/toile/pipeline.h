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
#include "toile/io/dxf.h"
#include "toile/io/hpgl.h"
#include "toile/io/pdf.h"
#include "toile/layout/pattern.h"
#include "toile/unfold/unfold.h"

/// Start reading here: Toile in one sentence.
///
///     ReferenceModel + Design -> cut -> Piece -> unfold -> FlatPiece
///                             -> finish -> PatternPiece -> arrange -> Layout -> write
///
/// makePattern() is that sentence as code; openDocument() comes before it, writePattern() after it.
namespace toile {

/// The mean area error from which on something is done about a piece.
struct AreaLimit {
  AreaLimit() = default;                    ///< of each piece's fabric
  AreaLimit(Ratio share) : ofAll(share) {}  // NOLINT(google-explicit-constructor)
  std::optional<Ratio> ofAll;  ///< none = the lesser stretch limit of each piece's fabric
  /// @return none for a piece of a fabric without limits
  [[nodiscard]] std::optional<Ratio> of(const Design& design, const std::string& pieceId) const;
};

struct MakeOptions {
  UnfoldOptions unfold;
  bool autoCut = false;  ///< cut tubes open by the proposed shortest cut
  /// Puts darts, and cuts across saddles, into pieces whose mean area error is greater.
  std::optional<AreaLimit> autoDart{};
  /// Processes pieces whose mean area error is greater (toile/develop/develop.h), unless their
  /// record says how.
  std::optional<AreaLimit> autoDevelop{};
  /// Makes pieces symmetric whose outline is as near to its mirror image, as a share of the root of
  /// their area: 0..0.2. Both sides of a seam get the lengths.
  std::optional<Ratio> symmetrise{};
};

/// Solved pieces by content: what an edit did not touch is not solved again. Answers have no
/// history: with or without a cache the bytes are the same. Not for use by two threads at once.
class PatternCache {
 public:
  /// What became of a piece: a plane, with its processing if there was any, or why there is none.
  struct Entry {
    std::shared_ptr<const FlatPiece> flat;
    std::shared_ptr<const DevelopedPiece> developed;
    std::optional<Error> error;
    std::size_t lastUsed = 0;  ///< the number of the pattern that used it last
  };
  std::map<ContentHash, Entry> entries;
  std::size_t patterns = 0;  ///< made so far with this cache
  std::size_t solved = 0;    ///< pieces unfolded so far through this cache
  std::size_t reused = 0;    ///< pieces taken from it

  /// Drops what none of the last so many patterns used.
  void keepOfLast(std::size_t count);
};

/// Makes the pattern of a document. A piece that cannot be unfolded does not stop the others.
///
/// Why it could not be is in Pattern::failures; it is left out of the pattern pieces.
/// @return the pattern; an Error only when no piece can be made at all (curves that cannot be
///   placed, a cut that fails, Cancelled).
/// @par Cost  3 s for a wetsuit on 25k triangles is the bound; bench/pipeline_bench.cpp tells
Result<Pattern> makePattern(const Document& document, const MakeOptions& options = {},
                            PatternCache* cache = nullptr, Progress* progress = nullptr);

/// Reads a design and the model it is used on: its own first model, or `body` in its place.
///
/// A body without names (a mesh file) on the connectivity of the design's own model takes over the
/// names of that model. To one of another connectivity, or points without faces, the design's model
/// is fitted and the design carried over to the fitted shape (pipeline/carry.h).
/// @param body a mesh file, a `*.model.json` or "builtin:...".
/// @return the document; the errors of readDesign(), readModel(), makeBuiltinModel() and of
///   carryToScan(), which refuses what is no such body.
Result<Document> openDocument(const std::filesystem::path& design,
                              const std::optional<std::string>& body = std::nullopt,
                              std::optional<FileUnit> unit = std::nullopt);

/// One file of the result and what it is for.
struct WrittenFile {
  std::filesystem::path path;
  std::string purpose;
};

struct WrittenPattern {
  std::vector<WrittenFile> files;
  std::vector<Finding> findings;  ///< of the pattern and of writing it, such as shortened names
};

/// How the files are written.
struct WriteOptions {
  PdfOptions pdf{};
  DxfOptions dxf{};
  HpglOptions hpgl{};
};

/// Writes pattern.dxf, .svg, .pdf, .plt, laser.dxf, seams.json, lengths.csv, sewing.html,
/// sewing.pdf, preview.png, report.html, report.json, pieces/*.obj into the folder: all of them, or
/// on an error none of this run's, and then the files of an earlier run stay as they were. Pieces
/// that an earlier run made and this one does not are removed.
Result<WrittenPattern> writePattern(const Pattern& pattern, const std::filesystem::path& folder,
                                    Progress* progress = nullptr, const WriteOptions& options = {});

}  // namespace toile
