// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/generated_pieces.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "support/meshes.h"
#include "support/patches.h"

namespace toile::test {
namespace {

using Chains = std::vector<PolygonSoup::Chain>;
using std::numbers::pi;

PolygonSoup::Chain chain(const std::string& group, std::vector<std::uint32_t> vertices) {
  PolygonSoup::Chain made;
  made.group = group;
  made.vertices = std::move(vertices);
  return made;
}

/// A surface over a grid of columns x rows cells, by parameters 0..1.
struct GridPatch {
  int columns, rows;
  Mesh mesh;

  GridPatch(int columnCount, int rowCount,
            const std::function<Eigen::Vector3d(double, double)>& place)
      : columns(columnCount), rows(rowCount), mesh(grid(columnCount, rowCount)) {
    std::vector<Eigen::Vector3d> positions;
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) {
        positions.push_back(place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
      }
    }
    mesh = mesh.withPositions(std::move(positions));
  }
  [[nodiscard]] std::uint32_t at(int i, int j) const {
    return static_cast<std::uint32_t>(j * (columns + 1) + i);
  }
  [[nodiscard]] PolygonSoup::Chain alongRow(const std::string& group, int j, int from,
                                            int to) const {
    std::vector<std::uint32_t> v;
    for (int i = from; i <= to; ++i) v.push_back(at(i, j));
    return chain(group, v);
  }
  [[nodiscard]] PolygonSoup::Chain alongColumn(const std::string& group, int i, int from,
                                               int to) const {
    std::vector<std::uint32_t> v;
    for (int j = from; j <= to; ++j) v.push_back(at(i, j));
    return chain(group, v);
  }
  [[nodiscard]] PolygonSoup::Chain box(const std::string& group, int i0, int j0, int i1,
                                       int j1) const {
    std::vector<std::uint32_t> v;
    for (int i = i0; i < i1; ++i) v.push_back(at(i, j0));
    for (int j = j0; j < j1; ++j) v.push_back(at(i1, j));
    for (int i = i1; i > i0; --i) v.push_back(at(i, j1));
    for (int j = j1; j >= j0; --j) v.push_back(at(i0, j));
    return chain(group, v);
  }
  /// Every edge of the mesh as a feature.
  [[nodiscard]] Chains everyEdge() const {
    Chains chains;
    for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
      const auto a = static_cast<std::uint32_t>(mesh.tail(EdgeId(e)).index());
      const auto b = static_cast<std::uint32_t>(mesh.head(EdgeId(e)).index());
      chains.push_back(chain("wire_feature_e" + std::to_string(e), {a, b}));
    }
    return chains;
  }
};

/// A cap of a sphere in rings around its pole (vertex 0).
struct Cap {
  static constexpr int kSegments = 24, kRows = 9;
  Mesh mesh;

  explicit Cap(double degrees) : mesh(grid(1, 1)) {
    constexpr double kRadius = 120;
    const double half = degrees * pi / 180;
    std::vector<Eigen::Vector3d> positions{{0, 0, kRadius}};
    for (int j = 1; j <= kRows; ++j) {
      for (int i = 0; i < kSegments; ++i) {
        const double polar = half * j / kRows, around = 2 * pi * (i + 0.13 * j) / kSegments;
        positions.push_back(kRadius * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                                      std::sin(polar) * std::sin(around),
                                                      std::cos(polar)));
      }
    }
    std::vector<Triangle> triangles;
    const auto id = [&](int j, int i) { return VertexId(at(j, i)); };
    for (int i = 0; i < kSegments; ++i) {
      triangles.push_back({VertexId(0), id(1, i), id(1, i + 1)});
      for (int j = 1; j < kRows; ++j) {
        triangles.push_back({id(j, i), id(j + 1, i), id(j + 1, i + 1)});
        triangles.push_back({id(j, i), id(j + 1, i + 1), id(j, i + 1)});
      }
    }
    mesh = *makeMesh(positions, triangles);
  }
  static std::uint32_t at(int j, int i) {
    return j == 0
               ? 0
               : static_cast<std::uint32_t>(1 + (j - 1) * kSegments + (i + kSegments) % kSegments);
  }
  /// From ring `from` to ring `to` at segment i.
  static PolygonSoup::Chain spoke(const std::string& group, int i, int from, int to) {
    std::vector<std::uint32_t> v;
    for (int j = from; j <= to; ++j) v.push_back(at(j, i));
    return chain(group, v);
  }
  /// Around ring j from segment `from` to `to`.
  static PolygonSoup::Chain arc(const std::string& group, int j, int from, int to) {
    std::vector<std::uint32_t> v;
    for (int i = from; i <= to; ++i) v.push_back(at(j, i));
    return chain(group, v);
  }
  static Chains spokes(int count, int to = kRows) {
    Chains chains;
    for (int k = 0; k < count; ++k) {
      chains.push_back(
          spoke("wire_feature_spoke" + std::to_string(k), k * kSegments / count, 0, to));
    }
    return chains;
  }
};

}  // namespace

