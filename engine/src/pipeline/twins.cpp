// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/twins.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "pipeline/wire_match.h"

namespace toile {
namespace {

using Eigen::Vector3d;

Vector3d reflected(const Symmetry& symmetry, const Vector3d& p) {
  return p - 2 * (symmetry.normal.dot(p) - symmetry.offset) * symmetry.normal;
}

/// The piece on the mean of both sides of the model.
void moveToMean(const ReferenceModel& model, const std::vector<SurfacePoint>& images,
                Piece& piece) {
  std::vector<Vector3d> positions = piece.mesh->positions();
  for (std::size_t v = 0; v < positions.size(); ++v) {
    positions[v] =
        0.5 * (positions[v] + reflected(*model.symmetry, position(*model.mesh, images[v])));
  }
  auto moved = std::make_shared<const Mesh>(piece.mesh->withPositions(std::move(positions)));
  for (std::size_t f = 0; f < piece.targetSides.size(); ++f) {
    const Triangle& t = moved->vertices(FaceId(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto length = [&](const Mesh& mesh) {
        return (mesh.position(t[(k + 1) % 3]) - mesh.position(t[k])).norm();
      };
      piece.targetSides[FaceId(f)][k] *= length(*moved) / length(*piece.mesh);
    }
  }
  piece.mesh = std::move(moved);
}

/// The mesh of `original` turned over, with the wires of `twin` on it.
Result<Piece> mirrorImage(const ReferenceModel& model, const Piece& original,
                          const std::vector<SurfacePoint>& images,
                          const std::vector<std::vector<EdgeOfWire>>& originalOf, Piece twin) {
  std::vector<Vector3d> positions;
  for (const Vector3d& p : original.mesh->positions()) {
    positions.push_back(reflected(*model.symmetry, p));
  }
  std::vector<Triangle> triangles = original.mesh->triangles();
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  if (!mesh) return mesh.error();
  twin.mesh = std::make_shared<const Mesh>(*std::move(mesh));
  twin.onModel.values() = images;
  twin.sourceFace = FaceData<FaceId>(original.sourceFace.size());
  for (std::size_t f = 0; f < original.sourceFace.size(); ++f) {
    Triangle corners = model.mesh->vertices(original.sourceFace[FaceId(f)]);
    for (VertexId& v : corners) v = model.symmetry->partner[v];
    for (const FaceId face : model.mesh->facesAround(corners[0])) {
      const Triangle& t = model.mesh->vertices(face);
      if (std::is_permutation(t.begin(), t.end(), corners.begin())) {
        twin.sourceFace[FaceId(f)] = face;
      }
    }
  }
  twin.targetSides = original.targetSides;
  for (std::array<double, 3>& sides : twin.targetSides.values()) std::swap(sides[0], sides[2]);
  for (std::size_t w = 0; w < twin.wires.size(); ++w) {
    std::vector<VertexId>& vertices = twin.wires[w].vertices;
    for (std::size_t e = 0; e + 1 < vertices.size(); ++e) {
      const auto& [wire, edge, isBackward] = originalOf[w][e];
      const std::vector<VertexId>& ends = original.wires[wire].vertices;
      vertices[e] = ends[edge + (isBackward ? 1 : 0)];
      vertices[e + 1] = ends[edge + (isBackward ? 0 : 1)];
    }
  }
  return twin;
}

/// One target for each edge of the original and its image: the original's or the mean of both.
void shareTargets(TwinMode mode, const Piece& original, const Piece& twin,
                  const std::vector<std::vector<EdgeOfWire>>& originalOf, RefinedMesh& refined) {
  for (std::size_t w = 0; w < twin.wires.size(); ++w) {
    for (std::size_t e = 0; e < twin.wires[w].cutEdges.size(); ++e) {
      const EdgeOfWire& from = originalOf[w][e];
      double& theirs =
          refined.cutEdges[original.wires[from.wire].cutEdges[from.edge].index()].targetLength;
      double& own = refined.cutEdges[twin.wires[w].cutEdges[e].index()].targetLength;
      if (mode == TwinMode::Mean) theirs = 0.5 * (theirs + own);
      own = theirs;
    }
  }
}

/// @return why the two are no twins; nothing when they were made so.
std::optional<std::string> makeTwin(Pattern& pattern, RefinedMesh& refined, const Twin& wish,
                                    std::size_t originalIndex, std::size_t twinIndex) {
  const ReferenceModel& model = *pattern.document.model;
  if (!model.symmetry || model.symmetry->partner.empty()) return "the model has no left and right";
  Piece& original = pattern.cut.pieces[originalIndex];
  Piece& twin = pattern.cut.pieces[twinIndex];
  if (!original.include || !twin.include) return "one of them is left out";
  const WireMatch match(model, original, twin);
  const auto originalOf = match.find();
  if (!originalOf) {
    return "their lines are not each other's mirror images; draw one side's as `mirrorOf` the "
           "other's";
  }
  shareTargets(wish.mode, original, twin, *originalOf, refined);
  if (wish.mode == TwinMode::Mean) moveToMean(model, match.images(), original);
  Result<Piece> image = mirrorImage(model, original, match.images(), *originalOf, twin);
  if (!image) return image.error().message;
  twin = *std::move(image);
  pattern.twinOf[twinIndex] = static_cast<std::uint32_t>(originalIndex);
  return std::nullopt;
}

}  // namespace

void makeTwins(Pattern& pattern) {
  const Design& design = *pattern.document.design;
  pattern.twinOf.clear();
  if (std::none_of(design.pieces.begin(), design.pieces.end(),
                   [](const PieceRecord& record) { return record.twin.has_value(); })) {
    return;
  }
  std::vector<Piece>& pieces = pattern.cut.pieces;
  pattern.twinOf.assign(pieces.size(), std::nullopt);
  const auto refined = std::make_shared<RefinedMesh>(*pattern.cut.refined);
  for (const PieceRecord& record : design.pieces) {
    if (!record.twin) continue;
    const auto indexOf = [&](const std::string& id) {
      return static_cast<std::size_t>(
          std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.id == id; }) -
          pieces.begin());
    };
    const std::size_t original = indexOf(record.twin->of), twin = indexOf(record.id);
    std::optional<std::string> why = "one of them has no region of its own";
    if (original < pieces.size() && twin < pieces.size()) {
      why = pattern.twinOf[original]
                ? std::optional<std::string>("the other is a twin itself; name its original")
                : makeTwin(pattern, *refined, *record.twin, original, twin);
    }
    if (!why) continue;
    pattern.findings.push_back(
        {"no-twins",
         fmt::format("pieces \"{}\" and \"{}\" stay true to their own sides: {}", record.twin->of,
                     record.id, *why),
         {Element::piece(record.twin->of), Element::piece(record.id)}});
  }
  copyTargets(*refined, pieces);
  pattern.cut.refined = refined;
}

FlatPiece mirrorImage(const FlatPiece& flat) {
  FlatPiece image = flat;
  for (Eigen::Vector2d& p : image.position.values()) p.x() = -p.x();
  return image;
}

}  // namespace toile
