// SPDX-License-Identifier: GPL-3.0-or-later
// An orientation-reversing automorphism maps halfedge a -> b to b' -> a'. It is known for a whole
// component once it is known for one halfedge: next goes to previous, opposite to opposite.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "toile/model/reference_model.h"

namespace toile {
namespace {

class Pairing {
 public:
  /// Asked for each pair of vertices before it is taken.
  using Accepts = std::function<bool(VertexId, VertexId)>;

  Pairing(const Mesh& mesh, Accepts accepts)
      : mesh_(mesh),
        accepts_(std::move(accepts)),
        image_(mesh.halfedgeCount()),
        partner_(mesh.vertexCount()) {}

  [[nodiscard]] bool has(VertexId v) const { return partner_[v].isValid(); }

  /// Maps h to one of the halfedges that end in `to`, with everything that follows from it; leaves
  /// all as it was if none fits. Precondition: h begins at a vertex without partner.
  bool extend(HalfedgeId h, VertexId to) {
    const HalfedgeId first = mesh_.outgoing(to);
    HalfedgeId out = first;
    do {
      if (walk(h, mesh_.previous(out))) return true;
      out = mesh_.opposite(mesh_.previous(out));
    } while (out.isValid() && out != first);
    return false;
  }

  std::optional<VertexData<VertexId>> take() {
    for (std::size_t v = 0; v < partner_.size(); ++v) {
      const VertexId other = partner_[VertexId(v)];
      if (!other.isValid() || partner_[other] != VertexId(v)) return std::nullopt;
    }
    return std::move(partner_);
  }

 private:
  bool walk(HalfedgeId from, HalfedgeId to) {
    std::vector<HalfedgeId> newHalfedges;
    std::vector<VertexId> newVertices;
    const auto undo = [&] {
      for (const HalfedgeId h : newHalfedges) image_[h] = HalfedgeId();
      for (const VertexId v : newVertices) partner_[v] = VertexId();
      return false;
    };
    const auto pair = [&](VertexId v, VertexId w) {
      if (partner_[v].isValid()) return partner_[v] == w;
      if (!accepts_(v, w)) return false;
      partner_[v] = w;
      newVertices.push_back(v);
      return true;
    };
    std::vector<std::pair<HalfedgeId, HalfedgeId>> waiting{{from, to}};
    while (!waiting.empty()) {
      const auto [h, g] = waiting.back();
      waiting.pop_back();
      if (image_[h].isValid()) {
        if (image_[h] != g) return undo();
        continue;
      }
      if (!pair(mesh_.from(h), mesh_.to(g)) || !pair(mesh_.to(h), mesh_.from(g))) return undo();
      image_[h] = g;
      newHalfedges.push_back(h);
      const HalfedgeId across = mesh_.opposite(h);
      const HalfedgeId acrossImage = mesh_.opposite(g);
      if (across.isValid() != acrossImage.isValid()) return undo();
      if (across.isValid()) waiting.emplace_back(across, acrossImage);
      waiting.emplace_back(mesh_.next(h), mesh_.previous(g));
    }
    return true;
  }

  const Mesh& mesh_;
  Accepts accepts_;
  HalfedgeData<HalfedgeId> image_;
  VertexData<VertexId> partner_;
};

/// Finds vertices by place: sorted along one axis.
class VertexFinder {
 public:
  explicit VertexFinder(const Mesh& mesh) : mesh_(mesh) {
    (mesh.boxMax() - mesh.boxMin()).maxCoeff(&axis_);
    order_.reserve(mesh.vertexCount());
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) order_.emplace_back(v);
    std::sort(order_.begin(), order_.end(), [&](VertexId a, VertexId b) {
      return height(a) != height(b) ? height(a) < height(b) : a < b;
    });
  }

  /// Within the tolerance, nearest first.
  [[nodiscard]] std::vector<VertexId> near(const Eigen::Vector3d& place, double tolerance) const {
    std::vector<std::pair<double, VertexId>> found;
    const auto begin =
        std::lower_bound(order_.begin(), order_.end(), place[axis_] - tolerance,
                         [&](VertexId v, double value) { return height(v) < value; });
    for (auto v = begin; v != order_.end() && height(*v) <= place[axis_] + tolerance; ++v) {
      const double distance = (mesh_.position(*v) - place).norm();
      if (distance <= tolerance) found.emplace_back(distance, *v);
    }
    std::sort(found.begin(), found.end());
    std::vector<VertexId> vertices;
    for (const auto& [distance, v] : found) vertices.push_back(v);
    return vertices;
  }

