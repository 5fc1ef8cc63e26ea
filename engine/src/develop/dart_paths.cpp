// SPDX-License-Identifier: GPL-3.0-or-later
#include "develop/dart_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>

#include "develop/curvature_potential.h"
#include "develop/wire_vertices.h"
#include "toile/curve/geodesic.h"
#include "toile/mesh/surface_index.h"
#include "unfold/symmetry.h"

namespace toile::developing {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Apexes and mouths that are looked at.
constexpr std::size_t kApexes = 3;
constexpr std::size_t kMouths = 6;
/// A bulge smaller than this share of the greatest is left for a later dart.
constexpr double kLeastBulge = 0.35;
/// Mouths of one apex lie apart by this share of the boundary.
constexpr double kMouthSpacing = 0.06;
/// A boundary vertex turns a corner when its angle of cloth is this far from straight: darts do not
/// begin there, nor nearer to it than this share of the boundary.
constexpr double kCorner = 35 * std::numbers::pi / 180;
constexpr double kCornerDistance = 0.015;
/// A piece this near to its mirror image, as a share of its size, gets symmetric darts.
constexpr double kSymmetric = 0.02;
/// What is on the middle of a symmetric piece, as a share of its boundary.
constexpr double kMiddle = 0.006;
/// A way on the middle is straight between so many points of it.
constexpr int kMiddleParts = 24;
/// An end beside the middle is joined to it over so many times its distance: no hook.
constexpr double kBlend = 8;
/// Darts spread evenly round a dome: at most so many, their mouths off their places by at most this
/// share of the distance between them, the longest so much longer than the shortest.
constexpr std::size_t kMaxStar = 6;
constexpr double kStarSlack = 0.1;
constexpr double kDome = 1.4;

class PathFinder {
 public:
  PathFinder(const Piece& piece, const DartOptions& options)
      : piece_(piece),
        mesh_(*piece.mesh),
        options_(options),
        isWire_(wireEdges(piece)),
        onWire_(wireVertices(mesh_, isWire_)),
        potential_(curvaturePotential(mesh_, FreeVertices(mesh_, onWire_))),
        linker_(piece.mesh),
        mirror_(unfolding::findMirrorPlane(piece, kSymmetric)) {
    for (std::size_t e = 0; e < mesh_.edgeCount(); ++e) {
      if (mesh_.isBorder(EdgeId(e))) boundaryLength_ += mesh_.length(EdgeId(e));
    }
    findMouths();
  }

