// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace toile {

/// Appends a revision of the document in which viewers are told not to scale when printing
/// (/ViewerPreferences << /PrintScaling /None >>), as PDF 32000-1, 7.5.6 describes incremental
/// updates. A file whose cross-reference is not a plain table, or which has preferences already,
/// is returned as it is.
[[nodiscard]] std::string withoutPrintScaling(std::string pdf);

/// Blanks the creation time in the document's information, byte for byte, so that every offset in
/// the file stays right.
[[nodiscard]] std::string withoutCreationDate(std::string pdf);

}  // namespace toile
