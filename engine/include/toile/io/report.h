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
/// @param strain if given, `# strain <face> <along> <across> <shear> <area>` per face, faces from
/// 0:
///   shares of the cloth's own size, positive where it must stretch (toile/finish/strain.h)
std::string writePieceObj(const Piece& piece, const FlatPiece& flat,
                          const PieceStrain* strain = nullptr);

/// The same as PLY for viewers and plots: vertices with `x y z` on the body and `s t` in the plane,
/// mm; faces with `greatest least along across shear area` of the strain.
std::string writePiecePly(const Piece& piece, const FlatPiece& flat, const PieceStrain& strain);

/// The name of a wire in OBJ files and reports, unique in its piece: `wire_<kind>_<curve>`, from
/// the second run of a curve on `wire_<kind>_<curve>.2` and so on.
std::string wireGroup(const Wire& wire);

/// File names below pieces/, one per piece of the cut: its name made fit for file systems, unique.
std::vector<std::string> pieceFileNames(const CutResult& cut);
/// The name of a piece's PLY, from that of its OBJ.
std::string plyFileName(const std::string& objName);

}  // namespace toile
