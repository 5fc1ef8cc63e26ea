// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/allowance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <polyclipping/clipper.hpp>

#include "finish/polygon.h"

namespace toile {
namespace {

// Clipper computes in integers: 1e-5 mm a step leaves 10 m either way in its fast range.
constexpr double kStepsPerMm = 1e5;
constexpr double kArcErrorMm = 0.02;       ///< of the chords around convex turns
constexpr double kSimplifyMm = 0.01;       ///< vertices of the union this close to a chord go
constexpr double kSmallestPocketMm2 = 25;  ///< closed-in leftovers below this are filled

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

IntPoint toInteger(const Eigen::Vector2d& p) {
  return {static_cast<ClipperLib::cInt>(std::llround(p.x() * kStepsPerMm)),
          static_cast<ClipperLib::cInt>(std::llround(p.y() * kStepsPerMm))};
}

Path toPath(const Points2& points) {
  Path path;
  path.reserve(points.size());
  for (const Eigen::Vector2d& p : points) path.push_back(toInteger(p));
  return path;
}

Points2 toPoints(const Path& path) {
  Points2 points;
  points.reserve(path.size());
  for (const IntPoint& p : path)
    points.emplace_back(static_cast<double>(p.X) / kStepsPerMm,
                        static_cast<double>(p.Y) / kStepsPerMm);
  return points;
}

/// Where an edge of the outline ends and the next begins. d = unit directions, n = unit normals to
/// the outside, a = allowances; subscript 1 = before, 2 = after the vertex c.
struct Turn {
  Eigen::Vector2d c, d1, d2, n1, n2;
  double a1, a2;
  double angle;  ///< to the left; > 0 = convex
};

/// The sector of a smooth convex turn, by chords.
Points2 sector(const Turn& turn) {
  Points2 points{turn.c};
  const double step = 2 * std::acos(1 - std::min(kArcErrorMm / turn.a1, 0.5));
  const int chords = std::max(1, static_cast<int>(std::ceil(turn.angle / step)));
  const double start = std::atan2(turn.n1.y(), turn.n1.x());
  for (int i = 0; i <= chords; ++i) {
    const double angle = start + turn.angle * i / chords;
    points.push_back(turn.c + turn.a1 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  points[1] = turn.c + turn.a1 * turn.n1;
  points.back() = turn.c + turn.a2 * turn.n2;
  return points;
}

/// What fills a convex corner: both parallels prolonged until they meet.
Points2 mitre(const Turn& turn) {
  const Eigen::Vector2d end1 = turn.c + turn.a1 * turn.n1;
  const Eigen::Vector2d end2 = turn.c + turn.a2 * turn.n2;
  const double cosine = std::cos(turn.angle);
  const double sine = std::sin(turn.angle);
  // Lengths by which the parallels are prolonged: c + a1 n1 + t1 d1 = c + a2 n2 - t2 d2.
  const double numerator1 = turn.a2 - turn.a1 * cosine;
  const double numerator2 = turn.a1 - turn.a2 * cosine;
  // The wider strip may stand out beyond the narrower one's parallel: that one runs up to it.
  if (numerator1 < 0) return {turn.c, turn.c + turn.n1 * (turn.a2 / cosine), end2};
  if (numerator2 < 0) return {turn.c, end1, turn.c + turn.n2 * (turn.a1 / cosine)};
  Eigen::Vector2d bisector = turn.n1 + turn.n2;
  bisector = bisector.norm() > 1e-6 ? Eigen::Vector2d(bisector.normalized()) : turn.d1;
  const double reach = kMitreLimit * std::max(turn.a1, turn.a2);
  const double rise = std::max(turn.d1.dot(bisector), 1e-9);
  const double cut1 = std::max((reach - turn.a1 * turn.n1.dot(bisector)) / rise, 0.0);
  const double cut2 = std::max((reach - turn.a2 * turn.n2.dot(bisector)) / rise, 0.0);
  if (sine > 1e-9) {
    const double t1 = numerator1 / sine;
    const double t2 = numerator2 / sine;
    if (t1 <= cut1 && t2 <= cut2) return {turn.c, end1, end1 + t1 * turn.d1, end2};
    return {turn.c, end1, end1 + std::min(t1, cut1) * turn.d1, end2 - std::min(t2, cut2) * turn.d2,
            end2};
  }
  return {turn.c, end1, end1 + cut1 * turn.d1, end2 - cut2 * turn.d2, end2};
}

/// Allowance of each edge of each loop.
std::vector<std::vector<double>> edgeAllowances(const SewOutline& sew) {
  std::vector<std::vector<double>> widths;
  for (const Outline& loop : sew.loops) widths.emplace_back(loop.size(), 0.0);
  for (const OutlineRun& run : sew.runs)
    for (std::size_t i = 0; i < run.edgeCount; ++i) widths[run.loop][run.first + i] = run.allowance;
  return widths;
}

void addStrips(const Outline& loop, const std::vector<double>& widths, Paths& strips) {
  const std::size_t count = loop.size();
  const auto add = [&](const Points2& points) {
    Path path = toPath(points);
    if (ClipperLib::Area(path) < 0) ClipperLib::ReversePath(path);
    strips.push_back(std::move(path));
  };
  const auto direction = [&](std::size_t edge) -> Eigen::Vector2d {
    const Eigen::Vector2d d = loop[(edge + 1) % count].position - loop[edge].position;
    return d.norm() > 0 ? Eigen::Vector2d(d.normalized()) : d;
  };
  for (std::size_t i = 0; i < count; ++i) {
    Turn turn;
    const std::size_t before = (i + count - 1) % count;
    turn.c = loop[i].position;
    turn.d1 = direction(before);
    turn.d2 = direction(i);
    turn.n1 = {turn.d1.y(), -turn.d1.x()};
    turn.n2 = {turn.d2.y(), -turn.d2.x()};
    turn.a1 = widths[before];
    turn.a2 = widths[i];
    turn.angle = std::atan2(cross(turn.d1, turn.d2), turn.d1.dot(turn.d2));
    if (turn.a2 > 0) {
      const Eigen::Vector2d& next = loop[(i + 1) % count].position;
      add({turn.c, turn.c + turn.a2 * turn.n2, next + turn.a2 * turn.n2, next});
    }
    if (turn.angle <= 0 || std::max(turn.a1, turn.a2) <= 0) continue;
    if (!loop[i].corner && turn.a1 == turn.a2) {
      add(sector(turn));
    } else {
      add(mitre(turn));
    }
  }
}

Outline toOutline(const Points2& points) {
  const std::vector<char> keep(points.size(), 0);
  const std::vector<std::size_t> kept = simplifiedIndices(points, keep, kSimplifyMm);
  Outline outline;
  for (const std::size_t i : kept) outline.push_back({points[i], false});
  const std::size_t count = outline.size();
  std::size_t sharpest = 0;
  double sharpestTurn = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = std::abs(turnAngle(outline[(i + count - 1) % count].position,
                                           outline[i].position, outline[(i + 1) % count].position));
    outline[i].corner = turn > kCornerDegrees * std::numbers::pi / 180;
    // A hair of preference for the earlier one: equal corners must not swap by rounding.
    if (turn > sharpestTurn + 1e-6) {
      sharpestTurn = turn;
      sharpest = i;
    }
  }
  std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(sharpest),
              outline.end());
  return outline;
}

/// Vertices around which the distance between the lines is the corner's matter, with the radius.
struct CornerZone {
  Eigen::Vector2d position;
  double radius;
};

std::vector<CornerZone> cornerZones(const SewOutline& sew,
                                    const std::vector<std::vector<double>>& widths) {
  std::vector<CornerZone> zones;
  for (std::size_t l = 0; l < sew.loops.size(); ++l) {
    const std::size_t count = sew.loops[l].size();
    for (std::size_t i = 0; i < count; ++i) {
      const double before = widths[l][(i + count - 1) % count];
      const double after = widths[l][i];
      if (sew.loops[l][i].corner || before != after)
        zones.push_back({sew.loops[l][i].position, 1.1 * kMitreLimit * std::max(before, after)});
    }
  }
  return zones;
}

}  // namespace

std::vector<Outline> makeCutLines(const SewOutline& sew) {
  if (std::all_of(sew.runs.begin(), sew.runs.end(),
                  [](const OutlineRun& run) { return run.allowance <= 0; }))
    return sew.loops;
  const std::vector<std::vector<double>> widths = edgeAllowances(sew);
  Paths parts;
  for (std::size_t l = 0; l < sew.loops.size(); ++l) {
    parts.push_back(toPath(positions(sew.loops[l])));
    addStrips(sew.loops[l], widths[l], parts);
  }
  ClipperLib::Clipper clipper;
  clipper.AddPaths(parts, ClipperLib::ptSubject, true);
  Paths united;
  clipper.Execute(ClipperLib::ctUnion, united, ClipperLib::pftNonZero, ClipperLib::pftNonZero);

  std::vector<Points2> loops;
  for (const Path& path : united) {
    Points2 points = toPoints(path);
    if (points.size() >= 3) loops.push_back(std::move(points));
  }
  if (loops.empty()) return sew.loops;
  std::stable_sort(loops.begin(), loops.end(), [](const Points2& a, const Points2& b) {
    return signedArea(a) > signedArea(b);
  });
  std::vector<Outline> cutLines{toOutline(loops.front())};
  for (std::size_t l = 1; l < loops.size(); ++l)
    if (signedArea(loops[l]) < -kSmallestPocketMm2) cutLines.push_back(toOutline(loops[l]));
  return cutLines;
}

std::vector<Finding> checkCutLines(const SewOutline& sew, const std::vector<Outline>& cutLines,
                                   const Piece& piece) {
  std::vector<Finding> findings;
  const std::vector<std::vector<double>> widths = edgeAllowances(sew);
  std::vector<double> flatWidths;
  for (const std::vector<double>& w : widths)
    flatWidths.insert(flatWidths.end(), w.begin(), w.end());
  if (std::all_of(flatWidths.begin(), flatWidths.end(), [](double w) { return w <= 0; }))
    return findings;
  const std::vector<CornerZone> zones = cornerZones(sew, widths);
  const auto nearCorner = [&](const Eigen::Vector2d& p) {
    return std::any_of(zones.begin(), zones.end(), [&](const CornerZone& zone) {
      return (p - zone.position).norm() <= zone.radius;
    });
  };
  const std::vector<Points2> sewLoops = positions(sew.loops);
  const std::vector<Points2> cutLoops = positions(cutLines);
  const EdgeGrid sewGrid(sewLoops);
  const EdgeGrid cutGrid(cutLoops);

  double worst = 0;
  Eigen::Vector2d where{0, 0};
  for (const Points2& loop : cutLoops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d middle = 0.5 * (a + loop[(i + 1) % loop.size()]);
      for (const Eigen::Vector2d& p : {a, middle}) {
        const EdgeGrid::Nearest nearest = sewGrid.nearest(p);
        const double off = std::abs(nearest.distance - flatWidths[nearest.edge]);
        if (off > std::max(worst, kAllowanceToleranceMm) && !nearCorner(p)) {
          worst = off;
          where = p;
        }
      }
    }
  }
  if (worst > kAllowanceToleranceMm)
    findings.push_back({"allowance-differs",
                        fmt::format("piece \"{}\": the seam allowance is off by {:.2f} mm near "
                                    "({:.0f}, {:.0f}) mm of the flat piece; look at the cut line "
                                    "there",
                                    piece.name, worst, where.x(), where.y()),
                        {Element::piece(piece.id)}});

