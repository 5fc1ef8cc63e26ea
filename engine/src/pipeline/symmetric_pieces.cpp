// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/symmetric_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "cut/cut_at.h"
#include "pipeline/wire_match.h"
#include "unfold/symmetry.h"

namespace toile {
namespace {

/// A point that one piece adds may ask its neighbour for one more on the other side, and the cut
/// may merge a point with what is near to it. In each round vertices twice as far apart are the
/// same.
constexpr int kMaxRounds = 5;
/// Pairs whose lengths differ by more than this share of their mean are none.
constexpr double kMaxChange = 0.5;
/// A change of lengths that nobody needs to be told of, as a share.
constexpr double kRounding = 1e-9;

struct EdgeAt {
  std::size_t wire = 0, edge = 0;
};
using Ends = std::pair<VertexId, VertexId>;

/// Boundary edges by their ends, the piece on their left.
std::map<Ends, EdgeAt> boundaryEdges(const Piece& piece) {
  std::map<Ends, EdgeAt> edges;
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (!isBoundary(wire.kind)) continue;
    for (std::size_t e = 0; e + 1 < wire.vertices.size(); ++e) {
      edges[{wire.vertices[e], wire.vertices[e + 1]}] = {w, e};
    }
  }
  return edges;
}

/// Calls visit(edge, image) for every pair of boundary edges, each pair twice.
template <class Visit>
void forEachPair(const Piece& piece, const PieceSymmetry& symmetry, const Visit& visit) {
  std::map<VertexId, VertexId> image;
  for (const VertexId v : symmetry.axis) image[v] = v;
  for (const auto& [right, left] : symmetry.pairs) {
    image[right] = left;
    image[left] = right;
  }
  const std::map<Ends, EdgeAt> edges = boundaryEdges(piece);
  for (const auto& [ends, edge] : edges) {
    const auto from = image.find(ends.first), to = image.find(ends.second);
    if (from == image.end() || to == image.end()) continue;
    const auto mirrored = edges.find({to->second, from->second});
    if (mirrored != edges.end()) visit(edge, mirrored->second);
  }
}

/// A piece that is to be symmetric. It keeps the plane of the first round: a plane that is fitted
/// to the added points too would ask for others.
struct Wish {
  unfolding::MirrorPlane plane;
  double asymmetry = 0;  ///< mm
  std::size_t added = 0;
  std::optional<PieceSymmetry> symmetry;  ///< in the last round
};
/// By the id of the piece: cutting again may change its place.
using Wishes = std::map<std::string, Wish>;

std::vector<const Piece*> candidates(const Pattern& pattern) {
  std::vector<const Piece*> pieces;
  for (const Piece& piece : pattern.cut.pieces) {
    const PieceRecord* record = recordOf(*pattern.document.design, piece.id);
    const bool isTwin = record != nullptr && record->twin;
    if (piece.include && !isTwin) pieces.push_back(&piece);
  }
  return pieces;
}

/// By the model's pairing of vertices, however crooked the model is.
std::optional<unfolding::OutlineSymmetry> findPaired(const ReferenceModel& model,
                                                     const Piece& piece) {
  if (!model.symmetry || model.symmetry->partner.empty()) return std::nullopt;
  const auto originalOf = WireMatch(model, piece, piece).find();
  if (!originalOf) return std::nullopt;
  unfolding::OutlineSymmetry found;
  std::map<VertexId, VertexId> image;
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (!isBoundary(wire.kind)) continue;
    for (std::size_t e = 0; e + 1 < wire.vertices.size(); ++e) {
      const EdgeOfWire& other = (*originalOf)[w][e];
      const std::vector<VertexId>& ends = piece.wires[other.wire].vertices;
      image[wire.vertices[e]] = ends[other.edge + 1];
      image[wire.vertices[e + 1]] = ends[other.edge];
    }
  }
  const std::vector<std::vector<HalfedgeId>> loops = piece.mesh->boundaryLoops();
  if (loops.size() != 1) return std::nullopt;
  for (const auto& [v, other] : image) {
    const Eigen::Vector3d p = piece.mesh->position(v), q = piece.mesh->position(other);
    const double side = model.symmetry->normal.dot(p) - model.symmetry->offset;
    found.asymmetry = std::max(found.asymmetry, (p - 2 * side * model.symmetry->normal - q).norm());
    if (v == other) found.symmetry.axis.push_back(v);
    if (v < other) found.symmetry.pairs.emplace_back(v, other);
  }
  if (found.symmetry.axis.size() != 2) return std::nullopt;
  return found;
}

