// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toile/model/reference_model.h"

namespace toile {

/// Which half of the sheet a chart lies on.
enum class MapSide {
  Front,  ///< seen from the front: the wearer's right on the left of the sheet
  Back    ///< seen from behind
};

/// A part of the model that the map shows in one piece.
struct MapChart {
  std::string name;  ///< unique in the map, such as "front"
  MapSide side = MapSide::Front;
  friend bool operator==(const MapChart&, const MapChart&) = default;
};

/// A flat map of a model, made once: it says where on the sheet a place of the model belongs.
///
/// Near an isometry, as large as the model in area, right side up, faces counter-clockwise, the
/// body's up along +y. Both sides have the medial axis at x = 0; on a model with a symmetry pairing
/// mirrored faces lie at mirrored places, bit for bit.
struct GuidingMap {
  std::vector<MapChart> charts;
  FaceData<std::uint32_t> chartOf;                   ///< index in charts
  FaceData<std::array<Eigen::Vector2d, 3>> corners;  ///< mm, in the face's corner order
  /// Place of a surface point that lies in that face.
  [[nodiscard]] Eigen::Vector2d place(const Mesh& mesh, const SurfacePoint& point,
                                      FaceId face) const;
  friend bool operator==(const GuidingMap&, const GuidingMap&) = default;
};

/// Where the map of a model is kept once it is made; copies of the model share it.
class GuidingMapSlot {
 public:
  GuidingMapSlot() = default;
  explicit GuidingMapSlot(GuidingMap given);
  /// A given map belongs to the model's file and is carried to other bodies; one that was made
  /// follows from the model.
  [[nodiscard]] bool isGiven() const { return isGiven_; }

 private:
  friend std::shared_ptr<const GuidingMap> guidingMap(const ReferenceModel& model);
  std::once_flag once_;
  std::shared_ptr<const GuidingMap> map_;
  bool isGiven_ = false;
};

/// The map of a model: the one given in its file, else makeGuidingMap(), made at the first call.
[[nodiscard]] std::shared_ptr<const GuidingMap> guidingMap(const ReferenceModel& model);

/// Proposes charts and flattens them.
///
/// Borders lie at sharp turns of the surface. What still turns away from itself (a body, a limb) is
/// parted in two, by a minimum cut that weighs which way each face looks against the length of the
/// border: into front and back, or along the direction that shows most of it. Charts that cannot
/// lie flat without lying on themselves are parted further, where they bend most. Mirrored faces
/// get mirrored charts.
/// @par Cost  a minimum cut and one sparse factorisation a chart: bench/layout_bench.cpp
/// @see Boykov, Kolmogorov, "An Experimental Comparison of Min-Cut/Max-Flow Algorithms for Energy
///   Minimization in Vision", IEEE PAMI 26(9), 2004.
[[nodiscard]] GuidingMap makeGuidingMap(const ReferenceModel& model);

/// The same with borders along the model's own curves instead of sharp turns.
/// @return NameNotFound for a curve that the model does not have.
Result<GuidingMap> makeGuidingMap(const ReferenceModel& model,
                                  std::span<const std::string> borderCurves);

/// Flattens given charts: every face's index in `charts`. Each by a least squares conformal map,
/// with the spectral condition in place of two pins, so that no vertex is preferred; then every
/// triangle is made as rigid as possible, since a conformal map draws limbs several times too
/// small or too large; then what is turned over is put right.
/// @see Levy, Petitjean, Ray, Maillot, "Least Squares Conformal Maps for Automatic Texture Atlas
///   Generation", SIGGRAPH 2002; Mullen, Tong, Alliez, Desbrun, "Spectral Conformal
///   Parameterization", SGP 2008; Liu, Zhang, Xu, Gotsman, Gortler, "A Local/Global Approach to
///   Mesh Parameterization", SGP 2008; Garanzha et al., "Foldover-free Maps in 50 Lines of Code",
///   ACM TOG 40(4), 2021.
[[nodiscard]] GuidingMap flattenCharts(const ReferenceModel& model, std::vector<MapChart> charts,
                                       FaceData<std::uint32_t> chartOf);

/// Carries a map to another model: the charts go along, the places are made of the new shape.
/// @param sourceFace per face of the model the face of the map's own model that its middle
///   corresponds to; the same faces for a body of the same connectivity.
[[nodiscard]] GuidingMap carryGuidingMap(const GuidingMap& map, const ReferenceModel& model,
                                         const FaceData<FaceId>& sourceFace);

/// {"charts": [{"name", "side", "faces", "places"}]}, places per vertex of those faces in ascending
/// order; or {"borders": ["side_l", ...]}, which makes the map of that model.
/// @return FileFormat when it does not fit the mesh; NameNotFound.
Result<GuidingMap> parseGuidingMap(const ReferenceModel& model, std::string_view json,
                                   const std::string& file);
[[nodiscard]] std::string writeGuidingMap(const Mesh& mesh, const GuidingMap& map);

}  // namespace toile
