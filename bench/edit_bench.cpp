// SPDX-License-Identifier: GPL-3.0-or-later
// What a hand waits for while it draws: one move of the mouse, a stroke, fairing. On a body of
// 24 424 triangles and on the same body split twice in four (390 784).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>

#include "support/yardstick.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/shape.h"

namespace {

using namespace toile;
using Eigen::Vector3d;

/// Each triangle in four, in the same planes.
Mesh splitInFour(const Mesh& mesh) {
  std::vector<Vector3d> positions = mesh.positions();
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
    positions.emplace_back(
        0.5 * (mesh.position(mesh.tail(EdgeId(e))) + mesh.position(mesh.head(EdgeId(e)))));
  }
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    Triangle m;
    for (int k = 0; k < 3; ++k) {
      m[static_cast<std::size_t>(k)] =
          VertexId(mesh.vertexCount() + mesh.edge(mesh.halfedge(FaceId(f), k)).index());
    }
    triangles.push_back({t[0], m[0], m[2]});
    triangles.push_back({m[0], t[1], m[1]});
    triangles.push_back({m[2], m[1], t[2]});
    triangles.push_back(m);
  }
  return *makeMesh(std::move(positions), std::move(triangles));
}

/// Of this thread's own work, so that others on the machine do not count; a move runs on one.
double threadMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Document body(benchmark::State& state, int splits) {
  static std::map<int, Document> known;
  if (const auto found = known.find(splits); found != known.end()) return found->second;
  const auto mesh = bench::loadMesh(state, "bodies/female_average.ply");
  if (!mesh) return {};
  Mesh fine = *mesh;
  for (int i = 0; i < splits; ++i) fine = splitInFour(fine);
  known[splits] = {std::make_shared<const Design>(),
                   std::make_shared<const ReferenceModel>(makeReferenceModel("body", fine))};
  return known[splits];
}

// From the new cursor position to the linked curve: half of a girth of the waist, pulled by one of
// its handles to and fro by 60 mm, up to 8 mm a move. Argument: splits of the mesh. The handle must
// really go there: far_mm is the farthest that it was from its start, off_mm how far it was from
// the cursor's place on the surface at most.
void BM_DragMove(benchmark::State& state) {
  const Document document = body(state, static_cast<int>(state.range(0)));
  if (!document.model) return;
  const Mesh& mesh = *document.model->mesh;
  const SurfacePoint start = document.model->index->closestPoint({0, -300, 1000}).point;
  const auto girth = drawGirth(document, start, {0, 0, 1}, {"girth", "", CurveKind::Seam});
  if (!girth) return state.SkipWithError(girth.error().message.c_str());
  const Stretch stretch{0.1, 0.6};
  const auto handles = handlesOf(girth->document, "girth", stretch);
  auto drag = CurveDrag::begin(girth->document, "girth", stretch, 1);
  if (!handles || !drag) return state.SkipWithError("no handle");
  const Vector3d from = position(mesh, (*handles)[1].point);
  std::vector<double> times;
  double far = 0, off = 0;
  int i = 0;
  for (auto _ : state) {
    const Vector3d goal = from + 60 * Vector3d(0, 0, std::sin(0.13 * ++i));
    const double begin = threadMilliseconds();
    const Result<void> moved = drag->moveTo(goal);
    times.push_back(threadMilliseconds() - begin);
    if (!moved) return state.SkipWithError(moved.error().message.c_str());
    state.PauseTiming();
    const Vector3d now = position(mesh, drag->handle());
    far = std::max(far, (now - from).norm());
    off = std::max(off, (now - document.model->index->closestPoint(goal).position).norm());
    state.ResumeTiming();
  }
  std::sort(times.begin(), times.end());
  state.counters["p95_ms"] = times[times.size() * 95 / 100];
  state.counters["far_mm"] = far;
  state.counters["off_mm"] = off;
  state.counters["faces"] = static_cast<double>(mesh.faceCount());
}
BENCHMARK(BM_DragMove)->Arg(0)->Arg(2)->Unit(benchmark::kMillisecond);

// 500 samples of a trembling hand across the front.
void BM_StrokeToCurve(benchmark::State& state) {
  const Document document = body(state, 0);
  if (!document.model) return;
  std::vector<StrokeSample> stroke;
  for (int i = 0; i < 500; ++i) {
    const double t = i / 499.0;
    stroke.push_back(
        {{-100 + 200 * t + std::sin(7.0 * i), 250 * std::sin(5 * t) + std::cos(9.0 * i)},
         0.004 * i,
         1});
  }
  const View view;
  for (auto _ : state) {
    const auto drawn = drawStroke(document, view, stroke);
    if (!drawn) return state.SkipWithError(drawn.error().message.c_str());
    benchmark::DoNotOptimize(drawn);
  }
}
BENCHMARK(BM_StrokeToCurve)->Unit(benchmark::kMillisecond);

// Ten girths and ten lines down the trunk that cross them, all with ripples of 4 mm.
void BM_FairNetworkOf20(benchmark::State& state) {
  Document document = body(state, 0);
  if (!document.model) return;
  constexpr int kPoints = 32;
  std::vector<std::string> ids;
  for (int i = 0; i < 20; ++i) {
    const bool isRing = i < 10;
    std::vector<SurfacePoint> points;
    for (int k = 0; k < kPoints; ++k) {
      const double ripple = 4 * std::sin(1.3 * k + i);
      const double turn =
          2 * std::numbers::pi * (isRing ? k / double{kPoints} : (i - 10) / 10.0 + ripple / 800);
      const double z = isRing ? 960 + 22 * i + ripple : 950 + 8 * k;
      points.push_back(
          document.model->index->closestPoint({130 * std::cos(turn), 100 * std::sin(turn), z})
              .point);
    }
    const auto drawn = drawThrough(document, points, isRing);
    if (!drawn) return state.SkipWithError(drawn.error().message.c_str());
    document = drawn->document;
    ids.push_back(drawn->curves[0]);
  }
  std::vector<FairedCurve> faired;
  for (auto _ : state) {
    const auto result = fairCurves(document, ids);
    if (!result) return state.SkipWithError(result.error().message.c_str());
    faired = result->curves;
  }
  double before = 0, after = 0, bends = 0, left = 0, deviation = 0;
  for (const FairedCurve& curve : faired) {
    before += curve.variationBefore;
    after += curve.variationAfter;
    bends += curve.inflectionsBefore;
    left += curve.inflectionsAfter;
    deviation = std::max(deviation, curve.deviation.mm());
  }
  state.counters["variation_left"] = after / before;
  state.counters["bends_before"] = bends;
  state.counters["bends_after"] = left;
  state.counters["deviation_mm"] = deviation;
}
BENCHMARK(BM_FairNetworkOf20)->Unit(benchmark::kMillisecond);

}  // namespace