/// Where on the model a point on an edge of a piece lies.
SurfacePoint onModel(const Mesh& model, const Piece& piece,
                     const unfolding::OutlineSymmetry::Point& point) {
  for (const FaceId f : piece.mesh->facesAround(point.from)) {
    const Triangle& t = piece.mesh->vertices(f);
    if (std::find(t.begin(), t.end(), point.to) == t.end()) continue;
    const FaceId face = piece.sourceFace[f];
    return makeSurfacePoint(model, face,
                            (1 - point.t) * barycentricIn(model, piece.onModel[point.from], face) +
                                point.t * barycentricIn(model, piece.onModel[point.to], face));
  }
  return piece.onModel[point.from];
}

/// In the model's plane, in that of another piece, or in one of its own. Neighbours that share the
/// middle must share the plane: each would mirror the other's middle without end.
std::optional<Wish> findWish(const ReferenceModel& model, const Piece& piece,
                             std::vector<unfolding::MirrorPlane>& planes, double tolerance) {
  if (const auto paired = findPaired(model, piece)) {
    return Wish{{model.symmetry->normal, model.symmetry->offset}, paired->asymmetry, 0, {}};
  }
  for (const unfolding::MirrorPlane& plane : planes) {
    const auto found = unfolding::compareHalves(piece, plane, tolerance);
    if (found) return Wish{plane, found->asymmetry, 0, {}};
  }
  const auto own = unfolding::findMirrorPlane(piece, tolerance);
  if (!own) return std::nullopt;
  const auto found = unfolding::compareHalves(piece, *own, tolerance);
  if (!found) return std::nullopt;
  planes.push_back(*own);
  return Wish{*own, found->asymmetry, 0, {}};
}

Wishes findWishes(const Pattern& pattern, double tolerance) {
  const ReferenceModel& model = *pattern.document.model;
  std::vector<unfolding::MirrorPlane> planes;
  if (model.symmetry) planes.push_back({model.symmetry->normal, model.symmetry->offset});
  Wishes wishes;
  for (const Piece* piece : candidates(pattern)) {
    if (auto wish = findWish(model, *piece, planes, tolerance)) wishes[piece->id] = *wish;
  }
  return wishes;
}

/// Pairs the vertices of each outline; what is missing for that is added to the points.
/// @param sameVertex as for compareHalves()
void pairOutlines(const Pattern& pattern, double sameVertex, Wishes& wishes,
                  std::vector<SurfacePoint>& points) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const ReferenceModel& model = *pattern.document.model;
  for (const Piece* piece : candidates(pattern)) {
    const auto wish = wishes.find(piece->id);
    if (wish == wishes.end()) continue;
    wish->second.symmetry.reset();
    auto found = findPaired(model, *piece);
    if (!found) found = unfolding::compareHalves(*piece, wish->second.plane, kAny, sameVertex);
    if (!found) continue;
    if (found->missing.empty()) wish->second.symmetry = std::move(found->symmetry);
    for (const auto& point : found->missing) {
      points.push_back(onModel(*model.mesh, *piece, point));
    }
    wish->second.added += found->missing.size();
  }
}

/// Which edges of the cut are to be equally long.
class EqualEdges {
 public:
  EqualEdges(const Pattern& pattern, const Wishes& wishes)
      : parent_(pattern.cut.refined->cutEdges.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (const Piece& piece : pattern.cut.pieces) {
      const auto wish = wishes.find(piece.id);
      if (wish == wishes.end() || !wish->second.symmetry) continue;
      forEachPair(piece, *wish->second.symmetry, [&](const EdgeAt& a, const EdgeAt& b) {
        parent_[rootOf(cutEdge(piece, a))] = rootOf(cutEdge(piece, b));
      });
    }
    std::vector<double> sum(parent_.size(), 0.0);
    std::vector<int> count(parent_.size(), 0);
    for (std::size_t e = 0; e < parent_.size(); ++e) {
      sum[rootOf(e)] += pattern.cut.refined->cutEdges[e].targetLength;
      ++count[rootOf(e)];
    }
    for (std::size_t e = 0; e < parent_.size(); ++e) {
      mean_.push_back(count[rootOf(e)] > 1 ? sum[rootOf(e)] / count[rootOf(e)]
                                           : pattern.cut.refined->cutEdges[e].targetLength);
    }
  }
  [[nodiscard]] double mean(std::size_t edge) const { return mean_[edge]; }
  static std::size_t cutEdge(const Piece& piece, const EdgeAt& at) {
    return piece.wires[at.wire].cutEdges[at.edge].index();
  }

