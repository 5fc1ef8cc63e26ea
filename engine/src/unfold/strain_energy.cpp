// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/strain_energy.h"

#include <algorithm>
#include <cmath>

namespace toile::unfolding {
namespace {

using Matrix2 = Eigen::Matrix2d;

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

double StrainEnergy::energy(const Plane& q) const {
  double sum = 0;
  for (const RestTriangle& t : triangles()) {
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
  for (std::size_t i = 0; i < triangles().size(); ++i) {
    const RestTriangle& t = triangles()[i];
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
    add(i, stress, byMap, gradient, hessian);
  }
}

}  // namespace toile::unfolding
