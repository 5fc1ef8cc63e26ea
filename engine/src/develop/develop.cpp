// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/develop/develop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "develop/shape.h"

namespace toile {
namespace {

using namespace developing;
using Eigen::Vector3d;

/// Values of t that are tried one after the other; more area error at a greater t is possible.
constexpr int kScans = 10;
/// Halvings of the interval that holds the smallest t.
constexpr int kHalvings = 5;
/// Mean area error that nobody would ask to lessen.
constexpr double kNearlyFlat = 2e-3;

Result<void> checkOptions(const DevelopOptions& options) {
  const auto refuse = [](const char* name, double value, const char* range) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} is {}; it must lie in {}", name, value, range),
                 {}};
  };
  if (!(options.amount >= 0 && options.amount <= 1)) {
    return refuse("the amount t", options.amount, "0..1");
  }
  if (options.maxAreaError && !(options.maxAreaError->value() > 0)) {
    return refuse("the greatest mean area error", options.maxAreaError->value(),
                  "0..1, 0 excluded");
  }
  if (!(options.gap.mm() >= 0 && options.gap.mm() <= 1000)) {
    return refuse("the gap in mm", options.gap.mm(), "0..1000");
  }
  if (options.maxSteps < 0) return refuse("the number of steps", options.maxSteps, "0 and more");
  return {};
}

/// The piece in another shape: wires inside it take over its lengths, in their share of the
/// target, those of the boundary stay.
Piece inShape(const Piece& piece, const Positions& at) {
  Piece shaped = piece;
  shaped.mesh = std::make_shared<const Mesh>(piece.mesh->withPositions(at));
  for (Wire& wire : shaped.wires) {
    for (std::size_t i = 0; i < wire.targetLength.size(); ++i) {
      const EdgeId edge = piece.mesh->findEdge(wire.vertices[i], wire.vertices[i + 1]);
      if (piece.mesh->isBorder(edge)) continue;
      const double length = shaped.mesh->length(edge), before = piece.mesh->length(edge);
      if (length != before) wire.targetLength[i] *= length / before;
    }
  }
  if (!piece.targetSides.empty()) {
    for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const EdgeId edge = piece.mesh->edge(piece.mesh->halfedge(FaceId(f), k));
        shaped.targetSides[FaceId(f)][static_cast<std::size_t>(k)] *=
            shaped.mesh->length(edge) / piece.mesh->length(edge);
      }
    }
  }
  return shaped;
}

/// One t: the piece there and its plane.
struct Trial {
  double amount = 0;
  Piece piece;
  std::shared_ptr<const FlatPiece> flat;
};

class Interpolation {
 public:
  Interpolation(const Piece& piece, const DevelopOptions& options, Positions end)
      : piece_(piece), options_(options), end_(std::move(end)) {}

  Result<Trial> at(double amount, Progress* progress) const {
    Trial trial{amount, piece_, nullptr};
    if (amount > 0) trial.piece = inShape(piece_, positions(amount));
    Result<FlatPiece> flat = unfold(trial.piece, options_.unfold, progress);
    if (!flat) return flat.error();
    trial.flat = std::make_shared<const FlatPiece>(*std::move(flat));
    return trial;
  }

  /// The smallest t found whose error is small enough, else the one of least error.
  Result<Trial> search(Trial first, double limit, Progress* progress) const {
    const auto isEnough = [&](const Trial& t) {
      return t.flat->check.passes() && t.flat->meanAreaError <= limit;
    };
    if (isEnough(first)) return first;
    Trial best = first;
    double low = 0;
    for (int i = 1; i <= kScans; ++i) {
      Result<Trial> trial = at(static_cast<double>(i) / kScans, progress);
      if (!trial) return trial;
      if (!isEnough(*trial)) {
        low = trial->amount;
        if (trial->flat->meanAreaError < best.flat->meanAreaError) best = *std::move(trial);
        continue;
      }
      best = *std::move(trial);
      for (int halving = 0; halving < kHalvings; ++halving) {
        Result<Trial> middle = at(0.5 * (low + best.amount), progress);
        if (!middle) return middle;
        if (isEnough(*middle)) {
          best = *std::move(middle);
        } else {
          low = middle->amount;
        }
      }
      return best;
    }
    return best;
  }

 private:
  [[nodiscard]] Positions positions(double amount) const {
    if (amount == 1) return end_;
    Positions at = piece_.mesh->positions();
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at[i] != end_[i]) at[i] += amount * (end_[i] - at[i]);
    }
    if (options_.outsideOf) pushOutside(*piece_.mesh, *options_.outsideOf, options_.gap.mm(), at);
    return at;
  }

  const Piece& piece_;
  const DevelopOptions& options_;
  Positions end_;
};

double sum(const std::vector<double>& lengths) {
  double total = 0;
  for (const double length : lengths) total += length;
  return total;
}

