// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp/judge.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toile/mesh/mesh_check.h"
#include "warp/body_distance.h"

namespace toile::detail {

using Eigen::Vector3d;

namespace {

constexpr double kEaseError = 1;   ///< mm, of the distance at a girth
constexpr double kInside = 0.25;   ///< mm; a chord between two points on a rounding body
constexpr double kFoldBefore = 0;  ///< cosine between neighbours that are no fold: 90 degrees
constexpr double kFoldAfter = -0.7;
constexpr std::size_t kMostNamed = 24;  ///< elements of a finding

double lineLength(const std::vector<Vector3d>& line, bool closed) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += (line[i + 1] - line[i]).norm();
  return closed && !line.empty() ? sum + (line.front() - line.back()).norm() : sum;
}

std::vector<Vector3d> places(const Mesh& mesh, const std::vector<SurfacePoint>& points) {
  std::vector<Vector3d> line;
  line.reserve(points.size());
  for (const SurfacePoint& point : points) line.push_back(position(mesh, point));
  return line;
}

std::vector<Vector3d> places(const Mesh& mesh, const std::vector<EasePoint>& points) {
  std::vector<Vector3d> line;
  line.reserve(points.size());
  for (const EasePoint& point : points) line.push_back(point.at(mesh.positions()));
  return line;
}

double meanValue(const std::vector<BodyDistance>& distances) {
  double sum = 0;
  for (const BodyDistance& distance : distances) sum += distance.value;
  return sum / static_cast<double>(std::max<std::size_t>(1, distances.size()));
}

void judgeGirths(const BeforeAndAfter& warp, WarpReport& report) {
  for (const GirthLine& girth : warp.girths) {
    WarpedGirth measured{.name = girth.name};
    const auto before = places(*warp.productBefore.mesh, girth.onProduct);
    const auto after = places(*warp.productAfter.mesh, girth.onProduct);
    measured.bodyBefore = lineLength(places(*warp.a.mesh, girth.onA), girth.closed);
    measured.bodyAfter = lineLength(places(*warp.b.mesh, girth.onB), girth.closed);
    measured.productBefore = lineLength(before, girth.closed);
    measured.productAfter = lineLength(after, girth.closed);
    measured.easeBefore = meanValue(distancesTo(*warp.a.index, before));
    const std::vector<BodyDistance> distances = distancesTo(*warp.b.index, after);
    measured.easeAfter = meanValue(distances);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      measured.largestError =
          std::max(measured.largestError, std::abs(distances[i].value - girth.onProduct[i].ease));
    }
    if (measured.largestError > kEaseError) {
      report.reasons.push_back(
          {"warp-ease",
           fmt::format("at the girth \"{}\" the distance to the body is up to {:.1f} mm off what "
                       "is asked for: girths that contradict each other, or a rigid part",
                       girth.name, measured.largestError),
           {Element::curve(girth.name)}});
    }
    report.girths.push_back(std::move(measured));
  }
}

void judgeEase(const BeforeAndAfter& warp, WarpReport& report) {
  const std::vector<BodyDistance> after =
      distancesTo(*warp.b.index, warp.productAfter.mesh->positions());
  std::vector<double> changes;
  std::vector<Element> inside;
  for (std::size_t v = 0; v < after.size(); ++v) {
    const double before = warp.easeBefore[v];
    report.deepestBefore = std::max(report.deepestBefore, -before);
    report.deepestAfter = std::max(report.deepestAfter, -after[v].value);
    if (before >= 0) {
      report.deeper = std::max(report.deeper, -after[v].value);
      if (after[v].value < -kInside && inside.size() < kMostNamed) {
        inside.push_back(Element::vertex(VertexId(v)));
      }
    }
    if (warp.easeWeight[v] > 0.5) changes.push_back(std::abs(after[v].value - before));
  }
  if (report.deeper > kInside) {
    report.reasons.push_back(
        {"warp-inside",
         fmt::format("the product lies up to {:.1f} mm inside the body where it was outside",
                     report.deeper),
         std::move(inside)});
  }
  if (changes.empty()) return;
  for (const double change : changes) {
    report.meanEaseChange += change / static_cast<double>(changes.size());
  }
  std::sort(changes.begin(), changes.end());
  report.easeChange95 = changes[(changes.size() - 1) * 95 / 100];
}

void judgeShape(const BeforeAndAfter& warp, WarpReport& report) {
  const Mesh& before = *warp.productBefore.mesh;
  const Mesh& after = *warp.productAfter.mesh;
  std::vector<Element> folds;
  for (std::size_t e = 0; e < before.edgeCount(); ++e) {
    const EdgeId edge(e);
    if (before.isBorder(edge)) continue;
    const HalfedgeId h = before.halfedge(edge);
    const FaceId left = before.face(h), right = before.face(before.opposite(h));
    if (before.normal(left).dot(before.normal(right)) < kFoldBefore) continue;
    if (after.normal(left).dot(after.normal(right)) > kFoldAfter) continue;
    ++report.folds;
    if (folds.size() < kMostNamed) folds.push_back(Element::edge(edge));
  }
  if (report.folds > 0) {
    report.reasons.push_back({"warp-fold",
                              fmt::format("the product turns back on itself along {} edge{}",
                                          report.folds, report.folds == 1 ? "" : "s"),
                              std::move(folds)});
  }
  for (std::size_t f = 0; f < before.faceCount(); ++f) {
    const double area = before.area(FaceId(f));
    if (area <= 0) continue;
    const double ratio = after.area(FaceId(f)) / area;
    report.leastAreaRatio = f == 0 ? ratio : std::min(report.leastAreaRatio, ratio);
    report.mostAreaRatio = f == 0 ? ratio : std::max(report.mostAreaRatio, ratio);
  }
  report.crossingsBefore = findCrossingFaces(before).size();
  const auto crossings = findCrossingFaces(after);
  report.crossings = crossings.size();
  if (report.crossings > report.crossingsBefore) {
    std::vector<Element> where;
    for (const auto& [f, g] : crossings) {
      if (where.size() < kMostNamed) where.push_back(Element::face(f));
    }
    report.reasons.push_back(
        {"warp-crossing",
         fmt::format("{} pairs of the product's faces cross each other, {} did before",
                     report.crossings, report.crossingsBefore),
         std::move(where)});
  }
}

}  // namespace

WarpReport judgeWarp(const BeforeAndAfter& warp) {
  WarpReport report;
  judgeGirths(warp, report);
  judgeEase(warp, report);
  judgeShape(warp, report);
  return report;
}

}  // namespace toile::detail
