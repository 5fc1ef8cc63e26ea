// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/curve_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "support/edit_support.h"
#include "toile/curve/geodesic.h"
#include "toile/edit/symmetry.h"

namespace toile::test {

using Eigen::Vector3d;

namespace {

/// What the angles of a link may miss of pi: 1e-6, and what the rounding of positions makes of the
/// directions of its shortest segment.
double allowedDefect(const Mesh& mesh, const SurfacePath& link, double size) {
  double shortest = size;
  for (std::size_t k = 0; k + 1 < link.points.size(); ++k) {
    shortest = std::min(
        shortest, (position(mesh, link.points[k]) - position(mesh, link.points[k + 1])).norm());
  }
  return 1e-6 + 32 * std::numeric_limits<double>::epsilon() * size / shortest;
}

void expectOnSurface(const Mesh& mesh, const SurfacePath& path, double size,
                     const std::string& context) {
  for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
    // The middle of each segment is the point of its face that it names.
    const SurfacePoint& a = path.points[i];
    const SurfacePoint& b = path.points[(i + 1) % path.points.size()];
    const FaceId face = path.faceOfSegment[i];
    const SurfacePoint middle = makeSurfacePoint(
        mesh, face, 0.5 * (barycentricIn(mesh, a, face) + barycentricIn(mesh, b, face)));
    const double off =
        (position(mesh, middle) - 0.5 * (position(mesh, a) + position(mesh, b))).norm();
    ASSERT_LE(off, 1e-12 * size) << context;
  }
}

std::vector<std::string> idsOf(const Design& design) {
  std::vector<std::string> ids;
  for (const StylingCurve& curve : design.curves) ids.push_back(curve.id);
  return ids;
}

/// Data points of both, bit for bit.
std::vector<ModelPoint> commonPoints(const StylingCurve& a, const StylingCurve& b) {
  std::vector<ModelPoint> common;
  std::copy_if(a.dataPoints.begin(), a.dataPoints.end(), std::back_inserter(common),
               [&](const ModelPoint& point) {
                 return std::find(b.dataPoints.begin(), b.dataPoints.end(), point) !=
                        b.dataPoints.end();
               });
  return common;
}

}  // namespace

void expectSound(const Document& document, GeodesicLinker& linker, const std::string& context) {
  const Mesh& mesh = *document.model->mesh;
  const double size = (mesh.boxMax() - mesh.boxMin()).norm();
  const auto placed =
      placeCurves(*document.design, *document.model, idsOf(*document.design), linker);
  ASSERT_TRUE(placed) << context << ": " << placed.error();
  for (const PlacedCurve& curve : *placed) {
    const std::string here = context + ": " + curve.id;
    ASSERT_TRUE(isValid(mesh, curve.path)) << here;
    expectOnSurface(mesh, curve.path, size, here);
    if (testing::Test::HasFatalFailure()) return;
    const std::size_t n = curve.path.points.size(), count = curve.dataPoints.size();
    ASSERT_EQ(curve.path.points[0], curve.dataPoints[0]) << here;
    std::size_t from = 0;
    for (std::size_t d = 1; d < count + (curve.path.closed ? 1 : 0); ++d) {
      const SurfacePoint& next = curve.dataPoints[d % count];
      std::size_t to = from + 1;
      while (to < n && !(curve.path.points[to] == next)) ++to;
      ASSERT_TRUE(to < n || (curve.path.closed && d == count))
          << here << " leaves out data point " << d;
      SurfacePath link;
      for (std::size_t k = from; k <= to; ++k) link.points.push_back(curve.path.points[k % n]);
      for (std::size_t k = from; k < to; ++k) {
        link.faceOfSegment.push_back(curve.path.faceOfSegment[k]);
      }
      ASSERT_LE(geodesicDefect(mesh, link), allowedDefect(mesh, link, size))
          << here << ", link to data point " << d << " of " << count;
      from = to;
    }
  }
}

void expectAllShared(const Document& document, GeodesicLinker& linker, const std::string& context) {
  const auto& curves = document.design->curves;
  const auto placed =
      placeCurves(*document.design, *document.model, idsOf(*document.design), linker);
  ASSERT_TRUE(placed) << context << ": " << placed.error();
  const Mesh& mesh = *document.model->mesh;
  for (std::size_t a = 0; a < curves.size(); ++a) {
    for (std::size_t b = a + 1; b < curves.size(); ++b) {
      if (curves[a].dataPoints.empty() || curves[b].dataPoints.empty()) continue;
      for (const PathMeeting& meeting : findMeetings(mesh, (*placed)[a].path, (*placed)[b].path)) {
        // Nearer than rounding it is the shared point itself; where lines run along each other the
        // place of a meeting is only known to rounding over their angle.
        double least = std::numeric_limits<double>::infinity();
        for (const ModelPoint& point : commonPoints(curves[a], curves[b])) {
          const Vector3d place = position(mesh, *toSurfacePoint(mesh, point));
          least = std::min(least, (place - position(mesh, meeting.point)).norm());
        }
        ASSERT_LT(least, 10 * kSameMeeting)
            << context << ": " << curves[a].id << " and " << curves[b].id << " at " << meeting.a
            << " and " << meeting.b;
      }
    }
  }
}

std::vector<std::string> sharingWith(const Design& design, const std::string& curve) {
  std::vector<std::string> others;
  const auto found = std::find_if(design.curves.begin(), design.curves.end(),
                                  [&](const StylingCurve& c) { return c.id == curve; });
  if (found == design.curves.end()) return others;
  for (const StylingCurve& other : design.curves) {
    if (other.id != curve && !commonPoints(*found, other).empty()) others.push_back(other.id);
  }
  return others;
}

void expectStillShared(const Document& document, GeodesicLinker& linker, const std::string& curve,
                       const std::vector<std::string>& others, const std::string& context) {
  for (const std::string& other : others) {
    const std::vector<std::string> both{curve, other};
    const auto placed = placeCurves(*document.design, *document.model, both, linker);
    ASSERT_TRUE(placed) << context << ": " << placed.error();
    const auto meetings = findMeetings(*document.model->mesh, (*placed)[0].path, (*placed)[1].path);
    if (meetings.empty()) continue;
    ASSERT_FALSE(commonPoints(curveOf(document, curve), curveOf(document, other)).empty())
        << context << ": " << curve << " and " << other;
  }
}

void expectMirrorOfMirror(const Document& document, const std::string& curve,
                          const std::string& context) {
  const Mesh& mesh = *document.model->mesh;
  const auto once = mirrorCurves(document, std::vector<std::string>{curve}, false);
  ASSERT_TRUE(once) << context << once.error();
  const auto twice = mirrorCurves(once->document, once->curves, false);
  ASSERT_TRUE(twice) << context << twice.error();
  const auto& original = curveOf(document, curve).dataPoints;
  const auto& back = curveOf(twice->document, twice->curves[0]).dataPoints;
  ASSERT_EQ(original.size(), back.size()) << context;
  const bool isPaired = !document.model->symmetry->partner.empty();
  for (std::size_t i = 0; i < original.size(); ++i) {
    if (isPaired && !std::holds_alternative<ModelPoint::OnEdge>(original[i].at)) {
      ASSERT_EQ(original[i], back[i]) << context;
    }
    const Vector3d was = position(mesh, *toSurfacePoint(mesh, original[i])),
                   now = position(mesh, *toSurfacePoint(mesh, back[i]));
    ASSERT_LE((was - now).norm(), 1e-12 * (mesh.boxMax() - mesh.boxMin()).norm()) << context;
  }
}

}  // namespace toile::test