DevelopReport makeReport(const Piece& piece, const FlatPiece& flatBefore, const Trial& trial,
                         const DevelopOptions& options) {
  DevelopReport report;
  const Mesh& before = *piece.mesh;
  const Mesh& after = *trial.piece.mesh;
  report.errorBefore = flatBefore.meanAreaError;
  report.errorAgainstProcessed = trial.flat->meanAreaError;
  report.errorAgainstOriginal = meanAreaError(piece, *trial.flat);
  const auto measure = [](const Mesh& mesh, double& greatest, double& total) {
    const VertexData<double> defects = angleDefects(mesh);
    for (const double defect : defects.values()) {
      greatest = std::max(greatest, std::abs(defect));
      total += std::abs(defect);
    }
  };
  measure(before, report.maxDefectBefore, report.totalDefectBefore);
  measure(after, report.maxDefect, report.totalDefect);
  report.roughnessBefore = roughness(before, before.positions());
  report.roughness = roughness(after, after.positions());
  for (std::size_t f = 0; f < before.faceCount(); ++f) {
    const Vector3d a = before.normal(FaceId(f)), b = after.normal(FaceId(f));
    report.maxNormalTurn = std::max(report.maxNormalTurn, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  for (std::size_t v = 0; v < before.vertexCount(); ++v) {
    report.maxMove =
        std::max(report.maxMove, (after.positions()[v] - before.positions()[v]).norm());
  }
  for (std::size_t w = 0; w < piece.wires.size(); ++w) {
    const Wire& wire = piece.wires[w];
    if (isBoundary(wire.kind)) continue;
    const FeatureChange change{wire.curve, wire.part, sum(wire.targetLength),
                               sum(trial.piece.wires[w].targetLength)};
    report.maxFeatureChange =
        std::max(report.maxFeatureChange, std::abs(change.after / change.before - 1));
    report.features.push_back(change);
  }
  if (options.outsideOf) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < after.vertexCount(); ++v) {
      if (after.isBorder(VertexId(v))) continue;
      least = std::min(least, signedDistance(*options.outsideOf, after.positions()[v]));
    }
    report.clearance = least;
  }
  return report;
}

std::string whyStopped(ShapeEnd end) {
  switch (end) {
    case ShapeEnd::Developable:
      return "";
    case ShapeEnd::Rough:
      return "it would crease";
    case ShapeEnd::Turned:
      return "a face would turn by more than 60 degrees";
    case ShapeEnd::Stretched:
      return "an edge would change by more than 30 %";
    case ShapeEnd::Stuck:
      return "with its boundary held it can get no nearer to a developable surface";
    case ShapeEnd::StepLimit:
      return "the limit of steps was reached";
    case ShapeEnd::Cancelled:
      return "it was cancelled";
  }
  return "";
}

}  // namespace

VertexData<double> angleDefects(const Mesh& mesh) {
  const FreeVertices inner(mesh);
  const Eigen::VectorXd defect = defects(mesh, inner, mesh.positions());
  VertexData<double> all(mesh.vertexCount(), 0.0);
  for (Eigen::Index i = 0; i < inner.count(); ++i) {
    all[inner.vertices[static_cast<std::size_t>(i)]] = defect[i];
  }
  return all;
}

double meanAreaError(const Piece& piece, const FlatPiece& flat) {
  const Mesh& mesh = *piece.mesh;
  double error = 0, total = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    const Eigen::Vector2d u = flat.position[t[1]] - flat.position[t[0]];
    const Eigen::Vector2d w = flat.position[t[2]] - flat.position[t[0]];
    const double area = areaOf(targetSides(piece, FaceId(f)));
    error += std::abs(0.5 * (u.x() * w.y() - u.y() * w.x()) - area);
    total += area;
  }
  return error / total;
}

Result<DevelopedPiece> develop(const Piece& piece, const DevelopOptions& options,
                               Progress* progress) {
  if (const Result<void> valid = checkOptions(options); !valid) return valid.error();
  const Interpolation none(piece, options, piece.mesh->positions());
  Result<Trial> before = none.at(0, progress);
  if (!before) return before.error();

  DevelopedPiece developed;
  const auto isEnough = [&](const FlatPiece& flat) {
    return options.maxAreaError && flat.check.passes() &&
           flat.meanAreaError <= options.maxAreaError->value();
  };
  const std::shared_ptr<const FlatPiece> flatBefore = before->flat;
  Trial chosen = *before;
  const bool wanted = options.maxAreaError ? !isEnough(*flatBefore) : options.amount > 0;
  if (wanted) {
    Shape shape = findDevelopableShape(*piece.mesh, options, progress);
    if (shape.end == ShapeEnd::Cancelled) return Error{ErrorCode::Cancelled, "stopped", {}};
    const Interpolation way(piece, options, std::move(shape.at));
    Result<Trial> found = options.maxAreaError ? way.search(*std::move(before),
                                                            options.maxAreaError->value(), progress)
                                               : way.at(options.amount, progress);
    if (!found) return found.error();
    chosen = *std::move(found);
    if (options.maxAreaError && !isEnough(*chosen.flat)) {
      developed.findings.push_back(
          {"develop-over-limit",
           fmt::format("the surface cannot be processed to {:.3g} % area error: {:.3g} % is the "
                       "least that was found, at t = {:.2f}{}{}; a dart or a seam is needed",
                       options.maxAreaError->percent(), 100 * chosen.flat->meanAreaError,
                       chosen.amount,
                       shape.end == ShapeEnd::Developable ? "" : ", since beyond it ",
                       whyStopped(shape.end)),
           {}});
    } else if (!options.maxAreaError && shape.end != ShapeEnd::Developable && options.amount == 1 &&
               chosen.flat->meanAreaError > kNearlyFlat) {
      developed.findings.push_back(
          {"develop-stopped",
           fmt::format("the surface is not developable yet, {:.2g} % area error is left: {}",
                       100 * chosen.flat->meanAreaError, whyStopped(shape.end)),
           {}});
    }
  }
  developed.report = makeReport(piece, *flatBefore, chosen, options);
  developed.amount = chosen.amount;
  developed.piece = std::move(chosen.piece);
  developed.flat = std::move(chosen.flat);
  return developed;
}

}  // namespace toile
