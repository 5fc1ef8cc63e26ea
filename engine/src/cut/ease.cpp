// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut/ease.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "toile/core/nearest_name.h"

// Notation: n = unit normal of the model, p = direction of the ease projected into the tangent
// plane. Cloth is mapped by E = (1 + girth) I + (length - girth) p p': where the surface is upright
// to the direction the two eases act across and along it; where the surface lies across the
// direction (a crown), all of it is girth. So there is no place where the field jumps.
namespace toile::cutting {
namespace {

using Eigen::Vector3d;

/// Directions along a curve of the model, or the same everywhere.
class Direction {
 public:
  static Result<Direction> find(const std::string& name, const ReferenceModel& model) {
    Direction direction;
    for (const Eigen::Index axis : {0, 1, 2}) {
      if (name.size() == 1 && name[0] == "xyz"[axis]) {
        direction.axis_ = Vector3d::Unit(axis);
        return direction;
      }
    }
    const auto curve = model.curves.find(name);
    if (curve == model.curves.end()) {
      std::vector<std::string> known{"x", "y", "z"};
      for (const auto& [id, path] : model.curves) known.push_back(id);
      return Error{ErrorCode::NameNotFound,
                   "ease along \"" + name + "\": the model has no such curve" +
                       suggestion(name, known) + "; \"x\", \"y\", \"z\" are directions too",
                   {Element::curve(name)}};
    }
    for (const SurfacePoint& point : curve->second.points) {
      direction.points_.push_back(position(*model.mesh, point));
    }
    if (curve->second.closed) direction.points_.push_back(direction.points_.front());
    const auto& at = direction.points_;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vector3d along = at[std::min(i + 1, at.size() - 1)] - at[i == 0 ? 0 : i - 1];
      direction.tangents_.push_back(along.normalized());
    }
    return direction;
  }

  [[nodiscard]] Vector3d at(const Vector3d& place) const {
    if (points_.empty()) return axis_;
    double nearest = std::numeric_limits<double>::infinity();
    Vector3d tangent = tangents_.front();
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const Vector3d along = points_[i + 1] - points_[i];
      const double squared = along.squaredNorm();
      if (squared == 0) continue;
      const double t = std::clamp((place - points_[i]).dot(along) / squared, 0.0, 1.0);
      const double distance = (place - points_[i] - t * along).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      tangent = (1 - t) * tangents_[i] + t * tangents_[i + 1];
    }
    return tangent.normalized();
  }

 private:
  Vector3d axis_ = Vector3d::UnitZ();
  std::vector<Vector3d> points_;
  std::vector<Vector3d> tangents_;
};

