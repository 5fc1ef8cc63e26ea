// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "app/session.h"

namespace toile::studio {

/// Makes one piece of the two beside a seam by taking the seam away, as a step of the history. Of a
/// seam with several pieces on a side the stretch at the selected piece goes, of one that is
/// selected on the body the whole. A twin of the line goes with it. The larger piece keeps its
/// name.
void mergeAlong(Session& session, const std::string& curve);

}  // namespace toile::studio
