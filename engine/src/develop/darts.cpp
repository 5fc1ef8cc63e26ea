// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/develop/darts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "develop/dart_paths.h"
#include "develop/patch.h"

namespace toile {
namespace {

using namespace developing;

/// A dart must lower the mean area error by this share.
constexpr double kLeastHelp = 0.1;
/// What unfold() promises of the lengths of wires.
constexpr double kExactLength = 1e-9;

/// How wide the dart's mouth opens in the plane: its two boundary ends.
double intakeOf(const Piece& piece, const FlatPiece& flat, const std::string& dart) {
  std::vector<VertexId> ends;
  for (const Wire& wire : piece.wires) {
    if (wire.kind != WireKind::Dart || wire.curve != dart) continue;
    ends.push_back(wire.vertices.front());
    ends.push_back(wire.vertices.back());
  }
  // Both sides share the tip; the two other ends are the mouth's.
  std::vector<VertexId> mouth;
  for (const VertexId v : ends) {
    if (std::count(ends.begin(), ends.end(), v) == 1) mouth.push_back(v);
  }
  if (mouth.size() != 2) return 0;
  return (flat.position[mouth[0]] - flat.position[mouth[1]]).norm();
}

/// A piece that a line opens or parts, in the plane.
struct Laid {
  std::vector<FlatPiece> flats;  ///< of its parts
  double error = 0;              ///< mean area error over all of them
  std::size_t crossings = 0;
};

/// @return nothing when a part cannot be laid flat
std::optional<Laid> lay(const Piece& piece, const UnfoldOptions& options, Progress* progress) {
  const Result<std::vector<Piece>> parts = partsOf(piece);
  if (!parts) return std::nullopt;
  Laid laid;
  double total = 0;
  for (const Piece& part : *parts) {
    // The numbering of a piece in one part is kept: its ends are looked up afterwards.
    const Piece& whole = parts->size() == 1 ? piece : part;
    Result<FlatPiece> flat = unfold(whole, options, progress);
    if (!flat || flat->check.flippedFaces > 0 || flat->check.maxLengthError > kExactLength) {
      return std::nullopt;
    }
    double area = 0;
    for (std::size_t f = 0; f < whole.mesh->faceCount(); ++f) {
      area += areaOf(targetSides(whole, FaceId(f)));
    }
    laid.error += area * flat->meanAreaError;
    laid.crossings += flat->check.crossings;
    total += area;
    laid.flats.push_back(*std::move(flat));
  }
  laid.error /= total;
  return laid;
}

Result<void> checkOptions(const DartOptions& options) {
  if (options.maxProposals >= 1 && options.maxProposals <= 16 && options.tipDistance.mm() >= 0) {
    return {};
  }
  return Error{ErrorCode::InvalidArgument,
               "dart options: 1 to 16 proposals, a distance of the tip of 0 mm or more",
               {}};
}

}  // namespace

std::string describe(const DartProposal& proposal) {
  if (proposal.kind == DartProposal::Kind::Cut) {
    return fmt::format("cut or gusset, {:.0f} mm long", proposal.length);
  }
  if (!proposal.companions.empty()) {
    return fmt::format("{} darts, {:.0f} mm long together, {:.1f} mm wide at the widest mouth",
                       proposal.dartCount(), proposal.length, proposal.intake);
  }
  return fmt::format("dart, {:.0f} mm long, {:.1f} mm wide at its mouth", proposal.length,
                     proposal.intake);
}

Result<std::vector<DartProposal>> adviseDarts(const Piece& piece, const FlatPiece& flat,
                                              const DartOptions& options, Progress* progress) {
  if (const Result<void> valid = checkOptions(options); !valid) return valid.error();
  std::vector<DartProposal> proposals;
  const Patch patch = patchOf(piece);
  const auto isEnough = [&](const DartProposal& proposal) {
    return options.limit && proposal.errorAfter <= options.limit->value();
  };
  std::array<std::size_t, 2> tried{};  // darts, cuts
  for (const Candidate& candidate : findCandidates(piece, options)) {
    if (isCancelled(progress)) return Error{ErrorCode::Cancelled, "stopped", {}};
    DartProposal proposal;
    proposal.path = candidate.paths.front();
    proposal.companions.assign(candidate.paths.begin() + 1, candidate.paths.end());
    proposal.isSymmetric = candidate.isSymmetric;
    proposal.apex = candidate.apex;
    proposal.length = candidate.length;
    proposal.errorBefore = flat.meanAreaError;
    const bool isCut = candidate.bulge < 0;
    if (candidate.isStar) {
      // Few darts are better than many: those that come after one that is enough are not tried.
      if (std::any_of(proposals.begin(), proposals.end(), isEnough)) break;
    } else if (tried[isCut ? 1 : 0]++ >= options.maxProposals) {
      continue;
    }
    if (isCut) proposal.kind = DartProposal::Kind::Cut;
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < candidate.paths.size(); ++i) {
      ids.push_back(fmt::format("{}-{}", kProposal, i + 1));
    }
    const Result<Patch> with = addDarts(patch, piece, candidate.paths, ids);
    if (!with) continue;
    Result<Piece> opened = makePiece(piece.name, with->mesh, with->chains, with->targets);
    if (!opened) continue;
    takeTargetSides(piece, with->sourceFace, *opened);
    const std::optional<Laid> laid = lay(*opened, options.unfold, progress);
    if (!laid) continue;
    proposal.errorAfter = laid->error;
    for (const std::string& id : ids) {
      if (isCut) break;
      proposal.intake = std::max(proposal.intake, intakeOf(*opened, laid->flats.front(), id));
    }
    // What overlaps needs a line that opens it; strain comes second.
    const bool opens = laid->crossings < flat.check.crossings;
    const bool strainsLess =
        proposal.errorAfter < std::pow(1 - kLeastHelp, proposal.dartCount()) * proposal.errorBefore;
    if (opens || (strainsLess && laid->crossings <= flat.check.crossings)) {
      proposals.push_back(std::move(proposal));
    }
  }
  // A cut makes two pieces of one: nobody wants it where a dart does.
  const auto rank = [&](const DartProposal& p) {
    const bool enough = isEnough(p);
    const double gain = options.limit && !enough ? std::log(p.errorAfter / p.errorBefore) /
                                                       static_cast<double>(p.dartCount())
                                                 : p.errorAfter;
    return std::tuple(p.kind, !enough, enough ? p.dartCount() : 0, gain);
  };
  std::stable_sort(proposals.begin(), proposals.end(),
                   [&](const DartProposal& a, const DartProposal& b) { return rank(a) < rank(b); });
  return proposals;
}

