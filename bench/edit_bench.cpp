// SPDX-License-Identifier: GPL-3.0-or-later
// What a hand waits for while it draws: one move of the mouse, a stroke, fairing. On a body of
// 24 424 triangles and on the same body split twice in four (390 784).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

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

// From the new cursor position to the linked curve: a girth of the waist with six handles, pulled
// to and fro by up to 60 mm, 8 mm a move. Argument: splits of the mesh.
void BM_DragMove(benchmark::State& state) {
  const Document document = body(state, static_cast<int>(state.range(0)));
  if (!document.model) return;
  const SurfacePoint start = document.model->index->closestPoint({0, -300, 1000}).point;
  const auto girth = drawGirth(document, start, {0, 0, 1}, {"girth", "", CurveKind::Seam});
  if (!girth) return state.SkipWithError(girth.error().message.c_str());
  const Stretch stretch{0.1, 0.6};
  const auto handles = handlesOf(girth->document, "girth", stretch);
  auto drag = CurveDrag::begin(girth->document, "girth", stretch, 1);
  if (!handles || !drag) return state.SkipWithError("no handle");
  const Vector3d from = position(*document.model->mesh, (*handles)[1].point);
  std::vector<double> times;
  int i = 0;
  for (auto _ : state) {
    const double t = 0.13 * ++i;
    const auto begin = std::chrono::steady_clock::now();
    const Result<void> moved =
        drag->moveTo(from + 60 * Vector3d(0, 0.3 * std::cos(t), std::sin(t)));
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
    if (!moved) return state.SkipWithError(moved.error().message.c_str());
  }
  std::sort(times.begin(), times.end());
  state.counters["p95_ms"] = times[times.size() * 95 / 100];
  state.counters["faces"] = static_cast<double>(document.model->mesh->faceCount());
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

// Ten wavy girths and ten wavy lines down the trunk that cross them.
void BM_FairNetworkOf20(benchmark::State& state) {
  Document document = body(state, 0);
  if (!document.model) return;
  std::vector<std::string> ids;
  for (int i = 0; i < 20; ++i) {
    std::vector<SurfacePoint> points;
    for (int k = 0; k < 16; ++k) {
      const double wave = 6 * std::sin(2.6 * k + i);
      const double angle = i < 10 ? 2 * 3.14159265 * k / 16 : 2 * 3.14159265 * (i - 10) / 10;
      const double z = i < 10 ? 960 + 22 * i + wave : 950 + 16 * k;
      const double turned = i < 10 ? angle : angle + 0.03 * wave;
      points.push_back(
          document.model->index->closestPoint({130 * std::cos(turned), 100 * std::sin(turned), z})
              .point);
    }
    const auto drawn = drawThrough(document, points, i < 10);
    if (!drawn) return state.SkipWithError(drawn.error().message.c_str());
    document = drawn->document;
    ids.push_back(drawn->curves[0]);
  }
  double before = 0, after = 0;
  for (auto _ : state) {
    const auto faired = fairCurves(document, ids);
    if (!faired) return state.SkipWithError(faired.error().message.c_str());
    before = after = 0;
    for (const FairedCurve& curve : faired->curves) {
      before += curve.variationBefore;
      after += curve.variationAfter;
    }
  }
  state.counters["variation_left"] = after / before;
}
BENCHMARK(BM_FairNetworkOf20)->Unit(benchmark::kMillisecond);

}  // namespace
