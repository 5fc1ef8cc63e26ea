// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toile/mesh/mesh_file.h"

namespace toile {

/// How a model file is, and what is wrong with it.
struct MeshCheck {
  std::optional<MeshFile> file;    ///< as readMesh() gives it; nothing when it is refused
  std::optional<Error> refusal;    ///< why no mesh can be made of it: NotManifold, NotOrientable
  std::vector<std::string> facts;  ///< size, parts, borders: one sentence each
  /// What reading had to mend, then what is still wrong. Vertices and faces of the former are the
  /// file's, of the latter the mesh's: the file's where nothing had to be mended.
  std::vector<Finding> findings;
};

/// Looks for everything that reading looks for, and for borders that lie on each other without
/// being joined, and for faces that cross.
///
/// @return an Error where the file cannot be read at all, or has no unit.
/// @par Cost  that of reading, and about 1 s for 100k faces
Result<MeshCheck> checkMesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

/// The mesh with borders joined where they lie on each other, in addition to what reading mends.
Result<MeshFile> repairMesh(const std::filesystem::path& path, ReadMeshOptions options = {});

/// Pairs of faces that cross or touch without sharing a vertex or edge there, ascending; faces
/// without area are not looked at.
[[nodiscard]] std::vector<std::pair<FaceId, FaceId>> findCrossingFaces(const Mesh& mesh);

}  // namespace toile
