// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <iterator>

#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& out, T value) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  out.append(bytes.data(), bytes.size());
}

}  // namespace

std::string writeObj(const Mesh& mesh) {
  std::string out = "# toile-units: mm\n";
  out.reserve(60 * mesh.vertexCount() + 24 * mesh.faceCount());
  // fmt writes the shortest decimal that reads back to the same double.
  for (const Eigen::Vector3d& p : mesh.positions()) {
    fmt::format_to(std::back_inserter(out), "v {} {} {}\n", p.x(), p.y(), p.z());
  }
  for (const Triangle& t : mesh.triangles()) {
    fmt::format_to(std::back_inserter(out), "f {} {} {}\n", t[0].index() + 1, t[1].index() + 1,
                   t[2].index() + 1);
  }
  return out;
}

std::string writePly(const Mesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment toile-units: mm\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertexCount(), mesh.faceCount());
  out.reserve(out.size() + 24 * mesh.vertexCount() + 13 * mesh.faceCount());
  for (const Eigen::Vector3d& p : mesh.positions()) {
    for (int axis = 0; axis < 3; ++axis) append(out, p[axis]);
  }
  for (const Triangle& t : mesh.triangles()) {
    append(out, std::uint8_t{3});
    for (const VertexId v : t) append(out, v.index());
  }
  return out;
}

}  // namespace toile
