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
using detail::TurnModel;
using Eigen::VectorXd;

/// Wavelengths that are tried: from this many samples on, each longer by the factor, up to so many
/// lengths of the line.
constexpr double kShortestInSamples = 4;
constexpr double kLongestInLengths = 4;
constexpr double kLadderFactor = 1.3;
constexpr int kMaxRungs = 24;
constexpr int kWideSteps = 2;  ///< on the surface, in frames carried along
constexpr int kFineSteps = 3;  ///< then in the line's own
constexpr int kAttempts = 12;  ///< with other wavelengths: a line bends too often, or moved too far
constexpr double kLeastBend = std::numbers::pi / 60;  ///< that counts as one: 3 degrees

double strengthOf(double wavelength) {
  return std::pow(2 * std::numbers::pi / wavelength, 6);
}

/// The linear problem at one state of the samples, for any strengths.
class Step {
 public:
  Step(const FairSamples& samples, TurnModel model) : samples_(samples) {
    const FairSamples::Variation variation = samples.variation(model);
    normal_ = variation.matrix.transpose() * variation.matrix;
    right_ = -(variation.matrix.transpose() * variation.constant);
    // Every entry of the holds exists, so that strengths only change values.
    std::vector<Eigen::Triplet<double>> zeros;
    for (int i = 0; i < samples.unknownCount(); i += 2) {
      for (const int row : {i, i + 1}) {
        for (const int column : {i, i + 1}) zeros.emplace_back(row, column, 0.0);
      }
    }
    Eigen::SparseMatrix<double> pairs(samples.unknownCount(), samples.unknownCount());
    pairs.setFromTriplets(zeros.begin(), zeros.end());
    normal_ = (normal_ + pairs).eval();
    solver_.analyzePattern(normal_);
  }

  VectorXd solve(const std::vector<double>& strengthOfLine) {
    const FairSamples::Hold hold = samples_.hold(strengthOfLine);
    Eigen::SparseMatrix<double> system = normal_;
    for (Eigen::Index i = 0; i < system.rows(); i += 2) {
      const Eigen::Matrix2d& weight = hold.weight[static_cast<std::size_t>(i / 2)];
      for (Eigen::Index r = 0; r < 2; ++r) {
        for (Eigen::Index c = 0; c < 2; ++c) system.coeffRef(i + r, i + c) += weight(r, c);
      }
    }
    solver_.factorize(system);
    return solver_.solve(right_ + hold.pull);
  }

 private:
  const FairSamples& samples_;
  Eigen::SparseMatrix<double> normal_;
  VectorXd right_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

/// The least wavelength that a line may be faired with.
double shortestWavelength(const detail::FairSampledLine& line) {
  return kShortestInSamples * line.spacing;
}
/// Beyond the length only the ends and crossings hold a line.
double longestWavelength(const detail::FairSampledLine& line) {
  return kLongestInLengths * line.spacing * static_cast<double>(line.size());
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
  Step step(samples, TurnModel::Carried);
  const auto rungOf = [&](std::size_t l, int k) {
    return shortestWavelength(lines[l]) * std::pow(kLadderFactor, k);
  };
  // Bends longer than half of the line are meant, if nobody says which.
  const auto halfOf = [&](std::size_t l) {
    return 0.5 * longestWavelength(lines[l]) / kLongestInLengths;
  };
  const auto isNeeded = [&](std::size_t l, int k) {
    if (k == 0) return true;
    const Rung& last = ladder[l].back();
    if (static_cast<int>(ladder[l].size()) < k || last.farthest > options.maxDeviation.mm()) {
      return false;
    }
    const std::optional<int>& wanted = network.lines[l].inflections;
    return wanted ? last.inflections > *wanted && rungOf(l, k) <= longestWavelength(lines[l])
                  : rungOf(l, k) <= halfOf(l);
  };
  for (int k = 0; k < kMaxRungs; ++k) {
    std::vector<double> strengths;
    std::vector<std::size_t> needed;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      strengths.push_back(strengthOf(rungOf(l, k)));
      if (isNeeded(l, k)) needed.push_back(l);
    }
    if (needed.empty()) break;
    const VectorXd unknowns = step.solve(strengths);
    for (const std::size_t l : needed) {
      const auto places = samples.placesAfter(l, unknowns);
      ladder[l].push_back(
          {samples.inflections(l, places, kLeastBend), samples.deviation(l, places)});
    }
  }
  for (std::size_t l = 0; l < lines.size(); ++l) {
    std::vector<Rung>& rungs = ladder[l];
    const auto tooFar = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& rung) {
      return rung.farthest > options.maxDeviation.mm();
    });
    rungs.erase(tooFar, rungs.end());
    const int left = rungs.empty() ? 0 : rungs.back().inflections;
    const int wanted = network.lines[l].inflections.value_or(left);
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
  std::vector<bool> isLimited(lines.size(), false);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (attempt > 0) samples.returnToStart();
    std::vector<double> strengths;
    for (const double w : wavelengths) strengths.push_back(strengthOf(w));
    for (int k = 0; k < kWideSteps + kFineSteps; ++k) {
      const TurnModel model = k < kWideSteps ? TurnModel::Carried : TurnModel::Own;
      samples.move(Step(samples, model).solve(strengths));
    }
    bool isDone = true;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (network.lines[l].isFixed) continue;
      const auto places = samples.places(l);
      const std::optional<int>& wanted = network.lines[l].inflections;
      if (samples.deviation(l, places) > options.maxDeviation.mm()) {
        wavelengths[l] /= kLadderFactor;
        isLimited[l] = true;
        isDone = false;
      } else if (!options.wavelength && wanted && !isLimited[l] &&
                 samples.inflections(l, places, kLeastBend) > *wanted &&
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
    const auto measure = [&](const SurfacePath& path, const std::vector<double>& corners) {
      const std::size_t count = detail::evenSampleCount(*mesh, length(*mesh, path));
      return measureRestlessness(sampleCurvature(*mesh, path, count), path.closed,
                                 Angle::degrees(3), corners);
    };
    std::vector<double> cornersBefore, cornersAfter;
    for (const FairLine::Stop& stop : line.stops) {
      if (stop.isCorner) cornersBefore.push_back(stop.arc);
    }
    const Restlessness before = measure(line.path, cornersBefore);
    for (const detail::FairSample& sample : lines[l].samples) faired.points.push_back(sample.point);
    if (line.isFixed) {
      faired.path = line.path;
    } else {
      Result<SurfacePath> path = linker.linkAll(faired.points, line.path.closed);
      if (!path) return path.error();
      faired.path = *std::move(path);
      faired.wavelength = Length::mm(wavelengths[l]);
    }
    double arc = 0;
    for (std::size_t i = 0; i + 1 < faired.path.points.size() && !cornersBefore.empty(); ++i) {
      for (const FairLine::Stop& stop : line.stops) {
        const bool isHere = stop.isCorner && faired.path.points[i] == result.nodes[stop.node];
        if (isHere) cornersAfter.push_back(arc);
      }
      arc += (position(*mesh, faired.path.points[i + 1]) - position(*mesh, faired.path.points[i]))
                 .norm();
    }
    const Restlessness after = line.isFixed ? before : measure(faired.path, cornersAfter);
    faired.inflectionsBefore = before.inflections;
    faired.inflectionsAfter = after.inflections;
    faired.variationBefore = before.variation;
    faired.variationAfter = after.variation;
    faired.deviation = Length::mm(samples.deviation(l, samples.places(l)));
    result.lines.push_back(std::move(faired));
  }
  return result;
}

}  // namespace toile
