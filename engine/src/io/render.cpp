// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/picture.h"
#include "io/render_model.h"
#include "io/render_sheet.h"

namespace toile {
namespace {

constexpr int kLeastSize = 16, kMostSize = 16000;
constexpr int kMostSamples = 8;
// Line widths of the style are meant for a picture of this height.
constexpr double kStyleHeight = 1000;
constexpr double kCaptionRoom = 44;  // px of the style: below the views
constexpr double kTopRoom = 64;      // above them, for the title
constexpr double kSideRoom = 26;

ModelView front() {
  return {std::numbers::pi / 10, std::numbers::pi / 40};
}
ModelView back() {
  return {std::numbers::pi + std::numbers::pi / 10, std::numbers::pi / 40};
}

/// How the picture is divided: two views of the model, beside or above each other, then the sheet.
struct Arrangement {
  PixelBox ground;
  std::array<PixelBox, 2> views;
  PixelBox sheet;
};

Arrangement divide(const RenderOptions& options, double scale, double modelAspect,
                   double sheetAspect) {
  const double height = options.height - (kTopRoom + kCaptionRoom) * scale;
  const bool stacked = modelAspect > 1.3;
  // What each part would like at full height; then they share the width.
  const double side = 2 * kSideRoom * scale;
  const double model =
      stacked ? side + modelAspect * height / 2 : 2 * (side + modelAspect * height);
  const double sheet = 2 * kSideRoom * scale + sheetAspect * options.height;
  const double share = std::clamp(model / (model + sheet), 0.42, 0.62);
  const int groundWidth = std::max(2, static_cast<int>(std::lround(share * options.width)));

  Arrangement result;
  result.ground = {0, 0, groundWidth, options.height};
  result.sheet = {groundWidth, 0, options.width - groundWidth, options.height};
  if (stacked) {
    const int half = options.height / 2;
    result.views = {PixelBox{0, 0, groundWidth, half},
                    PixelBox{0, half, groundWidth, options.height - half}};
  } else {
    const int half = groundWidth / 2;
    result.views = {PixelBox{0, 0, half, options.height},
                    PixelBox{half, 0, groundWidth - half, options.height}};
  }
  return result;
}

}  // namespace

Result<std::string> renderPreview(const Pattern& pattern, const RenderOptions& options) {
  if (std::min(options.width, options.height) < kLeastSize ||
      std::max(options.width, options.height) > kMostSize || options.samples < 1 ||
      options.samples > kMostSamples) {
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("a picture of {} x {} px with {} samples cannot be made; sides go from "
                    "{} to {} px, samples from 1 to {}",
                    options.width, options.height, options.samples, kLeastSize, kMostSize,
                    kMostSamples),
        {}};
  }
  const double scale = options.height / kStyleHeight;
  const ModelRenderer renderer(pattern);
  const Eigen::Vector2d size = renderer.size(front()).cwiseMax(renderer.size(back()));
  const Eigen::Vector2d sheet = (pattern.layout.max - pattern.layout.min).cwiseMax(1e-6);
  const Arrangement parts =
      divide(options, scale, size.x() / size.y(), std::clamp(sheet.x() / sheet.y(), 0.4, 2.5));

  Picture picture(options.width, options.height);
  const std::array<ModelView, 2> views = {front(), back()};
  const std::array<const char*, 2> names = {"front", "back"};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const PixelBox& box = parts.views[i];
    const double width = std::max(1.0, box.width - 2 * kSideRoom * scale);
    const double height = std::max(1.0, box.height - (kTopRoom + kCaptionRoom) * scale);
    ModelRenderer::Frame frame;
    frame.box = box;
    frame.ground = parts.ground;
    frame.mmPerPixel = std::max(size.x() / width, size.y() / height);
    frame.samples = options.samples;
    frame.lineScale = scale;
    renderer.draw(picture, frame, views[i]);
    drawCaption(picture, {.text = names[i],
                          .x = box.x + box.width / 2.0,
                          .y = box.y + box.height - 18 * scale,
                          .size = 12 * scale,
                          .bold = false,
                          .centred = true});
  }
  drawSheet(picture, parts.sheet, pattern, scale);
  drawCaption(picture, {.text = pattern.document.design->name,
                        .x = 22 * scale,
                        .y = 36 * scale,
                        .size = 18 * scale,
                        .bold = true,
                        .centred = false});
  return encodePng(picture);
}

}  // namespace toile
