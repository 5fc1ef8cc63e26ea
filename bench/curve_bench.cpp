// SPDX-License-Identifier: GPL-3.0-or-later
// Curves on a body of 24 424 triangles. Yardstick: one factorisation of its Laplacian.
#include <benchmark/benchmark.h>

#include <cmath>

#include "support/yardstick.h"
#include "toile/curve/geodesic.h"
#include "toile/design/design.h"

namespace {

using namespace toile;
using Eigen::Vector3d;

constexpr const char* kBody = "bodies/female_average.ply";

ReferenceModel loadModel(benchmark::State& state) {
  ReferenceModel model;
  model.mesh = bench::loadMesh(state, kBody);
  if (model.mesh) model.index = std::make_shared<const SurfaceIndex>(model.mesh);
  return model;
}

void BM_CurveYardstick(benchmark::State& state) {
  const auto mesh = bench::loadMesh(state, kBody);
  if (mesh) bench::factorise(state, *mesh);
}
BENCHMARK(BM_CurveYardstick)->Unit(benchmark::kMillisecond);

// Neighbouring data points of a girth: what a drawn curve is made of. Argument: mm between them.
void BM_ShortLink(benchmark::State& state) {
  const ReferenceModel model = loadModel(state);
  if (!model.mesh) return;
  std::vector<SurfacePath> girths = model.index->planeSection(Vector3d::UnitZ(), 1000);
  const SurfacePath& waist = girths.front();
  const double all = length(*model.mesh, waist);
  const auto count = static_cast<std::size_t>(all / static_cast<double>(state.range(0)));
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count);
    // A little up and down, so that links do not run in the plane of the section.
    const Vector3d place = position(*model.mesh, pointAtFraction(*model.mesh, waist, fraction)) +
                           Vector3d(0, 0,
                                    0.4 * static_cast<double>(state.range(0)) *
                                        std::sin(2.4 * static_cast<double>(i)));
    points.push_back(model.index->closestPoint(place).point);
  }
  GeodesicLinker linker(model.mesh);
  std::size_t crossed = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) {
      const Result<SurfacePath> path = linker.link(points[i], points[(i + 1) % count]);
      crossed += path ? path->faceOfSegment.size() : 0;
    }
  }
  const auto links = state.iterations() * static_cast<std::int64_t>(count);
  state.SetItemsProcessed(links);
  state.counters["s_per_link"] = benchmark::Counter(
      static_cast<double>(links), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["triangles"] = static_cast<double>(crossed) / static_cast<double>(links);
}
BENCHMARK(BM_ShortLink)->Arg(5)->Arg(15)->Arg(40)->Unit(benchmark::kMicrosecond);

/// The ends of the body in a direction, so that no names are needed.
SurfacePoint farthest(const Mesh& mesh, const Vector3d& direction) {
  VertexId best(0);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (direction.dot(mesh.position(VertexId(v))) > direction.dot(mesh.position(best))) {
      best = VertexId(v);
    }
  }
  return {best};
}

void farLink(benchmark::State& state, const Vector3d& from, const Vector3d& to) {
  const ReferenceModel model = loadModel(state);
  if (!model.mesh) return;
  GeodesicLinker linker(model.mesh);
  const SurfacePoint a = farthest(*model.mesh, from), b = farthest(*model.mesh, to);
  Result<SurfacePath> path = linker.link(a, b);
  for (auto _ : state) {
    path = linker.link(a, b);
    benchmark::DoNotOptimize(path);
  }
  if (!path) return;
  state.counters["mm"] = length(*model.mesh, *path);
  state.counters["triangles"] = static_cast<double>(path->faceOfSegment.size());
  state.counters["defect"] = geodesicDefect(*model.mesh, *path);
}
void BM_LinkCrownToToe(benchmark::State& state) {
  farLink(state, {0, 0, 1}, {0.2, -1, -2});
}
BENCHMARK(BM_LinkCrownToToe)->Unit(benchmark::kMicrosecond);
void BM_LinkHandToHand(benchmark::State& state) {
  farLink(state, {1, 0, 0}, {-1, 0, 0});
}
BENCHMARK(BM_LinkHandToHand)->Unit(benchmark::kMicrosecond);

// A smooth girth with ten control points: subdivided, put on the surface, linked.
void BM_PlaceSmoothCurve(benchmark::State& state) {
  const ReferenceModel model = loadModel(state);
  if (!model.mesh) return;
  SmoothWay way;
  for (int i = 0; i < 10; ++i) {
    OnSection control;
    control.plane.through = Length::mm(1000 + 15.0 * (i % 2));
    control.direction = {std::cos(0.628 * i), std::sin(0.628 * i), 0};
    const Result<SurfacePoint> place = resolvePlace(control, model, {});
    if (!place) return state.SkipWithError(place.error().message.c_str());
    way.controls.push_back(toModelPoint(*model.mesh, *place));
  }
  StylingCurve curve;
  curve.id = "girth";
  curve.closed = true;
  curve.way = way;
  Design design;
  design.curves.push_back(curve);
  for (auto _ : state) {
    const auto placed = placeCurves(design, model);
    if (!placed) return state.SkipWithError(placed.error().message.c_str());
    benchmark::DoNotOptimize(placed);
  }
}
BENCHMARK(BM_PlaceSmoothCurve)->Unit(benchmark::kMicrosecond);

}  // namespace