Result<AutoDart> autoDart(Patch patch, const std::string& name, Ratio limit,
                          const DartOptions& options, int maxDarts, Progress* progress) {
  DartOptions wanted = options;
  wanted.limit = limit;
  wanted.unfold.keepApart = false;  // a piece that lies on itself shall get a dart
  Result<Piece> piece = makePiece(name, patch.mesh, patch.chains, patch.targets);
  if (!piece) return piece.error();
  Result<ForcedError> forced = measureForcedError(*piece);
  if (!forced) return forced.error();
  Result<FlatPiece> flat = unfold(*piece, wanted.unfold, progress);
  if (!flat) return flat.error();
  AutoDart made{std::move(patch), *std::move(piece), nullptr, {}, *forced, flat->meanAreaError, {}};

  const auto stopBecause = [&](const char* code, const std::string& why) {
    made.findings.push_back(
        {code,
         fmt::format("{:.2f} % mean area error is left where {:.3g} % is wanted{}: {}",
                     100 * flat->meanAreaError, limit.percent(),
                     flat->check.crossings > 0 ? ", and it lies on itself" : "", why),
         {}});
  };
  std::size_t darts = 0;
  while (flat->meanAreaError > limit.value() || flat->check.crossings > 0) {
    if (static_cast<int>(darts) >= maxDarts) {
      stopBecause("dart-limit", fmt::format("{} darts are in already", darts));
      break;
    }
    const auto proposals = adviseDarts(made.piece, *flat, wanted, progress);
    if (!proposals) return proposals.error();
    if (proposals->empty()) {
      stopBecause("no-dart-helps",
                  "no further dart helps by a tenth; part the piece by a seam, or let it be "
                  "processed (toile develop)");
      break;
    }
    const DartProposal& best = proposals->front();
    if (best.kind == DartProposal::Kind::Cut) {
      stopBecause(
          "needs-cut",
          "cloth is missing there (a saddle), where a dart would overlap: part the piece by "
          "a seam or sew in a gusset; " +
              describe(best));
      break;
    }
    std::vector<SurfacePath> paths = best.companions;
    paths.insert(paths.begin(), best.path);
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < paths.size(); ++i)
      ids.push_back(fmt::format("autodart-{}", ++darts));
    Result<Patch> with = addDarts(made.patch, made.piece, paths, ids);
    if (!with) return with.error();
    Result<Piece> opened = makePiece(name, with->mesh, with->chains, with->targets);
    if (!opened) return opened.error();
    Result<FlatPiece> after = unfold(*opened, wanted.unfold, progress);
    if (!after) return after.error();
    made.findings.push_back(
        {"auto-dart",
         fmt::format("\"{}\": {}; mean area error {:.2f} -> {:.2f} %", fmt::join(ids, "\", \""),
                     describe(best), 100 * flat->meanAreaError, 100 * after->meanAreaError),
         {Element::curve(ids.front())}});
    made.darts.push_back(best);
    made.patch = *std::move(with);
    made.piece = *std::move(opened);
    flat = std::move(after);
  }
  if (flat->check.crossings > 0 && options.unfold.keepApart) {
    flat = unfold(made.piece, options.unfold, progress);
    if (!flat) return flat.error();
  }
  made.flat = std::make_shared<const FlatPiece>(*std::move(flat));
  return made;
}

}  // namespace toile
