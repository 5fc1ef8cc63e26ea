// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/meshes.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

namespace toile::test {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Mesh build(std::vector<Vector3d> positions, std::vector<Triangle> triangles) {
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  if (!mesh) {
    std::cerr << "a made-up mesh is broken: " << mesh.error().message << '\n';
    std::abort();
  }
  return *std::move(mesh);
}

/// Two triangles per cell; `vertexAt` gives the index of the corner (i, j).
template <class VertexAt>
std::vector<Triangle> cellTriangles(int columns, int rows, const VertexAt& vertexAt) {
  std::vector<Triangle> triangles;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const VertexId a(vertexAt(i, j)), b(vertexAt(i + 1, j));
      const VertexId c(vertexAt(i + 1, j + 1)), d(vertexAt(i, j + 1));
      if ((i + j) % 2 == 0) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  }
  return triangles;
}

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// A rectangle of cells whose corner (i, j) lies at place(i, j).
template <class Place>
Mesh patch(int columns, int rows, const Place& place) {
  std::vector<Vector3d> positions;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) positions.push_back(place(i, j));
  }
  return build(std::move(positions), cellTriangles(columns, rows, [&](int i, int j) {
                 return at(j * (columns + 1) + i);
               }));
}

/// A tube of cells, closed in the first direction.
template <class Place>
void tube(int segments, int rows, const Place& place, std::vector<Vector3d>& positions,
          std::vector<Triangle>& triangles) {
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < segments; ++i) positions.push_back(place(i, j));
  }
  triangles =
      cellTriangles(segments, rows, [&](int i, int j) { return at(j * segments + i % segments); });
}

Vector3d onCircle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Keeps the faces and renumbers the vertices that they use.
Mesh keepFaces(const std::vector<Vector3d>& positions, const std::vector<Triangle>& triangles) {
  std::map<VertexId, VertexId> newIndex;
  std::vector<Vector3d> kept;
  std::vector<Triangle> renumbered;
  for (const Triangle& triangle : triangles) {
    Triangle moved;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [entry, isNew] = newIndex.try_emplace(triangle[k], VertexId(kept.size()));
      if (isNew) kept.push_back(positions[triangle[k].index()]);
      moved[k] = entry->second;
    }
    renumbered.push_back(moved);
  }
  return build(std::move(kept), std::move(renumbered));
}

}  // namespace

Mesh grid(int columns, int rows, double cell) {
  return heightField(columns, rows, cell, [](double, double) { return 0.0; });
}

Mesh irregularGrid(int columns, int rows, double cell, double amount, unsigned seed) {
  std::mt19937 random(seed);
  // The generator's own numbers are the same everywhere; the library's distributions are not.
  const auto next = [&] {
    return amount * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
  };
  return patch(columns, rows, [&](int i, int j) {
    Vector3d place(i, j, 0);
    const double dx = next(), dy = next();
    if (i > 0 && i < columns && j > 0 && j < rows) place += Vector3d(dx, dy, 0);
    return Vector3d(cell * place);
  });
}

Mesh heightField(int columns, int rows, double cell,
                 const std::function<double(double, double)>& height) {
  return patch(columns, rows, [&](int i, int j) {
    return Vector3d(cell * i, cell * j, height(cell * i, cell * j));
  });
}

Mesh saddle(int n, double cell, double curvature) {
  const double middle = 0.5 * n * cell;
  return heightField(n, n, cell, [&](double x, double y) {
    return 0.5 * curvature * ((x - middle) * (x - middle) - (y - middle) * (y - middle));
  });
}

Mesh coneStrip(double inner, double outer, int segments, int rows, double halfApexAngle) {
  return patch(segments, rows, [&](int i, int j) {
    const double slant = outer - (outer - inner) * j / rows;
    return onCircle(slant * std::sin(halfApexAngle), pi * i / segments,
                    -slant * std::cos(halfApexAngle));
  });
}

