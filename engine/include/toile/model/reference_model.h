// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/units.h"
#include "toile/mesh/surface_index.h"

namespace toile {

/// Left and right of a model.
struct Symmetry {
  Eigen::Vector3d normal{1, 0, 0};  ///< unit normal of the mirror plane, to the model's left
  double offset = 0;                ///< mm; plane: normal . x = offset
  /// For every vertex its partner (itself on the mid-line); empty when there is no exact pairing.
  VertexData<VertexId> partner;
};

class GuidingMapSlot;

/// What is designed on: a mesh with names. A value that shares its large parts.
struct ReferenceModel {
  std::string name;
  std::string reference;  ///< as written in designs: a path or "builtin:..."
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const SurfaceIndex> index;
  std::map<std::string, SurfacePath> curves;  ///< feature curves
  std::map<std::string, SurfacePoint> landmarks;
  std::optional<Symmetry> symmetry;
  std::shared_ptr<GuidingMapSlot> map;  ///< for guidingMap() (toile/model/guiding_map.h)
  std::vector<Finding> findings;        ///< from reading
};

/// A model without names, indexed.
[[nodiscard]] ReferenceModel makeReferenceModel(std::string name, Mesh mesh);

/// Puts names on a model: each file's entries are refused when they do not fit the connectivity.
/// `curves.json` and `landmarks.json` as in docs/file-format.md (curves by triangle and barycentric
/// weights, landmarks by vertex).
Result<std::map<std::string, SurfacePath>> parseModelCurves(const Mesh& mesh, std::string_view json,
                                                            const std::string& file);
Result<std::map<std::string, SurfacePoint>> parseLandmarks(const Mesh& mesh, std::string_view json,
                                                           const std::string& file);

/// Reads a model: a mesh file alone, or a `*.model.json` that names the mesh, its unit, curves,
/// landmarks, symmetry. Paths in it are relative to it. Limits, errors as in readMesh().
Result<ReferenceModel> readModel(const std::filesystem::path& path,
                                 std::optional<FileUnit> unit = std::nullopt);

/// The same names on another mesh of the same connectivity. ModelMismatch otherwise.
Result<ReferenceModel> withMesh(const ReferenceModel& names, std::string name, Mesh mesh);

/// Pairs vertices across the plane normal . x = offset by position and connectivity: a seed is
/// found by position, its partner's surroundings follow by walking both sides at once.
/// @param tolerance mm that a vertex may lie beside its partner's mirror image
/// @return a full pairing (an orientation-reversing automorphism that is its own inverse), or
///   nullopt.
/// @par Cost  O(n) where the mesh is symmetric
std::optional<VertexData<VertexId>> findSymmetryPairing(const Mesh& mesh,
                                                        const Eigen::Vector3d& normal,
                                                        double offset, double tolerance);
/// The same without positions, for bodies in any posture: landmarks `x_l` and `x_r` are partners.
/// One such pair is the seed, all others must agree.
std::optional<VertexData<VertexId>> findSymmetryPairing(
    const Mesh& mesh, const std::map<std::string, SurfacePoint>& landmarks);
/// The mirror plane that fits a pairing best; its normal points to the side that has more of +x.
Symmetry makeSymmetry(const Mesh& mesh, VertexData<VertexId> partner);

}  // namespace toile
