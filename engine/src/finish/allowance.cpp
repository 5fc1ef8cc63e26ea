// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/allowance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <polyclipping/clipper.hpp>

#include "finish/polygon.h"

namespace toile {
namespace {

// Clipper computes in integers: 1e-5 mm a step leaves 10 m either way in its fast range.
constexpr double kStepsPerMm = 1e5;
constexpr double kArcErrorMm = 0.02;  ///< of the chords around convex turns
constexpr double kSimplifyMm = 0.01;  ///< vertices of the union this close to a chord go
/// Where parts of the union touch along a line, rounding leaves slits in it, closer than this.
constexpr double kSlitMm = 0.002;
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

Turn turnAt(const Outline& loop, std::size_t i, double before, double after) {
  const std::size_t count = loop.size();
  const auto direction = [&](std::size_t edge) -> Eigen::Vector2d {
    const Eigen::Vector2d d = loop[(edge + 1) % count].position - loop[edge].position;
    return d.norm() > 0 ? Eigen::Vector2d(d.normalized()) : d;
  };
  Turn turn;
  turn.c = loop[i].position;
  turn.d1 = direction((i + count - 1) % count);
  turn.d2 = direction(i);
  turn.n1 = {turn.d1.y(), -turn.d1.x()};
  turn.n2 = {turn.d2.y(), -turn.d2.x()};
  turn.a1 = before;
  turn.a2 = after;
  turn.angle = std::atan2(cross(turn.d1, turn.d2), turn.d1.dot(turn.d2));
  return turn;
}

/// The same corner walked the other way.
Turn reversed(const Turn& turn) {
  Turn other = turn;
  // Mirrored, so that the piece is on the left again: directions turn round, normals stay.
  std::swap(other.d1, other.d2);
  std::swap(other.n1, other.n2);
  std::swap(other.a1, other.a2);
  other.d1 = -other.d1;
  other.d2 = -other.d2;
  return other;
}

/// What fills a convex corner: both parallels prolonged until they meet, `limit` allowances out at
/// most.
Points2 mitre(const Turn& turn, double limit = kMitreLimit) {
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
  const double reach = limit * std::max(turn.a1, turn.a2);
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

/// The side that ends here is cut off square, where the neighbour's parallel meets the prolonged
/// sew line.
Points2 squareCorner(const Turn& turn) {
  const double sine = std::sin(turn.angle);
  const double most = kMitreLimit * std::max(turn.a1, turn.a2);
  const double x = sine > 1e-6 ? std::min(turn.a2 / sine, most) : most;
  const Eigen::Vector2d end1 = turn.c + turn.a1 * turn.n1;
  return {turn.c, end1, end1 + x * turn.d1, turn.c + x * turn.d1, turn.c + turn.a2 * turn.n2};
}

/// Where the neighbour's parallel crosses the sew line of the hem that ends here, and how it goes
/// on, mirrored in that line, to the hem's parallel.
struct MirroredEnd {
  Eigen::Vector2d onSewLine, onCutLine;
};
std::optional<MirroredEnd> mirroredEnd(const Turn& turn) {
  const double sine = std::sin(turn.angle);
  constexpr double kLeastSine = 0.2;  // flatter, the mirrored line would run far along the hem
  if (sine < kLeastSine) return std::nullopt;
  const Eigen::Vector2d on = turn.c + turn.a2 / sine * turn.d1;
  const double back = turn.a1 * std::cos(turn.angle) / sine;
  return MirroredEnd{on, on + back * turn.d1 + turn.a1 * turn.n1};
}

/// The part of a convex polygon where (p - c).d <= reach.
Points2 clipped(const Points2& polygon, const Eigen::Vector2d& c, const Eigen::Vector2d& d,
                double reach) {
  if (!std::isfinite(reach)) return polygon;
  Points2 out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double ha = (a - c).dot(d) - reach;
    const double hb = (b - c).dot(d) - reach;
    if (ha <= 0) out.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) out.emplace_back(a + ha / (ha - hb) * (b - a));
  }
  return out;
}

/// What a corner adds to the strips beside it, and what it takes from them.
struct CornerShape {
  Points2 added, removed;
};
CornerShape cornerShape(const Turn& turn, const Corner& corner) {
  CornerShape shape;
  const bool isSided = corner.style == CornerStyle::Square || corner.style == CornerStyle::Mirrored;
  const Turn sided = isSided && corner.byNext ? reversed(turn) : turn;
  switch (corner.style) {
    case CornerStyle::Mitre:
      shape.added = mitre(turn);
      break;
    case CornerStyle::Truncated:
      shape.added = mitre(turn, 1);
      break;
    case CornerStyle::Square:
      shape.added = squareCorner(sided);
      break;
    case CornerStyle::Mirrored: {
      const std::optional<MirroredEnd> end = mirroredEnd(sided);
      if (!end) {
        shape.added = mitre(turn);
        break;
      }
      const Eigen::Vector2d own = sided.c + sided.a1 * sided.n1;
      const Eigen::Vector2d other = sided.c + sided.a2 * sided.n2;
      const double beyond = (end->onCutLine - sided.c).dot(sided.d1);
      if (beyond >= 0) {
        shape.added = {sided.c, own, end->onCutLine, end->onSewLine, other};
      } else {
        // The mirrored line cuts into the hem's own strip.
        const double out = (end->onSewLine - sided.c).dot(sided.d1);
        const Eigen::Vector2d crossing =
            end->onSewLine + out / (out - beyond) * (end->onCutLine - end->onSewLine);
        shape.added = {sided.c, crossing, end->onSewLine, other};
        shape.removed = {crossing, end->onCutLine, end->onCutLine + sided.n1, own + sided.n1, own};
      }
      break;
    }
  }
  shape.added = clipped(shape.added, turn.c, turn.d1, corner.reachBefore);
  shape.added = clipped(shape.added, turn.c, -turn.d2, corner.reachNext);
  return shape;
}

/// Allowance of each edge of each loop; none along folded darts.
std::vector<std::vector<double>> edgeAllowances(const SewOutline& sew) {
  std::vector<std::vector<double>> widths;
  for (const Outline& loop : sew.loops) widths.emplace_back(loop.size(), 0.0);
  for (const OutlineRun& run : sew.runs)
    if (!run.folded)
      for (std::size_t i = 0; i < run.edgeCount; ++i)
        widths[run.loop][run.first + i] = run.allowance;
  return widths;
}

void addPolygon(const Points2& points, Paths& paths) {
  if (points.size() < 3) return;
  Path path = toPath(points);
  if (ClipperLib::Area(path) < 0) ClipperLib::ReversePath(path);
  paths.push_back(std::move(path));
}

/// @param cornerAt per point of the loop: its corner where a run begins there, else null
void addStrips(const Outline& loop, const std::vector<double>& widths,
               const std::vector<const Corner*>& cornerAt, Paths& strips, Paths& removed) {
  const std::size_t count = loop.size();
  const auto add = [&](const Points2& points) { addPolygon(points, strips); };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const Turn turn = turnAt(loop, i, widths[before], widths[i]);
    if (turn.a2 > 0) {
      const Eigen::Vector2d& next = loop[(i + 1) % count].position;
      add({turn.c, turn.c + turn.a2 * turn.n2, next + turn.a2 * turn.n2, next});
    }
    if (turn.angle <= 0 || std::max(turn.a1, turn.a2) <= 0) continue;
    if (!loop[i].corner && turn.a1 == turn.a2) {
      add(sector(turn));
    } else {
      const CornerShape shape = cornerShape(turn, cornerAt[i] != nullptr ? *cornerAt[i] : Corner());
      add(shape.added);
      addPolygon(shape.removed, removed);
    }
  }
}

