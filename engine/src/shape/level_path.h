// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "toile/mesh/surface_point.h"

namespace toile {

/// A field over the surface: a value per vertex, none of them zero, linear within faces.
using VertexField = VertexData<double>;

/// The field normal . (x - through), with zeros moved off by less than a nanometre.
VertexField planeField(const Mesh& mesh, const Eigen::Vector3d& normal,
                       const Eigen::Vector3d& through);

/// Does the field change its sign along the edge?
bool crosses(const Mesh& mesh, const VertexField& field, EdgeId edge);

/// The line on which the field is zero, from its point on `start` through the face of `into`
/// onwards, until an edge for which `isLast` holds (its point is the last), or round to the start.
/// Precondition: crosses(start), and the line meets no border before its end.
SurfacePath levelPath(const Mesh& mesh, const VertexField& field, HalfedgeId into,
                      const std::function<bool(EdgeId)>& isLast);

/// The parts of an open path between the places where another field changes its sign there.
std::vector<SurfacePath> splitBySign(const Mesh& mesh, const SurfacePath& path,
                                     const VertexField& field);

}  // namespace toile
