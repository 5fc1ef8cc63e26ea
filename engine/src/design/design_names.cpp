// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/design_names.h"

namespace toile {

std::string_view toString(CurveKind kind) {
  return nameOf(kCurveKindNames, kind);
}

}  // namespace toile
