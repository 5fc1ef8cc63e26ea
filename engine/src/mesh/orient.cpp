// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/orient.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace toile::detail {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Component {
  std::vector<std::uint32_t> faces;  // in the order of the walk
  bool isClosed = true;
  bool isMixed = false;
  double volume = 0;  // six times, of the faces as turned
  Eigen::AlignedBox3d box;
};

class Orienter {
 public:
  Orienter(const std::vector<Eigen::Vector3d>& positions, std::vector<Triangle>& triangles,
           const std::vector<EdgeSide>& sides)
      : positions_(positions),
        triangles_(triangles),
        neighbour_(3 * triangles.size(), kNone),
        isTurned_(triangles.size(), false),
        isVisited_(triangles.size(), false) {
    forEachEdge(sides, [&](std::span<const EdgeSide> edge) {
      if (edge.size() != 2) return;
      neighbour_[edge[0].halfedge] = edge[1].halfedge;
      neighbour_[edge[1].halfedge] = edge[0].halfedge;
    });
  }

  Orientation orient() {
    std::vector<Component> components;
    for (std::uint32_t seed = 0; seed < triangles_.size(); ++seed) {
      if (!isVisited_[seed]) components.push_back(walk(seed));
    }
    for (const Component& component : components) takeMajority(component);
    for (Component& component : components) measure(component);
    for (std::size_t i = 0; i < components.size(); ++i) {
      result_.firstFaceOfComponent.push_back(components[i].faces.front());
      faceOutward(components, i);
    }
    std::sort(result_.turned.begin(), result_.turned.end());
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      if (isTurned_[f]) std::swap(triangles_[f][1], triangles_[f][2]);
    }
    return std::move(result_);
  }

 private:
  /// Vertex where the halfedge begins, as the file has it.
  [[nodiscard]] VertexId from(std::uint32_t halfedge) const {
    return triangles_[halfedge / 3][halfedge % 3];
  }

  Component walk(std::uint32_t seed) {
    Component component;
    component.faces.push_back(seed);
    isVisited_[seed] = true;
    for (std::size_t i = 0; i < component.faces.size(); ++i) {
      const std::uint32_t face = component.faces[i];
      for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const std::uint32_t other = neighbour_[h];
        if (other == kNone) {
          component.isClosed = false;
          continue;
        }
        // Two neighbours that agree run along their edge in opposite directions.
        const bool agrees = from(h) != from(other);
        if (!agrees) component.isMixed = true;
        const bool wanted = agrees ? isTurned_[face] : !isTurned_[face];
        const std::uint32_t next = other / 3;
        if (!isVisited_[next]) {
          isVisited_[next] = true;
          isTurned_[next] = wanted;
          component.faces.push_back(next);
        } else if (isTurned_[next] != wanted && h < other) {
          const std::uint32_t end = 3 * face + (h + 1) % 3;
          result_.contradictions.emplace_back(from(h).index(), from(end).index());
        }
      }
    }
    return component;
  }

  void turnAll(const Component& component) {
    for (const std::uint32_t f : component.faces) isTurned_[f] = !isTurned_[f];
  }

  void takeMajority(const Component& component) {
    std::size_t turned = 0;
    for (const std::uint32_t f : component.faces) turned += isTurned_[f] ? 1 : 0;
    if (2 * turned > component.faces.size()) turnAll(component);
  }

  void measure(Component& component) {
    // About a point of the component: about the origin a far-away one would be lost to rounding.
    const Eigen::Vector3d origin = positions_[triangles_[component.faces.front()][0].index()];
    for (const std::uint32_t f : component.faces) {
      const Eigen::Vector3d a = positions_[triangles_[f][0].index()] - origin;
      const Eigen::Vector3d b = positions_[triangles_[f][1].index()] - origin;
      const Eigen::Vector3d c = positions_[triangles_[f][2].index()] - origin;
      const double volume = a.dot(b.cross(c));
      component.volume += isTurned_[f] ? -volume : volume;
      for (const VertexId v : triangles_[f]) component.box.extend(positions_[v.index()]);
    }
  }

  void faceOutward(const std::vector<Component>& components, std::size_t i) {
    const Component& component = components[i];
    if (component.isClosed && component.volume < 0) {
      bool isHollow = false;
      for (std::size_t k = 0; k < components.size() && !isHollow; ++k) {
        isHollow = k != i && components[k].isClosed && components[k].box.contains(component.box);
      }
      if (isHollow) {
        result_.cavities.push_back(component.faces.front());
      } else {
        turnAll(component);
        if (!component.isMixed) {
          result_.turnedOut.push_back(component.faces.front());
          return;
        }
      }
    }
    if (!component.isMixed) return;
    for (const std::uint32_t f : component.faces) {
      if (isTurned_[f]) result_.turned.push_back(f);
    }
  }

  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> neighbour_;
  std::vector<bool> isTurned_;
  std::vector<bool> isVisited_;
  Orientation result_;
};

}  // namespace

Orientation orientConsistently(const std::vector<Eigen::Vector3d>& positions,
                               std::vector<Triangle>& triangles,
                               const std::vector<EdgeSide>& sides) {
  return Orienter(positions, triangles, sides).orient();
}

}  // namespace toile::detail