std::vector<Vector3d> vertexNormals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertexCount(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Vector3d normal = mesh.area(FaceId(f)) * mesh.normal(FaceId(f));
    for (const VertexId v : mesh.vertices(FaceId(f))) normals[v.index()] += normal;
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

/// What a piece's cloth asks for.
struct Wish {
  Ease ease;
  double offset = 0;  ///< mm outwards at which lengths are counted
  [[nodiscard]] bool isNone() const { return ease.isNone() && offset == 0; }
};

Wish wishOf(const Design& design, const Piece& piece) {
  const PieceRecord* record = recordOf(design, piece.id);
  const Fabric* fabric = fabricOf(design, record);
  Wish wish;
  if (fabric != nullptr) {
    wish.ease = fabric->ease;
    wish.offset = fabric->thickness.mm() * fabric->thicknessOffset.value();
  }
  if (record != nullptr && record->ease) wish.ease = *record->ease;
  return wish;
}

/// The lengths that one piece wishes for.
class WishedLengths {
 public:
  WishedLengths(const Piece& piece, const Wish& wish, const Direction& direction, const Mesh& model,
                const std::vector<Vector3d>& modelNormals)
      : piece_(piece), wish_(wish), direction_(direction) {
    const Mesh& mesh = *piece.mesh;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
      const SurfacePoint& point = piece.onModel[VertexId(v)];
      const FaceId face = facesOf(model, point).front();
      const Vector3d weights = barycentricIn(model, point, face);
      Vector3d normal = Vector3d::Zero();
      for (Eigen::Index k = 0; k < 3; ++k) {
        normal +=
            weights[k] * modelNormals[model.vertices(face)[static_cast<std::size_t>(k)].index()];
      }
      normal_.push_back(normal.normalized());
      offset_.push_back(mesh.position(VertexId(v)) + wish.offset * normal_.back());
    }
  }

  [[nodiscard]] double edge(VertexId a, VertexId b) const {
    const Vector3d normal = (normal_[a.index()] + normal_[b.index()]).normalized();
    const Vector3d along = offset_[b.index()] - offset_[a.index()];
    const Vector3d& from = piece_.mesh->position(a);
    return eased(along, normal, 0.5 * (from + piece_.mesh->position(b)));
  }

  [[nodiscard]] std::array<double, 3> face(FaceId f) const {
    const Triangle& t = piece_.mesh->vertices(f);
    const Vector3d& a = offset_[t[0].index()];
    const Vector3d& b = offset_[t[1].index()];
    const Vector3d& c = offset_[t[2].index()];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    const Vector3d middle =
        (piece_.mesh->position(t[0]) + piece_.mesh->position(t[1]) + piece_.mesh->position(t[2])) /
        3;
    return {eased(b - a, normal, middle), eased(c - b, normal, middle),
            eased(a - c, normal, middle)};
  }

 private:
  [[nodiscard]] double eased(const Vector3d& along, const Vector3d& normal,
                             const Vector3d& place) const {
    if (wish_.ease.isNone()) return along.norm();
    Vector3d p = direction_.at(place);
    p -= p.dot(normal) * normal;
    const double girth = wish_.ease.girth.value(), length = wish_.ease.length.value();
    return ((1 + girth) * along + (length - girth) * p.dot(along) * p).norm();
  }

  const Piece& piece_;
  const Wish& wish_;
  const Direction& direction_;
  std::vector<Vector3d> normal_;  ///< of the model, per vertex
  std::vector<Vector3d> offset_;  ///< positions in the cloth
};

struct Sum {
  double lengths = 0;
  int count = 0;
};

}  // namespace

Result<void> applyEase(const Document& document, RefinedMesh& refined,
                       std::vector<PieceBuild>& builds) {
  std::vector<Wish> wishes;
  for (const PieceBuild& build : builds) wishes.push_back(wishOf(*document.design, build.piece));
  if (std::all_of(wishes.begin(), wishes.end(), [](const Wish& w) { return w.isNone(); }))
    return {};

  const Mesh& model = *document.model->mesh;
  const std::vector<Vector3d> modelNormals = vertexNormals(model);
  std::vector<Sum> sums(refined.cutEdges.size());
  for (std::size_t i = 0; i < builds.size(); ++i) {
    Piece& piece = builds[i].piece;
    if (!piece.include) continue;
    const Result<Direction> direction = Direction::find(wishes[i].ease.along, *document.model);
    if (!direction) return direction.error().during("piece \"" + piece.id + "\"");
    const WishedLengths wished(piece, wishes[i], *direction, model, modelNormals);
    const bool isPlain = wishes[i].isNone();
    for (const Wire& wire : piece.wires) {
      for (std::size_t e = 0; e < wire.cutEdges.size(); ++e) {
        Sum& sum = sums[wire.cutEdges[e].index()];
        sum.lengths +=
            isPlain ? wire.bodyLength[e] : wished.edge(wire.vertices[e], wire.vertices[e + 1]);
        ++sum.count;
      }
    }
    if (isPlain) continue;
    piece.targetSides = FaceData<std::array<double, 3>>(piece.mesh->faceCount());
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      piece.targetSides[FaceId(f)] = wished.face(FaceId(f));
    }
  }
  for (std::size_t e = 0; e < sums.size(); ++e) {
    if (sums[e].count > 0) refined.cutEdges[e].targetLength = sums[e].lengths / sums[e].count;
  }
  for (PieceBuild& build : builds) {
    for (Wire& wire : build.piece.wires) {
      for (std::size_t e = 0; e < wire.cutEdges.size(); ++e) {
        wire.targetLength[e] = refined.cutEdges[wire.cutEdges[e].index()].targetLength;
      }
    }
  }
  return {};
}

}  // namespace toile::cutting
