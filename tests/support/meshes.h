// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "toile/mesh/mesh.h"

namespace toile::test {

// Made-up meshes, all in mm with the outside up or outwards. Vertices of grids run row by row:
// vertex (i, j) has the index j * (columns + 1) + i, x growing with i and y with j.

/// A planar rectangle [0, columns * cell] x [0, rows * cell] at z = 0; diagonals alternate.
Mesh grid(int columns, int rows, double cell = 10);
/// The same with the inner vertices moved within the plane by up to `amount` of a cell.
Mesh irregularGrid(int columns, int rows, double cell = 10, double amount = 0.3, unsigned seed = 1);
/// A rectangle like grid(), raised to z = height(x, y).
Mesh heightField(int columns, int rows, double cell,
                 const std::function<double(double, double)>& height);
/// z = curvature * (x^2 - y^2) / 2 around the middle of a square of n x n cells.
Mesh saddle(int n, double cell = 10, double curvature = 0.01);
/// Half of a cone's mantle (turned by pi around the z axis), the slant from outer (first row) to
/// inner. A developable patch: its inner vertices have no curvature.
Mesh coneStrip(double inner, double outer, int segments, int rows, double halfApexAngle);

/// A tube around the z axis from z = 0 to height, open at both ends. Vertex (i, j) = j * segments +
/// i at the angle 2 pi i / segments.
Mesh cylinder(double radius, double height, int segments, int rows);
/// A half of it, angles 0..pi: a developable patch. Vertex (i, j) = j * (segments + 1) + i.
Mesh halfCylinder(double radius, double height, int segments, int rows);
/// The tube closed by a fan at each end.
Mesh closedCylinder(double radius, double height, int segments, int rows);
/// The surface of [0, size]^3 with n x n cells per side.
Mesh cube(double size, int n);
/// A subdivided icosahedron: 20 * 4^levels faces, every vertex on the sphere.
Mesh icosphere(double radius, int levels);
/// The upper part of the icosphere, faces whose corners all have z >= lowest * radius.
Mesh sphereCap(double radius, int levels, double lowest);
/// Around the z axis.
Mesh torus(double ringRadius, double tubeRadius, int ringSegments, int tubeSegments);
/// Two tubes joined at a third, a pair of trousers standing for limbs: legs along -z, waist at the
/// top, all three ends open. About 6 * segments * rows faces.
Mesh trousers(int segments = 16, int rows = 12);

/// linear * x + shift. A mirroring `linear` turns the mesh inside out.
Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift);

}  // namespace toile::test
