// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "io/drawing_style.h"
#include "io/picture.h"
#include "toile/layout/pattern.h"

namespace toile {

/// From where the model is seen. Angles about the vertical: 0 looks at its front.
struct ModelView {
  double turn = 0;   ///< radians, positive shows more of the model's left
  double above = 0;  ///< radians, how far the eye stands above the middle
};

/// The model in clay and fabric tints with its lines, ray traced. Builds its trees once and draws
/// any number of views; every view is a function of the pattern alone.
class ModelRenderer {
 public:
  explicit ModelRenderer(const Pattern& pattern);
  ~ModelRenderer();
  ModelRenderer(const ModelRenderer&) = delete;
  ModelRenderer& operator=(const ModelRenderer&) = delete;

  /// Width and height of the model in a view, mm in the plane through its middle.
  [[nodiscard]] Eigen::Vector2d size(const ModelView& view) const;

  struct Frame {
    PixelBox box;     ///< filled whole, the model in its middle
    PixelBox ground;  ///< over which the ground shades, so that views side by side share it
    double mmPerPixel = 1;
    int samples = 2;  ///< one more per pixel and axis where outlines and lines pass, 1 elsewhere
    double lineScale = 1;  ///< px of the picture per px of the line styles
  };
  void draw(Picture& picture, const Frame& frame, const ModelView& view) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace toile
