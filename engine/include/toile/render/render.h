// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/progress.h"
#include "toile/core/units.h"
#include "toile/layout/pattern.h"

namespace toile {

/// From where the model is seen.
struct RenderView {
  std::string name;  ///< stands below it
  Angle azimuth;     ///< about the vertical: 0 sees its front, 90 degrees its left side
  Angle elevation;   ///< -90..90 degrees, how far the eye stands above the middle
};
/// A list with commas of "front", "back", "left", "right", "three-quarter", "three-quarter-back",
/// "top" and pairs "azimuth,elevation" in degrees: "front,30,10" is two views.
/// @return InvalidArgument with the names that exist.
[[nodiscard]] Result<std::vector<RenderView>> parseViews(std::string_view list);

/// A part of the model, seen from near.
struct RenderCloseUp {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< mm; stands in the middle of every view
  Length height = Length::mm(300);  ///< of what is seen, where the middle is; above 0
};

enum class RenderStyle {
  Product,  ///< the finished thing: cloth, stitched seams, zips, on the model as a mannequin
  Plain     ///< pale panels with the design's lines in the colours of their kinds
};
enum class RenderLines { All, Seams, None };
enum class RenderPieces {
  Cloth,   ///< the pattern pieces beside the views, in the colour of their cloth
  Strain,  ///< the pieces coloured by how much the cloth must give
  None
};

/// What the colours of RenderPieces::Strain tell.
enum class StrainMap {
  Area,    ///< how much the area of the cloth must give
  Along,   ///< how much it must stretch along the grain
  Across,  ///< across it
  Shear,
  AreaError  ///< the article's map: |A2/A3 - 1| from 0 (blue) to 100 % (red)
};

struct RenderOptions {
  int width = 1600;   ///< px, 16..16000
  int height = 1000;  ///< px, 16..16000
  bool trim = false;  ///< only as high as what it shows at that width
  int samples = 3;    ///< 1..8, per pixel and axis where outlines and lines pass
  /// 0..12 views side by side; empty shows the pieces alone.
  std::vector<RenderView> views = {{"front", Angle::degrees(0), Angle::degrees(4)},
                                   {"back", Angle::degrees(180), Angle::degrees(4)}};
  std::optional<RenderCloseUp> closeUp{};  ///< absent: every view shows the model whole
  RenderStyle style = RenderStyle::Product;
  RenderLines lines = RenderLines::All;
  RenderPieces pieces = RenderPieces::Cloth;
  StrainMap strain = StrainMap::Area;
  Ratio explode = Ratio();  ///< 0..2: how far the pieces stand off the model
  bool captions = true;     ///< name of the design, of the views
};

/// @return InvalidArgument for options out of their ranges, or when they show nothing.
[[nodiscard]] Result<void> checkOptions(const RenderOptions& options);

/// A picture of the model in the made design with the flat pieces beside it; ray traced without a
/// display. The same pixels for any number of threads.
/// @param progress optional; polled between tiles of the picture.
/// @return the bytes of a PNG, the error of checkOptions(), or Cancelled.
/// @par Cost  about 5 million rays for the default
Result<std::string> renderPattern(const Pattern& pattern, const RenderOptions& options = {},
                                  Progress* progress = nullptr);

/// A picture of a model alone; `pieces` and `explode` do not matter, `lines` other than None draws
/// the model's own curves.
Result<std::string> renderModel(const ReferenceModel& model, const RenderOptions& options = {},
                                Progress* progress = nullptr);

}  // namespace toile