  double shortest = 0;
  std::size_t edge = 0;
  for (std::size_t l = 0; l < sewLoops.size(); ++l) {
    for (std::size_t i = 0; i < sewLoops[l].size(); ++i, ++edge) {
      const Eigen::Vector2d middle =
          0.5 * (sewLoops[l][i] + sewLoops[l][(i + 1) % sewLoops[l].size()]);
      if (flatWidths[edge] <= 0) continue;
      const double inside = isInside(cutLoops, middle) ? cutGrid.nearest(middle).distance : 0;
      const double missing = flatWidths[edge] - inside;
      if (missing > std::max(shortest, kAllowanceToleranceMm) && !nearCorner(middle)) {
        shortest = missing;
        where = middle;
      }
    }
  }
  if (shortest > kAllowanceToleranceMm)
    findings.push_back({"allowance-too-narrow",
                        fmt::format("piece \"{}\": {:.2f} mm of seam allowance are missing near "
                                    "({:.0f}, {:.0f}) mm of the flat piece",
                                    piece.name, shortest, where.x(), where.y()),
                        {Element::piece(piece.id)}});

  if (cutLines.size() < sew.loops.size())
    findings.push_back({"allowance-closes-hole",
                        fmt::format("piece \"{}\": the seam allowance fills a hole; give its curve "
                                    "a smaller allowance or cut it by hand along the sew line",
                                    piece.name),
                        {Element::piece(piece.id)}});
  if (cutLines.size() > sew.loops.size())
    findings.push_back({"allowance-closes-gap",
                        fmt::format("piece \"{}\": seam allowances on both sides of a gap meet and "
                                    "leave a hole; give those curves smaller allowances",
                                    piece.name),
                        {Element::piece(piece.id)}});
  return findings;
}

}  // namespace toile
