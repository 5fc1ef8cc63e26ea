// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "toile/unfold/unfold.h"

namespace toile::test {

/// makePiece() that must succeed.
Piece patchOf(const Mesh& mesh, const std::vector<PolygonSoup::Chain>& chains = {},
              const std::map<std::string, double>& targets = {});

/// The mesh in some other place and direction.
Mesh turnedAnyhow(const Mesh& mesh);

/// Without its last face (and the vertices that only that face used, which must be none).
Mesh withoutFace(const Mesh& mesh);

/// A ring around the z axis over the plane, with a hole of the inner radius.
Mesh ring(double inner, double outer, int segments, int rows,
          const std::function<double(double, double)>& height);

}  // namespace toile::test
