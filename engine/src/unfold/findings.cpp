// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "unfold/check.h"
#include "unfold/over_bracing.h"
#include "unfold/solution.h"
#include "unfold/wire_stiffness.h"

namespace toile::unfolding {
namespace {

/// Mean energy per area from which a piece should not be cut in one.
constexpr double kHighStrain = 0.3;
constexpr std::size_t kMaxNamed = 24;

/// The wires with the greatest length errors: curves first, then the edges themselves.
std::vector<Element> worstWires(const Piece& piece, const Problem& problem,
                                const Eigen::VectorXd& residual) {
  std::vector<std::uint32_t> order(problem.wireEdges.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto error = [&](std::uint32_t i) {
    return std::abs(residual[i]) / std::max(problem.wireEdges[i].target, 1.0);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return error(a) > error(b); });
  std::vector<Element> where;
  const double limit = 0.1 * error(order.front());
  const auto addOnce = [&](Element element) {
    if (where.size() < kMaxNamed && std::find(where.begin(), where.end(), element) == where.end()) {
      where.push_back(std::move(element));
    }
  };
  for (const std::uint32_t i : order) {
    if (error(i) < limit) break;
    const std::uint32_t wire = problem.wireEdges[i].wire;
    if (wire != WireEdge::kNoWire) addOnce(Element::curve(piece.wires[wire].curve));
  }
  for (const std::uint32_t i : order) {
    if (error(i) < limit) break;
    addOnce(Element::edge(
        piece.mesh->findEdge(VertexId(problem.wireEdges[i].a), VertexId(problem.wireEdges[i].b))));
  }
  return where;
}

/// Curves whose edges brace each other more than rigidly, in the piece's order.
std::vector<std::string> overBracedCurves(const Piece& piece, const Problem& problem) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bars;
  bars.reserve(problem.wireEdges.size());
  for (const WireEdge& edge : problem.wireEdges) bars.emplace_back(edge.a, edge.b);
  std::set<std::uint32_t> wires;
  for (const auto& part : findOverBraced(problem.vertexCount, bars)) {
    for (const std::uint32_t bar : part) wires.insert(problem.wireEdges[bar].wire);
  }
  std::vector<std::string> curves;
  for (const std::uint32_t wire : wires) {
    const std::string curve = wire == WireEdge::kNoWire ? "border" : piece.wires[wire].curve;
    if (std::find(curves.begin(), curves.end(), curve) == curves.end()) curves.push_back(curve);
  }
  return curves;
}

/// Of each part that is covered twice a face of either layer, the largest part first.
void nameOverlaps(const std::vector<Overlap>& overlaps, std::vector<Element>& where) {
  for (const Overlap& overlap : overlaps) {
    for (const std::vector<FaceId>& layer : overlap.layers) {
      if (where.size() < kMaxNamed) where.push_back(Element::face(layer[layer.size() / 2]));
    }
  }
}

/// Where the plane is covered twice, for people.
std::string describe(const std::vector<Overlap>& overlaps) {
  if (overlaps.empty()) return "nothing is covered twice but wires cross inside";
  constexpr std::size_t kMaxTold = 3;
  std::string text = fmt::format("{} part{} covered twice:", overlaps.size(),
                                 overlaps.size() == 1 ? " is" : "s are");
  for (std::size_t i = 0; i < std::min(kMaxTold, overlaps.size()); ++i) {
    const Overlap& o = overlaps[i];
    text += fmt::format("{} {:.2g} cm2 at ({:.0f}, {:.0f}) mm", i > 0 ? "," : "", o.area / 100,
                        o.middle.x(), o.middle.y());
  }
  return text + (overlaps.size() > kMaxTold ? " and others" : "");
}

}  // namespace

Error infeasible(const Piece& piece, const Problem& problem, const NewtonState& state,
                 const WireLengths& lengths) {
  const Eigen::VectorXd residual = lengths.residual(state.q, state.ratios);
  std::vector<Element> where = worstWires(piece, problem, residual);
  const std::vector<std::string> braced = overBracedCurves(piece, problem);
  const std::string left = fmt::format("{:.2g} % is left", 100 * lengths.worst(residual));
  if (!braced.empty()) {
    for (auto curve = braced.rbegin(); curve != braced.rend(); ++curve) {
      std::erase(where, Element::curve(*curve));
      where.insert(where.begin(), Element::curve(*curve));
    }
    if (where.size() > kMaxNamed) where.resize(kMaxNamed);
    constexpr std::size_t kMaxInMessage = 6;
    const std::span<const std::string> named(braced.data(), std::min(braced.size(), kMaxInMessage));
    return {
        ErrorCode::LengthsInfeasible,
        fmt::format("\"{}\"{} brace each other so that not all lengths can be kept ({}); take "
                    "one away, make one elastic, or give the lines between their crossings more "
                    "points",
                    fmt::join(named, "\", \""), braced.size() > kMaxInMessage ? " and others" : "",
                    left),
        std::move(where)};
  }
  const std::string first =
      !where.empty() && where.front().kind == Element::Kind::Curve ? where.front().name : "border";
  return {ErrorCode::LengthsInfeasible,
          fmt::format("the lengths of the wires contradict each other: {}, the worst at \"{}\"; "
                      "release a feature there, make it elastic or split the piece",
                      left, first),
          std::move(where)};
}

