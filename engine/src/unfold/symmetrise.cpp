// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/unfold/symmetrise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "toile/mesh/surface_index.h"
#include "unfold/problem.h"
#include "unfold/symmetry.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using unfolding::Problem;

/// Ends of lines this near to each other, as a share of half the outline, are mirror images.
constexpr double kSameEnd = 0.03;
/// Points of the outline that are compared with it.
constexpr std::size_t kSamples = 160;
constexpr std::size_t kInsideSamples = 64;
constexpr int kPlaneRounds = 8;
/// Symmetric to rounding, as a share of the size or of a length.
constexpr double kExact = 1e-11;
/// How far the surface inside may be from its mirror image then, as a share of the size: it may be
/// meshed in another way.
constexpr double kInside = 0.005;
/// A later plane must be this much better than one found before it.
constexpr double kBetter = 0.9;

struct Mirror {
  Vector3d normal = Vector3d::UnitX();
  double offset = 0;
  double distance = 0;  ///< greatest, of the outline from its mirror image
  [[nodiscard]] double side(const Vector3d& p) const { return normal.dot(p) - offset; }
};

Vector3d nearestOnOutline(const std::vector<Vector3d>& outline, const Vector3d& p) {
  Vector3d nearest = outline.front();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3d& a = outline[i];
    const Vector3d along = outline[(i + 1) % outline.size()] - a;
    const double t = std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (a + t * along - p).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    nearest = a + t * along;
  }
  return nearest;
}

/// Improves a plane by turns: nearest points of the mirror image, then the plane between them.
Mirror refined(const std::vector<Vector3d>& outline, Mirror mirror) {
  const std::size_t step = 1 + outline.size() / kSamples;
  Mirror best = mirror;
  best.distance = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kPlaneRounds; ++round) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Vector3d middle = Vector3d::Zero();
    double count = 0;
    mirror.distance = 0;
    for (std::size_t i = 0; i < outline.size(); i += step) {
      const Vector3d& p = outline[i];
      const Vector3d image = p - 2 * mirror.side(p) * mirror.normal;
      const Vector3d q = nearestOnOutline(outline, image);
      mirror.distance = std::max(mirror.distance, (image - q).norm());
      spread += (p - q) * (p - q).transpose();
      middle += 0.5 * (p + q);
      count += 1;
    }
    const bool improves = mirror.distance < kBetter * best.distance;
    if (mirror.distance < best.distance) best = mirror;
    if (!improves) break;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    mirror.normal = solver.eigenvectors().col(2);
    mirror.offset = mirror.normal.dot(middle / count);
  }
  return best;
}

/// The mirror with the greatest distance of the outline from its image in it.
Mirror measured(const std::vector<Vector3d>& outline, Mirror mirror) {
  const std::size_t step = 1 + outline.size() / kSamples;
  for (std::size_t i = 0; i < outline.size(); i += step) {
    const Vector3d image = outline[i] - 2 * mirror.side(outline[i]) * mirror.normal;
    mirror.distance = std::max(mirror.distance, (image - nearestOnOutline(outline, image)).norm());
  }
  return mirror;
}

/// Planes in which an outline may be symmetric: through its centre, across an axis of space or of
/// its own inertia.
std::vector<Mirror> candidates(const std::vector<Vector3d>& outline) {
  Vector3d centre = Vector3d::Zero();
  double length = 0;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3d& a = outline[i];
      const Vector3d& b = outline[(i + 1) % outline.size()];
      const Vector3d middle = 0.5 * (a + b);
      if (pass == 0) {
        centre += (b - a).norm() * middle;
        length += (b - a).norm();
      } else {
        spread += (b - a).norm() * (middle - centre) * (middle - centre).transpose();
      }
    }
    if (pass == 0) centre /= length;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  std::vector<Mirror> mirrors;
  for (int axis = 0; axis < 3; ++axis) {
    mirrors.push_back({Vector3d::Unit(axis), centre[axis], 0});
  }
  for (int axis = 2; axis >= 0; --axis) {
    const Vector3d normal = solver.eigenvectors().col(axis);
    mirrors.push_back({normal, normal.dot(centre), 0});
  }
  return mirrors;
}

