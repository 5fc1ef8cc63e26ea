// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/cut/records.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace toile {
namespace {

using Corner = Eigen::Vector2d;  // weights of a model face's second and third corner
using FlatTriangle = std::array<Corner, 3>;

FlatTriangle inSourceFace(const Piece& piece, const Mesh& model, FaceId f) {
  FlatTriangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const SurfacePoint& corner = piece.onModel[piece.mesh->vertices(f)[k]];
    triangle[k] = barycentricIn(model, corner, piece.sourceFace[f]).tail<2>();
  }
  return triangle;
}

double side(const Corner& a, const Corner& b, const Corner& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

/// Part of the face that both triangles cover (Sutherland and Hodgman's clipping).
double overlap(const FlatTriangle& clipped, const FlatTriangle& clip) {
  std::vector<Corner> polygon(clipped.begin(), clipped.end());
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    const Corner& a = clip[k];
    const Corner& b = clip[(k + 1) % 3];
    std::vector<Corner> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner& p = polygon[i];
      const Corner& q = polygon[(i + 1) % polygon.size()];
      const double atP = side(a, b, p);
      const double atQ = side(a, b, q);
      if (atP >= 0) inside.push_back(p);
      if ((atP >= 0) != (atQ >= 0)) inside.push_back(p + (atP / (atP - atQ)) * (q - p));
    }
    polygon = std::move(inside);
  }
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += side(polygon[0], polygon[i - 1], polygon[i]);
  }
  return twice;
}

struct Part {
  std::size_t piece = 0;
  FaceId face;
};

/// The faces of all pieces by the model face that holds them.
std::vector<std::vector<Part>> partsOfFaces(const CutResult& cut, const Mesh& model) {
  std::vector<std::vector<Part>> parts(model.faceCount());
  for (std::size_t p = 0; p < cut.pieces.size(); ++p) {
    const Piece& piece = cut.pieces[p];
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      parts[piece.sourceFace[FaceId(f)].index()].push_back({p, FaceId(f)});
    }
  }
  return parts;
}

/// For each old piece, mm^2 of each new piece that lies on it.
std::vector<std::map<std::size_t, double>> overlaps(const CutResult& oldCut,
                                                    const CutResult& newCut, const Mesh& model) {
  const auto oldParts = partsOfFaces(oldCut, model);
  const auto newParts = partsOfFaces(newCut, model);
  std::vector<std::map<std::size_t, double>> shared(oldCut.pieces.size());
  for (std::size_t i = 0; i < model.faceCount(); ++i) {
    const double area = model.area(FaceId(i));
    if (oldParts[i].size() == 1 && newParts[i].size() == 1) {
      shared[oldParts[i][0].piece][newParts[i][0].piece] += area;
      continue;
    }
    for (const Part& was : oldParts[i]) {
      const FlatTriangle old = inSourceFace(oldCut.pieces[was.piece], model, was.face);
      for (const Part& is : newParts[i]) {
        const FlatTriangle now = inSourceFace(newCut.pieces[is.piece], model, is.face);
        shared[was.piece][is.piece] += area * overlap(old, now);
      }
    }
  }
  return shared;
}

/// By vertex, mm along mesh edges from the boundary.
VertexData<double> distanceFromBoundary(const Mesh& mesh) {
  using Entry = std::pair<double, VertexId>;
  VertexData<double> distance(mesh.vertexCount(), std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    if (!mesh.isBorder(VertexId(v))) continue;
    distance[VertexId(v)] = 0;
    open.emplace(0.0, VertexId(v));
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    for (const FaceId f : mesh.facesAround(v)) {
      for (const VertexId next : mesh.vertices(f)) {
        const double reached = d + (mesh.position(next) - mesh.position(v)).norm();
        if (reached >= distance[next]) continue;
        distance[next] = reached;
        open.emplace(reached, next);
      }
    }
  }
  return distance;
}

/// The piece to which each record of a cut belongs.
std::map<std::string, std::size_t> piecesOfRecords(const Design& design, const CutResult& cut) {
  std::map<std::string, std::size_t> pieces;
  for (std::size_t p = 0; p < cut.pieces.size(); ++p) {
    for (const int r : cut.pieces[p].recordIndices) {
      pieces.emplace(design.pieces[static_cast<std::size_t>(r)].id, p);
    }
  }
  return pieces;
}

std::vector<std::string> boundingCurves(const Piece& piece) {
  std::vector<std::string> ids;
  for (const Wire& wire : piece.wires) {
    if (isBoundary(wire.kind)) ids.push_back(wire.curve);
  }
  return ids;
}

}  // namespace

SurfacePoint inmostPoint(const Piece& piece, const Mesh& model) {
  const Mesh& mesh = *piece.mesh;
  const VertexData<double> distance = distanceFromBoundary(mesh);
  FaceId best;
  std::pair<double, double> bestDepth{-1, -1};
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const FaceId f(i);
    const auto& [a, b, c] = mesh.vertices(f);
    const double depth = (distance[a] + distance[b] + distance[c]) / 3;
    const std::pair<double, double> candidate{depth, mesh.area(f)};
    if (candidate <= bestDepth) continue;
    best = f;
    bestDepth = candidate;
  }
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  for (const VertexId v : mesh.vertices(best)) {
    weights += barycentricIn(model, piece.onModel[v], piece.sourceFace[best]) / 3;
  }
  return makeSurfacePoint(model, piece.sourceFace[best], weights);
}

Result<Design> followRecords(const Design& oldDesign, const CutResult& oldCut,
                             const Design& newDesign, const CutResult& newCut,
                             const ReferenceModel& model) {
  const Mesh& mesh = *model.mesh;
  for (const CutResult* cut : {&oldCut, &newCut}) {
    for (const Piece& piece : cut->pieces) {
      for (const FaceId f : piece.sourceFace.values()) {
        if (f.index() < mesh.faceCount()) continue;
        return Error{ErrorCode::ModelMismatch,
                     "the cuts were made on another model than the one given",
                     {Element::piece(piece.id)}};
      }
    }
  }
  const auto oldPieces = piecesOfRecords(oldDesign, oldCut);
  const auto newPieces = piecesOfRecords(newDesign, newCut);
  const auto shared = overlaps(oldCut, newCut, mesh);
  Design design = newDesign;
  std::vector<bool> isTaken(newCut.pieces.size(), false);
  for (PieceRecord& record : design.pieces) {
    const auto was = oldPieces.find(record.id);
    const auto is = newPieces.find(record.id);
    if (was == oldPieces.end() || is == newPieces.end()) continue;
    const auto& candidates = shared[was->second];
    const auto most =
        std::max_element(candidates.begin(), candidates.end(),
                         [](const auto& l, const auto& r) { return l.second < r.second; });
    if (most == candidates.end()) continue;
    const bool isFirst = !isTaken[most->first];
    isTaken[most->first] = true;
    const Piece& target = newCut.pieces[most->first];
    const bool liesThere = is->second == most->first;
    if (liesThere && (!isFirst || contentHash(target) == contentHash(oldCut.pieces[was->second]))) {
      continue;
    }
    record.anchor = toModelPoint(mesh, inmostPoint(target, mesh));
    if (!record.boundary.empty()) record.boundary = boundingCurves(target);
  }
  return design;
}

}  // namespace toile
