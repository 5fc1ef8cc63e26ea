// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/elastics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "pipeline/unfold_options.h"
#include "toile/core/parallel.h"
#include "unfold/box_minimum.h"

namespace toile {
namespace {

/// The lines that are still elastic, in the design's order.
std::vector<ElasticLine> elasticLines(const Pattern& pattern) {
  std::map<std::string, double> rangeOf;
  for (const Piece& piece : pattern.cut.pieces) {
    for (const Wire& wire : piece.wires) {
      if (piece.include && wire.elasticRange > 0) rangeOf[wire.curve] = wire.elasticRange;
    }
  }
  std::vector<ElasticLine> lines;
  for (const StylingCurve& curve : pattern.document.design->curves) {
    const auto range = rangeOf.find(curve.id);
    if (range != rangeOf.end()) lines.push_back({curve.id, range->second, 0});
  }
  return lines;
}

/// Per line the first of those that share its ratio: a line and its mirror images do.
std::vector<Eigen::Index> sharedRatios(const Design& design,
                                       const std::vector<ElasticLine>& lines) {
  const auto rootOf = [&](std::string id) {
    for (std::size_t step = 0; step < design.curves.size(); ++step) {
      const auto curve = std::find_if(design.curves.begin(), design.curves.end(),
                                      [&](const StylingCurve& c) { return c.id == id; });
      if (curve == design.curves.end() || !curve->mirrorOf) break;
      id = *curve->mirrorOf;
    }
    return id;
  };
  std::map<std::string, Eigen::Index> first;
  std::vector<Eigen::Index> shared;
  for (const ElasticLine& line : lines) {
    shared.push_back(first.try_emplace(rootOf(line.curve), shared.size()).first->second);
  }
  return shared;
}

bool isElastic(const Piece& piece) {
  return piece.include && std::any_of(piece.wires.begin(), piece.wires.end(),
                                      [](const Wire& w) { return w.elasticRange > 0; });
}

void setTargets(Pattern& pattern, const std::map<std::string, double>& ratioOf) {
  const auto refined = std::make_shared<RefinedMesh>(*pattern.cut.refined);
  std::vector<bool> isDone(refined->cutEdges.size(), false);
  for (Piece& piece : pattern.cut.pieces) {
    for (Wire& wire : piece.wires) {
      const auto ratio = ratioOf.find(wire.curve);
      if (wire.elasticRange == 0 || ratio == ratioOf.end()) continue;
      wire.elasticRange = 0;
      for (std::size_t e = 0; e < wire.cutEdges.size(); ++e) {
        CutEdge& edge = refined->cutEdges[wire.cutEdges[e].index()];
        if (!isDone[wire.cutEdges[e].index()]) edge.targetLength *= 1 + ratio->second;
        isDone[wire.cutEdges[e].index()] = true;
        wire.targetLength[e] = edge.targetLength;
      }
    }
  }
  pattern.cut.refined = refined;
}

}  // namespace

void settleElastics(Pattern& pattern, const MakeOptions& options, Progress* progress) {
  std::vector<ElasticLine> lines = elasticLines(pattern);
  if (lines.empty()) return;
  std::vector<std::size_t> concerned;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    if (isElastic(pattern.cut.pieces[i])) concerned.push_back(i);
  }
  if (progress != nullptr) {
    progress->step(fmt::format("find the lengths of {} elastic line{}", lines.size(),
                               lines.size() == 1 ? "" : "s"));
  }
  std::vector<ElasticAnswer> answers(concerned.size());
  parallelFor(concerned.size(), [&](std::size_t i) {
    const Piece& piece = pattern.cut.pieces[concerned[i]];
    Result<FlatPiece> flat =
        unfold(piece, unfoldOptionsOf(*pattern.document.design, piece, options.unfold), progress);
    if (flat && flat->check.passes()) answers[i] = std::move(flat->elastic);
  });
  if (isCancelled(progress)) return;

  const auto count = static_cast<Eigen::Index>(lines.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(count), range(count);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  const std::vector<Eigen::Index> shared = sharedRatios(*pattern.document.design, lines);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto line = static_cast<std::size_t>(k);
    range[k] = lines[line].range;
    range[shared[line]] = std::min(range[shared[line]], range[k]);
  }
  for (const ElasticAnswer& answer : answers) {
    const auto own = static_cast<Eigen::Index>(answer.lines.size());
    if (own == 0 || answer.gradient.size() != own) continue;
    Eigen::VectorXd wish(own);
    std::vector<Eigen::Index> at;
    for (Eigen::Index k = 0; k < own; ++k) {
      const ElasticLine& line = answer.lines[static_cast<std::size_t>(k)];
      wish[k] = line.ratio;
      const auto found = std::find_if(lines.begin(), lines.end(), [&](const ElasticLine& other) {
        return other.curve == line.curve;
      });
      at.push_back(shared[static_cast<std::size_t>(found - lines.begin())]);
    }
    const Eigen::VectorXd atZero = answer.gradient - answer.stiffness * wish;
    for (Eigen::Index k = 0; k < own; ++k) {
      gradient[at[static_cast<std::size_t>(k)]] += atZero[k];
      for (Eigen::Index j = 0; j < own; ++j) {
        stiffness(at[static_cast<std::size_t>(k)], at[static_cast<std::size_t>(j)]) +=
            answer.stiffness(k, j);
      }
    }
  }
  const Eigen::VectorXd ratios = unfolding::minimumInBox(gradient, stiffness, -range, range);
  std::map<std::string, double> ratioOf;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    lines[k].ratio = ratios[shared[k]];
    ratioOf[lines[k].curve] = lines[k].ratio;
  }
  setTargets(pattern, ratioOf);
  pattern.elastics = std::move(lines);
}

}  // namespace toile
