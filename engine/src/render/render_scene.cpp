// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/render_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "render/panel_colours.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kSmoothing = 3;          // rounds over the light at vertices
constexpr double kShadeReach = 0.25;   // of the diagonal: nearer surface darkens
constexpr double kAlongNormal = 0.12;  // of the diagonal: what explodes moves out so far as well
constexpr Colour kBareModel = colourOf(0xCFC8BF);

/// Normals weighted by angle, so that they do not depend on how a face is split.
std::vector<Vector3f> vertexNormals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertexCount(), Vector3d::Zero());
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const Triangle& corners = mesh.vertices(FaceId(i));
    const Vector3d normal = mesh.normal(FaceId(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = mesh.position(corners[k]);
      const Vector3d a = (mesh.position(corners[(k + 1) % 3]) - p).normalized();
      const Vector3d b = (mesh.position(corners[(k + 2) % 3]) - p).normalized();
      normals[corners[k].index()] += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * normal;
    }
  }
  std::vector<Vector3f> result;
  result.reserve(normals.size());
  for (const Vector3d& normal : normals) result.push_back(normal.normalized().cast<float>());
  return result;
}

LineRole roleOf(WireKind kind, bool isSewn) {
  switch (kind) {
    case WireKind::Seam:
      return isSewn ? LineRole::Seam : LineRole::Hem;
    case WireKind::Opening:
      return LineRole::Zip;
    case WireKind::Dart:
      return LineRole::Dart;
    case WireKind::Feature:
      return LineRole::Feature;
    case WireKind::Elastic:
      return LineRole::Elastic;
    case WireKind::Border:
      return LineRole::Hem;
  }
  return LineRole::Hem;
}

std::vector<Vector3f> pointsOf(const Mesh& model, const SurfacePath& path) {
  std::vector<Vector3f> points;
  for (const SurfacePoint& point : path.points) {
    points.push_back(position(model, point).cast<float>());
  }
  if (path.closed && !points.empty()) points.push_back(points.front());
  return points;
}

class SceneBuilder {
 public:
  explicit SceneBuilder(const Mesh& model) : model_(model) {
    scene_.modelNormals = vertexNormals(model);
    scene_.middle = 0.5 * (model.boxMin() + model.boxMax());
    scene_.diagonal = std::max((model.boxMax() - model.boxMin()).norm(), 1e-6);
  }

  void addModel(Colour colour) {
    const std::uint32_t first = beginPart(colour);
    for (std::size_t i = 0; i < model_.vertexCount(); ++i) {
      const auto v = static_cast<std::uint32_t>(i);
      scene_.positions.push_back(model_.position(VertexId(i)).cast<float>());
      scene_.normals.push_back(scene_.modelNormals[i]);
      scene_.onModel.push_back({{v, v, v}, {1, 0, 0}});
    }
    addFaces(model_, first);
  }

  void addPiece(const Piece& piece, Colour colour, const Vector3d& offset) {
    const std::uint32_t first = beginPart(colour);
    for (std::size_t i = 0; i < piece.mesh->vertexCount(); ++i) {
      const SurfacePoint& point = piece.onModel[VertexId(i)];
      const FaceId face = facesOf(model_, point).front();
      const Vector3f weights = barycentricIn(model_, point, face).cast<float>();
      Vector3f normal = Vector3f::Zero();
      RenderScene::OnModel source{{}, weights};
      for (std::size_t k = 0; k < 3; ++k) {
        source.vertex[k] = model_.vertices(face)[k].index();
        normal += weights[static_cast<int>(k)] * scene_.modelNormals[source.vertex[k]];
      }
      const Vector3d moved = piece.mesh->position(VertexId(i)) + offset;
      scene_.positions.push_back(moved.cast<float>());
      scene_.normals.push_back(normal);
      scene_.onModel.push_back(source);
    }
    addFaces(*piece.mesh, first);
  }

  void addLine(SurfaceLine line) { scene_.lines.add(std::move(line)); }
  [[nodiscard]] std::uint32_t lastPart() const {
    return static_cast<std::uint32_t>(scene_.cloth.size() - 1);
  }

