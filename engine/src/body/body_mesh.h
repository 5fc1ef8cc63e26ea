// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/body/body.h"

namespace toile::body {

/// The shape of makeBody() alone: families need neither names nor the model's index.
Result<Mesh> makeBodyMesh(const BodyOptions& options);

}  // namespace toile::body