std::vector<GeneratedPiece> generatedPieces() {
  std::vector<GeneratedPiece> pieces;
  const auto add = [&](const std::string& name, const Mesh& mesh, const Chains& chains) -> auto& {
    return pieces.emplace_back(GeneratedPiece{name, patchOf(mesh, chains)});
  };
  const int rows = Cap::kRows;
  for (const int degrees : {30, 60, 90, 120}) {
    const Cap cap(degrees);
    const std::string name = "cap" + std::to_string(degrees);
    add(name, cap.mesh, {});
    if (degrees > 90) continue;
    add(name + "-diameter", cap.mesh, Cap::spokes(2)).wiresCross = degrees == 90;
    add(name + "-y", cap.mesh, Cap::spokes(3));
    add(name + "-cross", cap.mesh, Cap::spokes(4));
  }
  const Cap cap(60);
  add("cap60-closed", cap.mesh, {Cap::arc("wire_feature_ring", 5, 0, Cap::kSegments)});
  add("cap60-floating", cap.mesh, {Cap::arc("wire_feature_arc", 5, 3, 11)});
  add("cap60-dangling", cap.mesh, {Cap::spoke("wire_feature_end", 4, 3, rows)});
  add("cap60-junction", cap.mesh,
      {Cap::spoke("wire_feature_a", 0, 0, rows), Cap::spoke("wire_feature_b", 12, 0, rows),
       Cap::arc("wire_feature_c", 4, 0, 6), Cap::spoke("wire_feature_d", 6, 4, rows)});
  add("cap60-closed-and-linked", cap.mesh,
      {Cap::arc("wire_feature_ring", 5, 0, Cap::kSegments),
       Cap::spoke("wire_feature_link", 2, 5, rows)});
  const Cap hemisphere(90);
  add("cap90-dart", hemisphere.mesh, {Cap::spoke("wire_dart_d", 0, 0, rows)});
  add("cap90-four-darts", hemisphere.mesh,
      {Cap::spoke("wire_dart_a", 0, 2, rows), Cap::spoke("wire_dart_b", 6, 2, rows),
       Cap::spoke("wire_dart_c", 12, 2, rows), Cap::spoke("wire_dart_d", 18, 2, rows)});
  add("cap90-dart-and-ring", hemisphere.mesh,
      {Cap::spoke("wire_dart_d", 0, 3, rows), Cap::arc("wire_feature_ring", 6, 0, Cap::kSegments)});

  const auto saddle = [](double k) {
    return GridPatch(18, 16, [k](double u, double v) {
      const double x = 180 * u - 90, y = 160 * v - 80;
      return Eigen::Vector3d(x, y, k * (x * x - y * y));
    });
  };
  const GridPatch mild = saddle(0.002), strong = saddle(0.006);
  add("saddle-mild", mild.mesh, {});
  add("saddle-strong", strong.mesh, {});
  add("saddle-cross", mild.mesh,
      {mild.alongRow("wire_feature_a", 8, 0, 18), mild.alongColumn("wire_feature_b", 9, 0, 16)});
  add("saddle-dart", mild.mesh, {mild.alongRow("wire_dart_a", 8, 0, 6)}).overlapsItself = true;
  const GridPatch torus(24, 12, [](double u, double v) {
    const double around = 1.6 * u - 0.8, tube = 2 * v - 1;
    return Eigen::Vector3d((200 + 60 * std::cos(tube)) * std::sin(around),
                           -(200 + 60 * std::cos(tube)) * std::cos(around), 60 * std::sin(tube));
  });
  add("torus", torus.mesh, {});
  add("torus-line", torus.mesh, {torus.alongRow("wire_feature_a", 6, 0, 24)}).wiresCross = true;
  add("torus-box", torus.mesh, {torus.box("wire_feature_a", 6, 3, 18, 9)});
  const GridPatch bumpy(20, 20, [](double u, double v) {
    return Eigen::Vector3d(200 * u, 200 * v, 12 * std::sin(7 * u + 1) * std::cos(6 * v));
  });
  add("bumpy", bumpy.mesh, {});
  add("bumpy-grid", bumpy.mesh,
      {bumpy.alongRow("wire_feature_a", 6, 0, 20), bumpy.alongRow("wire_feature_b", 13, 0, 20),
       bumpy.alongColumn("wire_feature_c", 7, 0, 20),
       bumpy.alongColumn("wire_feature_d", 14, 0, 20)});
  add("bumpy-all-kinds", bumpy.mesh,
      {bumpy.alongRow("wire_feature_across", 4, 0, 20),
       bumpy.alongColumn("wire_feature_end", 10, 0, 3),
       bumpy.alongColumn("wire_feature_floating", 5, 8, 16),
       bumpy.box("wire_feature_closed", 10, 9, 16, 16), bumpy.alongRow("wire_dart_d", 18, 0, 5)})
      .overlapsItself = true;
  const GridPatch sleeve(14, 36, [](double u, double v) {
    const double angle = 4 * u, bend = 0.9 * std::sin(2 * pi * v);
    const double radius = 60 - 12 * v;
    return Eigen::Vector3d(radius * std::cos(angle) + 120 * bend * 0.4, radius * std::sin(angle),
                           420 * v);
  });
  add("s-sleeve", sleeve.mesh, {});
  add("s-sleeve-lines", sleeve.mesh,
      {sleeve.alongColumn("wire_feature_a", 7, 0, 36),
       sleeve.alongRow("wire_feature_b", 18, 0, 14)});
  const GridPatch spiral(90, 3, [](double u, double v) {
    const double angle = 8.5 * u;
    return Eigen::Vector3d((80 + 30 * v) * std::cos(angle), (80 + 30 * v) * std::sin(angle),
                           160 * u);
  });
  add("spiral", spiral.mesh, {}).overlapsItself = true;
  const GridPatch nose(16, 20, [](double u, double v) {
    const double x = 80 * u - 40, y = 100 * v - 50;
    return Eigen::Vector3d(x, y, 34 * std::exp(-x * x / 260) * std::exp(-y * y / 1400));
  });
  add("nose", nose.mesh, {});
  add("nose-ridge", nose.mesh, {nose.alongColumn("wire_feature_ridge", 8, 0, 20)});
  const GridPatch needles(16, 16, [](double u, double v) {
    return Eigen::Vector3d(8 * u * u * u + 0.3 * u, 160 * v, 6 * std::sin(3 * v) + u);
  });
  add("needles", needles.mesh, {needles.alongRow("wire_feature_a", 8, 0, 16)});
  const Mesh flatRing = ring(50, 120, 32, 5, [](double, double) { return 0.0; });
  const Mesh bumpyRing = ring(50, 120, 32, 5, [](double x, double y) { return 0.002 * x * y; });
  add("ring-flat", flatRing, {});
  add("ring-bumpy", bumpyRing, {});
  std::vector<std::uint32_t> across;
  for (std::uint32_t j = 0; j <= 5; ++j) across.push_back(32 * j + 7);
  add("ring-linked", bumpyRing, {chain("wire_feature_link", across)});

  const GridPatch dome(5, 5, [](double u, double v) {
    return Eigen::Vector3d(50 * u, 50 * v, 40 * u * (1 - u) * v * (1 - v));
  });
  add("over-braced-dome", dome.mesh, dome.everyEdge()).isFeasible = false;
  const GridPatch plane(5, 5,
                        [](double u, double v) { return Eigen::Vector3d(50 * u, 50 * v, 0); });
  add("over-braced-plane", plane.mesh, plane.everyEdge());
  return pieces;
}

}  // namespace toile::test
