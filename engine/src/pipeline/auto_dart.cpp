// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/auto_dart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/stages.h"
#include "pipeline/unfold_options.h"
#include "toile/cut/on_model.h"
#include "toile/develop/darts.h"

namespace toile {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
/// Pieces whose areas differ by less are each other's mirror images.
constexpr double kSameArea = 1e-3;
/// A dart nearer than this to the mirror plane at both ends is its own mirror image.
constexpr double kOnPlane = 5;

double areaOf(const Piece& piece) {
  double area = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) area += piece.mesh->area(FaceId(f));
  return area;
}

/// The piece that lies where the mirror image of this one does; kNone without one alike.
std::size_t mirrorPiece(const Pattern& pattern, std::size_t index) {
  const ReferenceModel& model = *pattern.document.model;
  if (!model.symmetry || model.symmetry->partner.empty()) return kNone;
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
  return kNone;
}

bool liesOnPlane(const Piece& piece, const SurfacePath& path, const Symmetry& symmetry) {
  const auto isNear = [&](const SurfacePoint& point) {
    const double offset = symmetry.normal.dot(position(*piece.mesh, point)) - symmetry.offset;
    return std::abs(offset) < kOnPlane;
  };
  return isNear(path.points.front()) && isNear(path.points.back());
}

}  // namespace

Result<bool> addProposedDarts(Pattern& pattern, const Symmetries& symmetries,
                              const MakeOptions& options, const PatternCache& cache,
                              std::vector<Finding>& findings, Progress* progress) {
  const ReferenceModel& model = *pattern.document.model;
  Design design = *pattern.document.design;
  std::set<std::string> taken;
  for (const StylingCurve& curve : design.curves) taken.insert(curve.id);
  const auto freeId = [&taken](const std::string& wanted) {
    std::string id = wanted;
    for (int n = 2; !taken.insert(id).second; ++n) id = fmt::format("{}-{}", wanted, n);
    return id;
  };
  bool added = false;
  std::set<std::size_t> done;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    const std::optional<Ratio> limit = options.autoDart->of(*pattern.document.design, piece.id);
    if (!piece.include || done.contains(i) || !limit) continue;
    const auto known = cache.entries.find(
        stages::cacheKey(pattern, i, symmetryOf(pattern, symmetries, i), options));
    if (known == cache.entries.end() || !known->second.flat) continue;
    const FlatPiece& flat = *known->second.flat;
    if (flat.meanAreaError <= limit->value() && flat.check.crossings == 0) continue;
    if (progress != nullptr) progress->step("look for a dart in " + piece.name);
    const UnfoldOptions own = unfoldOptionsOf(*pattern.document.design, piece, options.unfold);
    const auto proposals = adviseDarts(piece, flat, {.unfold = own, .limit = limit}, progress);
    if (!proposals) return proposals.error().during("piece \"" + piece.name + "\"");
    if (proposals->empty()) {
      findings.push_back(
          {"no-dart-helps",
           fmt::format("piece \"{}\": {:.2f} % mean area error is left where {:.3g} % "
                       "is wanted; no dart or cut helps by a tenth",
                       piece.name, 100 * flat.meanAreaError, limit->percent()),
           {Element::piece(piece.id)}});
      continue;
    }
    const DartProposal& best = proposals->front();
    const bool isDart = best.kind == DartProposal::Kind::Dart;
    const char* const kind = isDart ? "dart" : "seam";
    std::vector<SurfacePath> paths = best.companions;
    paths.insert(paths.begin(), best.path);
    const std::size_t mirror = mirrorPiece(pattern, i);
    const bool isMirrored = mirror != kNone && !done.contains(mirror) &&
                            (mirror != i || (!best.isSymmetric && best.companions.empty() &&
                                             !liesOnPlane(piece, best.path, *model.symmetry)));
    std::vector<std::string> ids;
    for (const SurfacePath& path : paths) {
      ids.push_back(freeId(fmt::format("auto{}-{}", kind, piece.id)));
      design.curves.push_back(makeCurveOnModel(piece, *model.mesh, path.points, ids.back(),
                                               "proposed for " + piece.name,
                                               isDart ? CurveKind::Dart : CurveKind::Seam));
      if (!isMirrored) continue;
      StylingCurve image;
      image.id = freeId(fmt::format("auto{}-{}", kind, pattern.cut.pieces[mirror].id));
      image.name = "proposed for " + pattern.cut.pieces[mirror].name;
      image.kind = design.curves.back().kind;
      image.mirrorOf = ids.back();
      design.curves.push_back(std::move(image));
      done.insert(mirror);
    }
    added = true;
    findings.push_back(
        {"auto-dart",
         fmt::format("piece \"{}\": \"{}\"{}: {}; mean area error {:.2f} -> {:.2f} %", piece.name,
                     fmt::join(ids, "\", \""), isMirrored ? " and its mirror image" : "",
                     describe(best), 100 * best.errorBefore, 100 * best.errorAfter),
         {Element::piece(piece.id), Element::curve(ids.front())}});
  }
  if (added) pattern.document.design = std::make_shared<const Design>(std::move(design));
  return added;
}

}  // namespace toile
