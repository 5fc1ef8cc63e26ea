// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/face_triangulation.h"

#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <string>

namespace toile::cutting {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
// Lattice coordinates are exact in double and edges meet at points only, so that no point is ever
// constructed.
using Triangulation =
    CGAL::Constrained_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

}  // namespace

Result<std::vector<LocalTriangle>> triangulate(std::span<const LatticePoint> points,
                                               std::span<const LocalEdge> edges) {
  try {
    Triangulation triangulation;
    std::vector<Triangulation::Vertex_handle> handles;
    handles.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const Kernel::Point_2 at(static_cast<double>(points[i].x), static_cast<double>(points[i].y));
      handles.push_back(triangulation.insert(
          at, handles.empty() ? Triangulation::Face_handle() : handles.back()->face()));
      handles.back()->info() = i;
    }
    for (const auto& [a, b] : edges) triangulation.insert_constraint(handles[a], handles[b]);
    std::vector<LocalTriangle> triangles;
    std::int64_t area = 0;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
      const LocalTriangle& t = triangles.back();
      area += orientation(points[t[0]], points[t[1]], points[t[2]]);
    }
    if (area == kUnit * kUnit) return triangles;
  } catch (const std::exception& failure) {
    return Error{
        ErrorCode::NotConverged, std::string("triangulation failed: ") + failure.what(), {}};
  }
  return Error{ErrorCode::NotConverged, "triangulation does not cover the face", {}};
}

}  // namespace toile::cutting
