// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/render_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "render/camera.h"
#include "render/ground_shadow.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr int kTile = 32;                     // px, one task
constexpr float kContrastStep = 14.0F / 255;  // between samples: asks for more of them
constexpr float kShadowStrength = 0.52F;
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

/// A rectangle in the view plane, mm.
struct ModelRenderer::Extent {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  void add(const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void grow(double rim) {
    low -= Vector2d::Constant(rim);
    high += Vector2d::Constant(rim);
  }
  [[nodiscard]] bool holds(const Vector2d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

struct ModelRenderer::Studio {
  RenderScene scene;
  RenderStyle style = RenderStyle::Product;
  std::optional<GroundShadow> ground;
  std::optional<double> seen;  ///< mm, the height of a close-up; the eye looks at its middle
  double mmPerPixel = 1;
  float unit = 1;  ///< mm per px of the line styles

  [[nodiscard]] Extent extent(const Camera& camera) const {
    Extent extent;
    for (const Vector3f& p : scene.positions) extent.add(project(camera, p.cast<double>()));
    return extent;
  }
};

/// One view into one box of the picture.
class ModelRenderer::Shot {
 public:
  Shot(const Studio& studio, const Frame& frame, const RenderView& view)
      : studio_(studio),
        scene_(studio.scene),
        frame_(frame),
        isProduct_(studio.style == RenderStyle::Product) {
    const Camera camera = makeCamera(scene_.middle, scene_.diagonal, view);
    eye_ = camera.eye.cast<float>();
    right_ = camera.right.cast<float>();
    up_ = camera.up.cast<float>();
    forward_ = camera.forward.cast<float>();
    distance_ = static_cast<float>(camera.distance);
    key_ = (-0.62F * right_ + 0.62F * up_ - 0.62F * forward_).normalized();
    model_ = studio.extent(camera);
    centre_ = studio.seen ? Vector2d(0, 0) : Vector2d(0.5 * (model_.low + model_.high));
    model_.grow(2 * studio.mmPerPixel);
    light_ = scene_.lightAtVertices(studioLight(scene_.sky.directions, right_, up_, -forward_));
    if (!studio.ground) return;
    darkness_ = studio.ground->darkness(
        studioLight(studio.ground->sky().directions, right_, up_, -forward_));
    for (const Vector3f& corner : studio.ground->corners()) {
      shadow_.add(project(camera, corner.cast<double>()));
    }
  }

  void drawTile(Picture& picture, int left, int top) const;

 private:
  [[nodiscard]] Sample shade(const FirstHit& hit, const Vector3f& direction) const;
  [[nodiscard]] Vector3f groundAt(double x, double y) const;
  [[nodiscard]] Sample sampleAt(double x, double y) const;
  [[nodiscard]] Vector3f fineAt(int x, int y) const;

  const Studio& studio_;
  const RenderScene& scene_;
  const Frame& frame_;
  bool isProduct_;
  Vector3f eye_, right_, up_, forward_;
  float distance_ = 1;  ///< of the eye from the middle, mm
  Vector3f key_;        ///< towards the lamp, for gloss
  Extent model_, shadow_;
  Vector2d centre_;              ///< of what is seen in the view plane, mm
  std::vector<Vector3f> light_;  ///< per vertex of the scene
  std::vector<float> darkness_;  ///< of the ground
};

Sample ModelRenderer::Shot::shade(const FirstHit& hit, const Vector3f& direction) const {
  const std::uint32_t* c = scene_.corners.data() + 3 * std::size_t{hit.primitive};
  const float w = 1 - hit.u - hit.v;
  const auto blend = [&](const std::vector<Vector3f>& values) -> Vector3f {
    return w * values[c[0]] + hit.u * values[c[1]] + hit.v * values[c[2]];
  };
  const std::uint32_t part = scene_.partOfFace[hit.primitive];
  const ClothPaint& cloth = scene_.cloth[part];
  const SurfaceLines::Near near = scene_.lines.near(part, blend(scene_.positions));
  Painted at =
      isProduct_ ? paintProduct(near, cloth, studio_.unit) : paintPlain(near, cloth, studio_.unit);
  Vector3f normal = blend(scene_.normals).normalized();
  Vector3f light = blend(light_);
  const Vector3f edgeA = scene_.positions[c[1]] - scene_.positions[c[0]];
  const Vector3f edgeB = scene_.positions[c[2]] - scene_.positions[c[0]];
  if (edgeA.cross(edgeB).dot(direction) > 0) {
    normal = -normal;
    light = Vector3f::Constant(kInside);
    at = {.colour = 0.5F * cloth.colour + 0.5F * cloth.thread};
  }
  float gloss = 0;
  if (isProduct_) {
    // Cloth is matt, with a nap that shines at grazing angles and the faintest gloss.
    const float facing = std::max(0.0F, -normal.dot(direction));
    const float mirrored = std::max(0.0F, normal.dot((key_ - direction).normalized()));
    gloss = (0.075F * power4(1 - facing) + 0.045F * power4(power4(mirrored))) * light.mean();
  }
  const Vector3f lit = at.shade * (light.cwiseProduct(at.colour) + Vector3f::Constant(gloss));
  return {(1 - at.inked) * toDisplay(lit) + at.inked * at.ink, part + 1, at.fine};
}

Vector3f ModelRenderer::Shot::groundAt(double x, double y) const {
  if (!isProduct_) return displayOf(kSheet);
  const double dx = (frame_.box.x + x - frame_.ground.x) / frame_.ground.width - 0.5;
  const double dy = (frame_.box.y + y - frame_.ground.y) / frame_.ground.height - 0.45;
  const auto t = static_cast<float>(std::min(1.0, 1.35 * std::sqrt(dx * dx + dy * dy)));
  return (1 - t * t) * displayOf(kGroundCentre) + t * t * displayOf(kGroundEdge);
}

Sample ModelRenderer::Shot::sampleAt(double x, double y) const {
  const PixelBox& box = frame_.box;
  const Vector2d at((x - box.width / 2.0) * studio_.mmPerPixel + centre_.x(),
                    (box.height / 2.0 + frame_.shift - y) * studio_.mmPerPixel + centre_.y());
  const bool mayHit = model_.holds(at);
  const bool mayBeDark = studio_.ground && shadow_.holds(at);
  if (!mayHit && !mayBeDark) return {groundAt(x, y), 0, false};
  const Vector3f direction = (distance_ * forward_ + static_cast<float>(at.x()) * right_ +
                              static_cast<float>(at.y()) * up_)
                                 .normalized();
  if (mayHit) {
    const FirstHit hit = scene_.surface.firstHit(eye_, direction, 0, 2 * distance_);
    if (hit.exists()) return shade(hit, direction);
  }
  Vector3f ground = groundAt(x, y);
  if (mayBeDark) {
    // Gone before the next view begins.
    const auto side = static_cast<float>(std::min(x, box.width - x) / (0.12 * box.width));
    const float dark = studio_.ground->at(darkness_, eye_, direction);
    ground *= 1 - kShadowStrength * dark * std::clamp(side, 0.0F, 1.0F);
  }
  return {ground, 0, false};
}

Vector3f ModelRenderer::Shot::fineAt(int x, int y) const {
  const int n = frame_.samples;
  Vector3f sum = Vector3f::Zero();
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      sum += sampleAt(x + (column + 0.5) / n, y + (row + 0.5) / n).colour;
    }
  }
  return sum / static_cast<float>(n * n);
}

/// One sample a pixel; many only on lines and where it differs from a neighbour.
void ModelRenderer::Shot::drawTile(Picture& picture, int left, int top) const {
  const auto differ = [](const Sample& a, const Sample& b) {
    return a.part != b.part || (a.colour - b.colour).cwiseAbs().maxCoeff() > kContrastStep;
  };
  const PixelBox& box = frame_.box;
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
    for (int x = -1; x <= width; ++x) coarseAt(x, y) = sampleAt(left + x + 0.5, top + y + 0.5);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Sample& here = coarseAt(x, y);
      const bool isEdge = here.fine || differ(here, coarseAt(x - 1, y)) ||
                          differ(here, coarseAt(x + 1, y)) || differ(here, coarseAt(x, y - 1)) ||
                          differ(here, coarseAt(x, y + 1));
      const Vector3f colour = isEdge ? fineAt(left + x, top + y) : here.colour;
      const Eigen::Matrix<std::uint32_t, 3, 1> rgb =
          (255 * colour + Vector3f::Constant(0.5F)).cast<std::uint32_t>();
      picture.at(box.x + left + x, box.y + top + y) = rgb[0] << 16U | rgb[1] << 8U | rgb[2];
    }
  }
}

