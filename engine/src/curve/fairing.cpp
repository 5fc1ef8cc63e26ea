// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/curve/fairing.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "curve/bends.h"
#include "curve/fair_samples.h"
#include "toile/curve/curvature.h"

namespace toile {

namespace {

using detail::FairSamples;
using Eigen::VectorXd;

/// Wavelengths that are tried: from this many samples on, each longer by the factor, up to the
/// length of the line.
constexpr double kShortestInSamples = 4;
constexpr double kLadderFactor = 1.3;
constexpr int kMaxRungs = 24;
constexpr int kSteps = 4;      ///< Gauss-Newton steps on the surface
constexpr int kAttempts = 12;  ///< with other wavelengths: a line bends too often, or moved too far
constexpr double kLeastBend = std::numbers::pi / 60;  ///< that counts as one: 3 degrees

double strengthOf(double wavelength) {
  return std::pow(2 * std::numbers::pi / wavelength, 6);
}

/// The linear problem at one state of the samples, for any strengths.
class Step {
 public:
  explicit Step(const FairSamples& samples) : samples_(samples), turns_(samples.turns()) {
    const Eigen::SparseMatrix<double> rows = samples.variation(turns_);
    const Eigen::SparseMatrix<double> variation = rows * turns_.matrix;
    normal_ = variation.transpose() * variation;
    right_ = -(variation.transpose() * (rows * turns_.constant));
    // Every diagonal entry exists, so that strengths only change values.
    std::vector<Eigen::Triplet<double>> zeros;
    for (int i = 0; i < samples.unknownCount(); ++i) zeros.emplace_back(i, i, 0.0);
    Eigen::SparseMatrix<double> diagonal(samples.unknownCount(), samples.unknownCount());
    diagonal.setFromTriplets(zeros.begin(), zeros.end());
    normal_ = (normal_ + diagonal).eval();
    solver_.analyzePattern(normal_);
  }

  VectorXd solve(const std::vector<double>& strengthOfLine) {
    const FairSamples::Hold hold = samples_.hold(strengthOfLine);
    Eigen::SparseMatrix<double> system = normal_;
    for (Eigen::Index i = 0; i < system.rows(); ++i) system.coeffRef(i, i) += hold.weight[i];
    solver_.factorize(system);
    return solver_.solve(right_ - hold.weight.cwiseProduct(hold.distance));
  }

  [[nodiscard]] int inflections(const VectorXd& turns, std::size_t line) const {
    const auto first = static_cast<Eigen::Index>(turns_.firstRow[line]);
    const auto end = static_cast<Eigen::Index>(turns_.firstRow[line + 1]);
    return detail::countInflections({turns.data() + first, turns.data() + end},
                                    samples_.lines()[line].closed, kLeastBend);
  }
  [[nodiscard]] VectorXd turnsAfter(const VectorXd& unknowns) const {
    return turns_.constant + turns_.matrix * unknowns;
  }

 private:
  const FairSamples& samples_;
  FairSamples::Turns turns_;
  Eigen::SparseMatrix<double> normal_;
  VectorXd right_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

/// The least wavelength that a line may be faired with.
double shortestWavelength(const detail::FairSampledLine& line) {
  return kShortestInSamples * line.spacing;
}
double longestWavelength(const detail::FairSampledLine& line) {
  return line.spacing * static_cast<double>(line.size());
}

/// One wavelength for each line, from how its bends would fare on the linear model.
std::vector<double> chooseWavelengths(const FairSamples& samples, const FairNetwork& network,
                                      const FairingOptions& options) {
  const auto& lines = samples.lines();
  std::vector<double> chosen(lines.size());
  if (options.wavelength) {
    std::fill(chosen.begin(), chosen.end(), std::max(1e-3, options.wavelength->mm()));
    return chosen;
  }
  struct Rung {
    int inflections;
    double farthest;
  };
  std::vector<std::vector<Rung>> ladder(lines.size());
  Step step(samples);
  const auto rungOf = [&](std::size_t l, int k) {
    return shortestWavelength(lines[l]) * std::pow(kLadderFactor, k);
  };
  for (int k = 0; k < kMaxRungs; ++k) {
    std::vector<double> strengths;
    bool isNeeded = false;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      strengths.push_back(strengthOf(rungOf(l, k)));
      isNeeded = isNeeded || rungOf(l, k) <= longestWavelength(lines[l]);
    }
    if (!isNeeded) break;
    const VectorXd unknowns = step.solve(strengths);
    const VectorXd turns = step.turnsAfter(unknowns);
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (rungOf(l, k) > longestWavelength(lines[l])) continue;
      double farthest = 0;
      for (const detail::FairSample& sample : lines[l].samples) {
        if (sample.unknown >= 0) {
          farthest = std::max(farthest, std::abs(unknowns[sample.unknown]));
        }
      }
      ladder[l].push_back({step.inflections(turns, l), farthest});
    }
  }
  for (std::size_t l = 0; l < lines.size(); ++l) {
    std::vector<Rung>& rungs = ladder[l];
    const auto tooFar = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& rung) {
      return rung.farthest > options.maxDeviation.mm();
    });
    rungs.erase(tooFar, rungs.end());
    // Bends longer than half of the line are meant, if nobody says which.
    const double half = 0.5 * longestWavelength(lines[l]);
    int wanted = network.lines[l].inflections.value_or(0);
    for (std::size_t k = 0; !network.lines[l].inflections && k < rungs.size(); ++k) {
      if (k == 0 || rungOf(l, static_cast<int>(k)) <= half) wanted = rungs[k].inflections;
    }
    const auto found = std::find_if(rungs.begin(), rungs.end(),
                                    [&](const Rung& rung) { return rung.inflections <= wanted; });
    const int best =
        std::max(0, static_cast<int>(found - rungs.begin()) - (found == rungs.end() ? 1 : 0));
    chosen[l] = rungOf(l, best);
  }
  return chosen;
}

}  // namespace

