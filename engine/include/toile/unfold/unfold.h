// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toile/core/progress.h"
#include "toile/cut/cut.h"
#include "toile/mesh/mesh_file.h"

namespace toile {

enum class UnfoldObjective {
  LeastStrain,  ///< least strain of the cloth, wires stay smooth
  WireWarping   ///< wires bent the least; the cloth is filled in
};
/// How the corners of wires count in WireWarping.
enum class WireWeights {
  Unit,   ///< all the same, as in the paper: the answer depends on the sampling
  Length  ///< by 1 / length of wire; corners and junctions by 1 / mean length
};

/// Woven or knitted cloth: what it resists, up to which strains, and where its warp runs.
struct Cloth {
  ClothWeights weights;
  /// Greatest strains it bears; beyond them it resists a hundred times as much. None = no limit.
  std::optional<Ratio> stretchAlong, stretchAcross, shear;
  Grain grain;
};

struct UnfoldOptions {
  UnfoldObjective objective = UnfoldObjective::LeastStrain;
  WireWeights weights = WireWeights::Length;  ///< of WireWarping
  /// kappa of the objective: price of area change against shear; 0 = plain symmetric Dirichlet.
  double areaWeight = 2;  ///< 0..1000
  /// beta: wires cannot wave below beta * sqrt(area); raised by its own rule where they would
  /// crinkle.
  double wireStiffness = 0.05;  ///< 0..10
  int maxSteps = 100;           ///< of the solver
  /// Cloth that is not alike in all directions; the piece is laid with its grain upright.
  std::optional<Cloth> cloth{};
  /// A piece that is its own mirror image to rounding unfolds to one (least strain); symmetrise()
  /// is for pieces that are so nearly.
  bool keepSymmetry = true;
  /// Edges of a piece that would lie on itself are kept apart (least strain), as far as that is
  /// possible with all lengths.
  bool keepApart = true;
};

/// How far one face is from its shape on the body.
struct FaceDistortion {
  double stretchMax = 1;  ///< larger singular value of the map body -> plane
  double stretchMin = 1;  ///< smaller one
  [[nodiscard]] double areaRatio() const { return stretchMax * stretchMin; }
};

/// What was verified after the solve, from the final positions alone.
struct UnfoldCheck {
  double maxLengthError = 0;  ///< over wire edges: |flat - target| / max(target, 1 mm)
  double maxClosureGap = 0;   ///< mm: of walking each boundary loop by its flat edges
  std::size_t flippedFaces = 0;
  std::size_t crossings = 0;  ///< pairs of wire edges that cross without sharing a node
  /// Greatest |theta - alpha| at wire nodes that are not corners (|pi - alpha| < 35 degrees),
  /// radians.
  double maxTurnError = 0;
  [[nodiscard]] bool passes() const {
    return maxLengthError <= 1e-9 && flippedFaces == 0 && crossings == 0 && maxClosureGap <= 1e-6;
  }
};

/// By how much an elastic line was made longer or shorter.
struct ElasticLine {
  std::string curve;
  double range = 0;  ///< what was allowed, either way
  double ratio = 0;  ///< what was taken: lengths are 1 + ratio times the piece's targets
};

/// The elastic lines of a piece and what other ratios would cost it: near these ratios the strain
/// energy changes by gradient . d + d . stiffness d / 2, in mm^2.
struct ElasticAnswer {
  std::vector<ElasticLine> lines;  ///< in the order of the piece's wires
  Eigen::VectorXd gradient;
  Eigen::MatrixXd stiffness;
};

/// A part of the plane that the piece covers twice.
struct Overlap {
  std::array<std::vector<FaceId>, 2>
      layers;  ///< the faces there: on the piece, and so on the model
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double area = 0;  ///< mm^2, covered by both
};

/// The piece in the plane: right side up, y up, faces counter-clockwise, mm.
struct FlatPiece {
  VertexData<Eigen::Vector2d> position;
  FaceData<FaceDistortion> distortion;
  UnfoldCheck check;
  int steps = 0;             ///< of the solver
  double wireStiffness = 0;  ///< the beta used at the end
  double meanAreaError = 0;  ///< area-weighted mean of |A2/A3 - 1|
  double maxAreaError = 0;
  /// Sum of w (theta - alpha)^2 over the wire corners, WireWarping's J; without the constant of the
  /// tips of wires that end in the cloth. 0 with the other objective.
  double wireBending = 0;
  ElasticAnswer elastic;  ///< of wires with an elastic range
  /// What would be covered twice, or is where wires cross; by falling area.
  std::vector<Overlap> overlaps;
  std::vector<Finding> findings;  ///< crossings, high strain, saddle point, ...
};

/// Unfolds a piece with the exact target length of every wire edge and the least strain.
///
/// Minimises symmetric Dirichlet energy with an area price plus a bending energy of the wires
/// subject to |q_i - q_j| = target on all wire edges; infeasible-start SQP from a conformal start.
/// The answer is a function of piece and options alone: no history, any number of threads. Centroid
/// at the origin; turned so that the model's up (z) points up on average.
///
/// @param piece a disk, possibly with holes.
/// @return the flat piece with its checks (the caller decides on crossings), or
///   NotADisk (one vertex per boundary loop), DegenerateFace, LengthsInfeasible (worst wires),
///   NotConverged, Cancelled.
/// @par Cost  at most one sparse factorisation of the mesh a step; steps are counted in
/// docs/unfolding.md
/// @see docs/unfolding.md for the objective and the solver.
Result<FlatPiece> unfold(const Piece& piece, const UnfoldOptions& options = {},
                         Progress* progress = nullptr);

/// Quick answers while a line is dragged or a body is changed.
///
/// The first answer, and one for a piece of other connectivity or wires, starts anew; the others go
/// on from the last and reuse the order of elimination. One step each: lengths are right to about a
/// thousandth and the strain is nearly the least. For the eye, never for cutting: the answer
/// depends on the ones before it.
class UnfoldPreview {
 public:
  explicit UnfoldPreview(const UnfoldOptions& options = {});
  ~UnfoldPreview();
  UnfoldPreview(const UnfoldPreview&) = delete;
  UnfoldPreview& operator=(const UnfoldPreview&) = delete;

  /// @return what unfold() returns, but LengthsInfeasible, which a preview does not find out.
  /// @par Cost  about half of unfold() at first, a fifth after a change.
  Result<FlatPiece> update(const Piece& piece, Progress* progress = nullptr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A piece from a surface patch alone: inner chains become wires (darts open the surface), the
/// border becomes border wires. Face order is the mesh's; without darts vertex order too. Group
/// names are `wire_<kind>_<id>`; a chain without group is a feature.
/// @return CurveInvalid for a chain step that is no mesh edge or an unknown wire kind, with the
/// line.
Result<Piece> makePiece(const std::string& name, const Mesh& mesh,
                        const std::vector<PolygonSoup::Chain>& chains,
                        const std::map<std::string, double>& targets = {});

/// The patch with its plane as OBJ: vertices and faces of `mesh` in their order, `vt` in mm, one
/// per vertex of the piece (those on a dart have one per side), the chains under their groups (a
/// chain without one as `wire_feature_chain-<n>`) and the targets that differ from the surface.
/// @param piece of makePiece() with the same mesh, chains and targets.
std::string writePatchObj(const Mesh& mesh, const std::vector<PolygonSoup::Chain>& chains,
                          const std::map<std::string, double>& targets, const Piece& piece,
                          const FlatPiece& flat);

}  // namespace toile
