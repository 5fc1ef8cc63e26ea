// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/cut/cut.h"

namespace toile::test {

double areaOf(const Mesh& mesh);
/// On the body.
double lengthOf(const Wire& wire);

/// Every wire runs along edges of its piece with its lengths; boundary wires have the piece on
/// their left and together are the boundary; mates are bitwise equal and opposite.
void expectSoundWires(const CutResult& result);
/// Putting the pieces together gives the refined mesh back, every face once, and nothing is lost.
void expectGluesBack(const Mesh& model, const CutResult& result);

}  // namespace toile::test
