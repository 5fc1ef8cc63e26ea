// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/fair_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toile/curve/curvature.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

/// Samples of a line: fine enough for its bends, coarser than the noise of the mesh.
constexpr double kMostSamples = 120;
constexpr double kFewestSamples = 24;
constexpr double kSpacingInEdges = 0.8;
/// Stops nearer than this to each other, or to an end, are one place, mm.
constexpr double kSameStop = 1e-6;

}  // namespace

FairSamples::FairSamples(std::shared_ptr<const Mesh> mesh, const FairNetwork& network)
    : mesh_(std::move(mesh)),
      closest_(*mesh_),
      unknownOfNode_(network.nodes.size(), -1),
      frameOfNode_(network.nodes.size()) {
  for (const FairNode& node : network.nodes) nodes_.push_back(node.point);
  firstNodes_ = nodes_;
  std::vector<bool> isFixed;
  for (const FairNode& node : network.nodes) isFixed.push_back(node.isFixed);
  for (const FairLine& line : network.lines) {
    if (!line.isFixed) continue;
    for (const FairLine::Stop& stop : line.stops) isFixed[stop.node] = true;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Vector3d normal = smoothNormal(*mesh_, nodes_[i]);
    const Vector3d a = normal.unitOrthogonal();
    frameOfNode_[i] = {a, normal.cross(a), position(*mesh_, nodes_[i])};
    if (isFixed[i]) continue;
    unknownOfNode_[i] = unknowns_;
    unknowns_ += 2;
    lineOfUnknown_.insert(lineOfUnknown_.end(), 2, -1);
  }
  for (std::size_t i = 0; i < network.lines.size(); ++i) sampleLine(network.lines[i], i);
  turnFrames();
}

void FairSamples::sampleLine(const FairLine& line, std::size_t index) {
  const Mesh& mesh = *mesh_;
  const double all = length(mesh, line.path);
  const double wanted = std::max(
      all / kMostSamples, std::min(all / kFewestSamples, kSpacingInEdges * mesh.meanEdgeLength()));
  struct Mark {
    double arc;
    int node;
  };
  std::vector<Mark> marks;
  for (const FairLine::Stop& stop : line.stops) {
    marks.push_back({std::clamp(stop.arc, 0.0, all), static_cast<int>(stop.node)});
  }
  std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.arc < b.arc; });
  if (line.path.closed) {
    if (marks.empty()) marks.push_back({0, -1});
    marks.push_back({marks.front().arc + all, marks.front().node});
  } else {
    if (marks.empty() || marks.front().arc > kSameStop) marks.insert(marks.begin(), {0, -1});
    if (all - marks.back().arc > kSameStop) marks.push_back({all, -1});
  }
  FairSampledLine sampled;
  sampled.closed = line.path.closed;
  for (std::size_t m = 0; m + 1 < marks.size(); ++m) {
    const double from = marks[m].arc, section = marks[m + 1].arc - from;
    const int count = std::max(1, static_cast<int>(std::lround(section / wanted)));
    for (int k = 0; k < count; ++k) {
      const double arc = from + section * k / count;
      FairSample sample;
      sample.node = k == 0 ? marks[m].node : -1;
      sample.point = sample.node >= 0 ? nodes_[static_cast<std::size_t>(sample.node)]
                                      : pointAtFraction(mesh, line.path, arc / all);
      sampled.samples.push_back(sample);
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
    if (sample.node >= 0 || line.isFixed) continue;
    if (!line.path.closed) {
      const bool atStart =
          i == 0 || (i == 1 && sampled.samples[0].node < 0 && line.start == FairEnd::Clamped);
      const bool atEnd = i + 1 == n || (i + 2 == n && sampled.samples[n - 1].node < 0 &&
                                        line.end == FairEnd::Clamped);
      if (atStart || atEnd) continue;
    }
    sample.unknown = unknowns_++;
    lineOfUnknown_.push_back(static_cast<int>(index));
  }
  std::vector<SurfacePoint> first;
  for (const FairSample& sample : sampled.samples) first.push_back(sample.point);
  firstPoints_.push_back(std::move(first));
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
      const Vector3d side = smoothNormal(*mesh_, sample.point).cross(chord);
      if (side.norm() > 0) sample.side = side.normalized();
    }
  }
}