  std::vector<Candidate> run() {
    std::vector<Candidate> candidates, stars;
    bool isFirst = true;
    for (const VertexId apex : apexes()) {
      const std::vector<SurfacePath> ways = waysTo(apex);
      if (potential_[apex] <= 0) {
        addCut(apex, ways, candidates);
        continue;
      }
      for (const SurfacePath& way : ways) addDarts(apex, {way}, candidates);
      if (mirror_) {
        for (const SurfacePath& way : ways) addPair(apex, way, candidates);
      }
      if (isFirst && options_.limit && !ways.empty()) addStars(apex, ways.front(), stars);
      isFirst = false;
    }
    const bool hasSymmetric = std::any_of(candidates.begin(), candidates.end(),
                                          [](const Candidate& c) { return c.isSymmetric; });
    if (hasSymmetric) {
      std::erase_if(candidates, [](const Candidate& c) { return c.bulge > 0 && !c.isSymmetric; });
    }
    // By what each dart gains.
    const double now = areaErrorOf(mesh_, potential_);
    const auto rank = [now](const Candidate& c) {
      return std::log(c.errorLeft / now) / static_cast<double>(c.paths.size());
    };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); });
    candidates.insert(candidates.end(), stars.begin(), stars.end());
    return candidates;
  }

 private:
  /// Local extremes of the potential, the greatest first.
  [[nodiscard]] std::vector<VertexId> apexes() const {
    std::vector<VertexId> found;
    for (std::size_t i = 0; i < mesh_.vertexCount(); ++i) {
      const VertexId v{i};
      if (onWire_[v] != 0) continue;
      bool isExtreme = true;
      for (const FaceId f : mesh_.facesAround(v)) {
        for (const VertexId w : mesh_.vertices(f)) {
          const double a = std::abs(potential_[v]), b = std::abs(potential_[w]);
          if (w != v && (b > a || (b == a && w < v))) isExtreme = false;
        }
      }
      if (isExtreme) found.push_back(v);
    }
    std::stable_sort(found.begin(), found.end(), [&](VertexId a, VertexId b) {
      return std::abs(potential_[a]) > std::abs(potential_[b]);
    });
    // Bulges and saddles are counted apart: a deep saddle must not hide a bulge.
    std::vector<VertexId> kept;
    for (const double sign : {1.0, -1.0}) {
      double greatest = 0;
      std::size_t count = 0;
      for (const VertexId v : found) {
        const double bulge = sign * potential_[v];
        if (bulge <= 0 || bulge < kLeastBulge * greatest || count == kApexes) continue;
        greatest = std::max(greatest, bulge);
        kept.push_back(v);
        ++count;
      }
    }
    return kept;
  }

  /// Boundary vertices at which a dart may begin, with their place along their loop.
  void findMouths() {
    canBegin_ = VertexData<char>(mesh_.vertexCount(), 0);
    along_ = VertexData<double>(mesh_.vertexCount(), 0.0);
    for (const std::vector<HalfedgeId>& loop : mesh_.boundaryLoops()) {
      std::vector<double> corners;
      double length = 0;
      for (const HalfedgeId h : loop) {
        along_[mesh_.from(h)] = length;
        if (std::abs(angleOfCloth(mesh_.from(h)) - std::numbers::pi) > kCorner)
          corners.push_back(length);
        length += mesh_.length(mesh_.edge(h));
      }
      for (const HalfedgeId h : loop) {
        const VertexId v = mesh_.from(h);
        const bool isFree = std::none_of(corners.begin(), corners.end(), [&](double corner) {
          const double apart = std::abs(along_[v] - corner);
          return std::min(apart, length - apart) < kCornerDistance * length;
        });
        canBegin_[v] = isFree && innerWiresAt(v) == 0 ? 1 : 0;
      }
    }
  }

  [[nodiscard]] int innerWiresAt(VertexId v) const {
    int count = 0;
    for (const FaceId f : mesh_.facesAround(v)) {
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh_.halfedge(f, side);
        if (mesh_.from(h) != v && mesh_.to(h) != v) continue;
        if (isWire_[mesh_.edge(h)] != 0 && !mesh_.isBorder(mesh_.edge(h))) ++count;
      }
    }
    return count;
  }

  [[nodiscard]] double angleOfCloth(VertexId v) const {
    double angle = 0;
    for (const FaceId f : mesh_.facesAround(v)) {
      const Triangle& t = mesh_.vertices(f);
      const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      const Eigen::Vector3d u = mesh_.position(t[(k + 1) % 3]) - mesh_.position(v);
      const Eigen::Vector3d w = mesh_.position(t[(k + 2) % 3]) - mesh_.position(v);
      angle += std::atan2(u.cross(w).norm(), u.dot(w));
    }
    return angle;
  }

  /// The shortest ways from the boundary to the apex that cross no wire, well apart.
  [[nodiscard]] std::vector<SurfacePath> waysTo(VertexId apex) {
    const VertexData<double> distance = distancesFrom(apex);
    std::vector<VertexId> mouths;
    for (std::size_t i = 0; i < mesh_.vertexCount(); ++i) {
      if (canBegin_[VertexId(i)] != 0 && distance[VertexId(i)] < kFar) mouths.emplace_back(i);
    }
    std::stable_sort(mouths.begin(), mouths.end(), [&](VertexId a, VertexId b) {
      const bool isMiddle = isOnMiddle(a);  // of a symmetric piece: looked at first
      return isMiddle != isOnMiddle(b) ? isMiddle : distance[a] < distance[b];
    });
    std::vector<SurfacePath> ways;
    std::vector<VertexId> taken;
    for (const VertexId mouth : mouths) {
      if (ways.size() == kMouths) break;
      const bool isNear = std::any_of(taken.begin(), taken.end(), [&](VertexId other) {
        return (mesh_.position(mouth) - mesh_.position(other)).norm() <
               kMouthSpacing * boundaryLength_;
      });
      if (isNear) continue;
      taken.push_back(mouth);
      Result<SurfacePath> way = isOnMiddle(mouth) && isOnMiddle(apex)
                                    ? wayOnMiddle(mouth, apex)
                                    : linker_.link({mouth}, {apex});
      if (way && staysFree(*way)) ways.push_back(*std::move(way));
    }
    return ways;
  }

  /// The way along the middle of a symmetric piece. Over a bulge it is straight but not the
  /// shortest: a link would slip off to one side, so it is led through points of the middle.
  [[nodiscard]] Result<SurfacePath> wayOnMiddle(VertexId mouth, VertexId apex) {
    if (!index_) index_.emplace(piece_.mesh);
    std::vector<SurfacePoint> points{{mouth}, {apex}};
    double shortest = kFar;
    for (const SurfacePath& section : index_->planeSection(mirror_->normal, mirror_->offset)) {
      const std::optional<double> begin = fractionAt(section, mouth),
                                  end = fractionAt(section, apex);
      if (!begin || !end || *begin == *end) continue;
      for (const bool isReversed : {false, true}) {
        if (isReversed && !section.closed) continue;
        const SurfacePath part = isReversed ? subPath(mesh_, section, *end, *begin)
                                            : subPath(mesh_, section, *begin, *end);
        if (length(mesh_, part) >= shortest) continue;
        shortest = length(mesh_, part);
        points.assign({{mouth}});
        for (int k = 1; k < kMiddleParts; ++k) {
          const double share =
              static_cast<double>(isReversed ? kMiddleParts - k : k) / kMiddleParts;
          const double passed = shortest * k / kMiddleParts;
          if (passed < kBlend * offMiddle(mouth) || shortest - passed < kBlend * offMiddle(apex)) {
            continue;
          }
          points.push_back(pointAtFraction(mesh_, part, share));
        }
        points.push_back({apex});
      }
    }
    return linker_.linkAll(points, false);
  }
  /// Where a section passes a vertex of the middle, as a share of its length.
  [[nodiscard]] std::optional<double> fractionAt(const SurfacePath& section, VertexId v) const {
    double nearest = kMiddle * boundaryLength_, passed = 0, found = -1;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const Eigen::Vector3d at = toile::position(mesh_, section.points[i]);
      if (i > 0) passed += (at - toile::position(mesh_, section.points[i - 1])).norm();
      if ((at - position(v)).norm() >= nearest) continue;
      nearest = (at - position(v)).norm();
      found = passed;
    }
    if (found < 0) return std::nullopt;
    return found / length(mesh_, section);
  }

  [[nodiscard]] VertexData<double> distancesFrom(VertexId apex) const {
    using Entry = std::pair<double, VertexId>;
    VertexData<double> distance(mesh_.vertexCount(), kFar);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    distance[apex] = 0;
    open.emplace(0.0, apex);
    while (!open.empty()) {
      const auto [d, v] = open.top();
      open.pop();
      if (d > distance[v] || onWire_[v] != 0) continue;
      for (const FaceId f : mesh_.facesAround(v)) {
        for (const VertexId w : mesh_.vertices(f)) {
          const double reached = d + (mesh_.position(w) - mesh_.position(v)).norm();
          if (reached >= distance[w]) continue;
          distance[w] = reached;
          open.emplace(reached, w);
        }
      }
    }
    return distance;
  }

  /// Touches no wire but where it begins.
  [[nodiscard]] bool staysFree(const SurfacePath& path) const {
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      if (const auto* v = std::get_if<VertexId>(&path.points[i].at)) {
        if (onWire_[*v] != 0) return false;
      } else if (const auto* e = std::get_if<SurfacePoint::OnEdge>(&path.points[i].at)) {
        if (isWire_[e->edge] != 0) return false;
      }
    }
    return true;
  }

  /// How much area error stays when the faces along the paths are at the boundary.
  [[nodiscard]] double errorWith(const std::vector<SurfacePath>& paths) const {
    VertexData<char> held = onWire_;
    for (const SurfacePath& path : paths) {
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        // The nearer end of each crossed edge stands for the path.
        if (const auto* v = std::get_if<VertexId>(&path.points[i].at)) held[*v] = 1;
        if (const auto* e = std::get_if<SurfacePoint::OnEdge>(&path.points[i].at)) {
          held[e->t < 0.5 ? mesh_.tail(e->edge) : mesh_.head(e->edge)] = 1;
        }
      }
    }
    return areaErrorOf(mesh_, curvaturePotential(mesh_, FreeVertices(mesh_, held)));
  }

  void addDarts(VertexId apex, const std::vector<SurfacePath>& ways, std::vector<Candidate>& out,
                bool isStar = false) const {
    Candidate candidate;
    for (const SurfacePath& way : ways) {
      const double whole = length(mesh_, way);
      const double tip = std::min(options_.tipDistance.mm(), whole / 8);
      candidate.paths.push_back(shortened(way, whole - tip));
      if (candidate.paths.back().points.size() < 2) return;
      candidate.length += whole - tip;
    }
    candidate.apex = apex;
    candidate.bulge = potential_[apex];
    candidate.errorLeft = errorWith(candidate.paths);
    candidate.isSymmetric =
        ways.size() == 1 && isOnMiddle(mouthOf(ways.front())) && isOnMiddle(apex);
    candidate.isStar = isStar;
    out.push_back(std::move(candidate));
  }

  /// The way and its mirror image.
  void addPair(VertexId apex, const SurfacePath& way, std::vector<Candidate>& out) {
    const VertexId mouth = mouthOf(way);
    const std::optional<VertexId> mirrored = nearestMouth(mirrorImage(mesh_.position(mouth)));
    const VertexId other = isOnMiddle(apex) ? apex : nearestFree(mirrorImage(position(apex)));
    if (isOnMiddle(mouth) || !mirrored || *mirrored == mouth || !other.isValid()) return;
    Result<SurfacePath> image = linker_.link({*mirrored}, {other});
    if (!image || !staysFree(*image)) return;
    addDarts(apex, {way, *std::move(image)}, out);
    if (!out.empty() && out.back().paths.size() == 2) out.back().isSymmetric = true;
  }

  /// Darts spread evenly round a dome: from equal shares of its one outline, all about as long.
  void addStars(VertexId apex, const SurfacePath& first, std::vector<Candidate>& out) {
    const std::vector<std::vector<HalfedgeId>> loops = mesh_.boundaryLoops();
    if (loops.size() != 1) return;
    const double begin = along_[mouthOf(first)];
    for (std::size_t count = 2; count <= kMaxStar; ++count) {
      const double share = boundaryLength_ / static_cast<double>(count);
      std::vector<SurfacePath> ways{first};
      double least = length(mesh_, first), most = least;
      for (std::size_t k = 1; k < count; ++k) {
        const std::optional<VertexId> mouth =
            mouthAt(loops.front(), begin + static_cast<double>(k) * share, kStarSlack * share);
        if (!mouth) break;
        Result<SurfacePath> way = linker_.link({*mouth}, {apex});
        if (!way || !staysFree(*way)) break;
        least = std::min(least, length(mesh_, *way));
        most = std::max(most, length(mesh_, *way));
        ways.push_back(*std::move(way));
      }
      if (ways.size() == count && most < kDome * least) addDarts(apex, ways, out, true);
    }
  }

  static VertexId mouthOf(const SurfacePath& way) {
    return std::get<VertexId>(way.points.front().at);
  }
  [[nodiscard]] const Eigen::Vector3d& position(VertexId v) const { return mesh_.position(v); }
  [[nodiscard]] Eigen::Vector3d mirrorImage(const Eigen::Vector3d& p) const {
    return p - 2 * (mirror_->normal.dot(p) - mirror_->offset) * mirror_->normal;
  }
  /// Of a symmetric piece: no farther from its middle than a share of its outline.
  [[nodiscard]] bool isOnMiddle(VertexId v) const {
    return mirror_ && offMiddle(v) < kMiddle * boundaryLength_;
  }
  [[nodiscard]] double offMiddle(VertexId v) const {
    return std::abs(mirror_->normal.dot(mesh_.position(v)) - mirror_->offset);
  }
  [[nodiscard]] std::optional<VertexId> nearestMouth(const Eigen::Vector3d& place) const {
    std::optional<VertexId> nearest;
    for (std::size_t i = 0; i < mesh_.vertexCount(); ++i) {
      const VertexId v{i};
      if (canBegin_[v] == 0) continue;
      if (!nearest || (position(v) - place).norm() < (position(*nearest) - place).norm()) {
        nearest = v;
      }
    }
    return nearest;
  }
  [[nodiscard]] VertexId nearestFree(const Eigen::Vector3d& place) const {
    VertexId nearest;
    for (std::size_t i = 0; i < mesh_.vertexCount(); ++i) {
      const VertexId v{i};
      if (onWire_[v] != 0) continue;
      if (!nearest.isValid() || (position(v) - place).norm() < (position(nearest) - place).norm()) {
        nearest = v;
      }
    }
    return nearest;
  }
  /// The vertex of a loop nearest to a place along it at which a dart may begin.
  [[nodiscard]] std::optional<VertexId> mouthAt(const std::vector<HalfedgeId>& loop, double place,
                                                double slack) const {
    std::optional<VertexId> nearest;
    double least = slack;
    for (const HalfedgeId h : loop) {
      const VertexId v = mesh_.from(h);
      if (canBegin_[v] == 0) continue;
      const double apart = std::abs(std::remainder(along_[v] - place, boundaryLength_));
      if (apart >= least) continue;
      least = apart;
      nearest = v;
    }
    return nearest;
  }

  /// The first two ways that come from different sides, joined at the apex.
  void addCut(VertexId apex, const std::vector<SurfacePath>& ways,
              std::vector<Candidate>& out) const {
    for (std::size_t i = 1; i < ways.size(); ++i) {
      const Eigen::Vector3d first = directionAtEnd(ways[0]), other = directionAtEnd(ways[i]);
      if (first.dot(other) > -0.5) continue;  // less than 120 degrees apart
      SurfacePath path = ways[0];
      for (std::size_t k = ways[i].points.size() - 1; k-- > 0;) {
        path.points.push_back(ways[i].points[k]);
        path.faceOfSegment.push_back(ways[i].faceOfSegment[k]);
      }
      const double left = errorWith({path});
      out.push_back({{path}, apex, potential_[apex], length(mesh_, path), left});
      return;
    }
  }

  [[nodiscard]] Eigen::Vector3d directionAtEnd(const SurfacePath& path) const {
    return (toile::position(mesh_, path.points[path.points.size() - 2]) -
            toile::position(mesh_, path.points.back()))
        .normalized();
  }

  [[nodiscard]] SurfacePath shortened(const SurfacePath& path, double wanted) const {
    SurfacePath cut;
    cut.points.push_back(path.points.front());
    double left = wanted;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const double step =
          (toile::position(mesh_, path.points[i + 1]) - toile::position(mesh_, path.points[i]))
              .norm();
      const FaceId face = path.faceOfSegment[i];
      cut.faceOfSegment.push_back(face);
      if (step >= left) {
        const double t = left / step;
        cut.points.push_back(
            makeSurfacePoint(mesh_, face,
                             (1 - t) * barycentricIn(mesh_, path.points[i], face) +
                                 t * barycentricIn(mesh_, path.points[i + 1], face)));
        return cut;
      }
      left -= step;
      cut.points.push_back(path.points[i + 1]);
    }
    return cut;
  }

  const Piece& piece_;
  const Mesh& mesh_;
  const DartOptions& options_;
  EdgeData<char> isWire_;
  VertexData<char> onWire_;
  VertexData<double> potential_;
  GeodesicLinker linker_;
  std::optional<unfolding::MirrorPlane> mirror_;
  std::optional<SurfaceIndex> index_;
  double boundaryLength_ = 0;
  VertexData<char> canBegin_;
  VertexData<double> along_;
};

}  // namespace

std::vector<Candidate> findCandidates(const Piece& piece, const DartOptions& options) {
  return PathFinder(piece, options).run();
}

}  // namespace toile::developing
