// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/missing_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toile::fitting {
namespace {

/// The side of a part after one that ends its opening: round the vertex, inside the part.
HalfedgeId nextOfOpening(const Mesh& mesh, const std::vector<char>& isIn, HalfedgeId side) {
  HalfedgeId next = mesh.next(side);
  for (HalfedgeId over = mesh.opposite(next); over.isValid() && isIn[mesh.face(over).index()] != 0;
       over = mesh.opposite(next)) {
    next = mesh.next(over);
  }
  return next;
}

/// Area vectors and centres of the openings fill them flat, whatever their form.
void measure(const Mesh& mesh, const std::vector<char>& isIn, MissingPart& part) {
  for (const FaceId f : part.faces) {
    const auto& [a, b, c] = mesh.vertices(f);
    const double area =
        0.5 *
        (mesh.position(b) - mesh.position(a)).cross(mesh.position(c) - mesh.position(a)).norm();
    part.area += area;
    part.centre += area * (mesh.position(a) + mesh.position(b) + mesh.position(c)) / 3;
  }
  if (part.area > 0) part.centre /= part.area;
  const auto cone = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
    return (a - part.centre).cross(b - part.centre).dot(c - part.centre) / 6;
  };
  double volume = 0, openings = 0;
  std::vector<char> isDone(3 * part.faces.size(), 0);
  const auto slot = [&](HalfedgeId h) {
    const auto at = std::lower_bound(part.faces.begin(), part.faces.end(), mesh.face(h));
    return 3 * static_cast<std::size_t>(at - part.faces.begin()) + h.index() % 3;
  };
  for (const FaceId f : part.faces) {
    const auto& [a, b, c] = mesh.vertices(f);
    volume += cone(mesh.position(a), mesh.position(b), mesh.position(c));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId first = mesh.halfedge(f, k);
      const HalfedgeId over = mesh.opposite(first);
      if (isDone[slot(first)] != 0 || (over.isValid() && isIn[mesh.face(over).index()] != 0)) {
        continue;
      }
      std::vector<Eigen::Vector3d> loop;
      for (HalfedgeId h = first; isDone[slot(h)] == 0; h = nextOfOpening(mesh, isIn, h)) {
        isDone[slot(h)] = 1;
        loop.push_back(mesh.position(mesh.from(h)));
      }
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3d& p : loop) middle += p / static_cast<double>(loop.size());
      Eigen::Vector3d area = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector3d& to = loop[(i + 1) % loop.size()];
        area += 0.5 * (loop[i] - middle).cross(to - middle);
        volume += cone(to, loop[i], middle);
      }
      openings += std::pow(area.norm(), 1.5);
    }
  }
  part.reach = openings > 0 ? volume / openings : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<MissingPart> findMissingParts(const Mesh& fit, const std::vector<char>& isMissing) {
  const std::size_t count = fit.faceCount();
  std::vector<char> isOpen(count, 0);
  for (std::size_t f = 0; f < count; ++f) {
    const Triangle& t = fit.vertices(FaceId(f));
    isOpen[f] =
        std::all_of(t.begin(), t.end(), [&](VertexId v) { return isMissing[v.index()] != 0; });
  }
  const std::vector<char> isIn = isOpen;
  std::vector<MissingPart> parts;
  for (std::size_t f = 0; f < count; ++f) {
    if (isOpen[f] == 0) continue;
    isOpen[f] = 0;
    MissingPart part;
    part.faces.emplace_back(f);
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId over = fit.opposite(fit.halfedge(part.faces[i], k));
        if (!over.isValid() || isOpen[fit.face(over).index()] == 0) continue;
        isOpen[fit.face(over).index()] = 0;
        part.faces.push_back(fit.face(over));
      }
    }
    std::sort(part.faces.begin(), part.faces.end());
    measure(fit, isIn, part);
    parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const MissingPart& a, const MissingPart& b) { return a.area > b.area; });
  return parts;
}

}  // namespace toile::fitting
