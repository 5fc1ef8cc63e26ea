// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "toile/edit/edited.h"

namespace toile {

enum class CurveEnd { Start, End };

/// Parts a curve at places (fractions, any order); a closed one at a single place is opened there.
/// The first part keeps the id, the others get `<id>-2`, ...; live mirror images are parted alike,
/// and what hangs on the curve hangs on the part that holds its place.
Result<Edited> splitCurve(const Document& document, const std::string& curve,
                          std::span<const double> at);
/// Parts a curve where it meets the others. CurveInvalid where it does not meet any.
Result<Edited> splitAtCrossings(const Document& document, const std::string& curve,
                                std::span<const std::string> others);
/// Takes away the part around a place, up to the nearest crossings with the others or the ends. The
/// new ends are data points of the others.
Result<Edited> trimAtCrossings(const Document& document, const std::string& curve, double at,
                               std::span<const std::string> others);
/// Takes a stretch away: what is left are up to two curves. The whole of it: removeCurve().
Result<Edited> eraseStretch(const Document& document, const std::string& curve,
                            const Stretch& stretch);
/// What hangs on the curve keeps its place, live mirror images stay as they are.
Result<Document> removeCurve(const Document& document, const std::string& curve);

/// Joins two open curves at their nearest ends into the first; a gap is bridged smoothly. The
/// second is gone, and what hung on it hangs on the first. Two live mirror images: their originals
/// are joined, and the image follows; so it is for the images of two curves that are joined. A live
/// image and anything else, its original too: the image is a curve of its own first, so that a half
/// and its image become one line over the middle.
Result<Document> joinCurves(const Document& document, const std::string& first,
                            const std::string& second);
/// Joins the ends of a curve with each other.
Result<Document> closeCurve(const Document& document, const std::string& curve);
/// Continues a curve straight over the surface until it meets another, and ends it there.
/// CurveInvalid when it does not meet it within `limit`.
Result<Document> extendToCurve(const Document& document, const std::string& curve, CurveEnd end,
                               const std::string& other, Length limit = Length::mm(500));

/// A curve beside another, at a distance measured square to it over the surface; positive = to its
/// left. Where the distance is longer than the radius of a hollow bend the loop is left out.
Result<Edited> offsetCurve(const Document& document, const std::string& curve, Length distance,
                           const std::string& id = {});
/// Moves a whole curve over the surface, as the way from one point to the other says; each of its
/// points stays on its limb. Ends that lie on other curves slide along them (those of a half that
/// meets its live mirror image: along the middle); curves that end on it are carried along, and
/// crossings stay shared.
Result<Document> moveCurve(const Document& document, const std::string& curve,
                           const SurfacePoint& from, const SurfacePoint& to);

/// The other direction; its sides change places, what hangs on it stays.
Result<Document> reverseCurve(const Document& document, const std::string& curve);
Result<Document> setCurveKind(const Document& document, const std::string& curve, CurveKind kind);

/// Makes the places where curves meet data points of all of them, bit for bit the same: crossings
/// that stay shared when one of them is moved. Of all curves of the design if none are named; then
/// those that cannot be put on the model are left out, with a finding "crossings-not-shared".
/// Live mirror images have no data points, and are left out too.
Result<Edited> shareCrossings(const Document& document, std::span<const std::string> curves = {});

}  // namespace toile
