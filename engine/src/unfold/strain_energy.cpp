// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/strain_energy.h"

#include <algorithm>
#include <cmath>

namespace toile::unfolding {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Vector2 = Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// F = Q rotation + P reflection; both matrices have the form [c -s; s c] and [c s; s -c].
struct Split {
  double q = 0, p = 0;
  Matrix2 rotation, reflection;
};

Split split(const PlaneMap& f) {
  const double e = 0.5 * (f.xx + f.yy);
  const double h = 0.5 * (f.yx - f.xy);
  const double d = 0.5 * (f.xx - f.yy);
  const double g = 0.5 * (f.yx + f.xy);
  Split s;
  s.q = std::sqrt(e * e + h * h);
  s.p = std::sqrt(d * d + g * g);
  if (s.q > 0) {
    s.rotation << e / s.q, -h / s.q, h / s.q, e / s.q;
  } else {
    s.rotation.setIdentity();
  }
  // Where the map is conformal any reflection serves: the eigenvalues along them are equal.
  if (s.p > 1e-150) {
    s.reflection << d / s.p, g / s.p, g / s.p, -d / s.p;
  } else {
    s.reflection << 1, 0, 0, -1;
  }
  return s;
}

Matrix2 quarterTurn(const Matrix2& m) {
  Matrix2 turned;
  turned << -m(1, 0), -m(1, 1), m(0, 0), m(0, 1);
  return turned;
}

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
  const double q = 0.5 * std::hypot(f.xx + f.yy, f.yx - f.xy);
  const double p = 0.5 * std::hypot(f.xx - f.yy, f.yx + f.xy);
  return {q + p, q - p};
}

StrainEnergy::StrainEnergy(const Problem& problem, const BlockPattern& pattern, double areaWeight)
    : problem_(&problem), areaWeight_(areaWeight) {
  places_.reserve(problem.triangles.size());
  for (const RestTriangle& t : problem.triangles) {
    places_.push_back({pattern.find(t.vertex[0], t.vertex[1]),
                       pattern.find(t.vertex[1], t.vertex[2]),
                       pattern.find(t.vertex[2], t.vertex[0])});
  }
}

double StrainEnergy::energy(const Plane& q) const {
  double sum = 0;
  for (const RestTriangle& t : problem_->triangles) {
    const PlaneMap f = mapOf(t, q);
    const double e = f.xx + f.yy, h = f.yx - f.xy, d = f.xx - f.yy, g = f.yx + f.xy;
    const double a = 0.5 * std::sqrt(e * e + h * h);
    const double b = 0.5 * std::sqrt(d * d + g * g);
    const double s1 = a + b;
    const double s2 = a - b;
    const double j = s1 * s2;
    if (!(s2 > 0) || !(f.determinant() > 0)) return kInfinity;
    // s^2 + 1/s^2 - 2 = (s - 1/s)^2, written so that it is exact near an isometry.
    const double u = (s1 - 1) * (s1 + 1) / s1;
    const double w = (s2 - 1) * (s2 + 1) / s2;
    sum += t.area * (u * u + w * w + 2 * areaWeight_ * (j - 1) * (j - 1) / j);
  }
  return sum;
}

// f1, f2, f11, f12, f22: derivatives of D by s1 and s2. The Hessian of D(s1(F), s2(F)) has four
// orthonormal modes: two scalings along the singular vectors, which the 2x2 matrix of second
// derivatives mixes, the twist (turning F) and the flip (turning its reflection part); see Smith,
// De Goes and Kim, "Analytic Eigensystems for Isotropic Distortion Energies", ACM TOG 38(1), 2019.
void StrainEnergy::addDerivatives(const Plane& q, double /*indefinite*/, Eigen::VectorXd& gradient,
                                  BlockMatrix& hessian) const {
  for (std::size_t i = 0; i < problem_->triangles.size(); ++i) {
    const RestTriangle& t = problem_->triangles[i];
    const Split s = split(mapOf(t, q));
    const double s1 = s.q + s.p;
    const double s2 = s.q - s.p;
    const double j = s1 * s2;
    const double price = 2 * areaWeight_ * (j - 1) * (j + 1) / (j * j);
    const double f1 = 2 * (s1 * s1 - 1) * (s1 * s1 + 1) / (s1 * s1 * s1) + price * s2;
    const double f2 = 2 * (s2 * s2 - 1) * (s2 * s2 + 1) / (s2 * s2 * s2) + price * s1;
    const double f11 = 2 + 6 / (s1 * s1 * s1 * s1) + 4 * areaWeight_ / (s1 * s1 * j);
    const double f22 = 2 + 6 / (s2 * s2 * s2 * s2) + 4 * areaWeight_ / (s2 * s2 * j);
    const double f12 = 2 * areaWeight_ * (1 + 1 / (j * j));

    const double middle = 0.5 * (f11 + f22);
    const double half = 0.5 * (f11 - f22);
    const double radius = std::sqrt(half * half + f12 * f12);
    const double cosine = radius > 0 ? std::sqrt(std::max(0.0, 0.5 * (1 + half / radius))) : 1;
    const double sine = radius > 0 ? std::sqrt(std::max(0.0, 0.5 * (1 - half / radius))) : 0;
    const std::array<double, 4> eigenvalue = {
        middle + radius, middle - radius, (f1 + f2) / (s1 + s2),
        2 + 2 * (s1 * s1 + j + s2 * s2) / (j * j * j) - price};
    const std::array<Matrix2, 4> mode = {
        0.5 * ((cosine + sine) * s.rotation + (cosine - sine) * s.reflection),
        0.5 * ((cosine - sine) * s.rotation - (cosine + sine) * s.reflection),
        std::sqrt(0.5) * quarterTurn(s.rotation), std::sqrt(0.5) * quarterTurn(s.reflection)};
    // The Hessian by the numbers of F, row by row.
    Eigen::Matrix4d byMap = Eigen::Matrix4d::Zero();
    for (std::size_t m = 0; m < 4; ++m) {
      if (!(eigenvalue[m] > 0)) continue;
      const Eigen::Vector4d v(mode[m](0, 0), mode[m](0, 1), mode[m](1, 0), mode[m](1, 1));
      const Eigen::Vector4d scaled = t.area * eigenvalue[m] * v;
      byMap += scaled * v.transpose();
    }

    const Matrix2 stress = t.area * 0.5 * ((f1 + f2) * s.rotation + (f1 - f2) * s.reflection);
    const Vector2 pull0 = stress * t.hatGradient[0];
    const Vector2 pull1 = stress * t.hatGradient[1];
    gradient.segment<2>(2 * Eigen::Index{t.vertex[0]}) += pull0;
    gradient.segment<2>(2 * Eigen::Index{t.vertex[1]}) += pull1;
    gradient.segment<2>(2 * Eigen::Index{t.vertex[2]}) -= pull0 + pull1;

    // Moving all three vertices changes nothing: the blocks of the third follow from the others.
    const auto byVertex = [&](std::size_t k) {
      const Vector2& g = t.hatGradient[k];
      Eigen::Matrix<double, 4, 2> columns;
      columns.col(0) = byMap.col(0) * g.x() + byMap.col(1) * g.y();
      columns.col(1) = byMap.col(2) * g.x() + byMap.col(3) * g.y();
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
    hessian.add(places_[i][0], b01);
    hessian.add(places_[i][1], b12);
    hessian.add(places_[i][2], b02.transpose());
  }
}

double StrainEnergy::distanceToBorder(const Plane& q, const Plane& d) const {
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

}  // namespace toile::unfolding
