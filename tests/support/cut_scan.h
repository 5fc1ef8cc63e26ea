// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "toile/fit/scan.h"

namespace toile::test {

/// As it comes from a scanner that did not see all: the faces of which every corner is kept, and
/// their points; one that no face uses would still be a point of the scan.
template <class IsKept>
Scan cutScan(const Mesh& mesh, const IsKept& isKept) {
  Scan scan = makeScan("part", mesh);
  std::erase_if(scan.triangles, [&](const Triangle& t) {
    return !std::all_of(t.begin(), t.end(), [&](VertexId v) { return isKept(mesh.position(v)); });
  });
  std::vector<VertexId> number(scan.points.size());
  std::vector<Eigen::Vector3d> points;
  for (Triangle& t : scan.triangles) {
    for (VertexId& v : t) {
      if (!number[v.index()].isValid()) {
        number[v.index()] = VertexId(points.size());
        points.push_back(scan.points[v.index()]);
      }
      v = number[v.index()];
    }
  }
  scan.points = std::move(points);
  return scan;
}

}  // namespace toile::test