 private:
  [[nodiscard]] double height(VertexId v) const { return mesh_.position(v)[axis_]; }

  const Mesh& mesh_;
  Eigen::Index axis_ = 0;
  std::vector<VertexId> order_;
};

struct LandmarkPair {
  VertexId left;
  VertexId right;
};

std::vector<LandmarkPair> pairsOf(const std::map<std::string, SurfacePoint>& landmarks) {
  std::vector<LandmarkPair> pairs;
  for (const auto& [name, point] : landmarks) {
    if (!name.ends_with("_l")) continue;
    const auto other = landmarks.find(name.substr(0, name.size() - 1) + "r");
    if (other == landmarks.end()) continue;
    const auto* left = std::get_if<VertexId>(&point.at);
    const auto* right = std::get_if<VertexId>(&other->second.at);
    if (left != nullptr && right != nullptr) pairs.push_back({*left, *right});
  }
  return pairs;
}

}  // namespace

std::optional<VertexData<VertexId>> findSymmetryPairing(const Mesh& mesh,
                                                        const Eigen::Vector3d& normal,
                                                        double offset, double tolerance) {
  if (!normal.allFinite() || normal.isZero(0) || !(tolerance >= 0)) return std::nullopt;
  const Eigen::Vector3d unit = normal.normalized();
  const double distance = offset / normal.norm();
  const auto mirrored = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p - 2 * (unit.dot(p) - distance) * unit;
  };
  const VertexFinder finder(mesh);
  Pairing pairing(mesh, [&](VertexId v, VertexId w) {
    return (mirrored(mesh.position(v)) - mesh.position(w)).norm() <= tolerance;
  });
  // Each component starts anew from its first vertex.
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
    const VertexId v(i);
    if (pairing.has(v)) continue;
    const std::vector<VertexId> candidates = finder.near(mirrored(mesh.position(v)), tolerance);
    const bool isFound = std::any_of(candidates.begin(), candidates.end(), [&](VertexId w) {
      return pairing.extend(mesh.outgoing(v), w);
    });
    if (!isFound) return std::nullopt;
  }
  return pairing.take();
}

std::optional<VertexData<VertexId>> findSymmetryPairing(
    const Mesh& mesh, const std::map<std::string, SurfacePoint>& landmarks) {
  const std::vector<LandmarkPair> pairs = pairsOf(landmarks);
  VertexData<VertexId> wanted(mesh.vertexCount());
  for (const auto& [left, right] : pairs) {
    wanted[left] = right;
    wanted[right] = left;
  }
  Pairing pairing(mesh,
                  [&](VertexId v, VertexId w) { return !wanted[v].isValid() || wanted[v] == w; });
  for (const auto& [left, right] : pairs) {
    if (pairing.has(left)) continue;
    if (!pairing.extend(mesh.outgoing(left), right)) return std::nullopt;
    if (!pairing.has(right) && !pairing.extend(mesh.outgoing(right), left)) return std::nullopt;
  }
  return pairing.take();
}

Symmetry makeSymmetry(const Mesh& mesh, VertexData<VertexId> partner) {
  // The normal along which partners differ most: sum of d d^T has it as its main direction.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d d = mesh.position(VertexId(v)) - mesh.position(partner[VertexId(v)]);
    spread += d * d.transpose();
  }
  Symmetry symmetry;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  symmetry.normal = solver.eigenvectors().col(2);
  // A plane across an axis is so exactly.
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(symmetry.normal[axis]) - 1) < 1e-12) {
      symmetry.normal = Eigen::Vector3d::Unit(axis);
    }
  }
  if (symmetry.normal.x() < 0) symmetry.normal = -symmetry.normal;
  double sum = 0;
  for (const Eigen::Vector3d& p : mesh.positions()) sum += symmetry.normal.dot(p);
  symmetry.offset = sum / static_cast<double>(mesh.vertexCount());
  symmetry.partner = std::move(partner);
  return symmetry;
}

}  // namespace toile
