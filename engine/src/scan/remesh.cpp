// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/remesh.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

namespace toile::scanning {

Result<Mesh> remeshEvenly(const Mesh& mesh, double edge) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  constexpr unsigned kRounds = 4;
  Surface surface;
  surface.reserve(mesh.vertexCount(), mesh.edgeCount(), mesh.faceCount());
  for (const Eigen::Vector3d& p : mesh.positions()) {
    surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  }
  for (const Triangle& t : mesh.triangles()) {
    surface.add_face(Surface::Vertex_index(t[0].index()), Surface::Vertex_index(t[1].index()),
                     Surface::Vertex_index(t[2].index()));
  }
  try {
    CGAL::Polygon_mesh_processing::isotropic_remeshing(
        surface.faces(), edge, surface,
        CGAL::Polygon_mesh_processing::parameters::number_of_iterations(kRounds)
            .number_of_relaxation_steps(2));
  } catch (const std::exception& fault) {
    return Error{ErrorCode::NotConverged,
                 std::string("the surface could not be divided evenly: ") + fault.what(),
                 {}};
  }
  surface.collect_garbage();
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (const Surface::Vertex_index v : surface.vertices()) {
    const Kernel::Point_3& p = surface.point(v);
    positions.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Surface::Face_index f : surface.faces()) {
    Triangle& t = triangles.emplace_back();
    std::size_t k = 0;
    for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) {
      t[k++] = VertexId(v.idx());
    }
  }
  return makeMesh(std::move(positions), std::move(triangles));
}

}  // namespace toile::scanning
