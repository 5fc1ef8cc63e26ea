// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "render/drawing_style.h"

namespace toile {

/// What a line is on the finished thing.
enum class LineRole { Seam, Hem, Zip, Dart, Feature, Elastic, Mark };
[[nodiscard]] constexpr bool isInside(LineRole role) {
  return role == LineRole::Feature || role == LineRole::Elastic || role == LineRole::Mark;
}

inline constexpr std::uint32_t kEveryPart = 0xffffffffU;

/// A line on one part of the picture's surface; a seam has one on each of its sides.
struct SurfaceLine {
  std::uint32_t part = kEveryPart;
  LineRole role = LineRole::Seam;
  LineStyle plain;                      ///< its look in plain pictures
  std::vector<Eigen::Vector3f> points;  ///< mm
  bool turned = false;     ///< the points run against the piece: the other side of a zip
  bool endsAtTop = false;  ///< of a zip: its slider is there
  float length = 0;        ///< mm, set by SurfaceLines
};

/// Lines to be painted on a surface: finds the nearest to a point of it. Points on the surface and
/// not pixels decide, so that a line foreshortens with the surface and ends at its outline.
class SurfaceLines {
 public:
  void add(SurfaceLine line);
  /// Sorts the stretches of all lines into boxes, so that near() finds what is within `reach`, mm.
  void prepare(float reach);

  struct Pass {
    const SurfaceLine* line = nullptr;  ///< null: none within reach
    float along = 0;                    ///< mm from the line's first point
    float across = 0;                   ///< mm
  };
  struct Near {
    Pass border;  ///< the nearest line that bounds a piece
    Pass zip;     ///< the nearest zip
    Pass inside;  ///< the nearest within it
  };
  /// @param part lines of other parts are not seen
  [[nodiscard]] Near near(std::uint32_t part, const Eigen::Vector3f& point) const;

 private:
  struct Stretch {
    Eigen::Vector3f a, b;
    float from = 0;  ///< mm along the line at a
    std::uint32_t line = 0;
  };
  [[nodiscard]] Eigen::Vector3i boxOf(const Eigen::Vector3f& point) const;
  [[nodiscard]] std::size_t indexOf(const Eigen::Vector3i& box) const;

  std::vector<SurfaceLine> lines_;
  std::vector<Stretch> stretches_;
  float reach_ = 0;
  float boxSize_ = 1;
  Eigen::Vector3f low_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i count_ = Eigen::Vector3i::Zero();  ///< boxes per axis; none without lines
  std::vector<std::uint32_t> firstOfBox_;            ///< in inBox_, and its end
  std::vector<std::uint32_t> inBox_;                 ///< stretches
};

}  // namespace toile
