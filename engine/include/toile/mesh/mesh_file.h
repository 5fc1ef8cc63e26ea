// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/result.h"
#include "toile/core/units.h"
#include "toile/mesh/mesh.h"

namespace toile {

/// What a file says, before it is judged: polygons in their order, chains of `l` records with the
/// group they stand under.
struct PolygonSoup {
  struct Chain {
    std::string group;
    std::vector<std::uint32_t> vertices;  ///< 0-based; closed if first == last
    std::uint64_t line = 0;               ///< of the file, for messages; 0 = made, not read
  };
  std::vector<Eigen::Vector3d> positions;  ///< in the file's own unit
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<Chain> chains;  ///< OBJ only
  std::map<std::string, double>
      targets;                   ///< OBJ `# target <wire> <edge> <mm>`: key "<wire> <edge>"
  std::optional<FileUnit> unit;  ///< from a `toile-units` comment
  /// The format writes the corners of every face anew (STL): equal positions are one vertex.
  bool repeatsPositions = false;
  std::vector<Finding> findings;
};

/// Reads OBJ, PLY (ascii, binary of both byte orders), STL (both), OFF, by content and extension.
/// Limits on counts before anything is allocated; a damaged file is refused with line or byte.
Result<PolygonSoup> readPolygonSoup(const std::filesystem::path& path);
/// The same from memory; `name` is used in messages and its extension as a hint.
Result<PolygonSoup> parsePolygonSoup(std::string_view content, const std::string& name);

struct ReadMeshOptions {
  std::optional<FileUnit> unit;  ///< of a file that does not say; a contradiction is an error
  /// Joins equal positions where the file repeats them for every face: STL always, other formats
  /// when no two faces share a vertex.
  bool weld = true;
  bool weldAll = false;  ///< joins equal positions whatever the file does
};

/// A mesh ready for design, in mm, and what had to be done to it.
struct MeshFile {
  Mesh mesh;
  std::vector<PolygonSoup::Chain> chains;
  std::map<std::string, double> targets;
  std::vector<Finding> findings;  ///< turned faces, removed duplicates, unit hint, components, ...
};

/// Reads, triangulates polygons (concave ones too), removes duplicate and index-degenerate faces
/// and unused vertices, makes the orientation consistent (and outward when closed), saying so in
/// findings; where nothing had to be done vertex and face order are the file's. Chains follow their
/// vertices; one through a vertex without faces is left out, with a finding. Numbers of vertices
/// and faces in messages and in `where` of errors are the file's, counted from 0.
///
/// @return UnitsMissing when neither the file nor the options know the unit; NotManifold and
///   NotOrientable with the elements; FileFormat; FileNotFound.
Result<MeshFile> readMesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});
Result<MeshFile> makeMeshFromSoup(PolygonSoup soup, const ReadMeshOptions& options = {});

/// OBJ text with the `toile-units: mm` comment; numbers read back bit for bit.
std::string writeObj(const Mesh& mesh);
/// Binary little-endian PLY with double coordinates and the units comment.
std::string writePly(const Mesh& mesh);

}  // namespace toile
