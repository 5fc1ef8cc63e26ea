// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/render_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "io/camera.h"
#include "io/ground_shadow.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kTile = 32;                     // px, one task
constexpr float kContrastStep = 14.0F / 255;  // between samples: asks for more of them
constexpr float kShadowStrength = 0.62F;
constexpr float kInside = 0.42F;  // of the light reaches the inside of an open model

struct Sample {
  Vector3f colour;         ///< display values 0..1
  std::uint32_t part = 0;  ///< 0 the ground, else one more than the part
  bool fine = false;
};

float power4(float x) {
  return x * x * x * x;
}

}  // namespace

struct ModelRenderer::Studio {
  RenderScene scene;
  RenderStyle style = RenderStyle::Product;
  std::optional<GroundShadow> ground;
  double mmPerPixel = 1;
  float unit = 1;  ///< mm per px of the line styles

  [[nodiscard]] std::array<Vector2d, 2> extent(const Camera& camera) const {
    Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
    Vector2d high = -low;
    for (const Vector3f& p : scene.positions) {
      const Vector2d at = project(camera, p.cast<double>());
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    return {low, high};
  }
};

namespace {

/// One view: what every sample needs.
struct Shot {
  Camera camera;
  Vector3f eye, right, up, forward;
  Vector2d low, high;  ///< of the model in the view plane, mm
  float distance = 1;
  Vector3f key;                 ///< towards the lamp, for gloss
  std::vector<Vector3f> light;  ///< per vertex of the scene
  std::vector<float> darkness;  ///< of the ground
};

}  // namespace

ModelRenderer::ModelRenderer(RenderScene scene, RenderStyle style, bool standing)
    : studio_(std::make_unique<Studio>()) {
  studio_->scene = std::move(scene);
  studio_->style = style;
  if (!standing) return;
  Vector3f low = Vector3f::Constant(std::numeric_limits<float>::infinity());
  Vector3f high = -low;
  for (const Vector3f& p : studio_->scene.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  studio_->ground.emplace(studio_->scene.surface, low, high);
}

ModelRenderer::~ModelRenderer() = default;

Vector2d ModelRenderer::size(const RenderView& view) const {
  const RenderScene& scene = studio_->scene;
  const auto [low, high] = studio_->extent(makeCamera(scene.middle, scene.diagonal, view));
  return (high - low).cwiseMax(1e-6);
}

void ModelRenderer::setScale(const Scale& scale) {
  studio_->mmPerPixel = scale.mmPerPixel;
  studio_->unit = static_cast<float>(scale.lineUnit);
  studio_->scene.lines.prepare(kPaintReach * studio_->unit);
}

void ModelRenderer::draw(Picture& picture, const Frame& frame, const RenderView& from) const {
  const Studio& studio = *studio_;
  const RenderScene& scene = studio.scene;
  const PixelBox& box = frame.box;
  Shot view;
  view.camera = makeCamera(scene.middle, scene.diagonal, from);
  view.eye = view.camera.eye.cast<float>();
  view.right = view.camera.right.cast<float>();
  view.up = view.camera.up.cast<float>();
  view.forward = view.camera.forward.cast<float>();
  view.distance = static_cast<float>(view.camera.distance);
  view.key = (-0.62F * view.right + 0.62F * view.up - 0.62F * view.forward).normalized();
  const std::array<Vector2d, 2> extent = studio.extent(view.camera);
  view.low = extent[0];
  view.high = extent[1];
  view.light =
      scene.lightAtVertices(studioLight(scene.sky.directions, view.right, view.up, -view.forward));
  if (studio.ground) {
    view.darkness = studio.ground->darkness(
        studioLight(studio.ground->sky().directions, view.right, view.up, -view.forward));
  }
  const Vector2d centre = 0.5 * (view.low + view.high);
  const Vector2d rim = Vector2d::Constant(2 * studio.mmPerPixel);
  const bool product = studio.style == RenderStyle::Product;

  const auto shade = [&](const FirstHit& hit, const Vector3f& direction) -> Sample {
    const std::uint32_t* c = scene.corners.data() + 3 * std::size_t{hit.primitive};
    const float w = 1 - hit.u - hit.v;
    const auto blend = [&](const std::vector<Vector3f>& values) -> Vector3f {
      return w * values[c[0]] + hit.u * values[c[1]] + hit.v * values[c[2]];
    };
    const std::uint32_t part = scene.partOfFace[hit.primitive];
    const Cloth& cloth = scene.cloth[part];
    const SurfaceLines::Near near = scene.lines.near(part, blend(scene.positions));
    Painted at =
        product ? paintProduct(near, cloth, studio.unit) : paintPlain(near, cloth, studio.unit);
    Vector3f normal = blend(scene.normals).normalized();
    Vector3f light = blend(view.light);
    const Vector3f edgeA = scene.positions[c[1]] - scene.positions[c[0]];
    const Vector3f edgeB = scene.positions[c[2]] - scene.positions[c[0]];
    if (edgeA.cross(edgeB).dot(direction) > 0) {
      normal = -normal;
      light = Vector3f::Constant(kInside);
      at = {.colour = 0.5F * cloth.colour + 0.5F * cloth.thread};
    }
    // Cloth is matt, with a nap that shines at grazing angles and the faintest gloss.
    const float facing = std::max(0.0F, -normal.dot(direction));
    const Vector3f half = (view.key - direction).normalized();
    const float mean = light.mean();
    const float gloss = product ? (0.075F * power4(1 - facing) +
                                   0.045F * power4(power4(std::max(0.0F, normal.dot(half))))) *
                                      mean
                                : 0.0F;
    const Vector3f lit = at.shade * (light.cwiseProduct(at.colour) + Vector3f::Constant(gloss));
    return {(1 - at.inked) * toDisplay(lit) + at.inked * at.ink, part + 1, at.fine};
  };

  const auto groundAt = [&](double x, double y) -> Vector3f {
    if (!product) return displayOf(kSheet);
    const double dx = (box.x + x - frame.ground.x) / frame.ground.width - 0.5;
    const double dy = (box.y + y - frame.ground.y) / frame.ground.height - 0.45;
    const auto t = static_cast<float>(std::min(1.0, 1.35 * std::sqrt(dx * dx + dy * dy)));
    return (1 - t * t) * displayOf(kGroundCentre) + t * t * displayOf(kGroundEdge);
  };

  const auto sampleAt = [&](double x, double y) -> Sample {
    const double right = (x - box.width / 2.0) * studio.mmPerPixel + centre.x();
    const double up = (box.height / 2.0 + frame.shift - y) * studio.mmPerPixel + centre.y();
    const Vector3f direction =
        (view.distance * view.forward + static_cast<float>(right) * view.right +
         static_cast<float>(up) * view.up)
            .normalized();
    const bool beside = right < view.low.x() - rim.x() || right > view.high.x() + rim.x() ||
                        up < view.low.y() - rim.y() || up > view.high.y() + rim.y();
    if (!beside) {
      const FirstHit hit = scene.surface.firstHit(view.eye, direction, 0, 2 * view.distance);
      if (hit.exists()) return shade(hit, direction);
    }
    Vector3f ground = groundAt(x, y);
    if (studio.ground) {
      // Gone before the next view begins.
      const auto side = static_cast<float>(std::min(x, box.width - x) / (0.12 * box.width));
      const float dark = studio.ground->at(view.darkness, view.eye, direction);
      ground *= 1 - kShadowStrength * dark * std::clamp(side, 0.0F, 1.0F);
    }
    return {ground, 0, false};
  };

  // One sample a pixel; many only on lines and where it differs from a neighbour.
  const auto fineAt = [&](int x, int y) -> Vector3f {
    const int n = frame.samples;
    Vector3f sum = Vector3f::Zero();
    for (int i = 0; i < n * n; ++i) {
      sum += sampleAt(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n).colour;
    }
    return sum / static_cast<float>(n * n);
  };
  const auto differ = [](const Sample& a, const Sample& b) {
    return a.part != b.part || (a.colour - b.colour).cwiseAbs().maxCoeff() > kContrastStep;
  };
  const auto drawTile = [&](int left, int top) {
    const int width = std::min(kTile, box.width - left);
    const int height = std::min(kTile, box.height - top);
    const int stride = width + 2;  // one pixel more on every side
    std::vector<Sample> coarse(static_cast<std::size_t>(stride) *
                               static_cast<std::size_t>(height + 2));
    const auto coarseAt = [&](int x, int y) -> Sample& {
      return coarse[static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(stride) +
                    static_cast<std::size_t>(x + 1)];
    };
    for (int y = -1; y <= height; ++y) {
      for (int x = -1; x <= width; ++x) {
        coarseAt(x, y) = sampleAt(left + x + 0.5, top + y + 0.5);
      }
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Sample& here = coarseAt(x, y);
        const bool edge = here.fine || differ(here, coarseAt(x - 1, y)) ||
                          differ(here, coarseAt(x + 1, y)) || differ(here, coarseAt(x, y - 1)) ||
                          differ(here, coarseAt(x, y + 1));
        const Vector3f colour = edge ? fineAt(left + x, top + y) : here.colour;
        const Eigen::Matrix<std::uint32_t, 3, 1> rgb =
            (255 * colour + Vector3f::Constant(0.5F)).cast<std::uint32_t>();
        picture.at(box.x + left + x, box.y + top + y) = rgb[0] << 16U | rgb[1] << 8U | rgb[2];
      }
    }
  };
  const int columns = (box.width + kTile - 1) / kTile;
  const int rows = (box.height + kTile - 1) / kTile;
  parallelFor(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
              [&](std::size_t tile) {
                const int index = static_cast<int>(tile);
                drawTile(index % columns * kTile, index / columns * kTile);
              });
}

}  // namespace toile
