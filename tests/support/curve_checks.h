// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "toile/design/design.h"

namespace toile::test {

/// Every curve can be placed, lies on the surface within 1e-12 of the model's size, passes its data
/// points in order, and is locally shortest from each to the next (also from the last to the first,
/// also where a link is as short as rounding; live mirror images on models that are symmetric).
void expectSound(const Document& document, GeodesicLinker& linker, const std::string& context);

/// Wherever two curves with data points meet, both have the same data point there, bit for bit.
void expectAllShared(const Document& document, GeodesicLinker& linker, const std::string& context);

/// With which curves a curve shares data points.
std::vector<std::string> sharingWith(const Design& design, const std::string& curve);
/// A curve still shares a data point with each of these that it still meets.
void expectStillShared(const Document& document, GeodesicLinker& linker, const std::string& curve,
                       const std::vector<std::string>& others, const std::string& context);

/// The mirror image of the mirror image of a curve has its data points: vertices and points inside
/// of faces bit for bit, others within rounding of their position.
void expectMirrorOfMirror(const Document& document, const std::string& curve,
                          const std::string& context);

}  // namespace toile::test
