// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/body_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kFewDots = 160;  // along the longer side, to choose
constexpr int kDots = 420;     // to draw
constexpr double kToleranceDots = 0.4;
// Of the light that falls on a surface facing it; darker ones are shaded.
constexpr double kShade = 0.5, kDeepShade = 0.15;

/// A side, and how much what it shows counts.
struct Side {
  const char* name;
  double azimuth, elevation;  ///< degrees, as in RenderView
  double worth;
};
constexpr std::array<Side, 14> kSides = {{{"the front", 0, 4, 1},
                                          {"behind", 180, 4, 1},
                                          {"the left", 90, 4, 0.85},
                                          {"the right", -90, 4, 0.85},
                                          {"the front left", 45, 4, 0.85},
                                          {"the front right", -45, 4, 0.85},
                                          {"behind on the left", 135, 4, 0.85},
                                          {"behind on the right", -135, 4, 0.85},
                                          {"above the front", 0, 50, 0.7},
                                          {"above the back", 180, 50, 0.7},
                                          {"above on the left", 90, 50, 0.7},
                                          {"above on the right", -90, 50, 0.7},
                                          {"below the front", 0, -50, 0.6},
                                          {"below the back", 180, -50, 0.6}}};

/// What the dots of a picture show.
struct Dots {
  int columns = 0, rows = 0;
  double perMm = 1;
  std::vector<std::uint16_t> label;  ///< kNothing, kBody, or kFirstPiece + pattern piece
  std::vector<float> light;          ///< towards the lamp, -1..1

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};
constexpr std::uint16_t kNothing = 0, kBody = 1, kFirstPiece = 2;

/// The pieces, left out ones too, as one heap of triangles.
struct Heap {
  std::vector<Vector3d> points, normals;
  struct Corner3 {
    std::array<std::uint32_t, 3> corners;
    std::uint16_t label;
  };
  std::vector<Corner3> faces;

  explicit Heap(const Pattern& pattern) {
    std::vector<std::uint16_t> label(pattern.cut.pieces.size(), kBody);
    for (std::size_t i = 0; i < pattern.pieceIndex.size(); ++i)
      label[pattern.pieceIndex[i]] = static_cast<std::uint16_t>(kFirstPiece + i);
    for (std::size_t p = 0; p < pattern.cut.pieces.size(); ++p) {
      const Mesh& mesh = *pattern.cut.pieces[p].mesh;
      const auto first = static_cast<std::uint32_t>(points.size());
      points.insert(points.end(), mesh.positions().begin(), mesh.positions().end());
      normals.resize(points.size(), Vector3d::Zero());
      for (const Triangle& t : mesh.triangles()) {
        const std::array<std::uint32_t, 3> c = {first + t[0].index(), first + t[1].index(),
                                                first + t[2].index()};
        const Vector3d weighted = (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]);
        for (const std::uint32_t v : c) normals[v] += weighted;
        faces.push_back({c, label[p]});
      }
    }
    for (Vector3d& n : normals) n.normalize();
  }
};

