// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/fair_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/bends.h"
#include "curve/path_walk.h"
#include "toile/curve/curvature.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// Stops nearer than this to each other, or to an end, are one place, mm.
constexpr double kSameStop = 1e-6;
/// Part of a line's hold that acts along it.
constexpr double kHoldAlong = 0.05;
/// The nearest place of the old line is looked for among this many segments to both sides.
constexpr std::ptrdiff_t kWindow = 8;

TangentFrame someFrame(const Vector3d& normal) {
  const Vector3d a = normal.unitOrthogonal();
  return {a, normal.cross(a)};
}

double squareToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0.0;
  return (a + t * d - p).squaredNorm();
}

/// The farthest that points lie from a polyline, each near its own index.
double farthestFrom(const std::vector<Vector3d>& line, const std::vector<Vector3d>& points,
                    bool closed) {
  const auto n = static_cast<std::ptrdiff_t>(line.size());
  double farthest = 0;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t k = i - kWindow; k < i + kWindow; ++k) {
      if (!closed && (k < 0 || k + 1 >= n)) continue;
      const auto from = static_cast<std::size_t>((k % n + n) % n);
      nearest = std::min(nearest, squareToSegment(points[static_cast<std::size_t>(i)], line[from],
                                                  line[(from + 1) % line.size()]));
    }
    farthest = std::max(farthest, nearest);
  }
  return std::sqrt(farthest);
}

}  // namespace

FairSamples::FairSamples(std::shared_ptr<const Mesh> mesh, const FairNetwork& network)
    : mesh_(std::move(mesh)), closest_(*mesh_), unknownOfNode_(network.nodes.size(), -1) {
  std::vector<bool> isFixed;
  for (const FairNode& node : network.nodes) {
    nodes_.push_back(node.point);
    isFixed.push_back(node.isFixed);
    frameOfNode_.push_back(someFrame(smoothNormal(*mesh_, node.point)));
  }
  firstNodes_ = nodes_;
  for (const FairLine& line : network.lines) {
    if (!line.isFixed) continue;
    for (const FairLine::Stop& stop : line.stops) isFixed[stop.node] = true;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (isFixed[i]) continue;
    unknownOfNode_[i] = unknowns_;
    unknowns_ += 2;
  }
  for (const FairLine& line : network.lines) sampleLine(line);
  turnFrames();
}

void FairSamples::sampleLine(const FairLine& line) {
  const Mesh& mesh = *mesh_;
  const double all = length(mesh, line.path);
  const double wanted = all / static_cast<double>(evenSampleCount(mesh, all));
  struct Mark {
    double arc;
    int node;
    bool isCorner;
  };
  std::vector<Mark> marks;
  for (const FairLine::Stop& stop : line.stops) {
    marks.push_back({std::clamp(stop.arc, 0.0, all), static_cast<int>(stop.node), stop.isCorner});
  }
  std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.arc < b.arc; });
  if (line.path.closed) {
    if (marks.empty()) marks.push_back({0, -1, false});
    marks.push_back({marks.front().arc + all, marks.front().node, marks.front().isCorner});
  } else {
    if (marks.empty() || marks.front().arc > kSameStop) marks.insert(marks.begin(), {0, -1, false});
    if (all - marks.back().arc > kSameStop) marks.push_back({all, -1, false});
  }
  FairSampledLine sampled;
  std::vector<double> steps;
  sampled.closed = line.path.closed;
  PathWalk walk(mesh, line.path);
  for (std::size_t m = 0; m + 1 < marks.size(); ++m) {
    const double from = marks[m].arc, section = marks[m + 1].arc - from;
    const int count = std::max(1, static_cast<int>(std::lround(section / wanted)));
    for (int k = 0; k < count; ++k) {
      const double arc = from + section * k / count;
      FairSample sample;
      sample.node = k == 0 ? marks[m].node : -1;
      sample.isCorner = k == 0 && marks[m].isCorner;
      sample.point =
          sample.node >= 0 ? nodes_[static_cast<std::size_t>(sample.node)] : walk.at(arc);
      sampled.samples.push_back(sample);
      steps.push_back(section / count);
    }
  }
  if (!line.path.closed) {
    FairSample last;
    last.node = marks.back().node;
    last.point =
        last.node >= 0 ? nodes_[static_cast<std::size_t>(last.node)] : line.path.points.back();
    sampled.samples.push_back(last);
  }
  const std::size_t n = sampled.samples.size();
  sampled.spacing = all / static_cast<double>(line.path.closed ? n : n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    FairSample& sample = sampled.samples[i];
    sample.start = sample.position = position(mesh, sample.point);
    sample.normal = smoothNormal(mesh, sample.point);
    sample.frame = someFrame(sample.normal);
    if (sample.node >= 0 || line.isFixed) continue;
    if (!line.path.closed) {
      const bool atStart =
          i == 0 || (i == 1 && sampled.samples[0].node < 0 && line.start == FairEnd::Clamped);
      const bool atEnd = i + 1 == n || (i + 2 == n && sampled.samples[n - 1].node < 0 &&
                                        line.end == FairEnd::Clamped);
      if (atStart || atEnd) continue;
    }
    sample.unknown = unknowns_;
    unknowns_ += 2;
  }
  std::vector<SurfacePoint> first;
  for (const FairSample& sample : sampled.samples) first.push_back(sample.point);
  firstPoints_.push_back(std::move(first));
  firstSteps_.push_back(std::move(steps));
  lines_.push_back(std::move(sampled));
}