Mesh cylinder(double radius, double height, int segments, int rows) {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  tube(
      segments, rows,
      [&](int i, int j) { return onCircle(radius, 2 * pi * i / segments, height * j / rows); },
      positions, triangles);
  return build(std::move(positions), std::move(triangles));
}

Mesh halfCylinder(double radius, double height, int segments, int rows) {
  return patch(segments, rows, [&](int i, int j) {
    return onCircle(radius, pi * i / segments, height * j / rows);
  });
}

Mesh closedCylinder(double radius, double height, int segments, int rows) {
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  tube(
      segments, rows,
      [&](int i, int j) { return onCircle(radius, 2 * pi * i / segments, height * j / rows); },
      positions, triangles);
  const VertexId bottom(positions.size()), top(positions.size() + 1);
  positions.emplace_back(0, 0, 0);
  positions.emplace_back(0, 0, height);
  for (int i = 0; i < segments; ++i) {
    const int j = (i + 1) % segments;
    triangles.push_back({bottom, VertexId(at(j)), VertexId(at(i))});
    triangles.push_back(
        {top, VertexId(at(rows * segments + i)), VertexId(at(rows * segments + j))});
  }
  return build(std::move(positions), std::move(triangles));
}

Mesh cube(double size, int n) {
  std::map<std::array<int, 3>, VertexId> vertexAt;
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  // For each side: where its cell coordinates (0, 0) lie and how they run, seen from outside.
  struct Side {
    std::array<int, 3> origin, u, v;
  };
  const std::array<Side, 6> sides{Side{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}},   // bottom
                                  Side{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},   // top
                                  Side{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},   // y = 0
                                  Side{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},   // y = size
                                  Side{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}},   // x = 0
                                  Side{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // x = size
  for (const Side& side : sides) {
    const auto vertex = [&](int i, int j) {
      std::array<int, 3> key{};
      for (std::size_t k = 0; k < 3; ++k) {
        key[k] = n * side.origin[k] + i * side.u[k] + j * side.v[k];
      }
      const auto [entry, isNew] = vertexAt.try_emplace(key, VertexId(positions.size()));
      if (isNew) positions.emplace_back(size / n * Vector3d(key[0], key[1], key[2]));
      return std::size_t{entry->second.index()};
    };
    const std::vector<Triangle> cells = cellTriangles(n, n, vertex);
    triangles.insert(triangles.end(), cells.begin(), cells.end());
  }
  return build(std::move(positions), std::move(triangles));
}

