// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve/path_walk.h"

#include <algorithm>

namespace toile::detail {

PathWalk::PathWalk(const Mesh& mesh, const SurfacePath& path)
    : mesh_(mesh), path_(path), span_(segmentLength(0)) {}

double PathWalk::segmentLength(std::size_t segment) const {
  return (position(mesh_, path_.points[(segment + 1) % path_.points.size()]) -
          position(mesh_, path_.points[segment]))
      .norm();
}

SurfacePoint PathWalk::at(double arc) {
  const std::size_t count = path_.faceOfSegment.size();
  while ((path_.closed || segment_ + 1 < count) && before_ + span_ < arc) {
    before_ += span_;
    segment_ = (segment_ + 1) % count;
    span_ = segmentLength(segment_);
  }
  const double t = span_ > 0 ? std::clamp((arc - before_) / span_, 0.0, 1.0) : 0.0;
  const SurfacePoint& a = path_.points[segment_];
  const SurfacePoint& b = path_.points[(segment_ + 1) % path_.points.size()];
  if (t <= 0) return a;
  if (t >= 1) return b;
  const FaceId face = path_.faceOfSegment[segment_];
  return makeSurfacePoint(
      mesh_, face, (1 - t) * barycentricIn(mesh_, a, face) + t * barycentricIn(mesh_, b, face));
}

}  // namespace toile::detail