  RenderScene finish() {
    scene_.surface = RayScene::ofTriangles(scene_.positions, scene_.corners);
    std::vector<Vector3f> points;
    for (const Vector3d& p : model_.positions()) points.push_back(p.cast<float>());
    for (const Triangle& triangle : model_.triangles()) {
      for (const VertexId v : triangle) scene_.modelCorners.push_back(v.index());
    }
    scene_.sky = computeSkyView(RayScene::ofTriangles(points, scene_.modelCorners), points,
                                scene_.modelNormals, static_cast<float>(2e-4 * scene_.diagonal),
                                static_cast<float>(kShadeReach * scene_.diagonal));
    return std::move(scene_);
  }

 private:
  std::uint32_t beginPart(Colour colour) {
    scene_.cloth.push_back(makeCloth(colour));
    return static_cast<std::uint32_t>(scene_.positions.size());
  }
  void addFaces(const Mesh& mesh, std::uint32_t first) {
    for (const Triangle& triangle : mesh.triangles()) {
      for (const VertexId v : triangle) scene_.corners.push_back(first + v.index());
      scene_.partOfFace.push_back(lastPart());
    }
  }

  const Mesh& model_;
  RenderScene scene_;
};

std::vector<Vector3d> pointsOf(const Piece& piece, const Wire& wire) {
  std::vector<Vector3d> points;
  for (const VertexId v : wire.vertices) points.push_back(piece.mesh->position(v));
  // Both sides of a zip run upwards, so that their teeth mesh.
  if (wire.kind == WireKind::Opening && points.back().z() < points.front().z()) {
    std::ranges::reverse(points);
  }
  return points;
}

/// The upper ends of openings, where zips close.
std::vector<Vector3d> zipTops(const std::vector<Piece>& pieces) {
  std::vector<Vector3d> lows;
  std::vector<Vector3d> tops;
  for (const Piece& piece : pieces) {
    for (const Wire& wire : piece.wires) {
      if (!piece.include || wire.kind != WireKind::Opening) continue;
      const std::vector<Vector3d> points = pointsOf(piece, wire);
      lows.push_back(points.front());
      tops.push_back(points.back());
    }
  }
  // Where one opening goes on in another the slider passes.
  std::erase_if(tops, [&lows](const Vector3d& top) {
    return std::ranges::any_of(lows,
                               [&top](const Vector3d& low) { return (low - top).norm() < 1; });
  });
  return tops;
}

/// The boundary and inner wires of a piece as lines of the part that was added last.
void addWires(SceneBuilder& builder, const Piece& piece, const std::vector<char>& isSewn,
              const std::vector<Vector3d>& tops, RenderLines wanted, const Vector3d& offset) {
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (wanted == RenderLines::None || (wanted == RenderLines::Seams && !isBoundary(wire.kind))) {
      continue;
    }
    const std::vector<Vector3d> points = pointsOf(piece, wire);
    SurfaceLine line;
    line.part = builder.lastPart();
    line.role = roleOf(wire.kind, isSewn[w] != 0);
    line.plain = lineStyle(wire.kind);
    line.turned = points.front() != piece.mesh->position(wire.vertices.front());
    line.endsAtTop = std::ranges::find(tops, points.back()) != tops.end();
    for (const Vector3d& p : points) line.points.push_back((p + offset).cast<float>());
    builder.addLine(std::move(line));
  }
}

/// How far a piece stands off the model: away from its middle and outwards.
Vector3d offsetOf(const Piece& piece, const Mesh& model, double explode) {
  Vector3d centroid = Vector3d::Zero();
  Vector3d outwards = Vector3d::Zero();
  double all = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
    const double area = piece.mesh->area(FaceId(f));
    const Triangle& t = piece.mesh->vertices(FaceId(f));
    for (const VertexId v : t) centroid += area / 3 * piece.mesh->position(v);
    outwards += area * piece.mesh->normal(FaceId(f));
    all += area;
  }
  if (all <= 0) return Vector3d::Zero();
  const Vector3d middle = 0.5 * (model.boxMin() + model.boxMax());
  const double diagonal = (model.boxMax() - model.boxMin()).norm();
  return explode * (centroid / all - middle + kAlongNormal * diagonal * outwards / all);
}

}  // namespace

