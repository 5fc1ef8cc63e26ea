// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/spikes.h"

#include <algorithm>
#include <map>

namespace toile::detail {

namespace {

/// A smooth line turns far less than this at a point: cosine of 110 degrees.
constexpr double kTurnsBack = -0.34;
constexpr int kMaxRounds = 8;

/// Of a turn between the links that meet at a data point.
double turnCosine(const Mesh& mesh, const WorkCurve& curve, std::size_t i) {
  const std::size_t before = (i + curve.linkCount() - 1) % curve.linkCount();
  const auto& in = curve.links[before].points;
  const auto& out = curve.links[i % curve.linkCount()].points;
  const Eigen::Vector3d a = position(mesh, in.back()) - position(mesh, in[in.size() - 2]);
  const Eigen::Vector3d b = position(mesh, out[1]) - position(mesh, out.front());
  const double size = a.norm() * b.norm();
  return size > 0 ? a.dot(b) / size : 1;
}

}  // namespace

Result<void> removeSpikes(Sketch& sketch, std::span<const std::string> ids) {
  const Mesh& mesh = sketch.mesh();
  for (const std::string& id : ids) {
    Result<WorkCurve> work = sketch.load(id);
    if (!work) return work.error();
    const auto isShared = [&](const SurfacePoint& point) {
      const ModelPoint stored = toModelPoint(mesh, point);
      const auto& curves = sketch.design().curves;
      return std::any_of(curves.begin(), curves.end(), [&](const StylingCurve& other) {
        const auto& data = other.dataPoints;
        return other.id != id && std::find(data.begin(), data.end(), stored) != data.end();
      });
    };
    bool isChanged = false;
    for (int round = 0; round < kMaxRounds; ++round) {
      std::vector<bool> isOut(work->data.size(), false);
      const std::size_t n = work->data.size();
      const auto isEnd = [&](std::size_t i) { return !work->closed && (i == 0 || i + 1 == n); };
      for (std::size_t i = 0; i < n; ++i) {
        if (isEnd(i) || work->isCorner[i] || turnCosine(mesh, *work, i) > kTurnsBack) continue;
        if (!isShared(work->data[i])) {
          isOut[i] = true;
          continue;
        }
        for (const std::size_t beside : {(i + n - 1) % n, (i + 1) % n}) {
          if (!isEnd(beside) && !isShared(work->data[beside])) isOut[beside] = true;
        }
      }
      if (std::find(isOut.begin(), isOut.end(), true) == isOut.end()) break;
      std::vector<SurfacePoint> kept;
      std::vector<bool> isControl, isCorner;
      for (std::size_t i = 0; i < n; ++i) {
        if (isOut[i]) continue;
        kept.push_back(work->data[i]);
        isControl.push_back(work->isControl[i]);
        isCorner.push_back(work->isCorner[i]);
      }
      Result<WorkCurve> made = makeWorkCurve(sketch.linker(), mesh, kept, work->closed);
      if (!made) break;  // too little would be left
      if (made->data.size() == isControl.size()) {
        made->isControl = isControl;
        made->isCorner = isCorner;
      }
      work = std::move(made);
      isChanged = true;
    }
    if (isChanged) sketch.store(id, *work);
  }
  return {};
}

}  // namespace toile::detail
