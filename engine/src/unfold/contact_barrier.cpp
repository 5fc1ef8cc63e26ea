// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/contact_barrier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "unfold/edge_grid.h"
#include "unfold/orientation.h"

namespace toile::unfolding {
namespace {

/// Where the barrier begins, as a share of the root of the area.
constexpr double kReach = 1e-3;
/// The same as a share of the way along the boundary: the sides of a dart that opens by more than
/// twice this angle do not push each other.
constexpr double kReachOfWay = 0.02;
/// Stiffness as that of the cloth beside it, so that the matrix stays well conditioned.
constexpr double kModulus = 4;

struct Distance {
  double value = 0;
  double t = 0;            ///< share of the edge at the nearest point
  Eigen::Vector2d normal;  ///< from there to the point
};

Distance distanceTo(const Plane& q, const Contact& contact) {
  const Eigen::Vector2d p = at(q, contact.point), a = at(q, contact.a);
  const Eigen::Vector2d along = at(q, contact.b) - a;
  Distance distance;
  distance.t = std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0);
  const Eigen::Vector2d apart = p - a - distance.t * along;
  distance.value = apart.norm();
  distance.normal = apart / distance.value;
  return distance;
}

/// -(x - 1)^2 log x with its derivatives, x = distance / reach.
struct Barrier {
  double value = 0, first = 0, second = 0;
};
Barrier barrierAt(double x) {
  const double y = x - 1, log = std::log(x);
  return {-y * y * log, -2 * y * log - y * y / x, -2 * log - 4 * y / x + y * y / (x * x)};
}

double weightOf(const Contact& contact) {
  return kModulus * contact.portion * contact.reach;
}

bool cross(const Plane& q, std::pair<std::uint32_t, std::uint32_t> e,
           std::pair<std::uint32_t, std::uint32_t> f) {
  const Eigen::Vector2d a = at(q, e.first), b = at(q, e.second);
  const Eigen::Vector2d c = at(q, f.first), d = at(q, f.second);
  return orientation(a, b, c) * orientation(a, b, d) < 0 &&
         orientation(c, d, a) * orientation(c, d, b) < 0;
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> couplingsOf(
    const std::vector<Contact>& contacts) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Contact& contact : contacts) {
    pairs.emplace_back(contact.point, contact.a);
    pairs.emplace_back(contact.point, contact.b);
  }
  return pairs;
}

ContactBarrier::ContactBarrier(const Problem& problem) : reach_(kReach * std::sqrt(problem.area)) {
  std::map<Pair, double> target;
  for (const WireEdge& edge : problem.wireEdges) {
    target[std::minmax(edge.a, edge.b)] = edge.target;
  }
  for (std::size_t l = 0; l < problem.loops.size(); ++l) {
    const std::vector<std::uint32_t>& loop = problem.loops[l];
    double way = 0;
    const std::size_t first = edges_.size();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      const double length = target.at(std::minmax(a, b));
      edges_.push_back({a, b, l, way, length, 0});
      way += length;
    }
    for (std::size_t i = first; i < edges_.size(); ++i) {
      const double before = (i == first ? edges_.back() : edges_[i - 1]).length;
      edges_[i].portion = 0.5 * (before + edges_[i].length);
    }
    loopLength_.push_back(way);
  }
}

Contact ContactBarrier::contactOf(const Edge& point, const Edge& edge) const {
  double reach = reach_;
  if (point.loop == edge.loop) {
    const double whole = loopLength_[edge.loop];
    const auto wayTo = [&](double end) {
      const double ahead = std::abs(point.begin - end);
      return std::min(ahead, std::abs(whole - ahead));
    };
    reach =
        std::min(reach, kReachOfWay * std::min(wayTo(edge.begin), wayTo(edge.begin + edge.length)));
  }
  return {point.a, edge.a, edge.b, reach, point.portion};
}

std::optional<std::vector<Contact>> ContactBarrier::contactsAt(const Plane& q, double wider) const {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments;
  segments.reserve(edges_.size());
  for (const Edge& edge : edges_) segments.emplace_back(at(q, edge.a), at(q, edge.b));
  std::vector<Contact> contacts;
  const auto consider = [&](const Edge& point, const Edge& edge) {
    if (point.a == edge.a || point.a == edge.b) return;
    const Contact contact = contactOf(point, edge);
    if (contact.reach > 0 && distanceTo(q, contact).value < wider * contact.reach) {
      contacts.push_back(contact);
    }
  };
  for (const auto& [i, j] : nearSegments(segments, 0.5 * wider * reach_)) {
    const Edge& e = edges_[i];
    const Edge& f = edges_[j];
    if (e.a == f.a || e.b == f.b) continue;  // the boundary touches itself there
    if (e.b != f.a && f.b != e.a && cross(q, {e.a, e.b}, {f.a, f.b})) return std::nullopt;
    consider(e, f);
    consider(f, e);
  }
  return contacts;
}

void ContactBarrier::usePattern(const BlockPattern& pattern, const std::vector<Contact>& contacts) {
  places_.clear();
  for (const Contact& contact : contacts) {
    for (const Pair& pair : {Pair{contact.point, contact.a}, Pair{contact.point, contact.b},
                             Pair{contact.a, contact.b}}) {
      places_[pair] = pattern.find(pair.first, pair.second);
    }
  }
}

double ContactBarrier::energy(const Plane& q) const {
  const std::optional<std::vector<Contact>> contacts = contactsAt(q, 1);
  if (!contacts) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const Contact& contact : *contacts) {
    sum += weightOf(contact) * barrierAt(distanceTo(q, contact).value / contact.reach).value;
  }
  return sum;
}

/// The curvature of the distance itself would only take from the matrix: left out.
void ContactBarrier::addDerivatives(const Plane& q, double /*indefinite*/,
                                    Eigen::VectorXd& gradient, BlockMatrix& hessian) const {
  const std::optional<std::vector<Contact>> contacts = contactsAt(q, 1);
  if (!contacts) return;
  for (const Contact& contact : *contacts) {
    const Distance distance = distanceTo(q, contact);
    const Barrier barrier = barrierAt(distance.value / contact.reach);
    const double weight = weightOf(contact);
    const double pull = weight * barrier.first / contact.reach;
    const double stiffness = weight * barrier.second / (contact.reach * contact.reach);
    const std::array<std::uint32_t, 3> node{contact.point, contact.a, contact.b};
    const std::array<double, 3> share{1, distance.t - 1, -distance.t};
    const Eigen::Vector2d& n = distance.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      gradient.segment<2>(2 * Eigen::Index{node[k]}) += pull * share[k] * n;
      const double own = stiffness * share[k] * share[k];
      hessian.addDiagonal(node[k], own * n.x() * n.x(), own * n.x() * n.y(), own * n.y() * n.y());
    }
    for (const auto& [k, l] : {std::pair{0U, 1U}, {0U, 2U}, {1U, 2U}}) {
      const auto place = places_.find({node[k], node[l]});
      if (place == places_.end()) continue;
      hessian.add(place->second, stiffness * share[k] * share[l] * n * n.transpose());
    }
  }
}

}  // namespace toile::unfolding
