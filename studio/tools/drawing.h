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

/// How near a pointer takes a line, px.
inline constexpr double kLineCatch = 10;
/// The name of a line for people.
[[nodiscard]] QString titleOf(const ToolHost& host, const std::string& id);
/// All lines but one.
[[nodiscard]] std::vector<std::string> othersThan(const ToolHost& host, const std::string& curve);
[[nodiscard]] bool isLocked(const ToolHost& host, const std::string& curve);
/// Tells that a line is locked, if it is. @return whether
bool refuseLocked(ToolHost& host, const std::string& curve);

/// Shows what an edit would make; what cannot be made shows nothing.
void showEdit(ToolHost& host, const Result<Edited>& made);
/// Makes it a step of the work, with twins, and selects what was made; or tells why not.
void keepEdit(ToolHost& host, const QString& step, const Result<Edited>& made);
void keepEdit(ToolHost& host, const QString& step, const Result<Document>& made);

/// Moves the end of a line exactly to where the pointer was caught.
[[nodiscard]] Document withEndAt(const Document& document, const std::string& curve, bool atStart,
                                 const SurfacePoint& place);

/// Lines of a document that are not in another one, or that differ: what a preview adds.
[[nodiscard]] std::vector<std::string> newLines(const Document& before, const Document& after);

}  // namespace toile::studio
