// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "toile/io/dxf.h"

namespace toile {

/// One size of a graded pattern, its layout the nest: every size of a piece in the same place.
struct NestedSize {
  std::string name;
  const Pattern* pattern = nullptr;
  bool isBase = false;
};

/// All sizes in one drawing, 1:1 in mm: a layer per size, cut lines in a colour of their own, the
/// base size black with its notches, inner lines, grain and label; a key of the sizes.
/// @param sizes at least one, in the order of the key; one of them the base
std::string writeNestedSvg(std::span<const NestedSize> sizes);

/// All sizes in one file as of writeDxf(): a BLOCK per piece and size, named piece_size, with its
/// size in its text; "Sample Size" is the base.
DxfFile writeNestedDxf(std::span<const NestedSize> sizes);

}  // namespace toile