void FairSamples::turnFrames() {
  for (FairSampledLine& line : lines_) {
    const std::size_t n = line.size();
    for (std::size_t i = 0; i < n; ++i) {
      FairSample& sample = line.samples[i];
      const std::size_t before = !line.closed && i == 0 ? i : (i + n - 1) % n;
      const std::size_t after = !line.closed && i + 1 == n ? i : (i + 1) % n;
      const Vector3d chord = line.samples[after].position - line.samples[before].position;
      const Vector3d side = sample.normal.cross(chord);
      if (!(side.norm() > 0)) continue;
      sample.frame.b = side.normalized();
      sample.frame.a = sample.frame.b.cross(sample.normal);
    }
  }
}

int FairSamples::unknownOf(const FairSample& sample) const {
  return sample.node >= 0 ? unknownOfNode_[static_cast<std::size_t>(sample.node)] : sample.unknown;
}

const TangentFrame& FairSamples::basisOf(const FairSample& sample) const {
  return sample.node >= 0 ? frameOfNode_[static_cast<std::size_t>(sample.node)] : sample.frame;
}

FairSamples::Turns FairSamples::turns(TurnModel model) const {
  Turns turns;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const FairSampledLine& line = lines_[l];
    const std::size_t n = line.size();
    std::vector<int>& rows = turns.rowOfSample.emplace_back(n, -1);
    for (std::size_t i = line.closed ? 0 : 1; i + (line.closed ? 0 : 1) < n; ++i) {
      const FairSample& here = line.at(i);
      if (here.isCorner) continue;
      const FairSample& before = line.at(i + n - 1);
      const FairSample& after = line.at(i + 1);
      const Vector3d in = here.position - before.position, out = after.position - here.position;
      const bool isOwn = model == TurnModel::Own;
      const double stepIn = isOwn ? in.norm() : firstSteps_[l][(i + n - 1) % n];
      const double stepOut = isOwn ? out.norm() : firstSteps_[l][i];
      if (!(stepIn > 0 && stepOut > 0)) continue;
      const int row = static_cast<int>(turns.step.size());
      rows[i] = row;
      turns.step.push_back(0.5 * (stepIn + stepOut));
      const Vector3d turn = out / stepOut - in / stepIn;
      turns.constant.push_back(here.frame.a.dot(turn));
      turns.constant.push_back(here.frame.b.dot(turn));
      const auto depend = [&](const FairSample& sample, double factor) {
        const int unknown = unknownOf(sample);
        if (unknown < 0) return;
        const TangentFrame& basis = basisOf(sample);
        turns.entries.emplace_back(2 * row, unknown, factor * here.frame.a.dot(basis.a));
        turns.entries.emplace_back(2 * row, unknown + 1, factor * here.frame.a.dot(basis.b));
        turns.entries.emplace_back(2 * row + 1, unknown, factor * here.frame.b.dot(basis.a));
        turns.entries.emplace_back(2 * row + 1, unknown + 1, factor * here.frame.b.dot(basis.b));
      };
      depend(before, 1 / stepIn);
      depend(here, -1 / stepIn - 1 / stepOut);
      depend(after, 1 / stepOut);
    }
  }
  return turns;
}

FairSamples::Variation FairSamples::variation(TurnModel model) const {
  const Turns all = turns(model);
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const FairSampledLine& line = lines_[l];
    const std::size_t n = line.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
      const int from = all.rowOfSample[l][i], to = all.rowOfSample[l][(i + 1) % n];
      if (from < 0 || to < 0) continue;
      // The next turn in the frame of this one, carried over the surface.
      double cosine = 1, sine = 0;
      if (model == TurnModel::Carried) {
        const FairSample &here = line.at(i), &next = line.at(i + 1);
        const Vector3d carried =
            Eigen::Quaterniond::FromTwoVectors(here.normal, next.normal) * here.frame.a;
        cosine = carried.dot(next.frame.a);
        sine = carried.dot(next.frame.b);
      }
      const double stepFrom = all.step[static_cast<std::size_t>(from)];
      const double stepTo = all.step[static_cast<std::size_t>(to)];
      const double weight = 1 / std::sqrt(0.5 * (stepFrom + stepTo));
      const double mine = -weight / stepFrom, theirs = weight / stepTo;
      entries.emplace_back(row, 2 * from, mine);
      entries.emplace_back(row, 2 * to, theirs * cosine);
      entries.emplace_back(row, 2 * to + 1, theirs * sine);
      entries.emplace_back(row + 1, 2 * from + 1, mine);
      entries.emplace_back(row + 1, 2 * to, -theirs * sine);
      entries.emplace_back(row + 1, 2 * to + 1, theirs * cosine);
      row += 2;
    }
  }
  const auto turnRows = static_cast<Eigen::Index>(all.constant.size());
  Eigen::SparseMatrix<double> change(row, turnRows), turn(turnRows, unknowns_);
  change.setFromTriplets(entries.begin(), entries.end());
  turn.setFromTriplets(all.entries.begin(), all.entries.end());
  return {change * turn, change * Eigen::Map<const Eigen::VectorXd>(all.constant.data(), turnRows)};
}

