// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/torso_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "toile/core/assert.h"

// The surface f = 0 of softly joined ellipsoids and capsules, covered by the grid of a box that is
// relaxed on it: Laplacian smoothing within the surface and stepping back onto it by turns. Only
// the half x >= 0 is computed; the other one is its mirror image to the last bit.
namespace toile {
namespace {

using Eigen::Vector3d;

constexpr int kCellsX = 24, kCellsY = 16, kCellsZ = 44;
constexpr int kRounds = 100;
constexpr double kSoftnessMm = 13;  ///< how far joints are rounded

/// An ellipsoid, or a capsule when `to` differs from `at`.
struct Lump {
  Vector3d at;
  Vector3d radii;
  Vector3d to;
};

Lump ellipsoid(const Vector3d& at, const Vector3d& radii) {
  return {at, radii, at};
}
Lump capsule(const Vector3d& from, const Vector3d& to, double radius) {
  return {from, Vector3d::Constant(radius), to};
}

const std::vector<Lump>& lumps() {
  static const std::vector<Lump> list = [] {
    std::vector<Lump> out{
        ellipsoid({0, -42, 1250}, {132, 80, 150}),  // chest
        ellipsoid({0, -50, 1080}, {106, 71, 165}),  // waist
        ellipsoid({0, -38, 915}, {146, 87, 150}),   // pelvis
        capsule({0, -18, 1330}, {0, -34, 1440}, 46),
    };
    for (const double side : {1.0, -1.0}) {
      out.push_back(ellipsoid({side * 70, -96, 1210}, {50, 50, 54}));
      out.push_back(ellipsoid({side * 52, 12, 890}, {66, 56, 74}));
      out.push_back(capsule({side * 30, -18, 1372}, {side * 140, -20, 1345}, 30));
      out.push_back(capsule({side * 130, -24, 1312}, {side * 152, -24, 1312}, 46));
      out.push_back(capsule({side * 80, -36, 860}, {side * 84, -36, 800}, 66));
    }
    return out;
  }();
  return list;
}

/// About the distance from the lump, below zero inside, and about its gradient: exact for spheres
/// and capsules, near enough for ellipsoids to step onto the surface.
struct Distance {
  double value;
  Vector3d slope;
};
Distance distance(const Lump& lump, const Vector3d& place) {
  const Vector3d along = lump.to - lump.at;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((place - lump.at).dot(along) / length, 0.0, 1.0) : 0.0;
  const Vector3d p = place - lump.at - t * along;
  const double scaled = p.cwiseQuotient(lump.radii).norm();
  const Vector3d outwards = p.cwiseQuotient(lump.radii.cwiseAbs2());
  const double steepness = outwards.norm();
  if (!(steepness > 0)) return {-lump.radii.minCoeff(), Vector3d::Zero()};
  return {scaled * (scaled - 1) / steepness, outwards / steepness};
}

/// Soft union: -k log(sum exp(-d / k)); its gradient is the mean of theirs with these weights.
Distance field(const Vector3d& place) {
  double sum = 0;
  Vector3d slope = Vector3d::Zero();
  for (const Lump& lump : lumps()) {
    const Distance one = distance(lump, place);
    const double weight = std::exp(-one.value / kSoftnessMm);
    sum += weight;
    slope += weight * one.slope;
  }
  return {-kSoftnessMm * std::log(sum), slope / sum};
}

/// Towards the surface, at most a few cm a time, where the field is no true distance far away.
Vector3d steppedOn(Vector3d place, int steps) {
  constexpr double kLongestStep = 30;
  for (int i = 0; i < steps; ++i) {
    const Distance here = field(place);
    const double square = here.slope.squaredNorm();
    if (!(square > 1e-12)) break;
    const Vector3d step = -here.value / square * here.slope;
    place += step * std::min(1.0, kLongestStep / std::max(step.norm(), 1e-12));
  }
  return place;
}

/// Vertices and faces on the surface of a box of cells.
class BoxGrid {
 public:
  BoxGrid() {
    addSides();
    for (const auto& [cell, id] : ids_)
      partner.values()[id] = VertexId(at(-cell[0], cell[1], cell[2]));
  }
  /// Cell coordinates from the middle of the box: |x| <= kCellsX / 2, ...
  [[nodiscard]] std::size_t at(int x, int y, int z) const { return ids_.at({x, y, z}); }

  std::vector<std::array<int, 3>> cells;
  std::vector<Triangle> triangles;
  VertexData<VertexId> partner;

