// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/triangle_energy.h"

#include <cmath>

#include "unfold/cloth_energy.h"
#include "unfold/strain_energy.h"

namespace toile::unfolding {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Vector2 = Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

PlaneMap mapOf(const RestTriangle& triangle, const Plane& q) {
  PlaneMap f;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Index v = 2 * Eigen::Index{triangle.vertex[static_cast<std::size_t>(k)]};
    const Vector2& g = triangle.hatGradient[static_cast<std::size_t>(k)];
    f.xx += q[v] * g.x();
    f.xy += q[v] * g.y();
    f.yx += q[v + 1] * g.x();
    f.yy += q[v + 1] * g.y();
  }
  return f;
}

std::array<double, 2> singularValues(const PlaneMap& f) {
  const double e = f.xx + f.yy, h = f.yx - f.xy, d = f.xx - f.yy, g = f.yx + f.xy;
  const double q = 0.5 * std::sqrt(e * e + h * h);
  const double p = 0.5 * std::sqrt(d * d + g * g);
  return {q + p, q - p};
}

TriangleEnergy::TriangleEnergy(const Problem& problem, const BlockPattern& pattern)
    : problem_(&problem) {
  places_.reserve(problem.triangles.size());
  for (const RestTriangle& t : problem.triangles) {
    places_.push_back({pattern.find(t.vertex[0], t.vertex[1]),
                       pattern.find(t.vertex[1], t.vertex[2]),
                       pattern.find(t.vertex[2], t.vertex[0])});
  }
}

void TriangleEnergy::add(std::size_t triangle, const Matrix2& byMap,
                         const Eigen::Matrix4d& hessianByMap, Eigen::VectorXd& gradient,
                         BlockMatrix& hessian) const {
  const RestTriangle& t = problem_->triangles[triangle];
  const Vector2 pull0 = byMap * t.hatGradient[0];
  const Vector2 pull1 = byMap * t.hatGradient[1];
  gradient.segment<2>(2 * Eigen::Index{t.vertex[0]}) += pull0;
  gradient.segment<2>(2 * Eigen::Index{t.vertex[1]}) += pull1;
  gradient.segment<2>(2 * Eigen::Index{t.vertex[2]}) -= pull0 + pull1;

  // Moving all three vertices changes nothing: the blocks of the third follow from the others.
  const auto byVertex = [&](std::size_t k) {
    const Vector2& g = t.hatGradient[k];
    Eigen::Matrix<double, 4, 2> columns;
    columns.col(0) = hessianByMap.col(0) * g.x() + hessianByMap.col(1) * g.y();
    columns.col(1) = hessianByMap.col(2) * g.x() + hessianByMap.col(3) * g.y();
    return columns;
  };
  const auto block = [&](std::size_t k, const Eigen::Matrix<double, 4, 2>& columns) {
    const Vector2& g = t.hatGradient[k];
    Matrix2 b;
    b.row(0) = g.x() * columns.row(0) + g.y() * columns.row(1);
    b.row(1) = g.x() * columns.row(2) + g.y() * columns.row(3);
    return b;
  };
  const Eigen::Matrix<double, 4, 2> of1 = byVertex(1);
  const Matrix2 b00 = block(0, byVertex(0));
  const Matrix2 b01 = block(0, of1);
  const Matrix2 b11 = block(1, of1);
  const Matrix2 b02 = -(b00 + b01);
  const Matrix2 b12 = -(b01.transpose() + b11);
  const Matrix2 b22 = -(b02 + b12);
  hessian.addDiagonal(t.vertex[0], b00(0, 0), b00(0, 1), b00(1, 1));
  hessian.addDiagonal(t.vertex[1], b11(0, 0), b11(0, 1), b11(1, 1));
  hessian.addDiagonal(t.vertex[2], b22(0, 0), b22(0, 1), b22(1, 1));
  hessian.add(places_[triangle][0], b01);
  hessian.add(places_[triangle][1], b12);
  hessian.add(places_[triangle][2], b02.transpose());
}

double TriangleEnergy::distanceToBorder(const Plane& q, const Plane& d) const {
  double nearest = kInfinity;
  for (const RestTriangle& t : problem_->triangles) {
    const PlaneMap f = mapOf(t, q);
    const PlaneMap g = mapOf(t, d);
    // det(F + x G) = c + b x + a x^2, c > 0.
    const double a = g.determinant();
    const double b = f.xx * g.yy + f.yy * g.xx - f.xy * g.yx - f.yx * g.xy;
    const double c = f.determinant();
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) continue;
    const double root = std::sqrt(discriminant);
    double x = kInfinity;
    if (b < 0) {
      x = 2 * c / (-b + root);
    } else if (a < 0) {
      x = (b + root) / (-2 * a);
    }
    if (x > 0) nearest = std::min(nearest, x);
  }
  return nearest;
}

std::unique_ptr<TriangleEnergy> makeStrain(const Problem& problem, const BlockPattern& pattern,
                                           const UnfoldOptions& options) {
  if (!options.cloth) return std::make_unique<StrainEnergy>(problem, pattern, options.areaWeight);
  return std::make_unique<ClothEnergy>(problem, pattern, *options.cloth, options.areaWeight);
}

}  // namespace toile::unfolding
