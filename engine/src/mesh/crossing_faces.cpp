// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

#include "toile/mesh/mesh_check.h"

namespace toile {

std::vector<std::pair<FaceId, FaceId>> findCrossingFaces(const Mesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  surface.reserve(mesh.vertexCount(), mesh.edgeCount(), mesh.faceCount());
  for (const Eigen::Vector3d& p : mesh.positions()) {
    surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  }
  const auto point = [&](VertexId v) { return surface.point(Surface::Vertex_index(v.index())); };
  std::vector<FaceId> faceOf;  // by the surface's face
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const auto& [a, b, c] = mesh.vertices(FaceId(f));
    if (CGAL::collinear(point(a), point(b), point(c))) continue;
    const Surface::Face_index made =
        surface.add_face(Surface::Vertex_index(a.index()), Surface::Vertex_index(b.index()),
                         Surface::Vertex_index(c.index()));
    // Without its flat neighbours a vertex may have two fans, which CGAL's structure refuses.
    if (made == Surface::null_face()) continue;
    faceOf.emplace_back(f);
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> crossings;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(crossings));
  std::vector<std::pair<FaceId, FaceId>> pairs;
  for (const auto& [f, g] : crossings) {
    pairs.emplace_back(std::minmax(faceOf[f.idx()], faceOf[g.idx()]));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace toile
