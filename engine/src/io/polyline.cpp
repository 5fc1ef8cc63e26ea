// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/polyline.h"

namespace toile {

double lengthOf(const Points2& polyline) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
    length += (polyline[i + 1] - polyline[i]).norm();
  return length;
}

Eigen::Vector2d pointAt(const Points2& polyline, double along) {
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Eigen::Vector2d chord = polyline[i + 1] - polyline[i];
    const double step = chord.norm();
    if (along <= step && step > 0) return polyline[i] + along / step * chord;
    along -= step;
  }
  return polyline.back();
}

}  // namespace toile
