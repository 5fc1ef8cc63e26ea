// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toile/layout/pattern.h"

namespace toile {

/// Every piece: areas, distortion, checks; every wire: body, target, flat length in mm, its mate's;
/// every finding and failure. Format version stamped; keys in docs/file-format.md; numbers read
/// back exactly; no times, no thread counts.
std::string writeReportJson(const Pattern& pattern);

/// The same for people: one self-contained HTML page (no network), with the pieces drawn.
std::string writeReportHtml(const Pattern& pattern);

/// Version of the report.json format that this program writes.
inline constexpr int kReportFormatVersion = 1;

/// A piece with its pattern: `v` on the body, `vt` in the plane (mm, as unfolded, not moved to the
/// layout), `f a/a b/b c/c`, wires as `l` chains under `g` wireGroup(), `# target` comments where
/// the target differs from the length between the `v`.
std::string writePieceObj(const Piece& piece, const FlatPiece& flat);

/// The name of a wire in OBJ files and reports, unique in its piece: `wire_<kind>_<curve>`, from
/// the second run of a curve on `wire_<kind>_<curve>.2` and so on.
std::string wireGroup(const Wire& wire);

/// File names below pieces/, one per piece of the cut: its name made fit for file systems, unique.
std::vector<std::string> pieceFileNames(const CutResult& cut);

}  // namespace toile