Mirror findMirror(const std::vector<Vector3d>& outline) {
  std::optional<Mirror> best;
  for (const Mirror& candidate : candidates(outline)) {
    const Mirror mirror = refined(outline, candidate);
    if (!best || mirror.distance < kBetter * best->distance) best = mirror;
  }
  return *best;
}

/// The first candidate in which the outline is its own mirror image to rounding.
std::optional<Mirror> findExactMirror(const std::vector<Vector3d>& outline, double tolerance) {
  const std::size_t step = 1 + outline.size() / kSamples;
  for (const Mirror& mirror : candidates(outline)) {
    bool isExact = true;
    for (std::size_t i = 0; isExact && i < outline.size(); i += step) {
      const Vector3d image = outline[i] - 2 * mirror.side(outline[i]) * mirror.normal;
      isExact = (image - nearestOnOutline(outline, image)).norm() <= tolerance;
    }
    if (isExact) return mirror;
  }
  return std::nullopt;
}

/// A point of the outline, old or to be made.
struct OutlinePoint {
  std::size_t edge = 0;  ///< of the loop; begins at vertex `edge` of it
  double t = 0;          ///< share of that edge; 0 is the vertex itself
  double at = 0;         ///< share of the way along its half
};

class Symmetriser {
 public:
  Symmetriser(const Piece& piece, const Problem& problem)
      : piece_(piece), problem_(problem), loop_(problem.loops[problem.outerLoop]) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> targets;
    for (const auto& edge : problem.wireEdges) {
      targets[std::minmax(edge.a, edge.b)] = edge.target;
    }
    std::vector<char> endsHere(piece.mesh->vertexCount(), 0);
    for (const Wire& wire : piece.wires) {
      if (wire.vertices.empty() || wire.vertices.front() == wire.vertices.back()) continue;
      endsHere[wire.vertices.front().index()] = endsHere[wire.vertices.back().index()] = 1;
    }
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      isWireEnd_.push_back(endsHere[loop_[i]]);
      target_.push_back(targets.at(std::minmax(loop_[i], loop_[(i + 1) % loop_.size()])));
      outline_.push_back(piece.mesh->position(VertexId(loop_[i])));
    }
  }

  std::optional<SymmetricPiece> run(double tolerance) {
    const Mirror mirror = findMirror(outline_);
    if (!(mirror.distance <= tolerance) || !insideIsSymmetric(mirror, tolerance)) {
      return std::nullopt;
    }
    std::vector<OutlinePoint> forward, backward;
    if (!matchHalves(mirror, forward, backward)) return std::nullopt;
    result_.asymmetry = mirror.distance;
    result_.piece = piece_;
    makePoints(forward, backward);
    if (!splitFaces() || !rewriteWires(forward, backward)) return std::nullopt;
    return std::move(result_);
  }

  std::optional<unfolding::MirrorPlane> findPlane(double tolerance) const {
    const Mirror mirror = findMirror(outline_);
    if (!(mirror.distance <= tolerance) || !insideIsSymmetric(mirror, tolerance)) {
      return std::nullopt;
    }
    return unfolding::MirrorPlane{mirror.normal, mirror.offset};
  }

  std::optional<unfolding::OutlineSymmetry> compare(const unfolding::MirrorPlane& plane,
                                                    double tolerance, double sameVertex) {
    sameVertex_ = sameVertex;
    const Mirror mirror = measured(outline_, {plane.normal, plane.offset, 0});
    if (!(mirror.distance <= tolerance) || !insideIsSymmetric(mirror, tolerance)) {
      return std::nullopt;
    }
    std::vector<OutlinePoint> forward, backward;
    if (!matchHalves(mirror, forward, backward)) return std::nullopt;
    makePoints(forward, backward);
    unfolding::OutlineSymmetry found{mirror.distance, {}, {}};
    for (std::size_t e = 0; e < splits_.size(); ++e) {
      for (const auto& [t, vertex] : splits_[e]) {
        found.missing.push_back({VertexId(loop_[e]), VertexId(loop_[after(e)]), t});
      }
    }
    if (found.missing.empty()) found.symmetry = std::move(result_.symmetry);
    return found;
  }

  std::optional<PieceSymmetry> runExactly() {
    const double size = std::sqrt(problem_.area);
    const std::optional<Mirror> mirror = findExactMirror(outline_, kExact * size);
    if (!mirror) return std::nullopt;
    std::vector<OutlinePoint> forward, backward;
    if (!matchHalves(*mirror, forward, backward)) return std::nullopt;
    makePoints(forward, backward);
    if (result_.addedVertices > 0) return std::nullopt;
    (void)rewriteWires(forward, backward);
    if (result_.maxLengthChange > kExact || !insideIsSymmetric(*mirror, kInside * size)) {
      return std::nullopt;
    }
    return std::move(result_.symmetry);
  }

 private:
  [[nodiscard]] std::size_t after(std::size_t i) const { return (i + 1) % loop_.size(); }
  /// The same point as its vertex where it is near to one.
  [[nodiscard]] OutlinePoint snapped(std::size_t edge, double t) const {
    if (t < sameVertex_) return {edge, 0, 0};
    if (t > 1 - sameVertex_) return {after(edge), 0, 0};
    return {edge, t, 0};
  }

  /// From one point on the axis to the other, forward and backward, with the same points.
  [[nodiscard]] bool matchHalves(const Mirror& mirror, std::vector<OutlinePoint>& forward,
                                 std::vector<OutlinePoint>& backward) const {
    const std::vector<OutlinePoint> ends = axisPoints(mirror);
    if (ends.size() != 2) return false;
    forward = half(ends[0], ends[1]);
    backward = half(ends[1], ends[0]);
    std::reverse(backward.begin(), backward.end());
    for (OutlinePoint& p : backward) p.at = 1 - p.at;
    alignWireEnds(forward, backward);
    return mergePoints(forward, backward);
  }

  /// Where a line ends on both sides at nearly the same place, it ends at the same place: shares
  /// between such ends are counted from end to end. So they do not depend on what lies beyond, and
  /// the two pieces along a seam agree on them.
  void alignWireEnds(const std::vector<OutlinePoint>& forward,
                     std::vector<OutlinePoint>& backward) const {
    const auto isEnd = [&](const OutlinePoint& p) { return p.t == 0 && isWireEnd_[p.edge] != 0; };
    std::vector<std::pair<double, double>> anchors{{0, 0}};  // at of both halves
    std::size_t next = 1;
    for (std::size_t i = 1; i + 1 < forward.size(); ++i) {
      if (!isEnd(forward[i])) continue;
      std::size_t nearest = 0;
      double least = kSameEnd;
      for (std::size_t j = next; j + 1 < backward.size(); ++j) {
        const double apart = std::abs(forward[i].at - backward[j].at);
        if (!isEnd(backward[j]) || apart >= least) continue;
        least = apart;
        nearest = j;
      }
      if (nearest == 0) continue;
      anchors.emplace_back(forward[i].at, backward[nearest].at);
      next = nearest + 1;
    }
    anchors.emplace_back(1, 1);
    std::size_t run = 0;
    for (OutlinePoint& p : backward) {
      while (run + 2 < anchors.size() && p.at >= anchors[run + 1].second) ++run;
      const auto& [a, b] = anchors[run];
      const auto& [c, d] = anchors[run + 1];
      p.at = p.at == b ? a : a + (p.at - b) * (c - a) / (d - b);
    }
  }

  /// Whether inner wires and the surface are their own mirror images too.
  [[nodiscard]] bool insideIsSymmetric(const Mirror& mirror, double tolerance) const {
    const Mesh& mesh = *piece_.mesh;
    const auto imageOf = [&](std::uint32_t v) -> Vector3d {
      const Vector3d& p = mesh.position(VertexId(v));
      return p - 2 * mirror.side(p) * mirror.normal;
    };
    std::vector<char> isOuter(mesh.vertexCount(), 0);
    for (const std::uint32_t v : loop_) isOuter[v] = 1;
    std::vector<std::pair<Vector3d, Vector3d>> segments;
    std::vector<std::uint32_t> ends;
    for (const auto& edge : problem_.wireEdges) {
      if (!edge.inner && isOuter[edge.a] != 0) continue;
      segments.emplace_back(mesh.position(VertexId(edge.a)), mesh.position(VertexId(edge.b)));
      ends.push_back(edge.a);
      ends.push_back(edge.b);
    }
    for (const std::uint32_t v : ends) {
      const Vector3d image = imageOf(v);
      const bool isNear = std::any_of(segments.begin(), segments.end(), [&](const auto& segment) {
        const Vector3d along = segment.second - segment.first;
        const double t =
            std::clamp(along.dot(image - segment.first) / along.squaredNorm(), 0.0, 1.0);
        return (segment.first + t * along - image).norm() <= tolerance;
      });
      if (!isNear) return false;
    }
    const SurfaceIndex index(piece_.mesh);
    const std::size_t step = 1 + mesh.vertexCount() / kInsideSamples;
    for (std::size_t v = 0; v < mesh.vertexCount(); v += step) {
      if (index.closestPoint(imageOf(static_cast<std::uint32_t>(v))).distance > tolerance) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::vector<OutlinePoint> axisPoints(const Mirror& mirror) const {
    std::vector<OutlinePoint> points;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const double a = mirror.side(outline_[i]);
      const double b = mirror.side(outline_[after(i)]);
      if ((a >= 0) == (b >= 0)) continue;
      points.push_back(snapped(i, a / (a - b)));
    }
    return points;
  }

  /// From one point along the loop to the other, both included, with shares of the way.
  [[nodiscard]] std::vector<OutlinePoint> half(const OutlinePoint& from,
                                               const OutlinePoint& to) const {
    std::vector<OutlinePoint> points{from};
    double way = 0;
    std::size_t edge = from.edge;
    double t = from.t;
    for (std::size_t guard = 0; guard <= loop_.size(); ++guard) {
      if (edge == to.edge && to.t > t) {
        way += (to.t - t) * target_[edge];
        break;
      }
      way += (1 - t) * target_[edge];
      edge = after(edge);
      t = 0;
      if (edge == to.edge && to.t == 0) break;
      points.push_back({edge, 0, way});
    }
    points.push_back({to.edge, to.t, way});
    for (OutlinePoint& p : points) p.at /= way;
    return points;
  }

  /// Gives each half the points of the other.
  [[nodiscard]] bool mergePoints(std::vector<OutlinePoint>& a, std::vector<OutlinePoint>& b) const {
    if (a.size() < 3 || b.size() < 3) return false;
    std::vector<OutlinePoint> mergedA{a.front()}, mergedB{b.front()};
    std::size_t i = 1, j = 1;
    while (i + 1 < a.size() || j + 1 < b.size()) {
      const double nearA = sameVertex_ * std::min(a[i].at - a[i - 1].at,
                                                  i + 1 < a.size() ? a[i + 1].at - a[i].at : 1);
      const double nearB = sameVertex_ * std::min(b[j].at - b[j - 1].at,
                                                  j + 1 < b.size() ? b[j + 1].at - b[j].at : 1);
      const double gap = a[i].at - b[j].at;
      if (i + 1 < a.size() && j + 1 < b.size() && std::abs(gap) < std::min(nearA, nearB)) {
        mergedA.push_back(a[i++]);
        mergedB.push_back(b[j++]);
      } else if (j + 1 >= b.size() || (i + 1 < a.size() && gap < 0)) {
        mergedB.push_back(between(b[j - 1], b[j], a[i].at));
        mergedA.push_back(a[i++]);
      } else {
        mergedA.push_back(between(a[i - 1], a[i], b[j].at));
        mergedB.push_back(b[j++]);
      }
    }
    mergedA.push_back(a.back());
    mergedB.push_back(b.back());
    a = std::move(mergedA);
    b = std::move(mergedB);
    return true;
  }

  /// A new point between two neighbours of a half, which lie on one edge.
  [[nodiscard]] OutlinePoint between(const OutlinePoint& p, const OutlinePoint& q,
                                     double at) const {
    const double share = std::clamp((at - p.at) / (q.at - p.at), 1e-6, 1 - 1e-6);
    // Along the loop the edge begins at the one of the two that is its vertex or lies on it.
    const bool isForward = (p.edge == q.edge && p.t < q.t) || after(p.edge) == q.edge;
    const OutlinePoint& first = isForward ? p : q;
    const OutlinePoint& last = isForward ? q : p;
    const double end = last.t == 0 ? 1 : last.t;
    const double along = isForward ? share : 1 - share;
    return {first.edge, first.t + along * (end - first.t), at};
  }

  void makePoints(const std::vector<OutlinePoint>& a, const std::vector<OutlinePoint>& b) {
    splits_.assign(loop_.size(), {});
    const auto note = [&](const OutlinePoint& p) {
      if (p.t > 0) splits_[p.edge].emplace(p.t, 0);
    };
    for (const OutlinePoint& p : a) note(p);
    for (const OutlinePoint& p : b) note(p);
    positions_ = piece_.mesh->positions();
    for (std::size_t e = 0; e < loop_.size(); ++e) {
      for (auto& [t, vertex] : splits_[e]) {
        vertex = static_cast<std::uint32_t>(positions_.size());
        positions_.emplace_back((1 - t) * outline_[e] + t * outline_[after(e)]);
      }
    }
    result_.addedVertices = positions_.size() - piece_.mesh->vertexCount();
    result_.symmetry.axis = {VertexId(vertexOf(a.front())), VertexId(vertexOf(a.back()))};
    for (std::size_t i = 1; i + 1 < a.size(); ++i) {
      result_.symmetry.pairs.emplace_back(vertexOf(a[i]), vertexOf(b[i]));
    }
  }
  [[nodiscard]] std::uint32_t vertexOf(const OutlinePoint& p) const {
    return p.t == 0 ? loop_[p.edge] : splits_[p.edge].at(p.t);
  }

  bool splitFaces() {
    if (result_.addedVertices == 0) return true;
    std::vector<Triangle> triangles = piece_.mesh->triangles();
    std::vector<FaceId> source = piece_.sourceFace.values();
    // An edge of the loop may belong to a face with two of them: by ends, not by place.
    for (std::size_t e = 0; e < loop_.size(); ++e) {
      if (splits_[e].empty()) continue;
      const VertexId from(loop_[e]), to(loop_[after(e)]);
      const auto has = [&](const Triangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (t[k] == from && t[(k + 1) % 3] == to) return true;
        }
        return false;
      };
      const auto found = std::find_if(triangles.begin(), triangles.end(), has);
      if (found == triangles.end()) return false;
      const auto index = static_cast<std::size_t>(found - triangles.begin());
      VertexId apex = to;
      for (const VertexId v : *found) {
        if (v != from && v != to) apex = v;
      }
      VertexId last = from;
      for (const auto& [t, vertex] : splits_[e]) {
        if (last == from) {
          triangles[index] = {last, VertexId(vertex), apex};
        } else {
          triangles.push_back({last, VertexId(vertex), apex});
          source.push_back(source[index]);
        }
        last = VertexId(vertex);
      }
      triangles.push_back({last, to, apex});
      source.push_back(source[index]);
    }
    Result<Mesh> mesh = makeMesh(positions_, std::move(triangles));
    if (!mesh) return false;
    result_.piece.mesh = std::make_shared<const Mesh>(*std::move(mesh));
    result_.piece.sourceFace.values() = std::move(source);
    result_.piece.onModel = {};
    return true;
  }

  /// New edges and their targets, the mean of both sides, into the wires.
  bool rewriteWires(const std::vector<OutlinePoint>& a, const std::vector<OutlinePoint>& b) {
    using Ends = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Ends, double> meanTarget;
    const auto length = [&](const OutlinePoint& p, const OutlinePoint& q) {
      const bool isForward = (p.edge == q.edge && p.t < q.t) || after(p.edge) == q.edge;
      const OutlinePoint& first = isForward ? p : q;
      const OutlinePoint& last = isForward ? q : p;
      return ((last.t == 0 ? 1 : last.t) - first.t) * target_[first.edge];
    };
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
      const double right = length(a[i], a[i + 1]), left = length(b[i], b[i + 1]);
      const double mean = 0.5 * (right + left);
      meanTarget[std::minmax(vertexOf(a[i]), vertexOf(a[i + 1]))] = mean;
      meanTarget[std::minmax(vertexOf(b[i]), vertexOf(b[i + 1]))] = mean;
      result_.maxLengthChange =
          std::max(result_.maxLengthChange, std::abs(right - left) / (right + left));
    }
    std::map<Ends, std::size_t> edgeOfLoop;
    for (std::size_t e = 0; e < loop_.size(); ++e) {
      edgeOfLoop[{loop_[e], loop_[after(e)]}] = e;
    }
    for (Wire& wire : result_.piece.wires) {
      if (!isBoundary(wire.kind)) continue;
      Wire made = wire;
      made.vertices = {wire.vertices.front()};
      made.bodyLength.clear();
      made.targetLength.clear();
      made.cutEdges.clear();
      for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
        const auto from = static_cast<std::uint32_t>(wire.vertices[i].index());
        const auto to = static_cast<std::uint32_t>(wire.vertices[i + 1].index());
        const auto edge = edgeOfLoop.find({from, to});
        if (edge == edgeOfLoop.end()) {  // of a hole
          made.vertices.push_back(wire.vertices[i + 1]);
          made.bodyLength.push_back(wire.bodyLength[i]);
          made.targetLength.push_back(wire.targetLength[i]);
          continue;
        }
        const auto& splits = splits_[edge->second];
        if (!splits.empty() && wire.kind == WireKind::Dart) return false;
        double lastT = 0;
        std::uint32_t last = from;
        const auto append = [&](double t, std::uint32_t vertex) {
          made.vertices.emplace_back(vertex);
          made.bodyLength.push_back((t - lastT) * wire.bodyLength[i]);
          made.targetLength.push_back(meanTarget.at(std::minmax(last, vertex)));
          lastT = t;
          last = vertex;
        };
        for (const auto& [t, vertex] : splits) append(t, vertex);
        append(1, to);
      }
      wire = std::move(made);
    }
    return true;
  }

  const Piece& piece_;
  const Problem& problem_;
  const std::vector<std::uint32_t>& loop_;
  std::vector<double> target_;  ///< per edge of the loop
  std::vector<Vector3d> outline_;
  double sameVertex_ = unfolding::kSameVertex;
  std::vector<char> isWireEnd_;                          ///< per vertex of the loop
  std::vector<std::map<double, std::uint32_t>> splits_;  ///< per edge of the loop: t, new vertex
  std::vector<Vector3d> positions_;
  SymmetricPiece result_;
};

}  // namespace

namespace unfolding {

std::optional<PieceSymmetry> findExactSymmetry(const Piece& piece, const Problem& problem) {
  return Symmetriser(piece, problem).runExactly();
}

std::optional<MirrorPlane> findMirrorPlane(const Piece& piece, double tolerance) {
  const Result<Problem> problem = makeProblem(piece);
  if (!problem) return std::nullopt;
  return Symmetriser(piece, *problem).findPlane(tolerance * std::sqrt(problem->area));
}

std::optional<OutlineSymmetry> compareHalves(const Piece& piece, const MirrorPlane& plane,
                                             double tolerance, double sameVertex) {
  const Result<Problem> problem = makeProblem(piece);
  if (!problem) return std::nullopt;
  return Symmetriser(piece, *problem)
      .compare(plane, tolerance * std::sqrt(problem->area), sameVertex);
}

}  // namespace unfolding

std::optional<SymmetricPiece> symmetrise(const Piece& piece, double tolerance) {
  const Result<Problem> problem = unfolding::makeProblem(piece);
  if (!problem) return std::nullopt;
  return Symmetriser(piece, *problem).run(tolerance * std::sqrt(problem->area));
}

}  // namespace toile
