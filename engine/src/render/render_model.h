// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "render/picture.h"
#include "render/render_scene.h"

namespace toile {

/// The model in the made design, ray traced in a studio. Builds its trees once and draws any number
/// of views; every view is a function of the scene alone.
class ModelRenderer {
 public:
  /// @param closeUp what is seen of it; absent: all
  /// @param standing whether it throws a shadow on the ground below it
  ModelRenderer(RenderScene scene, RenderStyle style, const std::optional<RenderCloseUp>& closeUp,
                bool standing);
  ~ModelRenderer();
  ModelRenderer(const ModelRenderer&) = delete;
  ModelRenderer& operator=(const ModelRenderer&) = delete;

  /// Width and height of what is seen in a view, mm in the plane through its middle.
  [[nodiscard]] Eigen::Vector2d size(const RenderView& view) const;

  /// Of all views drawn from now on.
  struct Scale {
    double mmPerPixel = 1;
    double lineUnit = 1;  ///< mm per px of the line styles
  };
  void setScale(const Scale& scale);

  struct Frame {
    PixelBox box;     ///< filled whole, the model in its middle
    PixelBox ground;  ///< over which the ground shades, so that views side by side share it
    int samples = 3;  ///< per pixel and axis where outlines and lines pass, 1 elsewhere
    int shift = 0;    ///< px that the middle stands below the middle of the box
  };
  /// Leaves the box unfinished when cancelled.
  void draw(Picture& picture, const Frame& frame, const RenderView& view,
            const Progress* progress) const;

 private:
  struct Extent;
  struct Studio;
  class Shot;
  std::unique_ptr<Studio> studio_;
};

}  // namespace toile
