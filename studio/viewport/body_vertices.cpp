// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/body_vertices.h"

#include <Eigen/Geometry>
#include <QColor>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/palette.h"
#include "toile/core/parallel.h"

namespace toile::studio {

using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr int kRays = 16;
constexpr double kSky = 350;  // mm from which on a surface does not shade any more

/// Directions spread over the upper half sphere, more of them upwards.
std::array<Vector3d, kRays> sky() {
  std::array<Vector3d, kRays> directions;
  for (int i = 0; i < kRays; ++i) {
    const double radius = std::sqrt((i + 0.5) / kRays);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    directions[static_cast<std::size_t>(i)] = {radius * std::cos(angle), radius * std::sin(angle),
                                               std::sqrt(1 - radius * radius)};
  }
  return directions;
}

std::array<std::uint8_t, 4> bytesOf(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue()), 255};
}

std::array<float, 3> floats(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Normal and openness at a place of the model, between its vertices.
struct Shade {
  Vector3f normal;
  float openness;
};
Shade shadeAt(const BodyShape& shape, const SurfacePoint& point) {
  const Mesh& mesh = *shape.model->mesh;
  const auto of = [&](VertexId v) {
    return Shade{shape.normals[v.index()], shape.openness[v.index()]};
  };
  if (const auto* vertex = std::get_if<VertexId>(&point.at)) return of(*vertex);
  if (const auto* edge = std::get_if<SurfacePoint::OnEdge>(&point.at)) {
    const Shade a = of(mesh.tail(edge->edge)), b = of(mesh.head(edge->edge));
    const auto t = static_cast<float>(edge->t);
    return {((1 - t) * a.normal + t * b.normal).normalized(),
            (1 - t) * a.openness + t * b.openness};
  }
  const auto& in = std::get<SurfacePoint::InFace>(point.at);
  Shade sum{Vector3f::Zero(), 0};
  for (int k = 0; k < 3; ++k) {
    const Shade corner = of(mesh.vertices(in.face)[static_cast<std::size_t>(k)]);
    const auto weight = static_cast<float>(in.barycentric[k]);
    sum.normal += weight * corner.normal;
    sum.openness += weight * corner.openness;
  }
  sum.normal.normalize();
  return sum;
}

}  // namespace

BodyShape makeBodyShape(std::shared_ptr<const ReferenceModel> model) {
  BodyShape shape;
  const Mesh& mesh = *model->mesh;
  std::vector<Vector3d> sums(mesh.vertexCount(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& corners = mesh.vertices(FaceId(f));
    const Vector3d& a = mesh.position(corners[0]);
    const Vector3d normal = (mesh.position(corners[1]) - a).cross(mesh.position(corners[2]) - a);
    for (const VertexId corner : corners) sums[corner.index()] += normal;
  }
  shape.normals.reserve(sums.size());
  for (const Vector3d& sum : sums) shape.normals.push_back(sum.normalized().cast<float>());
  shape.openness.assign(sums.size(), 1.0F);
  shape.model = std::move(model);
  return shape;
}

std::vector<float> computeOpenness(const BodyShape& shape) {
  static const std::array<Vector3d, kRays> kSkyDirections = sky();
  const Mesh& mesh = *shape.model->mesh;
  const double lift = 0.05 * mesh.meanEdgeLength();
  std::vector<float> open(mesh.vertexCount());
  parallelFor(open.size(), [&](std::size_t v) {
    const Vector3d normal = shape.normals[v].cast<double>();
    const Vector3d side = normal.unitOrthogonal();
    const Vector3d other = normal.cross(side);
    const Vector3d from = mesh.positions()[v] + lift * normal;
    double seen = 0;
    for (const Vector3d& d : kSkyDirections) {
      const Vector3d way = d.x() * side + d.y() * other + d.z() * normal;
      const auto hit = shape.model->index->firstVisibleHit(from, way);
      seen += hit ? std::min(1.0, hit->t / kSky) : 1.0;
    }
    open[v] = static_cast<float>(seen / kRays);
  });
  // So few rays are uneven from vertex to vertex.
  for (int round = 0; round < 2; ++round) {
    std::vector<float> sum(open), count(open.size(), 1);
    for (std::size_t e = 0; e < mesh.edgeCount(); ++e) {
      const auto a = mesh.tail(EdgeId(e)).index(), b = mesh.head(EdgeId(e)).index();
      sum[a] += open[b];
      sum[b] += open[a];
      ++count[a];
      ++count[b];
    }
    for (std::size_t v = 0; v < open.size(); ++v) open[v] = sum[v] / count[v];
  }
  return open;
}

std::vector<float> strainOfVertices(const Mesh& mesh, const PieceStrain& strain, StrainKind kind) {
  std::vector<double> sum(mesh.vertexCount(), 0), weight(sum.size(), 0);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const double area = mesh.area(FaceId(f));
    for (const VertexId v : mesh.vertices(FaceId(f))) {
      sum[v.index()] += area * strain.faces[FaceId(f)].of(kind);
      weight[v.index()] += area;
    }
  }
  std::vector<float> means(sum.size(), 0);
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (weight[v] > 0) means[v] = static_cast<float>(sum[v] / weight[v]);
  }
  return means;
}

std::vector<BodyVertex> makeBodyVertices(const BodyShape& shape, const Pattern* pattern,
                                         const BodyPaint& paint) {
  std::vector<BodyVertex> vertices;
  const auto clay = bytesOf(palette().clay);
  if (pattern == nullptr || pattern->document.model != shape.model || pattern->cut.pieces.empty()) {
    const Mesh& mesh = *shape.model->mesh;
    vertices.reserve(3 * mesh.faceCount());
    for (const Triangle& corners : mesh.triangles()) {
      for (const VertexId v : corners) {
        vertices.push_back({floats(mesh.position(v)),
                            floats(shape.normals[v.index()].cast<double>()),
                            shape.openness[v.index()], 0, clay});
      }
    }
    return vertices;
  }
  for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
    const Piece& piece = pattern->cut.pieces[i];
    const bool strained = paint.strain && paint.strains != nullptr && i < paint.strains->size() &&
                          (*paint.strains)[i].has_value();
    const auto colour = paint.strain ? clay : bytesOf(pieceTint(*pattern, i, paint.colours));
    std::vector<float> strain;
    if (strained) strain = strainOfVertices(*piece.mesh, *(*paint.strains)[i], paint.kind);
    std::vector<BodyVertex> ofPiece;
    ofPiece.reserve(piece.mesh->vertexCount());
    for (std::size_t v = 0; v < piece.mesh->vertexCount(); ++v) {
      const Shade shade = shadeAt(shape, piece.onModel[VertexId(v)]);
      BodyVertex vertex{floats(piece.mesh->position(VertexId(v))),
                        floats(shade.normal.cast<double>()), shade.openness, 0, colour};
      if (strained) {
        vertex.strain = strain[v];
        vertex.colour[3] = 0;  // coloured by its strain
      }
      ofPiece.push_back(vertex);
    }
    for (const Triangle& corners : piece.mesh->triangles()) {
      for (const VertexId v : corners) vertices.push_back(ofPiece[v.index()]);
    }
  }
  return vertices;
}

}  // namespace toile::studio
