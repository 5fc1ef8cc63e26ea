// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/mesh/mesh.h"

namespace toile::scanning {

/// The same closed surface in nearly equilateral triangles with edges of about that length.
/// @see Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", SGP 2004.
[[nodiscard]] Result<Mesh> remeshEvenly(const Mesh& mesh, double edge);

}  // namespace toile::scanning