RenderScene makeScene(const Pattern& pattern, const RenderOptions& options) {
  const Mesh& model = *pattern.document.model->mesh;
  SceneBuilder builder(model);
  const PanelColours colours = panelColours(pattern, options.style);
  const std::vector<Piece>& pieces = pattern.cut.pieces;
  std::vector<std::vector<char>> isSewn;
  for (const Piece& piece : pieces) isSewn.emplace_back(piece.wires.size(), 0);
  for (const SeamMates& mates : pattern.cut.mates) {
    isSewn[mates.pieceA][mates.wireA] = 1;
    isSewn[mates.pieceB][mates.wireB] = 1;
  }
  const double explode = options.explode.value();
  if (explode > 0) builder.addModel(kMannequin);  // instead of what is left out
  const std::vector<Vector3d> tops = zipTops(pieces);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i].include && explode > 0) continue;
    const Vector3d offset = offsetOf(pieces[i], model, explode);
    builder.addPiece(pieces[i], colours.onModel[i], offset);
    if (pieces[i].include) {
      addWires(builder, pieces[i], isSewn[i], tops, options.lines, offset);
    }
  }
  if (explode > 0 || options.lines != RenderLines::All) return builder.finish();
  for (const PlacedCurve& curve : pattern.curves) {
    if (curve.kind != CurveKind::Mark) continue;
    builder.addLine({.role = LineRole::Mark,
                     .plain = lineStyle(CurveKind::Mark),
                     .points = pointsOf(model, curve.path)});
  }
  return builder.finish();
}

RenderScene makeScene(const ReferenceModel& model, const RenderOptions& options) {
  SceneBuilder builder(*model.mesh);
  builder.addModel(kBareModel);
  if (options.lines == RenderLines::None) return builder.finish();
  for (const auto& [name, path] : model.curves) {
    builder.addLine({.role = LineRole::Mark,
                     .plain = lineStyle(CurveKind::Mark),
                     .points = pointsOf(*model.mesh, path)});
  }
  return builder.finish();
}

/// Mean with the neighbours that face the same way: they have looked in other directions.
std::vector<Vector3f> RenderScene::smoothed(const std::vector<Vector3f>& light) const {
  std::vector<Vector3f> sum = light;
  std::vector<float> weight(light.size(), 1);
  for (std::size_t f = 0; f < modelCorners.size(); f += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = modelCorners[f + k];
      const std::uint32_t b = modelCorners[f + (k + 1) % 3];
      const float alike = std::max(0.0F, modelNormals[a].dot(modelNormals[b]));
      const float share = 0.5F * alike * alike * alike * alike;  // each edge comes twice
      sum[a] += share * light[b];
      sum[b] += share * light[a];
      weight[a] += share;
      weight[b] += share;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= weight[i];
  return sum;
}

std::vector<Vector3f> RenderScene::lightAtVertices(std::span<const Vector3f> light) const {
  std::vector<Vector3f> atModel(modelNormals.size());
  constexpr std::size_t kBlock = 512;
  const auto forBlocks = [](std::size_t count, const auto& body) {
    parallelFor((count + kBlock - 1) / kBlock, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) body(i);
    });
  };
  forBlocks(atModel.size(),
            [&](std::size_t i) { atModel[i] = irradiance(sky, i, light, modelNormals[i]); });
  for (int round = 0; round < kSmoothing; ++round) atModel = smoothed(atModel);
  std::vector<Vector3f> result(onModel.size());
  forBlocks(result.size(), [&](std::size_t i) {
    const OnModel& at = onModel[i];
    result[i] = at.weight[0] * atModel[at.vertex[0]] + at.weight[1] * atModel[at.vertex[1]] +
                at.weight[2] * atModel[at.vertex[2]];
  });
  return result;
}

}  // namespace toile
