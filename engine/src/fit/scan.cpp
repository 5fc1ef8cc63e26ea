// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/fit/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

constexpr std::size_t kFewestPoints = 100;
constexpr std::size_t kMostPoints = 20'000'000;

/// Face by face, without looking at how they meet; equal positions are one point.
Scan takeFaces(std::string name, const PolygonSoup& soup, double scale) {
  Scan scan;
  scan.name = std::move(name);
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<VertexId> point;
  for (const Eigen::Vector3d& p : soup.positions) {
    const auto [at, isNew] = known.try_emplace({p.x(), p.y(), p.z()}, scan.points.size());
    if (isNew) scan.points.push_back(scale * p);
    point.emplace_back(at->second);
  }
  for (const auto& polygon : soup.polygons) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Triangle t{point[polygon[0]], point[polygon[k - 1]], point[polygon[k]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) scan.triangles.push_back(t);
    }
  }
  return scan;
}

}  // namespace

Result<Scan> readScan(const std::filesystem::path& path, std::optional<FileUnit> unit) {
  const std::string file = path.string();
  Result<PolygonSoup> soup = readPolygonSoup(path);
  if (!soup) return soup.error();
  if (soup->unit && unit && *soup->unit != *unit) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{}: its unit is {}, --units says {}; leave out --units", file,
                             toString(*soup->unit), toString(*unit)),
                 {}};
  }
  const std::optional<FileUnit> known = soup->unit ? soup->unit : unit;
  if (!known) {
    return Error{ErrorCode::UnitsMissing,
                 fmt::format("{} does not say its unit; give --units mm, cm, m or in", file),
                 {}};
  }
  if (soup->positions.size() < kFewestPoints || soup->positions.size() > kMostPoints) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} has {} points; a scan needs {} to {}", file,
                             soup->positions.size(), kFewestPoints, kMostPoints),
                 {}};
  }
  for (std::size_t i = 0; i < soup->positions.size(); ++i) {
    if (soup->positions[i].allFinite()) continue;
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{}: point {} has a coordinate that is no number", file, i),
                 {Element::vertex(VertexId(i))}};
  }
  Scan loose = takeFaces(path.stem().string(), *soup, millimetresPer(*known));
  if (loose.triangles.empty()) return loose;
  Result<MeshFile> mesh = makeMeshFromSoup(std::move(*soup), {.unit = unit});
  if (!mesh) {
    loose.findings.push_back(
        {"scan-not-a-surface", file + " is taken face by face: " + mesh.error().message, {}});
    return loose;
  }
  Scan scan = makeScan(path.stem().string(), mesh->mesh);
  scan.findings = std::move(mesh->findings);
  return scan;
}

Scan makeScan(std::string name, const Mesh& mesh) {
  return {std::move(name), mesh.positions(), mesh.triangles(), {}};
}

}  // namespace toile
