// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/cut/cut.h"

namespace toile {

/// A point deep inside a piece, on the model: where an anchor is safest from later edits. The
/// middle of a face of the piece, as far as any from the piece's boundary along mesh edges.
[[nodiscard]] SurfacePoint inmostPoint(const Piece& piece, const Mesh& model);

/// Lets the piece records follow their regions after an edit of the curves.
///
/// A record of both designs (told by its id) goes to the piece of the new cut that overlaps its old
/// one most, by area on the model; its anchor moves to the inmost point there, and the list of its
/// bounding curves, if it had one, is noted again. Where several records come to one piece the
/// first moves; the others stay where they are if that is in the piece, so that parting it again
/// finds them. A record whose piece is still the same, and one that is new, is left alone.
///
/// @param oldCut  of the old design, @param newCut of the new one with its records not yet moved;
///   both on this model.
/// @return the new design with its records moved; nothing else is changed.
Result<Design> followRecords(const Design& oldDesign, const CutResult& oldCut,
                             const Design& newDesign, const CutResult& newCut,
                             const ReferenceModel& model);

}  // namespace toile