 private:
  std::size_t idAt(const std::array<int, 3>& cell) {
    const auto [found, isNew] = ids_.emplace(cell, cells.size());
    if (isNew) cells.push_back(cell);
    return found->second;
  }
  /// A side of the box: `low`, then steps along two axes whose cross product looks outwards.
  void addSide(const std::array<int, 3>& low, int axisA, int countA, int axisB, int countB,
               int stepA) {
    const auto corner = [&](int a, int b) {
      std::array<int, 3> cell = low;
      cell[static_cast<std::size_t>(axisA)] += stepA * a;
      cell[static_cast<std::size_t>(axisB)] += b;
      return cell;
    };
    for (int b = 0; b < countB; ++b) {
      for (int a = 0; a < countA; ++a) {
        const auto p = corner(a, b), q = corner(a + 1, b);
        const auto r = corner(a + 1, b + 1), s = corner(a, b + 1);
        const VertexId vp(idAt(p)), vq(idAt(q)), vr(idAt(r)), vs(idAt(s));
        // Diagonals are mirrored in x; the sum of the coordinates' signs picks one that stays
        // clear of the corners of the box.
        if (isFirstDiagonal(p, r)) {
          triangles.push_back({vp, vq, vr});
          triangles.push_back({vp, vr, vs});
        } else {
          triangles.push_back({vp, vq, vs});
          triangles.push_back({vq, vr, vs});
        }
      }
    }
  }
  /// The diagonal p-r, rather than q-s, points away from the middle of the side.
  static bool isFirstDiagonal(const std::array<int, 3>& p, const std::array<int, 3>& r) {
    int sign = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int middle = p[axis] + r[axis];
      if (p[axis] != r[axis]) sign *= (middle > 0 ? 1 : -1) * (r[axis] > p[axis] ? 1 : -1);
    }
    return sign > 0;
  }
  void addSides() {
    constexpr int x = kCellsX / 2, y = kCellsY / 2, z = kCellsZ / 2;
    addSide({-x, -y, -z}, 0, kCellsX, 2, kCellsZ, 1);  // front
    addSide({x, y, -z}, 0, kCellsX, 2, kCellsZ, -1);   // back
    addSide({x, -y, -z}, 1, kCellsY, 2, kCellsZ, 1);   // left
    addSide({-x, y, -z}, 1, kCellsY, 2, kCellsZ, -1);  // right
    addSide({-x, -y, z}, 0, kCellsX, 1, kCellsY, 1);   // top
    addSide({x, -y, -z}, 0, kCellsX, 1, kCellsY, -1);  // bottom
    partner = VertexData<VertexId>(cells.size());
  }

  std::map<std::array<int, 3>, std::size_t> ids_;
};

/// A box with round edges about the size of the torso.
Vector3d startPlace(const std::array<int, 3>& cell) {
  const Vector3d unit(2.0 * cell[0] / kCellsX, 2.0 * cell[1] / kCellsY, 2.0 * cell[2] / kCellsZ);
  const double norm = std::pow(unit.array().pow(4).sum(), 0.25);
  const Vector3d rounded = unit / norm;
  const double narrow = rounded.z() > 0 ? 1 - 0.55 * std::pow(rounded.z(), 4) : 1;
  return {170 * rounded.x() * narrow, -38 + 95 * rounded.y() * narrow, 1115 + 360 * rounded.z()};
}

std::vector<std::vector<std::size_t>> facesAround(const BoxGrid& grid) {
  std::vector<std::vector<std::size_t>> out(grid.cells.size());
  for (std::size_t f = 0; f < grid.triangles.size(); ++f) {
    for (const VertexId corner : grid.triangles[f]) out[corner.index()].push_back(f);
  }
  return out;
}

std::vector<Vector3d> relaxedPositions(const BoxGrid& grid) {
  std::vector<Vector3d> places(grid.cells.size());
  const std::vector<std::vector<std::size_t>> around = facesAround(grid);
  const auto settle = [&](std::size_t v, const Vector3d& place) {
    const int x = grid.cells[v][0];
    if (x < 0) return;
    places[v] = place;
    if (x == 0) places[v].x() = 0;
    const Vector3d& here = places[v];
    if (x > 0) places[grid.partner.values()[v].index()] = {-here.x(), here.y(), here.z()};
  };
  for (std::size_t v = 0; v < places.size(); ++v)
    settle(v, steppedOn(startPlace(grid.cells[v]), 6));
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector3d> before = places;
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (grid.cells[v][0] < 0) continue;
      // Larger faces pull harder, which draws vertices into the stumps.
      Vector3d mean = Vector3d::Zero();
      double sum = 0;
      for (const std::size_t f : around[v]) {
        const Triangle& corners = grid.triangles[f];
        const Vector3d& a = before[corners[0].index()];
        const Vector3d& b = before[corners[1].index()];
        const Vector3d& c = before[corners[2].index()];
        const double area = (b - a).cross(c - a).norm();
        mean += area / 3 * (a + b + c);
        sum += area;
      }
      mean /= sum;
      settle(v, steppedOn(mean, round + 1 == kRounds ? 4 : 1));
    }
  }
  return places;
}

}  // namespace

TorsoMesh makeTorsoMesh() {
  const BoxGrid grid;
  Result<Mesh> mesh = makeMesh(relaxedPositions(grid), grid.triangles);
  TOILE_ASSERT(mesh.hasValue());
  TorsoMesh torso{std::move(*mesh), grid.partner, {}, {}};
  constexpr int y = kCellsY / 2, z = kCellsZ / 2;
  for (const int side : {-1, 1}) {
    std::vector<VertexId>& column = side < 0 ? torso.frontColumn : torso.backColumn;
    for (int j = 0; j < y; ++j) column.emplace_back(grid.at(0, side * j, z));
    for (int k = z; k >= -z; --k) column.emplace_back(grid.at(0, side * y, k));
    for (int j = y - 1; j >= 0; --j) column.emplace_back(grid.at(0, side * j, -z));
  }
  return torso;
}

}  // namespace toile
