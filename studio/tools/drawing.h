// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/edit/draw.h"
#include "tools/picking.h"

namespace toile::studio {

/// How the next line is called, and of what kind it is: "Seam 3".
[[nodiscard]] NewCurve nextCurve(const ToolHost& host);
[[nodiscard]] NewCurve nextCurve(const ToolHost& host, CurveKind kind);
[[nodiscard]] QString kindWord(CurveKind kind);  ///< "Seam"

/// What linked symmetry makes of new lines: a live twin on the other side; of one that runs across
/// the middle, a symmetric one. Lines on the middle, and closed ones around it, stay as they are.
/// @return the document, or the given one where the engine refuses (and tells why)
[[nodiscard]] Document withTwins(ToolHost& host, const Edited& drawn);

/// Moves the end of a line exactly to where the pointer was caught.
[[nodiscard]] Document withEndAt(const Document& document, const std::string& curve, bool atStart,
                                 const SurfacePoint& place);

/// Lines of a document that are not in another one, or that differ: what a preview adds.
[[nodiscard]] std::vector<std::string> newLines(const Document& before, const Document& after);

}  // namespace toile::studio
