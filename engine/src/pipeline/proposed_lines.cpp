// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/proposed_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "toile/cut/on_model.h"

namespace toile {
namespace {

/// Pieces whose areas differ by less are each other's mirror images.
constexpr double kSameArea = 1e-3;
/// A dart nearer than this to the mirror plane at both ends is its own mirror image.
constexpr double kOnPlane = 5;

double areaOf(const Piece& piece) {
  double area = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) area += piece.mesh->area(FaceId(f));
  return area;
}

/// The piece that lies where the mirror image of this one does; nothing without one alike.
std::optional<std::size_t> mirrorPiece(const Pattern& pattern, std::size_t index) {
  const ReferenceModel& model = *pattern.document.model;
  if (!model.symmetry || model.symmetry->partner.empty()) return std::nullopt;
  const Piece& piece = pattern.cut.pieces[index];
  std::set<std::array<std::uint32_t, 3>> mirrored;
  for (const FaceId f : piece.sourceFace.values()) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = model.symmetry->partner[model.mesh->vertices(f)[k]].index();
    }
    std::sort(corners.begin(), corners.end());
    mirrored.insert(corners);
  }
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& other = pattern.cut.pieces[i];
    if (!other.include) continue;
    std::size_t inside = 0;
    for (const FaceId f : other.sourceFace.values()) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = model.mesh->vertices(f)[k].index();
      std::sort(corners.begin(), corners.end());
      inside += mirrored.count(corners);
    }
    const double area = areaOf(piece);
    if (2 * inside > other.sourceFace.size() && std::abs(areaOf(other) - area) < kSameArea * area) {
      return i;
    }
  }
  return std::nullopt;
}

bool liesOnPlane(const Piece& piece, const SurfacePath& path, const Symmetry& symmetry) {
  const auto isNear = [&](const SurfacePoint& point) {
    const double offset = symmetry.normal.dot(position(*piece.mesh, point)) - symmetry.offset;
    return std::abs(offset) < kOnPlane;
  };
  return isNear(path.points.front()) && isNear(path.points.back());
}

}  // namespace

std::string freeCurveId(const Design& design, const std::string& wanted) {
  const auto isTaken = [&design](const std::string& id) {
    return std::ranges::any_of(design.curves, [&](const auto& curve) { return curve.id == id; });
  };
  std::string id = wanted;
  for (int n = 2; isTaken(id); ++n) id = fmt::format("{}-{}", wanted, n);
  return id;
}

AddedLines addLines(Design& design, const Pattern& pattern, std::size_t index,
                    const DartProposal& proposal, const std::set<std::size_t>& done) {
  const ReferenceModel& model = *pattern.document.model;
  const Piece& piece = pattern.cut.pieces[index];
  const bool isDart = proposal.kind == DartProposal::Kind::Dart;
  const char* const kind = isDart ? "dart" : "seam";
  std::vector<SurfacePath> paths = proposal.companions;
  paths.insert(paths.begin(), proposal.path);
  const std::optional<std::size_t> mirror = mirrorPiece(pattern, index);
  const bool isMirrored =
      mirror && !done.contains(*mirror) &&
      (*mirror != index || (!proposal.isSymmetric && proposal.companions.empty() &&
                            !liesOnPlane(piece, proposal.path, *model.symmetry)));
  AddedLines lines;
  if (isMirrored) lines.alsoOn = mirror;
  for (const SurfacePath& path : paths) {
    lines.ids.push_back(freeCurveId(design, fmt::format("auto{}-{}", kind, piece.id)));
    design.curves.push_back(makeCurveOnModel(piece, *model.mesh, path.points, lines.ids.back(),
                                             "proposed for " + piece.name,
                                             isDart ? CurveKind::Dart : CurveKind::Seam));
    if (!isMirrored) continue;
    const Piece& other = pattern.cut.pieces[*mirror];
    StylingCurve image;
    image.id = freeCurveId(design, fmt::format("auto{}-{}", kind, other.id));
    image.name = "proposed for " + other.name;
    image.kind = design.curves.back().kind;
    image.mirrorOf = lines.ids.back();
    design.curves.push_back(std::move(image));
  }
  return lines;
}

}  // namespace toile