/// A folded dart: what was cut out of the piece between its legs, and the cap beyond its mouth,
/// which lies flush with the cut line before the mouth when the dart is folded.
void addFoldedDart(const SewOutline& sew, const FoldedDart& dart,
                   const std::vector<std::vector<double>>& widths, Paths& strips) {
  const Outline& loop = sew.loops[dart.loop];
  const std::size_t count = loop.size();
  const std::size_t first = sew.runs[dart.firstRun].first;
  std::size_t edges = 0;
  for (std::size_t r = 0; r < dart.runCount; ++r) edges += sew.runs[dart.firstRun + r].edgeCount;
  Points2 gap;
  for (std::size_t k = 0; k <= edges; ++k) gap.push_back(loop[(first + k) % count].position);
  if (dart.isInner) {
    gap.pop_back();
    addPolygon(gap, strips);
    return;
  }
  const std::size_t last = (first + edges) % count;
  const Eigen::Vector2d& tip = loop[dart.tips.front()].position;
  const double before = widths[dart.loop][(first + count - 1) % count];
  const double after = widths[dart.loop][last];
  const Turn in = turnAt(loop, first, before, 0);
  const Turn out = turnAt(loop, last, 0, after);
  // The legs prolonged to the parallels of the mouth's edges.
  const auto prolonged = [](const Eigen::Vector2d& mouth, const Eigen::Vector2d& leg,
                            const Eigen::Vector2d& normal, double width) -> Eigen::Vector2d {
    const double rise = std::max(leg.dot(normal), 0.35);
    return mouth + width / rise * leg;
  };
  const Eigen::Vector2d leg1 = (gap.front() - tip).normalized();
  const Eigen::Vector2d leg2 = (gap.back() - tip).normalized();
  const Eigen::Vector2d a = prolonged(gap.front(), leg1, in.n1, before);
  const Eigen::Vector2d b = prolonged(gap.back(), leg2, out.n2, after);
  // Folded, the cloth behind the first leg lies under the piece before the mouth: that piece's cut
  // line mirrored in the leg, up to the fold in the middle.
  const Eigen::Vector2d along = -in.d1;
  const Eigen::Vector2d mirrored = 2 * along.dot(leg1) * leg1 - along;
  const Eigen::Vector2d fold = (leg1 + leg2).normalized();
  const double determinant = cross(mirrored, fold);
  const auto cap = [&]() -> Eigen::Vector2d {
    const double reach = std::max((a - tip).norm(), (b - tip).norm());
    const Eigen::Vector2d usual = tip + reach * fold;
    if (std::abs(determinant) < 1e-6) return usual;
    const double along1 = cross(tip - a, fold) / determinant;
    const Eigen::Vector2d p = a + along1 * mirrored;
    const bool isNear = along1 > 0 && (p - usual).norm() < reach && (p - tip).dot(fold) > 0;
    return isNear ? p : usual;
  }();
  gap.push_back(b);
  gap.push_back(cap);
  gap.push_back(a);
  addPolygon(gap, strips);
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
  for (const FoldedDart& dart : foldedDarts(sew)) {
    const Outline& loop = sew.loops[dart.loop];
    std::size_t edges = 0;
    for (std::size_t r = 0; r < dart.runCount; ++r) edges += sew.runs[dart.firstRun + r].edgeCount;
    const std::size_t first = sew.runs[dart.firstRun].first;
    const Eigen::Vector2d& from = loop[first].position;
    const Eigen::Vector2d& to = loop[(first + edges) % loop.size()].position;
    const double width = std::max(widths[dart.loop][(first + loop.size() - 1) % loop.size()],
                                  widths[dart.loop][(first + edges) % loop.size()]);
    zones.push_back({0.5 * (from + to), 1.5 * (to - from).norm() + 2 * kMitreLimit * width});
  }
  return zones;
}

}  // namespace