Result<FairedNetwork> fairNetwork(GeodesicLinker& linker, std::shared_ptr<const Mesh> mesh,
                                  const FairNetwork& network, const FairingOptions& options) {
  for (const FairLine& line : network.lines) {
    const double all = isValid(*mesh, line.path) ? length(*mesh, line.path) : 0;
    if (!(all > 0) || !std::isfinite(all)) {
      return Error{ErrorCode::CurveInvalid, "a line without length cannot be faired", {}};
    }
  }
  FairSamples samples(mesh, network);
  if (samples.unknownCount() == 0) {
    return Error{ErrorCode::CurveInvalid,
                 "everything is fixed, so that there is nothing to fair; let go of a line, a "
                 "crossing or an end",
                 {}};
  }
  const auto& lines = samples.lines();
  std::vector<double> wavelengths = chooseWavelengths(samples, network, options);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (attempt > 0) samples.returnToStart();
    std::vector<double> strengths;
    for (const double w : wavelengths) strengths.push_back(strengthOf(w));
    for (int k = 0; k < kSteps; ++k) samples.move(Step(samples).solve(strengths));
    const Step last(samples);
    const VectorXd turns = last.turnsAfter(VectorXd::Zero(samples.unknownCount()));
    bool isDone = true;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (network.lines[l].isFixed) continue;
      if (samples.deviation(l) > options.maxDeviation.mm()) {
        wavelengths[l] /= kLadderFactor * kLadderFactor;
        isDone = false;
      } else if (!options.wavelength && network.lines[l].inflections &&
                 last.inflections(turns, l) > *network.lines[l].inflections &&
                 wavelengths[l] * kLadderFactor <= longestWavelength(lines[l])) {
        wavelengths[l] *= kLadderFactor;
        isDone = false;
      }
    }
    if (isDone) break;
  }

  FairedNetwork result;
  result.nodes = samples.nodes();
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const FairLine& line = network.lines[l];
    FairedLine faired;
    const auto measure = [&](const SurfacePath& path) {
      const auto count = std::max<std::size_t>(3, lines[l].size() - (path.closed ? 0 : 1));
      return measureRestlessness(sampleCurvature(*mesh, path, count), path.closed);
    };
    const Restlessness before = measure(line.path);
    for (const detail::FairSample& sample : lines[l].samples) faired.points.push_back(sample.point);
    if (line.isFixed) {
      faired.path = line.path;
    } else {
      Result<SurfacePath> path = linker.linkAll(faired.points, line.path.closed);
      if (!path) return path.error();
      faired.path = *std::move(path);
      faired.wavelength = Length::mm(wavelengths[l]);
    }
    const Restlessness after = line.isFixed ? before : measure(faired.path);
    faired.inflectionsBefore = before.inflections;
    faired.inflectionsAfter = after.inflections;
    faired.variationBefore = before.variation;
    faired.variationAfter = after.variation;
    faired.deviation = Length::mm(samples.deviation(l));
    result.lines.push_back(std::move(faired));
  }
  return result;
}

}  // namespace toile
