// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "toile/edit/edited.h"

namespace toile {

/// Mirror images of curves, by the model's symmetry (on bodies that are not symmetric themselves,
/// by the pairing of their vertices): ids `..._l` become `..._r` and the other way, others get
/// `-mirror`.
/// @param linked the images follow every edit, and editing them edits the originals; otherwise they
///   are curves of their own.
Result<Edited> mirrorCurves(const Document& document, std::span<const std::string> curves,
                            bool linked);

/// Makes a live mirror image a curve of its own, where it is.
Result<Document> unlinkMirror(const Document& document, const std::string& curve);

enum class Side { Left, Right };

/// Makes a curve that crosses the middle of the model, or ends on it, symmetric: the part on the
/// kept side, and a live mirror image of it. Both join smoothly: their ends are one point on the
/// middle line, and the kept half meets it square. They go on doing so when one is pulled, moved or
/// faired: the end slides along the middle line and keeps its direction. Of a curve that has a live
/// image already, or is one, both are made to meet so.
/// @return CurveInvalid when the model has no symmetry, or nothing of the curve lies on that side.
Result<Edited> makeSymmetric(const Document& document, const std::string& curve, Side kept);

}  // namespace toile