Dots draw(const Heap& heap, const Side& side, int most) {
  const double turn = side.azimuth * std::numbers::pi / 180;
  const double above = side.elevation * std::numbers::pi / 180;
  const Vector3d out(std::cos(above) * std::sin(turn), -std::cos(above) * std::cos(turn),
                     std::sin(above));
  const Vector3d right(std::cos(turn), std::sin(turn), 0);
  const Vector3d up = out.cross(right);
  const Vector3d lamp = (-0.5 * right + 0.6 * up + 0.65 * out).normalized();
  struct Seen {
    double x, y, depth;
    float light;
  };
  std::vector<Seen> seen(heap.points.size());
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vector3d& p = heap.points[i];
    seen[i] = {p.dot(right), p.dot(up), p.dot(out), static_cast<float>(heap.normals[i].dot(lamp))};
    low = low.cwiseMin(Vector2d(seen[i].x, seen[i].y));
    high = high.cwiseMax(Vector2d(seen[i].x, seen[i].y));
  }
  const double perMm = most / std::max((high - low).maxCoeff(), 1e-9);
  constexpr int kRim = 2;  // so that every outline closes
  for (Seen& s : seen) {
    s.x = (s.x - low.x()) * perMm + kRim;
    s.y = (s.y - low.y()) * perMm + kRim;
  }
  Dots dots;
  dots.perMm = perMm;
  dots.columns = static_cast<int>((high.x() - low.x()) * perMm) + 1 + 2 * kRim;
  dots.rows = static_cast<int>((high.y() - low.y()) * perMm) + 1 + 2 * kRim;
  const std::size_t count = dots.index(0, dots.rows);
  dots.label.assign(count, kNothing);
  dots.light.assign(count, 0);
  std::vector<double> depth(count, -std::numeric_limits<double>::infinity());
  for (const Heap::Corner3& face : heap.faces) {
    const Seen& a = seen[face.corners[0]];
    const Seen& b = seen[face.corners[1]];
    const Seen& c = seen[face.corners[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 1e-12)) continue;
    const int left = static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - 0.5));
    const int last = static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - 0.5));
    const int bottom = static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - 0.5));
    const int top = static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - 0.5));
    for (int row = bottom; row <= top; ++row) {
      for (int column = left; column <= last; ++column) {
        const double x = column + 0.5;
        const double y = row + 0.5;
        const double u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
        const double v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const double w = 1 - u - v;
        const std::size_t dot = dots.index(column, row);
        const double at = w * a.depth + u * b.depth + v * c.depth;
        if (at <= depth[dot]) continue;
        depth[dot] = at;
        dots.label[dot] = face.label;
        const double light = w * a.light + u * b.light + v * c.light;
        dots.light[dot] = static_cast<float>(light);
      }
    }
  }
  return dots;
}

/// Dots in columns and rows from the first to before the end.
struct DotBox {
  int left, bottom, right, top;
};

/// The outlines of the dots of a kind, which lie in a box, their steps cut across and what is
/// nearly straight made so.
template <class IsIn>
std::vector<Points2> outlinesOf(const Dots& dots, const DotBox& box, const IsIn& isIn) {
  // Steps along the edges of dots, the inside on their left; two may begin at one corner.
  struct Step {
    int x, y, dx, dy;
    bool isTaken = false;
  };
  std::vector<Step> steps;
  std::unordered_multimap<std::int64_t, std::size_t> from;
  const auto key = [&](int x, int y) {
    return static_cast<std::int64_t>(y) * (dots.columns + 1) + x;
  };
  const auto add = [&](int x, int y, int dx, int dy) {
    from.emplace(key(x, y), steps.size());
    steps.push_back({x, y, dx, dy});
  };
  const auto inside = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < dots.columns && row < dots.rows &&
           isIn(dots.index(column, row));
  };
  for (int row = box.bottom; row < box.top; ++row) {
    for (int column = box.left; column < box.right; ++column) {
      if (!isIn(dots.index(column, row))) continue;
      if (!inside(column, row - 1)) add(column, row, 1, 0);
      if (!inside(column + 1, row)) add(column + 1, row, 0, 1);
      if (!inside(column, row + 1)) add(column + 1, row + 1, -1, 0);
      if (!inside(column - 1, row)) add(column, row + 1, 0, -1);
    }
  }
  std::vector<Points2> loops;
  for (std::size_t first = 0; first < steps.size(); ++first) {
    if (steps[first].isTaken) continue;
    Points2 loop;
    for (std::size_t at = first; !steps[at].isTaken;) {
      Step& step = steps[at];
      step.isTaken = true;
      // Middles of the steps: half dots, whole numbers.
      loop.emplace_back(2 * step.x + step.dx, 2 * step.y + step.dy);
      const auto [begin, end] = from.equal_range(key(step.x + step.dx, step.y + step.dy));
      for (auto next = begin; next != end; ++next) {
        const Step& way = steps[next->second];
        if (way.isTaken) continue;
        at = next->second;
        // Where dots touch in a corner, round the same dot.
        if (step.dx * way.dy - step.dy * way.dx > 0) break;
      }
    }
    if (loop.size() < 8) continue;  // a dot or two
    const std::vector<char> keep(loop.size(), 0);
    Points2 simple;
    for (const std::size_t i : simplifiedIndices(loop, keep, 2 * kToleranceDots))
      simple.push_back(loop[i]);
    if (simple.size() >= 3) loops.push_back(std::move(simple));
  }
  return loops;
}

