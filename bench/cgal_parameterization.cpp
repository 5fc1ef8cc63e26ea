// SPDX-License-Identifier: GPL-3.0-or-later
#include "cgal_parameterization.h"

#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

namespace toile::bench {

namespace {

template <template <class> class Parameterizer>
std::vector<Eigen::Vector2d> parameterised(const Mesh& mesh) {
  namespace Parameterization = CGAL::Surface_mesh_parameterization;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  using Vertex = boost::graph_traits<Surface>::vertex_descriptor;
  Surface surface;
  for (const Eigen::Vector3d& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const Triangle& t : mesh.triangles()) {
    surface.add_face(Vertex(t[0].index()), Vertex(t[1].index()), Vertex(t[2].index()));
  }
  auto plane = surface.add_property_map<Vertex, Kernel::Point_2>("v:plane").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(surface).first;
  Parameterizer<Surface> parameterizer;
  if (Parameterization::parameterize(surface, parameterizer, border, plane) !=
      Parameterization::OK) {
    return {};
  }
  std::vector<Eigen::Vector2d> positions;
  for (const Vertex v : surface.vertices()) {
    const Kernel::Point_2& p = plane[v];
    positions.emplace_back(p.x(), p.y());
  }
  return positions;
}

template <class Surface>
using Lscm = CGAL::Surface_mesh_parameterization::LSCM_parameterizer_3<Surface>;
template <class Surface>
using Arap = CGAL::Surface_mesh_parameterization::ARAP_parameterizer_3<Surface>;

}  // namespace

std::vector<Eigen::Vector2d> cgalLscm(const Mesh& mesh) {
  return parameterised<Lscm>(mesh);
}

std::vector<Eigen::Vector2d> cgalArap(const Mesh& mesh) {
  return parameterised<Arap>(mesh);
}

}  // namespace toile::bench
