// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toile/core/units.h"
#include "toile/mesh/mesh.h"

namespace toile {

/// What a template is fitted to: measured points in mm, with faces or without. Stands and faces
/// as it likes; may have holes, noise, loose parts, faces that are no manifold.
struct Scan {
  std::string name;
  std::vector<Eigen::Vector3d> points;  ///< finite
  std::vector<Triangle> triangles;      ///< outside = counter-clockwise; empty for a cloud
  std::vector<Finding> findings;        ///< from reading
};

/// Reads a mesh file (OBJ, PLY, STL, OFF) or the points of one without faces (PLY, OBJ). What
/// readMesh() would refuse as a surface is taken face by face.
/// @return UnitsMissing when neither the file nor `unit` says it; FileFormat; FileNotFound;
///   InvalidArgument for fewer than 100 points, more than 20 million, or one that is not finite.
Result<Scan> readScan(const std::filesystem::path& path,
                      std::optional<FileUnit> unit = std::nullopt);

[[nodiscard]] Scan makeScan(std::string name, const Mesh& mesh);

}  // namespace toile
