// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toile/layout/pattern.h"

namespace toile {

/// Every piece: areas, distortion, checks; every wire: body, target, flat length in mm, its mate's;
/// every finding and failure. Format version stamped; keys in docs/file-format.md; numbers read
/// back exactly; no times, no thread counts.
std::string writeReportJson(const Pattern& pattern);

/// The same for people: one self-contained HTML page (no network), with the pieces drawn.
std::string writeReportHtml(const Pattern& pattern);

/// A piece with its pattern: `v` on the body, `vt` in the plane (mm, placed as in the layout's
/// piece frame, not moved), `f a/a b/b c/c`, wires as `l` chains under `g wire_<kind>_<id>`, `#
/// target` comments where the target differs from the body length.
std::string writePieceObj(const Piece& piece, const FlatPiece& flat);

}  // namespace toile
