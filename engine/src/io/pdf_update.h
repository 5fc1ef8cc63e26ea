// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace toile {

/// Appends a revision of the document in which viewers are told not to scale when printing
/// (/ViewerPreferences << /PrintScaling /None >>), as PDF 32000-1, 7.5.6 describes incremental
/// updates. A file whose cross-reference is not a plain table, or which has preferences already,
/// is returned as it is.
[[nodiscard]] std::string withoutPrintScaling(std::string pdf);

/// What a PNG of 8-bit red, green and blue holds: its rows, filtered and deflated as PDF too has
/// them (/Predictor 15).
struct PngImage {
  std::uint32_t columns = 0, rows = 0;
  std::string data;
};
/// @return nothing for bytes that are no such picture
[[nodiscard]] std::optional<PngImage> parsePng(std::string_view png);

/// Puts a picture in the place of one that is so many columns wide and one row high: its bytes as
/// they are, neither unpacked nor packed again. Appended as another revision.
[[nodiscard]] std::string withImage(std::string pdf, std::uint32_t columns, const PngImage& image);

/// Blanks the creation time in the document's information, byte for byte, so that every offset in
/// the file stays right.
[[nodiscard]] std::string withoutCreationDate(std::string pdf);

}  // namespace toile
