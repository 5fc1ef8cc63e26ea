// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/warp/warp.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "toile/core/parallel.h"
#include "warp/body_distance.h"
#include "warp/judge.h"
#include "warp/settle.h"
#include "warp/space_warp.h"

namespace toile {

using detail::BodyDistance;
using detail::EasePoint;
using detail::GirthLine;
using Eigen::Index;
using Eigen::Vector3d;

namespace {

constexpr std::size_t kCentres = 600;  ///< places of the body that the map of space goes through
/// Lengths as shares of the body's diagonal.
constexpr double kNear = 0.03;        ///< at this distance the body counts a quarter
constexpr double kAround = 0.25;      ///< median distance of what is no longer around the body
constexpr double kGuard = 0.05;       ///< nearer points are kept out of the body
constexpr double kReachMore = 0.1;    ///< beyond the product, of what the map of space is made of
constexpr double kEaseFades = 0.1;    ///< over this an ease given at a girth fades into that before
constexpr double kNoWayBack = 0.005;  ///< of a map that is to be relied on, there and back
constexpr double kLeastWeight = 0.01;
constexpr double kLeastNear = 20;                              ///< mm
constexpr double kOtherUnit = 8;                               ///< ratio of sizes
constexpr std::size_t kLeastSamples = 48, kMostSamples = 400;  ///< of a girth

double diagonal(const Mesh& mesh) {
  return (mesh.boxMax() - mesh.boxMin()).norm();
}

double quantileOf(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

class Warper {
 public:
  Warper(const ReferenceModel& product, const ReferenceModel& a, const ReferenceModel& b,
         const Correspondence& map, const WarpOptions& options, Progress* progress)
      : product_(product), a_(a), b_(b), map_(map), options_(options), progress_(progress) {}

  Result<Warp> run() {
    if (auto done = checkParts(); !done) return done.error();
    if (auto done = measureBefore(); !done) return done.error();
    if (cancelledAt("warp space")) return cancelled();
    const Result<std::vector<Vector3d>> start = followBody();
    if (!start) return start.error();
    if (cancelledAt("settle")) return cancelled();
    const auto settled =
        detail::settle(*product_.mesh, *start, *b_.index, makeWishes(*start), progress_);
    if (!settled) return cancelled();
    if (cancelledAt("judge")) return cancelled();
    Result<ReferenceModel> after =
        withMesh(product_, product_.name, product_.mesh->withPositions(*settled));
    if (!after) return after.error();
    WarpReport report =
        detail::judgeWarp({a_, b_, product_, *after, girths_, easeBefore_, easeWeight_});
    report.findings = std::move(findings_);
    return Warp{*std::move(after), std::move(report)};
  }

 private:
  [[nodiscard]] bool cancelledAt(const char* step) const {
    if (progress_ != nullptr) progress_->step(step);
    return isCancelled(progress_);
  }
  static Error cancelled() { return {ErrorCode::Cancelled, "cancelled", {}}; }

  [[nodiscard]] Result<void> checkParts() const {
    VertexData<char> isTaken(product_.mesh->vertexCount(), 0);
    for (const std::vector<VertexId>& part : options_.rigid) {
      for (const VertexId v : part) {
        if (v.index() < isTaken.size() && isTaken[v]++ == 0) continue;
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("vertex {} belongs to two rigid parts, or to none of the product",
                                 v.index()),
                     {Element::vertex(v)}};
      }
      if (part.size() >= 3) continue;
      return Error{ErrorCode::InvalidArgument, "a rigid part needs three vertices at least", {}};
    }
    return {};
  }

  Result<void> measureBefore() {
    const double size = diagonal(*a_.mesh), own = diagonal(*product_.mesh);
    if (own > kOtherUnit * size || size > kOtherUnit * own) {
      return Error{ErrorCode::UnitsMissing,
                   fmt::format("{} measures {:.4g} mm across and {} {:.4g} mm: one of them is in "
                               "another unit; give each its own",
                               product_.name, own, a_.name, size),
                   {}};
    }
    const std::vector<Vector3d>& places = product_.mesh->positions();
    std::vector<double> far;
    std::vector<Element> inside;
    std::size_t insideCount = 0;
    const double near = std::max(kLeastNear, kNear * size);
    for (const BodyDistance& distance : detail::distancesTo(*a_.index, places)) {
      const double ease = distance.value;
      if (ease < 0) {
        ++insideCount;
        if (inside.size() < 24) inside.push_back(Element::vertex(VertexId(easeBefore_.size())));
      }
      easeBefore_.push_back(ease);
      far.push_back(std::abs(ease));
      // What lies deep inside passes through the body: its distance says little.
      const double scaled = ease / (ease < 0 ? near / 4 : near);
      const double weight = 1 / std::pow(1 + scaled * scaled, 2);
      easeWeight_.push_back(weight > kLeastWeight ? weight : 0);
    }
    reach_ = quantileOf(far, 0.95);
    const double share = static_cast<double>(insideCount) / static_cast<double>(places.size());
    if (share > 0.5) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("{:.0f} % of {} lies inside {}: it does not stand around it; are "
                               "the two in the same place, and faces outward?",
                               100 * share, product_.name, a_.name),
                   std::move(inside)};
    }
    if (quantileOf(far, 0.5) > kAround * size) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("half of {} is more than {:.0f} mm away from {}: it does not stand "
                               "around it; are the two in the same place?",
                               product_.name, kAround * size, a_.name),
                   {}};
    }
    if (insideCount > 0) {
      findings_.push_back(
          {"product-crosses-body",
           fmt::format("{:.1f} % of {} lies inside {}, up to {:.1f} mm; there it may stay",
                       100 * share, product_.name, a_.name,
                       -*std::min_element(easeBefore_.begin(), easeBefore_.end())),
           std::move(inside)});
    }
    for (const WarpGirth& girth : options_.girths) girths_.push_back(lineOver(girth));
    return {};
  }

  /// The product's points nearest to a girth's.
  [[nodiscard]] GirthLine lineOver(const WarpGirth& girth) const {
    GirthLine line{
        .name = girth.name, .onA = {}, .onB = {}, .onProduct = {}, .closed = girth.path.closed};
    const double all = length(*a_.mesh, girth.path);
    const double step = detail::bendingLength(*product_.mesh) / 6;
    const auto count =
        std::clamp(static_cast<std::size_t>(all / step), kLeastSamples, kMostSamples);
    for (std::size_t i = 0; i < count; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(count);
      const SurfacePoint place = pointAtFraction(*a_.mesh, girth.path, fraction);
      const ClosestPoint over = product_.index->closestPoint(position(*a_.mesh, place));
      EasePoint point = easePoint(over.point);
      point.ease =
          girth.ease ? girth.ease->mm() : detail::distanceTo(*a_.index, over.position).value;
      line.onA.push_back(place);
      line.onB.push_back(map_.toB(place));
      line.onProduct.push_back(point);
    }
    return line;
  }
  [[nodiscard]] EasePoint easePoint(const SurfacePoint& point) const {
    const Mesh& mesh = *product_.mesh;
    const FaceId face = commonFace(mesh, point, point);
    EasePoint made;
    for (std::size_t k = 0; k < 3; ++k) made.corners[k] = mesh.vertices(face)[k].index();
    made.weights = barycentricIn(mesh, point, face);
    return made;
  }

  /// The product's vertices where the map of space brings them.
  Result<std::vector<Vector3d>> followBody() const {
    const Mesh& body = *a_.mesh;
    const double reach = 2 * reach_ + kReachMore * diagonal(body);
    std::vector<VertexId> near;
    std::vector<Vector3d> places;
    for (std::size_t v = 0; v < body.vertexCount(); ++v) {
      const Vector3d& p = body.position(VertexId(v));
      const Vector3d beyond = (product_.mesh->boxMin() - p).cwiseMax(p - product_.mesh->boxMax());
      if (beyond.maxCoeff() > reach) continue;
      if (product_.index->closestPoint(p).distance > reach) continue;
      near.emplace_back(v);
      places.push_back(p);
    }
    std::vector<VertexId> centres;
    for (const std::size_t i : detail::farthestPoints(places, kCentres)) {
      centres.push_back(near[i]);
    }
    if (a_.symmetry && !a_.symmetry->partner.empty()) {
      const std::size_t chosen = centres.size();
      for (std::size_t i = 0; i < chosen; ++i) centres.push_back(a_.symmetry->partner[centres[i]]);
      std::sort(centres.begin(), centres.end());
      centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
    }
    std::vector<Vector3d> from, to;
    for (const VertexId v : centres) {
      const SurfacePoint image = map_.toB(SurfacePoint{v});
      // Where the one body goes on beyond the end of the other there is no way back.
      const double missed = (position(body, map_.toA(image)) - body.position(v)).norm();
      if (missed > kNoWayBack * diagonal(body)) continue;
      from.push_back(body.position(v));
      to.push_back(position(*b_.mesh, image));
    }
    const auto warp = detail::SpaceWarp::through(from, to);
    if (!warp) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("{} is flat where {} is: there is no body to stand around", a_.name,
                               product_.name),
                   {}};
    }
    std::vector<Vector3d> start(product_.mesh->vertexCount());
    parallelFor(start.size(),
                [&](std::size_t v) { start[v] = (*warp)(product_.mesh->position(VertexId(v))); });
    return start;
  }

  [[nodiscard]] detail::Wishes makeWishes(const std::vector<Vector3d>& start) const {
    detail::Wishes wishes{easeBefore_, easeWeight_, {}, {}, options_.rigid};
    for (const GirthLine& girth : girths_) {
      wishes.exact.insert(wishes.exact.end(), girth.onProduct.begin(), girth.onProduct.end());
    }
    fadeGivenEase(start, wishes);
    const Mesh& mesh = *product_.mesh;
    std::vector<EasePoint> points;
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
      EasePoint middle;
      for (std::size_t k = 0; k < 3; ++k) {
        middle.corners[k] = mesh.vertices(FaceId(f))[k].index();
      }
      middle.weights = Vector3d::Constant(1.0 / 3);
      points.push_back(middle);
    }
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
      points.push_back(easePoint(SurfacePoint{VertexId(v)}));
    }
    std::vector<Vector3d> before, now;
    for (const EasePoint& point : points) {
      before.push_back(point.at(mesh.positions()));
      now.push_back(point.at(start));
    }
    const std::vector<BodyDistance> easeBefore = detail::distancesTo(*a_.index, before);
    const std::vector<BodyDistance> ease = detail::distancesTo(*b_.index, now);
    const double guard = kGuard * diagonal(*a_.mesh) + options_.leastEase.mm();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (easeBefore[i].value < 0) continue;  // passes through the body
      if (std::min(easeBefore[i].value, ease[i].value) > guard) continue;
      points[i].ease = std::min(easeBefore[i].value, options_.leastEase.mm());
      wishes.least.push_back(points[i]);
    }
    return wishes;
  }

  /// Around a girth with an ease of its own the ease goes over into what it was.
  void fadeGivenEase(const std::vector<Vector3d>& start, detail::Wishes& wishes) const {
    if (std::none_of(options_.girths.begin(), options_.girths.end(),
                     [](const WarpGirth& girth) { return girth.ease.has_value(); })) {
      return;
    }
    detail::Laplacian laplacian = detail::makeLaplacian(*product_.mesh, start);
    const double fades = kEaseFades * diagonal(*a_.mesh);
    Eigen::SparseMatrix<double> matrix = fades * fades * laplacian.matrix;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix.rows());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index v = 0; v < matrix.rows(); ++v) entries.emplace_back(v, v, laplacian.area[v]);
    const double weight = 1e3 * laplacian.area.mean();
    for (const EasePoint& point : wishes.exact) {
      double more = point.ease;
      for (std::size_t k = 0; k < 3; ++k) {
        more -= point.weights[static_cast<Index>(k)] * easeBefore_[point.corners[k]];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double own = weight * point.weights[static_cast<Index>(k)];
        right[point.corners[k]] += own * more;
        for (std::size_t l = 0; l < 3; ++l) {
          entries.emplace_back(point.corners[k], point.corners[l],
                               own * point.weights[static_cast<Index>(l)]);
        }
      }
    }
    Eigen::SparseMatrix<double> data(matrix.rows(), matrix.cols());
    data.setFromTriplets(entries.begin(), entries.end());
    matrix += data;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) return;
    const Eigen::VectorXd more = solver.solve(right);
    for (std::size_t v = 0; v < wishes.ease.size(); ++v) {
      wishes.ease[v] += more[static_cast<Index>(v)];
    }
  }

  const ReferenceModel &product_, &a_, &b_;
  const Correspondence& map_;
  const WarpOptions& options_;
  Progress* progress_;
  std::vector<double> easeBefore_, easeWeight_;  ///< per vertex of the product
  std::vector<GirthLine> girths_;
  std::vector<Finding> findings_;
  double reach_ = 0;  ///< mm; most of the product is nearer to the body
};

}  // namespace

Result<Warp> warpProduct(const ReferenceModel& product, const ReferenceModel& a,
                         const ReferenceModel& b, const Correspondence& map,
                         const WarpOptions& options, Progress* progress) {
  return Warper(product, a, b, map, options, progress).run();
}

}  // namespace toile
