// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/surface_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace toile {
namespace {

using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr int kMostBoxes = 128;  // per axis

}  // namespace

void SurfaceLines::add(SurfaceLine line) {
  const auto index = static_cast<std::uint32_t>(lines_.size());
  line.length = 0;
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    const float length = (line.points[k + 1] - line.points[k]).norm();
    if (length <= 0) continue;
    stretches_.push_back({line.points[k], line.points[k + 1], line.length, index});
    line.length += length;
  }
  lines_.push_back(std::move(line));
}

Vector3i SurfaceLines::boxOf(const Vector3f& point) const {
  return ((point - low_) / boxSize_).array().floor().cast<int>().matrix();
}

std::size_t SurfaceLines::indexOf(const Vector3i& box) const {
  return (static_cast<std::size_t>(box.z()) * static_cast<std::size_t>(count_.y()) +
          static_cast<std::size_t>(box.y())) *
             static_cast<std::size_t>(count_.x()) +
         static_cast<std::size_t>(box.x());
}

void SurfaceLines::prepare(float reach) {
  reach_ = reach;
  count_ = Vector3i::Zero();
  if (stretches_.empty()) return;
  low_ = Vector3f::Constant(std::numeric_limits<float>::infinity());
  Vector3f high = -low_;
  for (const Stretch& s : stretches_) {
    low_ = low_.cwiseMin(s.a.cwiseMin(s.b));
    high = high.cwiseMax(s.a.cwiseMax(s.b));
  }
  low_ -= Vector3f::Constant(reach);
  const Vector3f size = high + Vector3f::Constant(reach) - low_;
  boxSize_ = std::max(2 * reach, size.maxCoeff() / (kMostBoxes - 1));
  count_ = boxOf(low_ + size) + Vector3i::Ones();

  // Counted first, then filled: every box holds its stretches in their order.
  const auto forEachBox = [this](const Stretch& s, const auto& visit) {
    const Vector3f rim = Vector3f::Constant(reach_);
    const Vector3i first = boxOf(s.a.cwiseMin(s.b) - rim).cwiseMax(0);
    const Vector3i last = boxOf(s.a.cwiseMax(s.b) + rim).cwiseMin(count_ - Vector3i::Ones());
    for (int z = first.z(); z <= last.z(); ++z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) visit(indexOf({x, y, z}));
      }
    }
  };
  const auto boxes = static_cast<std::size_t>(count_.prod());
  firstOfBox_.assign(boxes + 1, 0);
  for (const Stretch& s : stretches_) {
    forEachBox(s, [this](std::size_t box) { ++firstOfBox_[box + 1]; });
  }
  for (std::size_t box = 0; box < boxes; ++box) firstOfBox_[box + 1] += firstOfBox_[box];
  inBox_.resize(firstOfBox_.back());
  std::vector<std::uint32_t> next(firstOfBox_.begin(), firstOfBox_.end() - 1);
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    forEachBox(stretches_[i],
               [&](std::size_t box) { inBox_[next[box]++] = static_cast<std::uint32_t>(i); });
  }
}

SurfaceLines::Near SurfaceLines::near(std::uint32_t part, const Vector3f& point) const {
  Near result;
  const Vector3i box = boxOf(point);
  if ((box.array() < 0).any() || (box.array() >= count_.array()).any()) return result;
  const std::size_t index = indexOf(box);
  struct Best {
    Pass Near::*pass;
    float squared;
  };
  const float most = reach_ * reach_;
  Best border{&Near::border, most};
  Best zip{&Near::zip, most};
  Best inside{&Near::inside, most};
  for (std::uint32_t i = firstOfBox_[index]; i < firstOfBox_[index + 1]; ++i) {
    const Stretch& s = stretches_[inBox_[i]];
    const SurfaceLine& line = lines_[s.line];
    if (line.part != part && line.part != kEveryPart) continue;
    const Vector3f axis = s.b - s.a;
    const float lengthSquared = axis.squaredNorm();
    const float t = std::clamp(axis.dot(point - s.a) / lengthSquared, 0.0F, 1.0F);
    const float squared = (s.a + t * axis - point).squaredNorm();
    Best& best = isInside(line.role) ? inside : line.role == LineRole::Zip ? zip : border;
    if (squared >= best.squared) continue;
    best.squared = squared;
    result.*best.pass = {&line, s.from + t * std::sqrt(lengthSquared), std::sqrt(squared)};
  }
  return result;
}

}  // namespace toile
