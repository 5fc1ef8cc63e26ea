// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "body/control_net.h"

namespace toile::body {

/// A line along edges of the refined net.
struct Chain {
  std::vector<std::size_t> vertices;
  bool closed = false;
};

/// The girths and lines that run along rings and spokes of the net, by the names that
/// docs/body.md lists; those of the left side end in `_l` and have their image `_r`.
const std::map<std::string, Chain>& namedChains();

/// Named places, both sides.
const std::map<std::string, std::size_t>& namedVertices();

}  // namespace toile::body
