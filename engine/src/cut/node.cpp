// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/node.h"

namespace toile::cutting {

Eigen::Vector3d position(const Mesh& mesh, const Node& node) {
  constexpr double kPart = 1.0 / static_cast<double>(kUnit);
  switch (node.kind) {
    case Node::Kind::Vertex:
      return mesh.position(VertexId(node.element));
    case Node::Kind::Edge: {
      const EdgeId e(node.element);
      const double t = node.p * kPart;
      return (1.0 - t) * mesh.position(mesh.tail(e)) + t * mesh.position(mesh.head(e));
    }
    case Node::Kind::Face:
      break;
  }
  const Triangle& corners = mesh.vertices(FaceId(node.element));
  const double b1 = node.p * kPart;
  const double b2 = node.q * kPart;
  return (1.0 - b1 - b2) * mesh.position(corners[0]) + b1 * mesh.position(corners[1]) +
         b2 * mesh.position(corners[2]);
}

SurfacePoint surfacePoint(const Node& node) {
  constexpr double kPart = 1.0 / static_cast<double>(kUnit);
  switch (node.kind) {
    case Node::Kind::Vertex:
      return {VertexId(node.element)};
    case Node::Kind::Edge:
      return {SurfacePoint::OnEdge{EdgeId(node.element), node.p * kPart}};
    case Node::Kind::Face:
      break;
  }
  const double b1 = node.p * kPart;
  const double b2 = node.q * kPart;
  return {SurfacePoint::InFace{FaceId(node.element), Eigen::Vector3d(1.0 - b1 - b2, b1, b2)}};
}

FaceFrame::FaceFrame(const Mesh& mesh, FaceId face) : face_(face), corners_(mesh.vertices(face)) {
  for (int side = 0; side < 3; ++side) {
    const HalfedgeId h = mesh.halfedge(face, side);
    const auto k = static_cast<std::size_t>(side);
    edges_[k] = mesh.edge(h);
    fromTail_[k] = mesh.from(h) < mesh.to(h);
  }
  const Eigen::Vector3d u = mesh.position(corners_[1]) - mesh.position(corners_[0]);
  const Eigen::Vector3d v = mesh.position(corners_[2]) - mesh.position(corners_[0]);
  const double width = u.norm();
  const Eigen::Vector3d axis = width > 0 ? Eigen::Vector3d(u / width) : Eigen::Vector3d::Zero();
  const double along = axis.dot(v);
  second_ = {width, 0};
  third_ = {along, (v - along * axis).norm()};
}

LatticePoint FaceFrame::lattice(const Node& node) const {
  constexpr std::array<LatticePoint, 3> kCorners{{{0, 0}, {kUnit, 0}, {0, kUnit}}};
  if (node.kind == Node::Kind::Face) return {node.p, node.q};
  if (node.kind == Node::Kind::Vertex) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners_[k].index() == node.element) return kCorners[k];
    }
  } else {
    for (int side = 0; side < 3; ++side) {
      if (edge(side).index() != node.element) continue;
      const std::int64_t t = alongEdge(side, node.p);  // its own inverse
      const LatticePoint& a = kCorners[static_cast<std::size_t>(side)];
      const LatticePoint& b = kCorners[static_cast<std::size_t>((side + 1) % 3)];
      return {(a.x * (kUnit - t) + b.x * t) / kUnit, (a.y * (kUnit - t) + b.y * t) / kUnit};
    }
  }
  TOILE_ASSERT(false && "the node lies on the face");
  return {};
}

Eigen::Vector2d FaceFrame::flat(const LatticePoint& point) const {
  return (static_cast<double>(point.x) * second_ + static_cast<double>(point.y) * third_) / kParts;
}

std::int64_t FaceFrame::reach(double distance) const {
  // x goes from 0 to kUnit over the height of the second corner above the opposite side.
  const double height = second_.x() * third_.y() / third_.norm();
  if (!(distance < height)) return kUnit;
  return static_cast<std::int64_t>(distance / height * kParts) + 2;
}

int FaceFrame::commonSide(const LatticePoint& a, const LatticePoint& b) const {
  if (a.y == 0 && b.y == 0) return 0;
  if (a.x + a.y == kUnit && b.x + b.y == kUnit) return 1;
  if (a.x == 0 && b.x == 0) return 2;
  return -1;
}

std::int64_t FaceFrame::alongSide(int side, const LatticePoint& point) {
  return side == 0 ? point.x : (side == 1 ? point.y : kUnit - point.y);
}

}  // namespace toile::cutting