FairSamples::Hold FairSamples::hold(const std::vector<double>& strengthOfLine) const {
  Hold hold{std::vector<Eigen::Matrix2d>(static_cast<std::size_t>(unknowns_ / 2),
                                         Eigen::Matrix2d::Zero()),
            Eigen::VectorXd::Zero(unknowns_)};
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    for (const FairSample& sample : lines_[l].samples) {
      const int unknown = unknownOf(sample);
      if (unknown < 0) continue;
      const TangentFrame& basis = basisOf(sample);
      const double weight = strengthOfLine[l] * lines_[l].spacing;
      const Vector3d gone = sample.position - sample.start;
      const auto add = [&](const Vector3d& direction, double factor) {
        const Eigen::Vector2d inBasis(direction.dot(basis.a), direction.dot(basis.b));
        hold.weight[static_cast<std::size_t>(unknown / 2)] +=
            factor * weight * inBasis * inBasis.transpose();
        hold.pull.segment<2>(unknown) -= factor * weight * direction.dot(gone) * inBasis;
      };
      add(sample.frame.a, kHoldAlong);
      add(sample.frame.b, 1);
    }
  }
  return hold;
}

std::vector<Vector3d> FairSamples::placesAfter(std::size_t line,
                                               const Eigen::VectorXd& unknowns) const {
  std::vector<Vector3d> places;
  for (const FairSample& sample : lines_[line].samples) {
    const int unknown = unknownOf(sample);
    Vector3d place = sample.position;
    if (unknown >= 0) {
      const TangentFrame& basis = basisOf(sample);
      place += unknowns[unknown] * basis.a + unknowns[unknown + 1] * basis.b;
    }
    places.push_back(place);
  }
  return places;
}

std::vector<Vector3d> FairSamples::places(std::size_t line) const {
  std::vector<Vector3d> places;
  for (const FairSample& sample : lines_[line].samples) places.push_back(sample.position);
  return places;
}

int FairSamples::inflections(std::size_t line, const std::vector<Vector3d>& places,
                             double leastBend) const {
  const FairSampledLine& sampled = lines_[line];
  const std::size_t n = sampled.size();
  std::vector<double> turns;
  for (std::size_t i = sampled.closed ? 0 : 1; i + (sampled.closed ? 0 : 1) < n; ++i) {
    if (sampled.samples[i].isCorner) continue;
    const Vector3d in = places[i] - places[(i + n - 1) % n];
    const Vector3d out = places[(i + 1) % n] - places[i];
    turns.push_back(std::atan2(sampled.samples[i].normal.dot(in.cross(out)), in.dot(out)));
  }
  return countInflections(turns, sampled.closed, leastBend);
}

double FairSamples::deviation(std::size_t line, const std::vector<Vector3d>& places) const {
  std::vector<Vector3d> first;
  for (const FairSample& sample : lines_[line].samples) first.push_back(sample.start);
  const bool closed = lines_[line].closed;
  return std::max(farthestFrom(first, places, closed), farthestFrom(places, first, closed));
}

void FairSamples::move(const Eigen::VectorXd& unknowns) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const int first = unknownOfNode_[i];
    if (first < 0) continue;
    const TangentFrame& frame = frameOfNode_[i];
    nodes_[i] = closest_.find(
        position(*mesh_, nodes_[i]) + unknowns[first] * frame.a + unknowns[first + 1] * frame.b,
        nodes_[i]);
    frameOfNode_[i] = someFrame(smoothNormal(*mesh_, nodes_[i]));
  }
  for (FairSampledLine& line : lines_) {
    for (FairSample& sample : line.samples) {
      if (unknownOf(sample) < 0) continue;
      if (sample.node >= 0) {
        sample.point = nodes_[static_cast<std::size_t>(sample.node)];
      } else {
        sample.point = closest_.find(sample.position + unknowns[sample.unknown] * sample.frame.a +
                                         unknowns[sample.unknown + 1] * sample.frame.b,
                                     sample.point);
      }
      sample.position = position(*mesh_, sample.point);
      sample.normal = smoothNormal(*mesh_, sample.point);
    }
  }
  turnFrames();
}

void FairSamples::returnToStart() {
  nodes_ = firstNodes_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    frameOfNode_[i] = someFrame(smoothNormal(*mesh_, nodes_[i]));
  }
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    for (std::size_t i = 0; i < lines_[l].size(); ++i) {
      FairSample& sample = lines_[l].samples[i];
      sample.point = firstPoints_[l][i];
      sample.position = sample.start;
      sample.normal = smoothNormal(*mesh_, sample.point);
    }
  }
  turnFrames();
}

}  // namespace toile::detail