ModelRenderer::ModelRenderer(RenderScene scene, RenderStyle style,
                             const std::optional<RenderCloseUp>& closeUp, bool standing)
    : studio_(std::make_unique<Studio>()) {
  studio_->scene = std::move(scene);
  studio_->style = style;
  if (closeUp) {
    studio_->scene.middle = closeUp->middle;
    studio_->seen = closeUp->height.mm();
  }
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
  if (studio_->seen) return Vector2d::Constant(*studio_->seen);
  const RenderScene& scene = studio_->scene;
  const Extent extent = studio_->extent(makeCamera(scene.middle, scene.diagonal, view));
  return (extent.high - extent.low).cwiseMax(1e-6);
}

void ModelRenderer::setScale(const Scale& scale) {
  studio_->mmPerPixel = scale.mmPerPixel;
  studio_->unit = static_cast<float>(scale.lineUnit);
  studio_->scene.lines.prepare(kPaintReach * studio_->unit);
}

void ModelRenderer::draw(Picture& picture, const Frame& frame, const RenderView& view,
                         const Progress* progress) const {
  const Shot shot(*studio_, frame, view);
  const int columns = (frame.box.width + kTile - 1) / kTile;
  const int rows = (frame.box.height + kTile - 1) / kTile;
  parallelFor(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
              [&](std::size_t tile) {
                if (isCancelled(progress)) return;
                const int index = static_cast<int>(tile);
                shot.drawTile(picture, index % columns * kTile, index / columns * kTile);
              });
}

}  // namespace toile
