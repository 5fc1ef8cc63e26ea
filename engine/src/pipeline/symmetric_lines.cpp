// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/symmetric_lines.h"

#include <algorithm>

#include "model/mirror.h"

namespace toile {
namespace {

/// mm; on a crooked model the ends, placed by lengths, are only nearly images of each other. Lines
/// whose ends are farther apart are other lines on the other side.
constexpr double kSameEnd = 10;

class LineMirror {
 public:
  LineMirror(const ReferenceModel& model, double keep) : model_(model), keep_(keep) {}

  void makeSymmetric(SurfacePath& path) const {
    const SurfacePath mirrored = detail::mirrored(*model_.mesh, model_.symmetry->partner, path);
    const std::size_t count = path.points.size();
    std::vector<std::size_t> middle;
    for (std::size_t i = 0; i < count; ++i) {
      if (distance(path.points[i], mirrored.points[i]) < kMergeDistanceMm) middle.push_back(i);
    }
    std::size_t begin = 0, end = 0;  // of the half that stays; around a closed path
    if (path.closed) {
      if (middle.size() != 2) return;
      begin = middle[0];
      end = middle[1];
      if (sideOf(path, begin, end) < 0) {
        begin = middle[1];
        end = middle[0] + count;
      }
    } else {
      if (middle.size() != 1 || middle[0] == 0 || middle[0] + 1 == count) return;
      if (distance(path.points.front(), mirrored.points.back()) > kSameEnd) return;
      const bool isFirst = sideOf(path, 0, middle[0]) > 0;
      begin = isFirst ? 0 : middle[0];
      end = isFirst ? middle[0] : count - 1;
    }
    if (!isNearly(path, mirrored)) return;
    SurfacePath whole;
    whole.closed = path.closed;
    const auto addHalf = [&] {
      for (std::size_t i = begin; i < end; ++i) add(path, i, i, whole);
    };
    const auto addImage = [&] {  // backward
      for (std::size_t i = end; i > begin; --i) add(mirrored, i, i - 1, whole);
    };
    if (path.closed || begin == 0) {
      addHalf();
      addImage();
      if (!path.closed) whole.points.push_back(mirrored.points[begin]);
    } else {
      addImage();
      addHalf();
      whole.points.push_back(path.points[end]);
    }
    path = std::move(whole);
  }

 private:
  /// A point and the face of the segment that leaves it.
  static void add(const SurfacePath& from, std::size_t point, std::size_t segment,
                  SurfacePath& to) {
    to.points.push_back(from.points[point % from.points.size()]);
    to.faceOfSegment.push_back(from.faceOfSegment[segment % from.faceOfSegment.size()]);
  }
  /// Whether every point of the path has one of its image nearby.
  [[nodiscard]] bool isNearly(const SurfacePath& path, const SurfacePath& mirrored) const {
    std::vector<Eigen::Vector3d> image;
    double step = 0;
    for (const SurfacePoint& p : mirrored.points) {
      image.push_back(position(*model_.mesh, p));
      if (image.size() > 1) step = std::max(step, (image.back() - image[image.size() - 2]).norm());
    }
    return std::all_of(path.points.begin(), path.points.end(), [&](const SurfacePoint& point) {
      const Eigen::Vector3d p = position(*model_.mesh, point);
      return std::any_of(image.begin(), image.end(), [&](const Eigen::Vector3d& q) {
        return (p - q).norm() <= kSameEnd + step;
      });
    });
  }
  [[nodiscard]] double distance(const SurfacePoint& a, const SurfacePoint& b) const {
    return (position(*model_.mesh, a) - position(*model_.mesh, b)).norm();
  }
  /// > 0 on the side that stays.
  [[nodiscard]] double sideOf(const SurfacePath& path, std::size_t begin, std::size_t end) const {
    double sum = 0;
    for (std::size_t i = begin; i <= end; ++i) {
      const SurfacePoint& point = path.points[i % path.points.size()];
      sum += model_.symmetry->normal.dot(position(*model_.mesh, point)) - model_.symmetry->offset;
    }
    return keep_ * sum;
  }

  const ReferenceModel& model_;
  double keep_;
};

}  // namespace

void makeLinesSymmetric(const Document& document, bool symmetricPieces,
                        std::vector<PlacedCurve>& curves) {
  const ReferenceModel& model = *document.model;
  const Design& design = *document.design;
  if (!model.symmetry || model.symmetry->partner.empty()) return;
  double side = 1;
  const auto twin = std::find_if(design.pieces.begin(), design.pieces.end(),
                                 [](const PieceRecord& r) { return r.twin.has_value(); });
  if (twin != design.pieces.end()) {
    const PieceRecord* original = recordOf(design, twin->twin->of);
    if (original == nullptr) return;
    const Result<SurfacePoint> anchor = resolvePlace(original->anchor, model, curves);
    if (!anchor) return;
    side = model.symmetry->normal.dot(position(*model.mesh, *anchor)) - model.symmetry->offset;
  } else if (!symmetricPieces) {
    return;
  }
  const LineMirror mirror(model, side < 0 ? -1 : 1);
  for (PlacedCurve& curve : curves) mirror.makeSymmetric(curve.path);
}

}  // namespace toile
