// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "curve/local_closest.h"
#include "toile/curve/fairing.h"

namespace toile::detail {

/// Two unit vectors in the tangent plane, square to each other.
struct TangentFrame {
  Eigen::Vector3d a{1, 0, 0};  ///< along the line
  Eigen::Vector3d b{0, 1, 0};  ///< to its left
};

/// A sample of a line that is faired.
struct FairSample {
  SurfacePoint point;
  Eigen::Vector3d start{0, 0, 0};     ///< where it was at first
  Eigen::Vector3d position{0, 0, 0};  ///< where it is
  Eigen::Vector3d normal{0, 0, 1};    ///< of the surface there, smooth
  TangentFrame frame;
  int node = -1;          ///< index of a node; then position and point are the node's
  int unknown = -1;       ///< the first of two, its motion along `frame`; -1: a node's, or none
  bool isCorner = false;  ///< the line may turn sharply here
};

struct FairSampledLine {
  std::vector<FairSample> samples;
  bool closed = false;
  double spacing = 0;  ///< mm, mean
  [[nodiscard]] std::size_t size() const { return samples.size(); }
  [[nodiscard]] const FairSample& at(std::size_t i) const { return samples[i % samples.size()]; }
};

/// How turns of the line at neighbouring samples are compared.
enum class TurnModel {
  /// In frames carried along the surface, at the first spacing: the covariant third derivative of
  /// the line. Nearly linear however wildly the line winds, and blind to geodesics; but a bend of
  /// constant curvature counts a little.
  Carried,
  /// In the line's own frames: the change of geodesic curvature itself. Only true near a smooth
  /// line.
  Own
};

/// The samples of a network and what may move: how its turns depend on the unknowns.
class FairSamples {
 public:
  FairSamples(std::shared_ptr<const Mesh> mesh, const FairNetwork& network);

  [[nodiscard]] int unknownCount() const { return unknowns_; }
  [[nodiscard]] const std::vector<FairSampledLine>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<SurfacePoint>& nodes() const { return nodes_; }

  /// Rows, two for a pair of neighbouring samples that are no corners, of the change of the
  /// curvature vector: rows = constant + matrix * unknowns, weighted so that squares sum up to the
  /// integral of its square along the lines.
  struct Variation {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd constant;
  };
  [[nodiscard]] Variation variation(TurnModel model) const;
  /// What holds the samples to where they were: each line sideways, by its strength, and a little
  /// along itself, so that a crossing may slide along a line whose shape that leaves alone.
  struct Hold {
    std::vector<Eigen::Matrix2d> weight;  ///< per pair of unknowns: strength times length
    Eigen::VectorXd pull;                 ///< per unknown, back to the start
  };
  [[nodiscard]] Hold hold(const std::vector<double>& strengthOfLine) const;

  /// Where the samples of a line would go, before they are put on the surface.
  [[nodiscard]] std::vector<Eigen::Vector3d> placesAfter(std::size_t line,
                                                         const Eigen::VectorXd& unknowns) const;
  /// Bends of the line through such places.
  [[nodiscard]] int inflections(std::size_t line, const std::vector<Eigen::Vector3d>& places,
                                double leastBend) const;
  /// The farthest that a line through such places lies from the first one, either way.
  [[nodiscard]] double deviation(std::size_t line,
                                 const std::vector<Eigen::Vector3d>& places) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> places(std::size_t line) const;

  /// Moves the samples and puts them on the surface again.
  void move(const Eigen::VectorXd& unknowns);
  void returnToStart();

 private:
  /// A turn at a sample in its frame: the change of direction as a vector of the tangent plane.
  struct Turns {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> constant;  ///< two per row
    std::vector<std::vector<int>> rowOfSample;
    std::vector<double> step;  ///< mm, per row
  };
  [[nodiscard]] Turns turns(TurnModel model) const;
  void sampleLine(const FairLine& line);
  void turnFrames();
  /// First unknown that moves the sample, -1 for none, and the directions of its pair.
  [[nodiscard]] int unknownOf(const FairSample& sample) const;
  [[nodiscard]] const TangentFrame& basisOf(const FairSample& sample) const;

  std::shared_ptr<const Mesh> mesh_;
  LocalClosest closest_;
  std::vector<FairSampledLine> lines_;
  std::vector<std::vector<double>> firstSteps_;  ///< mm from each sample to the next, per line
  std::vector<std::vector<SurfacePoint>> firstPoints_;
  std::vector<SurfacePoint> nodes_, firstNodes_;
  std::vector<int> unknownOfNode_;  ///< the first of two; -1 = fixed
  std::vector<TangentFrame> frameOfNode_;
  int unknowns_ = 0;
};

}  // namespace toile::detail
