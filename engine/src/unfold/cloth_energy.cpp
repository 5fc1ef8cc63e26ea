// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/cloth_energy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

// Notation: a, b = unit directions along and across the grain in the triangle's plane, u = F a,
// v = F b their images, s = u.v, J = det F. A direction w of the plane moved along a is the vector
// w a^T by the numbers of F, row by row.
namespace toile::unfolding {
namespace {

using Vector2 = Eigen::Vector2d;
using Vector4 = Eigen::Vector4d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of the area price, so that triangles cannot fold.
constexpr double kLeastAreaPrice = 0.3;
constexpr double kBeyondLimit = 100;
/// An axis that stands on a face more upright than this says nothing of directions in it.
constexpr double kAcross = 1e-3;

Vector4 outer(const Vector2& w, const Vector2& a) {
  return {w.x() * a.x(), w.x() * a.y(), w.y() * a.x(), w.y() * a.y()};
}

Vector2 leftOf(const Vector2& v) {
  return {-v.y(), v.x()};
}

double limitOf(const std::optional<Ratio>& limit) {
  return limit ? limit->value() : kInfinity;
}

}  // namespace

std::vector<Vector2> grainOf(const Problem& problem, const std::vector<Eigen::Vector3d>& positions,
                             const Grain& grain) {
  const Eigen::Rotation2Dd turn(grain.turn.radians());
  const auto first = static_cast<Eigen::Index>(grain.along);
  std::vector<Vector2> directions;
  directions.reserve(problem.triangles.size());
  for (const RestTriangle& t : problem.triangles) {
    Vector2 along(1, 0);
    for (const Eigen::Index axis : {first, (first + 2) % 3, (first + 1) % 3}) {
      // grad(axis . x) in the face is the axis' part in the face, in the face's frame.
      Vector2 inFace = Vector2::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        inFace += (positions[t.vertex[k]] - positions[t.vertex[0]])[axis] * t.hatGradient[k];
      }
      if (inFace.norm() < kAcross) continue;
      along = inFace.normalized();
      break;
    }
    directions.push_back(turn * along);
  }
  return directions;
}

ClothEnergy::ClothEnergy(const Problem& problem, const BlockPattern& pattern, const Cloth& cloth,
                         double areaWeight)
    : TriangleEnergy(problem, pattern),
      along_(cloth.weights.along),
      across_(cloth.weights.across),
      shear_(cloth.weights.shear),
      area_(std::max(2 * areaWeight, kLeastAreaPrice)),
      limitAlong_(limitOf(cloth.stretchAlong)),
      limitAcross_(limitOf(cloth.stretchAcross)),
      limitShear_(limitOf(cloth.shear)) {}

ClothEnergy::Jet ClothEnergy::stretching(double length, double weight, double limit) {
  const double inverse = 1 / length;
  const double change = (length - 1) * (length + 1) * inverse;
  const double squared = inverse * inverse;
  Jet jet{weight * change * change, 2 * weight * change * (1 + squared),
          2 * weight * (1 + 3 * squared * squared)};
  const double beyond = std::abs(length - 1) - limit;
  if (beyond > 0) {
    const double stiffness = 4 * kBeyondLimit * weight;
    jet.value += stiffness * beyond * beyond;
    jet.first += 2 * stiffness * std::copysign(beyond, length - 1);
    jet.second += 2 * stiffness;
  }
  return jet;
}

ClothEnergy::Jet ClothEnergy::shearing(double s) const {
  Jet jet{2 * shear_ * s * s, 4 * shear_ * s, 4 * shear_};
  const double beyond = std::abs(s) - limitShear_;
  if (beyond > 0) {
    const double stiffness = 2 * kBeyondLimit * shear_;
    jet.value += stiffness * beyond * beyond;
    jet.first += 2 * stiffness * std::copysign(beyond, s);
    jet.second += 2 * stiffness;
  }
  return jet;
}

ClothEnergy::Jet ClothEnergy::areaChange(double j) const {
  return {area_ * (j - 1) * (j - 1) / j, area_ * (j - 1) * (j + 1) / (j * j),
          2 * area_ / (j * j * j)};
}

double ClothEnergy::energy(const Plane& q) const {
  double sum = 0;
  for (std::size_t i = 0; i < triangles().size(); ++i) {
    const RestTriangle& t = triangles()[i];
    const PlaneMap f = mapOf(t, q);
    const double j = f.determinant();
    if (!(j > 0)) return kInfinity;
    const Vector2& a = grain()[i];
    const Vector2 b = leftOf(a);
    const Vector2 u(f.xx * a.x() + f.xy * a.y(), f.yx * a.x() + f.yy * a.y());
    const Vector2 v(f.xx * b.x() + f.xy * b.y(), f.yx * b.x() + f.yy * b.y());
    sum += t.area * (stretching(u.norm(), along_, limitAlong_).value +
                     stretching(v.norm(), across_, limitAcross_).value + shearing(u.dot(v)).value +
                     areaChange(j).value);
  }
  return sum;
}

void ClothEnergy::addDerivatives(const Plane& q, double indefinite, Eigen::VectorXd& gradient,
                                 BlockMatrix& hessian) const {
  for (std::size_t i = 0; i < triangles().size(); ++i) {
    const RestTriangle& t = triangles()[i];
    const PlaneMap f = mapOf(t, q);
    const Vector2& a = grain()[i];
    const Vector2 b = leftOf(a);
    Vector4 first = Vector4::Zero();
    Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
    const auto addMode = [&](double eigenvalue, const Vector4& mode) {
      second += (t.area * (eigenvalue < 0 ? indefinite * eigenvalue : eigenvalue)) * mode *
                mode.transpose();
    };
    const auto addStretch = [&](const Vector2& direction, const Vector2& image, double weight,
                                double limit) {
      const double length = image.norm();
      const Vector2 along = image / length;
      const Jet jet = stretching(length, weight, limit);
      first += t.area * jet.first * outer(along, direction);
      addMode(jet.second, outer(along, direction));
      addMode(jet.first / length, outer(leftOf(along), direction));
    };
    const Vector2 u(f.xx * a.x() + f.xy * a.y(), f.yx * a.x() + f.yy * a.y());
    const Vector2 v(f.xx * b.x() + f.xy * b.y(), f.yx * b.x() + f.yy * b.y());
    addStretch(a, u, along_, limitAlong_);
    addStretch(b, v, across_, limitAcross_);

    const Jet shear = shearing(u.dot(v));
    const Vector4 byShear = outer(v, a) + outer(u, b);
    first += t.area * shear.first * byShear;
    addMode(shear.second, byShear);
    const Jet area = areaChange(f.determinant());
    const Vector4 byArea(f.yy, -f.yx, -f.xy, f.xx);
    first += t.area * area.first * byArea;
    addMode(area.second, byArea);
    // The second derivatives of s and J are differences of squares.
    for (const Vector2& axis : {Vector2(1, 0), Vector2(0, 1)}) {
      addMode(0.5 * shear.first, outer(axis, a + b));
      addMode(-0.5 * shear.first, outer(axis, a - b));
    }
    const double half = 0.5 * area.first;
    addMode(half, {1, 0, 0, 1});
    addMode(half, {0, -1, 1, 0});
    addMode(-half, {1, 0, 0, -1});
    addMode(-half, {0, 1, 1, 0});

    Eigen::Matrix2d byMap;
    byMap << first[0], first[1], first[2], first[3];
    add(i, byMap, second, gradient, hessian);
  }
}

}  // namespace toile::unfolding
