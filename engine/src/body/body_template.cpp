// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/body_template.h"

#include <string_view>

#include "body/chains.h"
#include "body/princess_lines.h"
#include "model/vertex_path.h"
#include "toile/core/assert.h"

namespace toile::body {
namespace {

/// Which way each quad of the control net's left half is cut, four quads per hexadecimal digit from
/// its highest bit: 1 along the diagonal from its first to its third corner. Chosen once for the
/// larger angles on a few different bodies, and frozen.
constexpr std::string_view kDiagonals =
    "f07fcff3f838487c001c3c3fd0f00100c3e0fc0000000347639e401f0ff07ff3801f31d07c7f3fc7"
    "fc0386001ef03f81fc0fc07e07e0f80f03f03e03e03c33ffec31c0fc0fc0fc0fc0fc17007e3";

bool isCutFromFirstCorner(std::size_t quad) {
  const char digit = kDiagonals[quad / 4];
  const int value = digit <= '9' ? digit - '0' : digit - 'a' + 10;
  return (value >> (3 - quad % 4) & 1) != 0;
}

/// Splits the left half's quads, then takes the mirror images, so that the triangles are mirrored
/// too.
std::vector<Triangle> triangles() {
  const auto& quads = subdivision().quads();
  const std::vector<std::size_t>& partner = subdivision().partner();
  std::vector<Triangle> out;
  out.reserve(2 * quads.size());
  constexpr std::size_t kPerControlQuad = 16;
  for (std::size_t i = 0; i < quads.size() / 2; ++i) {
    const auto& q = quads[i];
    const VertexId a(q[0]), b(q[1]), c(q[2]), d(q[3]);
    // The four parts of a quad begin with its corners in turn, so that each refinement turns the
    // direction of the diagonal with every part.
    const bool isTurned = (i / 4 + i) % 2 == 1;
    if (isCutFromFirstCorner(i / kPerControlQuad) != isTurned) {
      out.push_back({a, b, c});
      out.push_back({a, c, d});
    } else {
      out.push_back({a, b, d});
      out.push_back({b, c, d});
    }
  }
  const std::size_t half = out.size();
  for (std::size_t i = 0; i < half; ++i) {
    const auto image = [&](std::size_t k) { return VertexId(partner[out[i][k].index()]); };
    out.push_back({image(0), image(2), image(1)});
  }
  return out;
}

ReferenceModel makeTemplate() {
  const Points cage = subdivision().cageThrough(controlPoints({}, 1680, {}));
  Result<Mesh> mesh = makeMesh(meshPositions(cage), triangles());
  TOILE_ASSERT(mesh.hasValue());
  ReferenceModel model = makeReferenceModel("body", std::move(*mesh));

  Symmetry symmetry;
  symmetry.partner = VertexData<VertexId>(subdivision().vertexCount());
  for (std::size_t v = 0; v < subdivision().vertexCount(); ++v) {
    symmetry.partner[VertexId(v)] = VertexId(subdivision().partner()[v]);
  }
  model.symmetry = std::move(symmetry);
  for (const auto& [name, chain] : namedChains()) {
    std::vector<VertexId> vertices;
    for (const std::size_t v : chain.vertices) vertices.emplace_back(v);
    model.curves.emplace(name, vertexPath(*model.mesh, vertices, chain.closed));
  }
  for (const auto& [name, vertex] : namedVertices()) {
    model.landmarks.emplace(name, SurfacePoint{VertexId(vertex)});
  }
  addPrincessLines(model);
  return model;
}

}  // namespace

std::vector<Eigen::Vector3d> meshPositions(const Points& cage) {
  const Points points = subdivision().weights() * cage;
  const std::vector<std::size_t>& partner = subdivision().partner();
  const double floor = points.col(2).minCoeff();
  std::vector<Eigen::Vector3d> out(partner.size());
  // Rounding differs between left and right: the left half counts, the mid-line has x = 0.
  for (std::size_t v = 0; v < partner.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    const double x = partner[v] == v ? 0 : points(row, 0);
    if (x < 0) continue;
    out[v] = {x, points(row, 1), points(row, 2) - floor};
    if (partner[v] != v) out[partner[v]] = {-x, out[v].y(), out[v].z()};
  }
  return out;
}

const ReferenceModel& bodyTemplate() {
  static const ReferenceModel model = makeTemplate();
  return model;
}

}  // namespace toile::body
