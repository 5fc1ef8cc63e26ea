// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>

#include "unfold/energy_term.h"

namespace toile::unfolding {

/// A point of the boundary near to an edge of it.
struct Contact {
  std::uint32_t point = 0, a = 0, b = 0;
  double reach = 0;    ///< mm: they push each other apart from there on
  double portion = 0;  ///< mm of boundary that the point stands for
};

/// Boundary edges that push each other apart, infinitely where they touch: a plane without flips
/// whose boundary is simple covers nothing twice.
///
/// The barrier begins at a thousandth of the piece's size, nearer where the way between the two
/// along the boundary is short (the tip of a dart).
/// @see Smith and Schaefer, "Bijective Parameterization with Free Boundaries", ACM TOG 34(4), 2015;
///   Li et al., "Incremental Potential Contact", ACM TOG 39(4), 2020 (the function).
class ContactBarrier : public EnergyTerm {
 public:
  explicit ContactBarrier(const Problem& problem);

  /// Pairs that are nearer than `wider` times their reach.
  /// @return nothing if the boundary crosses itself.
  [[nodiscard]] std::optional<std::vector<Contact>> contactsAt(const Plane& q, double wider) const;
  /// Takes the places of these pairs in the matrix; other pairs count in the gradient alone.
  void usePattern(const BlockPattern& pattern, const std::vector<Contact>& contacts);

  [[nodiscard]] double energy(const Plane& q) const override;
  void addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                      BlockMatrix& hessian) const override;

 private:
  struct Edge {
    std::uint32_t a = 0, b = 0;
    std::size_t loop = 0;
    double begin = 0;  ///< mm from the start of the loop
    double length = 0;
    double portion = 0;  ///< mm of boundary that `a` stands for
  };
  [[nodiscard]] Contact contactOf(const Edge& point, const Edge& edge) const;

  std::vector<Edge> edges_;
  std::vector<double> loopLength_;
  double reach_;
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Pair, BlockPattern::Place> places_;
};

/// The pairs of vertices that contacts couple.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> couplingsOf(
    const std::vector<Contact>& contacts);

}  // namespace toile::unfolding
