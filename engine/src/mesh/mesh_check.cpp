// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace toile {
namespace {

constexpr std::size_t kMaxNamed = 24;

/// Border vertices that lie exactly on another one, ascending.
std::vector<VertexId> coincidentBorderVertices(const Mesh& mesh) {
  std::vector<VertexId> border;
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (mesh.isBorder(VertexId(v))) border.emplace_back(v);
  }
  const auto key = [&](VertexId v) {
    const Eigen::Vector3d& p = mesh.position(v);
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::sort(border.begin(), border.end(),
            [&](VertexId a, VertexId b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<VertexId> coincident;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const bool isSame = (i > 0 && key(border[i]) == key(border[i - 1])) ||
                        (i + 1 < border.size() && key(border[i]) == key(border[i + 1]));
    if (isSame) coincident.push_back(border[i]);
  }
  std::sort(coincident.begin(), coincident.end());
  return coincident;
}

void describe(const Mesh& mesh, std::vector<std::string>& facts) {
  const Eigen::Vector3d size = mesh.boxMax() - mesh.boxMin();
  facts.push_back(fmt::format("{} vertices, {} triangles, {:.1f} x {:.1f} x {:.1f} mm",
                              mesh.vertexCount(), mesh.faceCount(), size.x(), size.y(), size.z()));
  const std::vector<std::vector<HalfedgeId>> loops = mesh.boundaryLoops();
  const std::size_t parts = mesh.componentCount();
  if (loops.empty()) {
    // Closed: V - E + F = 2 parts - 2 handles.
    const std::int64_t handles =
        (2 * static_cast<std::int64_t>(parts) - mesh.eulerCharacteristic()) / 2;
    facts.push_back(fmt::format("closed, {} {}, {} {}", parts, parts == 1 ? "part" : "parts",
                                handles, handles == 1 ? "handle" : "handles"));
    return;
  }
  facts.push_back(fmt::format("open, {} {}, {} border {}", parts, parts == 1 ? "part" : "parts",
                              loops.size(), loops.size() == 1 ? "loop" : "loops"));
  constexpr std::size_t kShown = 12;
  for (std::size_t i = 0; i < std::min(kShown, loops.size()); ++i) {
    double length = 0;
    for (const HalfedgeId h : loops[i]) length += mesh.length(mesh.edge(h));
    facts.push_back(fmt::format("border loop of {} edges, {:.1f} mm, at vertex {}", loops[i].size(),
                                length, mesh.from(loops[i].front()).index()));
  }
  if (loops.size() > kShown) {
    facts.push_back(fmt::format("and {} more border loops", loops.size() - kShown));
  }
}

void findFaults(const Mesh& mesh, std::vector<Finding>& findings) {
  if (const std::vector<VertexId> coincident = coincidentBorderVertices(mesh);
      !coincident.empty()) {
    Finding finding{
        "borders-not-joined",
        fmt::format("{} border vertices lie exactly on another one, the first is vertex "
                    "{}: parts that look joined are not; `toile check --repair` joins "
                    "them",
                    coincident.size(), coincident.front().index()),
        {}};
    for (std::size_t i = 0; i < std::min(kMaxNamed, coincident.size()); ++i) {
      finding.where.push_back(Element::vertex(coincident[i]));
    }
    findings.push_back(std::move(finding));
  }
  const std::vector<std::pair<FaceId, FaceId>> crossings = findCrossingFaces(mesh);
  if (crossings.empty()) return;
  std::set<FaceId> faces;
  for (const auto& [f, g] : crossings) {
    if (faces.size() >= kMaxNamed) break;
    faces.insert({f, g});
  }
  Finding finding{
      "faces-cross",
      fmt::format("{} pairs of faces cross, the first are the faces {} and {}; curves "
                  "and cuts keep to the surface, but pieces there cannot be worn as "
                  "they look",
                  crossings.size(), crossings[0].first.index(), crossings[0].second.index()),
      {}};
  for (const FaceId f : faces) finding.where.push_back(Element::face(f));
  findings.push_back(std::move(finding));
}

bool isAboutTheSurface(ErrorCode code) {
  return code == ErrorCode::NotManifold || code == ErrorCode::NotOrientable;
}

}  // namespace

Result<MeshCheck> checkMesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  Result<MeshFile> file = readMesh(path, options);
  MeshCheck check;
  if (!file) {
    if (!isAboutTheSurface(file.error().code)) return file.error();
    check.refusal = file.error();
    return check;
  }
  check.findings = file->findings;
  describe(file->mesh, check.facts);
  findFaults(file->mesh, check.findings);
  check.file = std::move(*file);
  return check;
}

Result<MeshFile> repairMesh(const std::filesystem::path& path, ReadMeshOptions options) {
  Result<MeshFile> file = readMesh(path, options);
  if (!file || coincidentBorderVertices(file->mesh).empty()) return file;
  options.weldAll = true;
  Result<MeshFile> joined = readMesh(path, options);
  if (joined) return joined;
  // Where joining would make an edge of three faces, the parts stay apart.
  file->findings.push_back(
      {"borders-left-apart",
       "borders that lie on each other were not joined: " + joined.error().message,
       joined.error().where});
  return file;
}

}  // namespace toile