 private:
  std::size_t rootOf(std::size_t edge) {
    while (parent_[edge] != edge) edge = parent_[edge] = parent_[parent_[edge]];
    return edge;
  }
  std::vector<std::size_t> parent_;
  std::vector<double> mean_;
};

/// Greatest share by which a target of the piece changes.
double greatestChange(const Piece& piece, const PieceSymmetry& symmetry, const EqualEdges& equal) {
  double greatest = 0;
  forEachPair(piece, symmetry, [&](const EdgeAt& a, const EdgeAt&) {
    const double target = piece.wires[a.wire].targetLength[a.edge];
    greatest = std::max(greatest, std::abs(equal.mean(EqualEdges::cutEdge(piece, a)) / target - 1));
  });
  return greatest;
}

std::string nameOf(const Piece& piece) {
  return "piece \"" + (piece.name.empty() ? piece.id : piece.name) + '"';
}

}  // namespace

const PieceSymmetry* symmetryOf(const Pattern& pattern, const Symmetries& symmetries,
                                std::size_t piece) {
  if (symmetries.empty() || !symmetries[piece]) return nullptr;
  const std::vector<Wire>& wires = pattern.cut.pieces[piece].wires;
  const PieceSymmetry* symmetry = &*symmetries[piece];
  forEachPair(pattern.cut.pieces[piece], *symmetries[piece], [&](const EdgeAt& a, const EdgeAt& b) {
    if (wires[a.wire].targetLength[a.edge] != wires[b.wire].targetLength[b.edge]) {
      symmetry = nullptr;
    }
  });
  return symmetry;
}

Result<Symmetries> makePiecesSymmetric(Pattern& pattern, Ratio tolerance, Progress* progress) {
  constexpr double kMaxAsymmetry = 0.2;
  if (!(tolerance.value() >= 0 && tolerance.value() <= kMaxAsymmetry)) {
    return Error{ErrorCode::InvalidArgument,
                 "pieces can be made symmetric that are so within 0 to 20 % of their size",
                 {}};
  }
  Wishes wishes = findWishes(pattern, tolerance.value());
  std::vector<SurfacePoint> points;
  double sameVertex = unfolding::kSameVertex;
  for (int round = 0; round < kMaxRounds; ++round, sameVertex *= 2) {
    const std::size_t before = points.size();
    pairOutlines(pattern, sameVertex, wishes, points);
    if (points.size() == before) break;
    Result<CutResult> again = cutting::cutAt(pattern.document, pattern.curves, points, progress);
    if (!again) return again.error();
    pattern.cut = *std::move(again);
  }

  EqualEdges equal(pattern, wishes);
  Symmetries symmetries(pattern.cut.pieces.size());
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    const auto found = wishes.find(piece.id);
    if (found == wishes.end()) continue;
    Wish& wish = found->second;
    double change = wish.symmetry ? greatestChange(piece, *wish.symmetry, equal) : 0;
    if (change > kMaxChange) {
      wish.symmetry.reset();
      equal = EqualEdges(pattern, wishes);
    }
    symmetries[i] = wish.symmetry;
    if (!wish.symmetry) {
      pattern.findings.push_back(
          {"not-symmetric",
           fmt::format(
               "{}: its outline is within {:.2g} mm of its mirror image and still could not "
               "be made symmetric: its neighbours' points or lengths do not agree with it",
               nameOf(piece), wish.asymmetry),
           {Element::piece(piece.id)}});
    } else if (change >= kRounding || wish.added > 0) {
      pattern.findings.push_back(
          {"made-symmetric",
           fmt::format("{}: its outline is within {:.2g} mm of its mirror image and was made "
                       "symmetric, its neighbours' edges with it: {} points added, lengths of "
                       "edges changed by {:.2g} % at most",
                       nameOf(piece), wish.asymmetry, wish.added, 100 * change),
           {Element::piece(piece.id)}});
    }
  }
  const auto refined = std::make_shared<RefinedMesh>(*pattern.cut.refined);
  for (std::size_t e = 0; e < refined->cutEdges.size(); ++e) {
    refined->cutEdges[e].targetLength = equal.mean(e);
  }
  copyTargets(*refined, pattern.cut.pieces);
  pattern.cut.refined = refined;
  return symmetries;
}

}  // namespace toile
