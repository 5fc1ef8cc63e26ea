// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/cut/cut.h"

namespace toile::developing {

/// 1 for the edges whose length is given: border and wires.
[[nodiscard]] EdgeData<char> wireEdges(const Piece& piece);
/// 1 for the ends of such edges.
[[nodiscard]] VertexData<char> wireVertices(const Mesh& mesh, const EdgeData<char>& isWire);

}  // namespace toile::developing
