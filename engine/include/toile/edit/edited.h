// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toile/design/design.h"

namespace toile {

// What all edits share. Every edit takes a Document and gives a new one; the old one stays as it
// was, so that undo is keeping it. An edit that cannot be done gives an Error and no document.
//
// A curve that is edited is put on the model: its data points become the truth, and its way a list
// of control points among them. The names that it was drawn from are no longer followed. Editing
// the mirror image of another curve (mirrorOf) edits that one, so that both follow.
//
// Places on a curve are fractions of its length, 0..1; those of a closed curve wrap.

/// The result of an edit that makes curves, or has something to say.
struct Edited {
  Document document;
  std::vector<std::string> curves;  ///< ids of the curves that were made or changed
  std::vector<Finding> findings;
};

/// A stretch of a curve, in its direction; on a closed curve `to` < `from` runs over the start, and
/// 0 to 1 is the whole of it.
struct Stretch {
  double from = 0;
  double to = 1;
};

}  // namespace toile