BodyView trace(const Dots& dots, const char* name, std::size_t pieces) {
  BodyView view;
  view.from = name;
  view.size = 2 * Vector2d(dots.columns, dots.rows);
  view.mmPerUnit = 0.5 / dots.perMm;
  const DotBox whole{0, 0, dots.columns, dots.rows};
  view.body = outlinesOf(dots, whole, [&](std::size_t dot) { return dots.label[dot] != kNothing; });
  for (const auto& [loops, limit] :
       {std::pair(&view.shade, kShade), std::pair(&view.deepShade, kDeepShade)}) {
    *loops = outlinesOf(dots, whole, [&, limit = limit](std::size_t dot) {
      return dots.label[dot] != kNothing && dots.light[dot] < limit;
    });
  }
  std::vector<DotBox> boxes(pieces, {dots.columns, dots.rows, 0, 0});
  for (int row = 0; row < dots.rows; ++row) {
    for (int column = 0; column < dots.columns; ++column) {
      const std::uint16_t label = dots.label[dots.index(column, row)];
      if (label < kFirstPiece) continue;
      DotBox& box = boxes[label - kFirstPiece];
      box = {std::min(box.left, column), std::min(box.bottom, row), std::max(box.right, column + 1),
             std::max(box.top, row + 1)};
    }
  }
  for (std::size_t i = 0; i < pieces; ++i) {
    view.pieces.push_back(outlinesOf(
        dots, boxes[i], [&](std::size_t dot) { return dots.label[dot] == kFirstPiece + i; }));
  }
  return view;
}

}  // namespace

BodyViews bodyViews(const Pattern& pattern) {
  const Heap heap(pattern);
  const std::size_t pieces = pattern.pieceIndex.size();
  std::vector<std::vector<double>> worth(kSides.size());
  parallelFor(kSides.size(), [&](std::size_t s) {
    const Dots dots = draw(heap, kSides[s], kFewDots);
    worth[s].assign(pieces, 0);
    for (const std::uint16_t label : dots.label)
      if (label >= kFirstPiece)
        worth[s][label - kFirstPiece] += kSides[s].worth / (dots.perMm * dots.perMm);
  });
  BodyViews all;
  std::vector<std::size_t> sideOf(pieces, 0);
  std::vector<char> isUsed(kSides.size(), 0);
  for (std::size_t i = 0; i < pieces; ++i) {
    for (std::size_t s = 1; s < kSides.size(); ++s)
      if (worth[s][i] > worth[sideOf[i]][i]) sideOf[i] = s;
    isUsed[sideOf[i]] = 1;
  }
  std::vector<std::size_t> sides;
  std::vector<std::size_t> viewOfSide(kSides.size(), 0);
  for (std::size_t s = 0; s < kSides.size(); ++s) {
    if (isUsed[s] == 0) continue;
    viewOfSide[s] = sides.size();
    sides.push_back(s);
  }
  all.views.resize(sides.size());
  parallelFor(sides.size(), [&](std::size_t v) {
    const Side& side = kSides[sides[v]];
    all.views[v] = trace(draw(heap, side, kDots), side.name, pieces);
  });
  for (const std::size_t side : sideOf) all.viewOf.push_back(viewOfSide[side]);
  return all;
}

}  // namespace toile
