// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "toile/io/dxf_file.h"
#include "toile/sew/sewing.h"

namespace toile {

/// Version of the seams.json that this program writes.
inline constexpr int kSeamsFormatVersion = 1;

/// Which edge is sewn to which, for a program that sews the pieces virtually: pieces with their
/// block in pattern.dxf, edges as points on the sheet (mm), in the direction in which mates meet
/// point by point, notches at their arc lengths, steps in the order of sewing. Keys in
/// docs/sewing.md.
std::string writeSeamsJson(const Pattern& pattern);

/// The length contract as a table (CSV, commas, decimal points) under the hash of its inputs.
std::string writeLengthsCsv(const Pattern& pattern);

/// The sewing sheet for the browser: one self-contained page.
/// @param coverPng picture of the finished thing, a PNG; may be empty
std::string writeSewingHtml(const Pattern& pattern, std::string_view coverPng);

/// The same to print: A4.
Result<std::string> writeSewingPdf(const Pattern& pattern, std::string_view coverPng);

/// What sewing the cutting file virtually found.
struct SewingCheck {
  struct Seam {
    std::string edgeA, edgeB;         ///< codes
    double lengthA = 0, lengthB = 0;  ///< mm, along the sew lines of the DXF
    double target = 0;                ///< mm, as seams.json tells
    double notchOff = 0;              ///< mm, by how much the worst pair of notches misses
    std::size_t notches = 0;          ///< pairs that meet
  };
  std::vector<Seam> seams;
  std::vector<Finding> findings;  ///< what does not fit; empty = everything does
};

/// Sews the pieces of a cutting file together as seams.json says: finds each edge on the sew line
/// of its piece in the DXF, measures both mates along it, and lays their notches on each other.
/// @return FileFormat for a seams.json that is damaged or of another version
Result<SewingCheck> checkSewing(std::string_view seamsJson, const DxfDrawing& drawing);

}  // namespace toile
