// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "toile/unfold/unfold.h"
#include "unfold/problem.h"

namespace toile::unfolding {

/// How stiff each wire is against bending, and which would wave under their compression.
///
/// Stiffness is given as beta: a wire cannot wave at lengths below beta sqrt(area). All wires begin
/// with that of the options; those that would wave get more, each for itself. See
/// docs/unfolding.md.
class WireStiffness {
 public:
  /// Wires wave when their compression passes this share of the buckling load (measured: smooth up
  /// to 1.06 at the least favourable piece).
  static constexpr double kBucklingLimit = 1.05;

  WireStiffness(const Problem& problem, const UnfoldOptions& options);

  /// Back to the options' for all.
  void reset();
  /// mm^3, for WireBending; where wires meet the stiffer one counts.
  [[nodiscard]] std::vector<double> ofCorners() const;
  /// The highest compression as a share of what that wire bears; 0 without stiffness.
  [[nodiscard]] double buckling(const Eigen::VectorXd& lambda) const;
  /// Makes wires that would wave so stiff that they bear their compression.
  /// @param most a wire's stiffness grows at most so many times.
  /// @return whether any was changed: waves longer than a fifth of the piece are its shape.
  bool raise(const Eigen::VectorXd& lambda, double most);
  /// All of them twice as stiff.
  void doubleAll();

  /// beta of the stiffest wire.
  [[nodiscard]] double greatest() const;
  /// Numbers in Piece::wires of those with more than the options', ascending; kNoWire for the
  /// unnamed border.
  [[nodiscard]] std::vector<std::uint32_t> raised() const;

 private:
  /// The compression at which a wire of this stiffness waves in the cloth beside it.
  [[nodiscard]] double loadOf(double beta) const;
  /// Highest compression of each wire; of an inner one half, for it has cloth and stiffness on both
  /// sides and bears twice as much.
  [[nodiscard]] std::vector<double> compressions(const Eigen::VectorXd& lambda) const;

  const Problem* problem_;
  double least_, highest_;    ///< beta
  double modulus_;            ///< of the cloth beside a wire
  std::vector<double> beta_;  ///< per wire; the unnamed border is the last
  std::vector<std::uint32_t> wireOfEdge_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> wiresOfCorner_;
};

}  // namespace toile::unfolding