FairSamples::Turns FairSamples::turns() const {
  Turns turns;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> constants;
  for (const FairSampledLine& line : lines_) {
    turns.firstRow.push_back(constants.size());
    const std::size_t n = line.size();
    for (std::size_t i = line.closed ? 0 : 1; i + (line.closed ? 0 : 1) < n; ++i) {
      const FairSample& before = line.at(i + n - 1);
      const FairSample& here = line.at(i);
      const FairSample& after = line.at(i + 1);
      const double in = (here.position - before.position).norm();
      const double out = (after.position - here.position).norm();
      const int row = static_cast<int>(constants.size());
      turns.step.push_back(0.5 * (in + out));
      if (!(in > 0 && out > 0)) {
        constants.push_back(0);
        continue;
      }
      const Vector3d& side = here.side;
      constants.push_back(side.dot((after.position - here.position) / out -
                                   (here.position - before.position) / in));
      const auto depend = [&](const FairSample& sample, double factor) {
        if (sample.node >= 0) {
          const auto node = static_cast<std::size_t>(sample.node);
          if (unknownOfNode_[node] < 0) return;
          entries.emplace_back(row, unknownOfNode_[node], factor * side.dot(frameOfNode_[node].a));
          entries.emplace_back(row, unknownOfNode_[node] + 1,
                               factor * side.dot(frameOfNode_[node].b));
        } else if (sample.unknown >= 0) {
          entries.emplace_back(row, sample.unknown, factor * side.dot(sample.side));
        }
      };
      depend(before, 1 / in);
      depend(here, -1 / in - 1 / out);
      depend(after, 1 / out);
    }
  }
  turns.firstRow.push_back(constants.size());
  turns.matrix.resize(static_cast<Eigen::Index>(constants.size()), unknowns_);
  turns.matrix.setFromTriplets(entries.begin(), entries.end());
  turns.constant = Eigen::Map<const Eigen::VectorXd>(constants.data(),
                                                     static_cast<Eigen::Index>(constants.size()));
  return turns;
}

Eigen::SparseMatrix<double> FairSamples::variation(const Turns& turns) const {
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const std::size_t first = turns.firstRow[l], end = turns.firstRow[l + 1];
    const std::size_t count = end - first;
    for (std::size_t i = 0; i + (lines_[l].closed ? 0 : 1) < count; ++i) {
      const std::size_t a = first + i, b = first + (i + 1) % count;
      const double between = 0.5 * (turns.step[a] + turns.step[b]);
      const double weight = 1 / std::sqrt(between);
      entries.emplace_back(row, static_cast<int>(a), -weight / turns.step[a]);
      entries.emplace_back(row, static_cast<int>(b), weight / turns.step[b]);
      ++row;
    }
  }
  Eigen::SparseMatrix<double> matrix(row, static_cast<Eigen::Index>(turns.step.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

FairSamples::Hold FairSamples::hold(const std::vector<double>& strengthOfLine) const {
  Hold hold{Eigen::VectorXd::Zero(unknowns_), Eigen::VectorXd::Zero(unknowns_)};
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    for (const FairSample& sample : lines_[l].samples) {
      const double weight = strengthOfLine[l] * lines_[l].spacing;
      if (sample.node >= 0) {
        const int first = unknownOfNode_[static_cast<std::size_t>(sample.node)];
        if (first < 0) continue;
        hold.weight[first] += weight;
        hold.weight[first + 1] += weight;
        const Frame& frame = frameOfNode_[static_cast<std::size_t>(sample.node)];
        hold.distance[first] = frame.a.dot(sample.position - frame.start);
        hold.distance[first + 1] = frame.b.dot(sample.position - frame.start);
      } else if (sample.unknown >= 0) {
        hold.weight[sample.unknown] += weight;
        hold.distance[sample.unknown] = sample.side.dot(sample.position - sample.start);
      }
    }
  }
  return hold;
}

void FairSamples::move(const Eigen::VectorXd& unknowns) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const int first = unknownOfNode_[i];
    if (first < 0) continue;
    Frame& frame = frameOfNode_[i];
    const Vector3d place =
        position(*mesh_, nodes_[i]) + unknowns[first] * frame.a + unknowns[first + 1] * frame.b;
    nodes_[i] = closest_.find(place, nodes_[i]);
    const Vector3d normal = smoothNormal(*mesh_, nodes_[i]);
    frame.a = normal.unitOrthogonal();
    frame.b = normal.cross(frame.a);
  }
  for (FairSampledLine& line : lines_) {
    for (FairSample& sample : line.samples) {
      if (sample.node >= 0) {
        sample.point = nodes_[static_cast<std::size_t>(sample.node)];
      } else if (sample.unknown >= 0) {
        const Vector3d place = sample.position + unknowns[sample.unknown] * sample.side;
        sample.point = closest_.find(place, sample.point);
      } else {
        continue;
      }
      sample.position = position(*mesh_, sample.point);
    }
  }
  turnFrames();
}

void FairSamples::returnToStart() {
  nodes_ = firstNodes_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Vector3d normal = smoothNormal(*mesh_, nodes_[i]);
    frameOfNode_[i].a = normal.unitOrthogonal();
    frameOfNode_[i].b = normal.cross(frameOfNode_[i].a);
  }
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    for (std::size_t i = 0; i < lines_[l].size(); ++i) {
      lines_[l].samples[i].point = firstPoints_[l][i];
      lines_[l].samples[i].position = lines_[l].samples[i].start;
    }
  }
  turnFrames();
}

double FairSamples::deviation(std::size_t line) const {
  double farthest = 0;
  for (const FairSample& sample : lines_[line].samples) {
    farthest = std::max(farthest, (sample.position - sample.start).norm());
  }
  return farthest;
}

}  // namespace toile::detail
