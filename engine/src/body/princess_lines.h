// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/model/reference_model.h"

namespace toile::body {

/// Adds princess_front and princess_back, both sides: smooth lines from the middle of the shoulder
/// over bust point or shoulder blade down to the hip, drawn once on the standard body.
void addPrincessLines(ReferenceModel& model);

}  // namespace toile::body
