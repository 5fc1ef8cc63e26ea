// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/untangle.h"

#include <algorithm>

#include "fit/lay_out.h"
#include "fit/surface.h"
#include "toile/mesh/mesh_check.h"

namespace toile::fitting {
namespace {

constexpr int kTrials = 5;
constexpr double kNearlyTurned = 0.0;  // cosine: such are laid out anew already

/// Marks the vertices of that many rings around those marked.
void grow(const Mesh& mesh, int rings, std::vector<char>& isMarked) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<char> wider = isMarked;
    for (const Triangle& t : mesh.triangles()) {
      if (std::any_of(t.begin(), t.end(), [&](VertexId v) { return isMarked[v.index()] != 0; })) {
        for (const VertexId v : t) wider[v.index()] = 1;
      }
    }
    isMarked = std::move(wider);
  }
}

/// The marked vertices as patches that hang together along edges.
std::vector<std::vector<std::uint32_t>> patchesOf(const Mesh& mesh,
                                                  const std::vector<char>& isMarked) {
  std::vector<std::vector<std::uint32_t>> patches;
  std::vector<char> isLeft = isMarked;
  for (std::uint32_t first = 0; first < isLeft.size(); ++first) {
    if (isLeft[first] == 0) continue;
    std::vector<std::uint32_t>& patch = patches.emplace_back();
    patch.push_back(first);
    isLeft[first] = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const FaceId face : mesh.facesAround(VertexId(patch[i]))) {
        for (const VertexId v : mesh.vertices(face)) {
          if (isLeft[v.index()] == 0) continue;
          isLeft[v.index()] = 0;
          patch.push_back(v.index());
        }
      }
    }
  }
  return patches;
}

}  // namespace

std::vector<FaceId> turnedFaces(const Mesh& connectivity,
                                const std::vector<Eigen::Vector3d>& positions,
                                const Expectation& expected, double leastCosine) {
  std::vector<FaceId> turned;
  for (std::size_t f = 0; f < connectivity.faceCount(); ++f) {
    const Eigen::Vector3d cross = faceCross(positions, connectivity.vertices(FaceId(f)));
    if (cross.dot(expected.normals[f]) <= leastCosine * cross.norm()) turned.emplace_back(f);
  }
  return turned;
}

void untangle(const Mesh& connectivity, const Expectation& expected,
              std::vector<Eigen::Vector3d>& positions) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<FaceId> turned =
        turnedFaces(connectivity, positions, expected, kNearlyTurned);
    if (turned.empty()) return;
    std::vector<char> isMarked(positions.size(), 0);
    for (const FaceId face : turned) {
      for (const VertexId v : connectivity.vertices(face)) isMarked[v.index()] = 1;
    }
    grow(connectivity, 1 + trial, isMarked);
    // With nothing left to hang on there is no place for it.
    if (std::all_of(isMarked.begin(), isMarked.end(), [](char m) { return m != 0; })) return;
    layOut(connectivity, expected.shape, expected.linear, isMarked, positions);
  }
}

void uncross(const Mesh& connectivity, const Expectation& expected,
             std::vector<Eigen::Vector3d>& positions) {
  auto crossing = findCrossingFaces(connectivity.withPositions(positions));
  // A shape that crosses everywhere is no fit; nothing of this would help.
  if (crossing.size() > connectivity.faceCount() / 50) return;
  for (int trial = 0; trial < kTrials && !crossing.empty(); ++trial) {
    std::vector<char> isMarked(positions.size(), 0);
    for (const auto& [a, b] : crossing) {
      for (const VertexId v : connectivity.vertices(a)) isMarked[v.index()] = 1;
      for (const VertexId v : connectivity.vertices(b)) isMarked[v.index()] = 1;
    }
    grow(connectivity, 1 + trial, isMarked);
    if (std::all_of(isMarked.begin(), isMarked.end(), [](char m) { return m != 0; })) return;
    std::vector<Eigen::Matrix3d> linear = expected.linear;
    for (const std::vector<std::uint32_t>& patch : patchesOf(connectivity, isMarked)) {
      Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
      for (const std::uint32_t v : patch) mean += linear[v] / static_cast<double>(patch.size());
      for (const std::uint32_t v : patch) linear[v] = mean;
    }
    std::vector<Eigen::Vector3d> laidOut = positions;
    layOut(connectivity, expected.shape, linear, isMarked, laidOut);
    auto left = findCrossingFaces(connectivity.withPositions(laidOut));
    if (left.size() >= crossing.size() ||
        turnedFaces(connectivity, laidOut, expected).size() >
            turnedFaces(connectivity, positions, expected).size()) {
      continue;
    }
    positions = std::move(laidOut);
    crossing = std::move(left);
  }
}

}  // namespace toile::fitting