std::vector<FoldedDart> foldedDarts(const SewOutline& sew) {
  std::vector<FoldedDart> darts;
  for (std::size_t r = 0; r < sew.runs.size();) {
    std::size_t end = r + 1;
    const OutlineRun& run = sew.runs[r];
    const auto isSame = [&](std::size_t k) {
      return k < sew.runs.size() && sew.runs[k].loop == run.loop && sew.runs[k].folded &&
             sew.runs[k].curve == run.curve;
    };
    if (!run.folded) {
      ++r;
      continue;
    }
    while (isSame(end)) ++end;
    FoldedDart dart{r, end - r, run.loop, false, {}};
    const Outline& loop = sew.loops[run.loop];
    std::size_t edges = 0;
    for (std::size_t k = r; k < end; ++k) edges += sew.runs[k].edgeCount;
    dart.isInner = edges == loop.size();
    // The legs are equally long: a tip lies where half of the way is walked.
    double half = 0;
    for (std::size_t k = r; k < end; ++k) half += 0.5 * sew.runs[k].length;
    double walked = 0;
    std::size_t tip = r + 1;
    for (std::size_t k = r; k < end; ++k) {
      if (std::abs(walked + sew.runs[k].length - half) < std::abs(walked - half)) tip = k + 1;
      walked += sew.runs[k].length;
    }
    if (tip < end) dart.tips.push_back(sew.runs[tip].first);
    if (dart.isInner) dart.tips.push_back(run.first);
    if (!dart.tips.empty()) darts.push_back(std::move(dart));
    r = end;
  }
  return darts;
}