Mesh icosphere(double radius, int levels) {
  const double g = std::numbers::phi;
  std::vector<Vector3d> positions{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                  {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                  {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::array<std::array<int, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::vector<Triangle> triangles;
  for (const auto& face : faces) {
    triangles.push_back({VertexId(at(face[0])), VertexId(at(face[1])), VertexId(at(face[2]))});
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<VertexId, VertexId>, VertexId> middleOf;
    const auto middle = [&](VertexId a, VertexId b) {
      const auto [entry, isNew] =
          middleOf.try_emplace(std::minmax(a, b), VertexId(positions.size()));
      if (isNew) positions.emplace_back(0.5 * (positions[a.index()] + positions[b.index()]));
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
    for (Vector3d& p : positions) p.normalize();
  }
  for (Vector3d& p : positions) p = radius * p.normalized();
  return build(std::move(positions), std::move(triangles));
}

Mesh sphereCap(double radius, int levels, double lowest) {
  const Mesh whole = icosphere(radius, levels);
  std::vector<Triangle> kept;
  for (const Triangle& triangle : whole.triangles()) {
    bool isHigh = true;
    for (const VertexId v : triangle) isHigh &= whole.position(v).z() >= lowest * radius;
    if (isHigh) kept.push_back(triangle);
  }
  return keepFaces(whole.positions(), kept);
}

Mesh torus(double ringRadius, double tubeRadius, int ringSegments, int tubeSegments) {
  std::vector<Vector3d> positions;
  for (int j = 0; j < tubeSegments; ++j) {
    const double v = 2 * pi * j / tubeSegments;
    for (int i = 0; i < ringSegments; ++i) {
      positions.push_back(onCircle(ringRadius + tubeRadius * std::cos(v), 2 * pi * i / ringSegments,
                                   tubeRadius * std::sin(v)));
    }
  }
  return build(std::move(positions), cellTriangles(ringSegments, tubeSegments, [&](int i, int j) {
                 return at((j % tubeSegments) * ringSegments + i % ringSegments);
               }));
}

Mesh trousers(int segments, int rows) {
  const int half = segments / 2;
  const double radius = 80, spread = 110, height = 700;
  std::vector<Vector3d> positions;
  std::vector<Triangle> triangles;
  // Each leg is a tube; its top ring is an outer half and an inner half, and the inner halves of
  // both legs are one row of vertices (the crotch line, from front to back).
  std::array<std::vector<std::size_t>, 2> outerRing;
  std::vector<std::size_t> crotch;
  for (int k = 0; k <= half; ++k) {
    const double s = std::cos(pi * k / half);
    crotch.push_back(positions.size());
    positions.emplace_back(0, -radius * s, height - 25 * (1 - s * s));
  }
  for (std::size_t leg = 0; leg < 2; ++leg) {
    const double sign = leg == 0 ? 1 : -1;
    std::vector<std::vector<std::size_t>> ring;
    for (int j = 0; j < rows; ++j) {
      ring.emplace_back();
      const double z = height * j / rows, w = static_cast<double>(j) / rows;
      for (int i = 0; i < segments; ++i) {
        // The angle 0 points to the front (-y) and grows outwards.
        const double angle = 2 * pi * i / segments;
        ring.back().push_back(positions.size());
        positions.emplace_back(
            sign * (spread * (1 - 0.3 * w) + radius * std::sin(angle) * (0.7 + 0.25 * w)),
            -radius * std::cos(angle) * (0.7 + 0.3 * w), z);
      }
    }
    ring.emplace_back();
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * pi * i / segments;
      if (i == 0) {
        ring.back().push_back(crotch.front());
      } else if (i < half) {
        ring.back().push_back(positions.size());
        outerRing[leg].push_back(positions.size());
        positions.emplace_back(sign * 170 * std::sin(angle), -radius * std::cos(angle), height);
      } else {
        ring.back().push_back(crotch[at(segments - i)]);
      }
    }
    const std::vector<Triangle> cells =
        cellTriangles(segments, rows, [&](int i, int j) { return ring[at(j)][at(i % segments)]; });
    for (Triangle triangle : cells) {
      if (leg == 1) std::swap(triangle[1], triangle[2]);
      triangles.push_back(triangle);
    }
  }
  // The waist: a tube over the outer halves of both rings.
  std::vector<std::size_t> top{crotch.front()};
  top.insert(top.end(), outerRing[0].begin(), outerRing[0].end());
  top.push_back(crotch.back());
  top.insert(top.end(), outerRing[1].rbegin(), outerRing[1].rend());
  std::vector<std::vector<std::size_t>> ring{top};
  for (int j = 1; j <= half; ++j) {
    ring.emplace_back();
    for (const std::size_t v : top) {
      ring.back().push_back(positions.size());
      const double w = static_cast<double>(j) / half;
      positions.emplace_back(positions[v].x() * (1 - 0.2 * w), positions[v].y() * (1 + 0.2 * w),
                             height + 250 * w);
    }
  }
  const std::vector<Triangle> cells =
      cellTriangles(segments, half, [&](int i, int j) { return ring[at(j)][at(i % segments)]; });
  triangles.insert(triangles.end(), cells.begin(), cells.end());
  return build(std::move(positions), std::move(triangles));
}

Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift) {
  std::vector<Vector3d> positions = mesh.positions();
  for (Vector3d& p : positions) p = linear * p + shift;
  return mesh.withPositions(std::move(positions));
}

}  // namespace toile::test