std::vector<Finding> makeFindings(const Piece& piece, const Problem& problem,
                                  const UnfoldOptions& options, const Solution& solution,
                                  const FlatPiece& flat) {
  std::vector<Finding> findings;
  const auto curveOf = [&](std::uint32_t wireEdge) {
    const std::uint32_t wire = problem.wireEdges[wireEdge].wire;
    return wire == WireEdge::kNoWire ? std::string("border") : piece.wires[wire].curve;
  };
  if (flat.check.crossings == 0 && !flat.overlaps.empty()) {
    Finding finding{"kept-apart",
                    fmt::format("the piece would lie on itself in the plane ({}); its edges were "
                                "kept apart, with {:.1f} % mean area error: a dart or a cut there "
                                "needs less",
                                describe(flat.overlaps), 100 * flat.meanAreaError),
                    {}};
    nameOverlaps(flat.overlaps, finding.where);
    findings.push_back(std::move(finding));
  }
  if (flat.check.crossings > 0) {
    Finding finding{"crossings",
                    fmt::format("{} pairs of wire edges cross in the plane: the piece overlaps "
                                "itself and has to be cut into two; {}",
                                flat.check.crossings, describe(flat.overlaps)),
                    {}};
    for (const auto& [a, b] : solution.crossings) {
      for (const std::uint32_t i : {a, b}) {
        Element element = Element::curve(curveOf(i));
        if (finding.where.size() < kMaxNamed &&
            std::find(finding.where.begin(), finding.where.end(), element) == finding.where.end()) {
          finding.where.push_back(std::move(element));
        }
      }
    }
    nameOverlaps(flat.overlaps, finding.where);
    findings.push_back(std::move(finding));
  }
  if (solution.meanEnergy > kHighStrain) {
    Finding finding{"high-strain",
                    fmt::format("the surface is too curved to be cut in one: {:.1f} % mean and "
                                "{:.0f} % greatest area error; add a dart or another seam",
                                100 * flat.meanAreaError, 100 * flat.maxAreaError),
                    {}};
    std::vector<std::uint32_t> order(problem.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto error = [&](std::uint32_t i) {
      return std::abs(flat.distortion[FaceId(i)].areaRatio() - 1);
    };
    const std::size_t named = std::min<std::size_t>(8, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(named),
                      order.end(), [&](std::uint32_t a, std::uint32_t b) {
                        return error(a) != error(b) ? error(a) > error(b) : a < b;
                      });
    for (std::size_t i = 0; i < named; ++i) {
      finding.where.push_back(Element::face(FaceId(order[i])));
    }
    findings.push_back(std::move(finding));
  }
  if (!solution.stiffened.empty()) {
    Finding finding{"wires-stiffened",
                    fmt::format("wires would have waved; their stiffness was raised from {:.3g} to "
                                "{:.3g} at most",
                                options.wireStiffness, solution.wireStiffness),
                    {}};
    for (const std::uint32_t wire : solution.stiffened) {
      Element element =
          Element::curve(wire == WireEdge::kNoWire ? "border" : piece.wires[wire].curve);
      if (finding.where.size() < kMaxNamed &&
          std::find(finding.where.begin(), finding.where.end(), element) == finding.where.end()) {
        finding.where.push_back(std::move(element));
      }
    }
    findings.push_back(std::move(finding));
  }
  if (!solution.stable || solution.buckling > WireStiffness::kBucklingLimit) {
    findings.push_back({"wires-may-wave",
                        "some wires are too long for the cloth they enclose and stand under high "
                        "compression; a dart or an elastic line would relieve them",
                        {}});
  }
  if (flat.check.flippedFaces > 0) {
    findings.push_back({"folds",
                        fmt::format("{} faces are folded: the cloth does not fit between the wires",
                                    flat.check.flippedFaces),
                        {}});
  }
  if (!solution.finished) {
    findings.push_back({"step-limit",
                        fmt::format("stopped after {} steps: all lengths are right, the strain may "
                                    "not be the least",
                                    solution.state.steps),
                        {}});
  }
  return findings;
}

}  // namespace toile::unfolding