CornerReach cornerReach(const SewOutline& sew, std::size_t index, const Corner& corner) {
  const OutlineRun& next = sew.runs[index];
  std::size_t before = index;
  for (std::size_t r = 0; r < sew.runs.size(); ++r) {
    const OutlineRun& run = sew.runs[r];
    if (run.loop == next.loop &&
        (run.first + run.edgeCount) % sew.loops[run.loop].size() == next.first)
      before = r;
  }
  const OutlineRun& last = sew.runs[before];
  const Turn turn = turnAt(sew.loops[next.loop], next.first, last.folded ? 0 : last.allowance,
                           next.folded ? 0 : next.allowance);
  if (turn.angle <= 0 || std::min(turn.a1, turn.a2) <= 0) return {};
  const CornerShape shape = cornerShape(turn, corner);
  CornerReach reach;
  for (const Eigen::Vector2d& p : shape.added) {
    // On the parallel of either run: the allowance ends there.
    constexpr double kOnLineMm = 1e-6;
    const Eigen::Vector2d d = p - turn.c;
    if (std::abs(d.dot(turn.n1) - turn.a1) < kOnLineMm)
      reach.before = std::max(reach.before, d.dot(turn.d1));
    if (std::abs(d.dot(turn.n2) - turn.a2) < kOnLineMm)
      reach.next = std::max(reach.next, -d.dot(turn.d2));
  }
  return reach;
}

std::vector<Outline> makeCutLines(const SewOutline& sew, const std::vector<Corner>& corners) {
  if (std::all_of(sew.runs.begin(), sew.runs.end(),
                  [](const OutlineRun& run) { return run.allowance <= 0; }))
    return sew.loops;
  const std::vector<std::vector<double>> widths = edgeAllowances(sew);
  Paths parts;
  Paths removed;
  std::vector<std::vector<const Corner*>> cornerAt;
  for (const Outline& loop : sew.loops) cornerAt.emplace_back(loop.size(), nullptr);
  for (std::size_t r = 0; r < corners.size(); ++r)
    cornerAt[sew.runs[r].loop][sew.runs[r].first] = &corners[r];
  for (std::size_t l = 0; l < sew.loops.size(); ++l) {
    parts.push_back(toPath(positions(sew.loops[l])));
    addStrips(sew.loops[l], widths[l], cornerAt[l], parts, removed);
  }
  for (const FoldedDart& dart : foldedDarts(sew)) addFoldedDart(sew, dart, widths, parts);
  ClipperLib::Clipper clipper;
  clipper.AddPaths(parts, ClipperLib::ptSubject, true);
  Paths united;
  clipper.Execute(ClipperLib::ctUnion, united, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  if (!removed.empty()) {
    ClipperLib::Clipper difference;
    difference.AddPaths(united, ClipperLib::ptSubject, true);
    difference.AddPaths(removed, ClipperLib::ptClip, true);
    difference.Execute(ClipperLib::ctDifference, united, ClipperLib::pftNonZero,
                       ClipperLib::pftNonZero);
  }

  std::vector<Points2> loops;
  for (Path& path : united) {
    ClipperLib::CleanPolygon(path, kSlitMm * kStepsPerMm);
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

  const std::vector<FoldedDart> darts = foldedDarts(sew);
  const auto inner = static_cast<std::size_t>(std::count_if(
      darts.begin(), darts.end(), [](const FoldedDart& dart) { return dart.isInner; }));
  if (cutLines.size() + inner < sew.loops.size())
    findings.push_back({"allowance-closes-hole",
                        fmt::format("piece \"{}\": the seam allowance fills a hole; give its curve "
                                    "a smaller allowance or cut it by hand along the sew line",
                                    piece.name),
                        {Element::piece(piece.id)}});
  if (cutLines.size() + inner > sew.loops.size())
    findings.push_back({"allowance-closes-gap",
                        fmt::format("piece \"{}\": seam allowances on both sides of a gap meet and "
                                    "leave a hole; give those curves smaller allowances",
                                    piece.name),
                        {Element::piece(piece.id)}});
  return findings;
}

}  // namespace toile
