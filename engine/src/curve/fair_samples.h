// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "curve/local_closest.h"
#include "toile/curve/fairing.h"

namespace toile::detail {

/// A sample of a line that is faired.
struct FairSample {
  SurfacePoint point;
  Eigen::Vector3d start{0, 0, 0};     ///< where it was at first
  Eigen::Vector3d position{0, 0, 0};  ///< where it is
  Eigen::Vector3d side{1, 0, 0};      ///< unit, in the surface, to the left of the line
  int node = -1;                      ///< index of a node; then position and point are the node's
  int unknown = -1;  ///< index of its sideways motion; -1: moves with its node or not at all
};

struct FairSampledLine {
  std::vector<FairSample> samples;
  bool closed = false;
  double spacing = 0;  ///< mm, mean
  [[nodiscard]] std::size_t size() const { return samples.size(); }
  [[nodiscard]] const FairSample& at(std::size_t i) const { return samples[i % samples.size()]; }
};

/// The samples of a network and what may move: how its curvatures depend on the unknowns.
class FairSamples {
 public:
  FairSamples(std::shared_ptr<const Mesh> mesh, const FairNetwork& network);

  [[nodiscard]] int unknownCount() const { return unknowns_; }
  [[nodiscard]] const std::vector<FairSampledLine>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<SurfacePoint>& nodes() const { return nodes_; }

  /// Geodesic curvature times step, of every interior sample: turns = constant + matrix * unknowns.
  struct Turns {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd constant;
    std::vector<std::size_t> firstRow;  ///< per line, and the end; rows of a line are consecutive
    std::vector<double> step;           ///< mm, per row
  };
  [[nodiscard]] Turns turns() const;
  /// Rows of the variation of curvature, weighted so that squares sum up to its integral.
  [[nodiscard]] Eigen::SparseMatrix<double> variation(const Turns& turns) const;
  /// Per unknown: the length it stands for by line, and how far it is from its first place.
  struct Hold {
    Eigen::VectorXd weight;    ///< strength of the line (of both, for a node) times length
    Eigen::VectorXd distance;  ///< from the start, along the unknown
  };
  [[nodiscard]] Hold hold(const std::vector<double>& strengthOfLine) const;
  /// The line that an unknown of a sample belongs to; -1 for a node's.
  [[nodiscard]] const std::vector<int>& lineOfUnknown() const { return lineOfUnknown_; }

  /// Moves the samples and puts them on the surface again.
  void move(const Eigen::VectorXd& unknowns);
  void returnToStart();
  [[nodiscard]] double deviation(std::size_t line) const;

 private:
  void sampleLine(const FairLine& line, std::size_t index);
  void turnFrames();

  std::shared_ptr<const Mesh> mesh_;
  LocalClosest closest_;
  std::vector<FairSampledLine> lines_;
  std::vector<SurfacePoint> nodes_, firstNodes_;
  std::vector<int> unknownOfNode_;  ///< the first of two; -1 = fixed
  struct Frame {
    Eigen::Vector3d a, b, start;
  };
  std::vector<Frame> frameOfNode_;
  std::vector<int> lineOfUnknown_;
  std::vector<std::vector<SurfacePoint>> firstPoints_;
  int unknowns_ = 0;
};

}  // namespace toile::detail
