// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/render_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "io/ray_scene.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kTile = 32;                          // px, one task
constexpr std::size_t kOcclusionRays = 2'000'000;  // for the whole model
constexpr std::size_t kMostRaysPerVertex = 128;    // over the sphere; half of them count
constexpr std::size_t kLeastRaysPerVertex = 24;
constexpr double kOcclusionReach = 0.25;  // of the model's diagonal: nearer surface darkens
constexpr double kEyeDistance = 5;        // in diagonals: nearly parallel, yet round
constexpr int kMostTubes = 12;            // along one ray
constexpr double kCasing = 1;             // px of white beside a line, each side
constexpr double kCasingOpacity = 0.55;
constexpr double kContrastStep = 18.0 / 255;  // difference of samples that asks for more of them

// Shading is computed in linear light; mixing of samples in sRGB, where edges look even.
double toLinear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
/// By table: it is asked for every sample, and pictures have eight bits.
double toDisplay(double x) {
  constexpr std::size_t kSteps = 4096;
  static const std::vector<double> table = [] {
    std::vector<double> values(kSteps + 1);
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double c = static_cast<double>(i) / kSteps;
      values[i] = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    }
    return values;
  }();
  return table[static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, 1.0) * kSteps))];
}
/// The 32nd power, 0 for what faces away.
double sharpened(double cosine) {
  double x = std::max(0.0, cosine);
  for (int i = 0; i < 5; ++i) x *= x;
  return x;
}
Vector3d displayOf(Colour c) {
  return Vector3d(c.r, c.g, c.b) / 255.0;
}
Vector3d linearOf(Colour c) {
  return displayOf(c).unaryExpr(&toLinear);
}

/// Normals weighted by angle, so that they do not depend on how a face is split.
std::vector<Vector3d> vertexNormals(const Mesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertexCount(), Vector3d::Zero());
  for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
    const Triangle& corners = mesh.vertices(FaceId(i));
    const Vector3d normal = mesh.normal(FaceId(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = mesh.position(corners[k]);
      const Vector3d a = (mesh.position(corners[(k + 1) % 3]) - p).normalized();
      const Vector3d b = (mesh.position(corners[(k + 2) % 3]) - p).normalized();
      normals[corners[k].index()] += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * normal;
    }
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

/// Evenly spread directions (golden spiral): the same for every vertex, so that the light varies
/// smoothly from one to the next.
std::vector<Vector3f> sphereDirections(std::size_t count) {
  std::vector<Vector3f> directions(count);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z);
    const double angle = golden * static_cast<double>(i);
    directions[i] = Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>();
  }
  return directions;
}

struct Camera {
  Vector3d eye, right, up, forward;
  double distance = 1;  ///< of the eye from the middle
};

Camera makeCamera(const Vector3d& middle, double diagonal, const ModelView& view) {
  Camera camera;
  const Vector3d out(std::cos(view.above) * std::sin(view.turn),
                     -std::cos(view.above) * std::cos(view.turn), std::sin(view.above));
  camera.distance = kEyeDistance * diagonal;
  camera.eye = middle + camera.distance * out;
  camera.forward = -out;
  camera.right = camera.forward.cross(Vector3d::UnitZ()).normalized();
  camera.up = camera.right.cross(camera.forward);
  return camera;
}

/// Where a point appears in the plane through the middle of the model, mm.
Vector2d project(const Camera& camera, const Vector3d& p) {
  const Vector3d d = p - camera.eye;
  const double scale = camera.distance / d.dot(camera.forward);
  return {scale * d.dot(camera.right), scale * d.dot(camera.up)};
}

struct Line {
  LineStyle style;
  std::vector<Vector3d> points;
};

/// One straight stretch of a line, with its way along the line.
struct Stretch {
  Vector3d a, b;
  double from = 0;  ///< mm along the line at a
  std::uint32_t line = 0;
};

bool isInked(const LineStyle& style, double along, double across) {
  switch (style.dash) {
    case Dash::Solid:
      return true;
    case Dash::Dashes:
      return std::fmod(along, kDashOn + kDashOff) < kDashOn;
    case Dash::Dots: {
      const double fromDot = std::remainder(along, kDotSpacing);
      return std::hypot(fromDot, across) <= style.width / 2;
    }
    case Dash::LongShort: {
      const double at = std::fmod(along, kLongOn + 3 * kLongOff);
      return at < kLongOn || (at >= kLongOn + kLongOff && at < kLongOn + 2 * kLongOff);
    }
  }
  return true;
}

struct Sample {
  Vector3d colour;         ///< display values 0..1
  std::uint32_t seen = 0;  ///< what kind of thing: ground, surface, ink, casing
};

}  // namespace

struct ModelRenderer::Scene {
  std::vector<Vector3f> positions;
  std::vector<std::uint32_t> corners;
  std::vector<Vector3f> normals;  ///< per corner's vertex
  std::vector<float> openness;    ///< 1 = sees the whole sky, 0 = nothing
  std::vector<std::uint16_t> colourOfFace;
  std::vector<Vector3d> colours;  ///< linear
  std::vector<Line> lines;
  Vector3d middle = Vector3d::Zero();
  double diagonal = 1;
  RayScene surface;

  void addPieces(const Pattern& pattern);
  void addModel(const Mesh& mesh);
  void addVertexLight(const Mesh& model, const std::vector<Vector3d>& modelNormals,
                      const std::vector<float>& modelOpenness,
                      const VertexData<SurfacePoint>& onModel);
  void addLines(const Pattern& pattern);
  [[nodiscard]] std::vector<float> computeOpenness(const Mesh& mesh,
                                                   const std::vector<Vector3d>& normals) const;
  [[nodiscard]] std::array<Vector2d, 2> extent(const Camera& camera) const;
  [[nodiscard]] Vector3d shade(const FirstHit& hit, const Camera& camera,
                               const Vector3d& direction) const;
};

/// What one call of draw() needs in every sample.
struct DrawContext {
  Camera camera;
  Vector2d centre;     ///< of the model in the view plane, mm
  Vector2d low, high;  ///< beyond these there is nothing to see, mm
  double unit = 1;     ///< mm per px of the line styles
  std::vector<Stretch> stretches;
  RayScene tubes;
};

void ModelRenderer::Scene::addModel(const Mesh& mesh) {
  for (const Vector3d& p : mesh.positions()) positions.push_back(p.cast<float>());
  for (const Triangle& triangle : mesh.triangles()) {
    for (const VertexId v : triangle) corners.push_back(v.index());
  }
  middle = 0.5 * (mesh.boxMin() + mesh.boxMax());
  diagonal = std::max((mesh.boxMax() - mesh.boxMin()).norm(), 1e-6);
  surface = RayScene::ofTriangles(positions, corners);
}

std::vector<float> ModelRenderer::Scene::computeOpenness(
    const Mesh& mesh, const std::vector<Vector3d>& meshNormals) const {
  const std::size_t count = mesh.vertexCount();
  const std::vector<Vector3f> directions =
      sphereDirections(std::clamp(kOcclusionRays / count, kLeastRaysPerVertex, kMostRaysPerVertex));
  std::vector<float> result(count, 1.0F);
  const auto lift = static_cast<float>(2e-4 * diagonal);
  const auto reach = static_cast<float>(kOcclusionReach * diagonal);
  constexpr std::size_t kBlock = 256;
  parallelFor((count + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const Vector3f normal = meshNormals[i].cast<float>();
      const Vector3f origin = mesh.position(VertexId(i)).cast<float>() + lift * normal;
      float open = 0;
      float all = 0;
      for (const Vector3f& direction : directions) {
        const float weight = normal.dot(direction);
        if (weight <= 0.05F) continue;  // grazing rays meet the facets of the surface itself
        all += weight;
        if (!surface.isBlocked(origin, direction, 0, reach)) open += weight;
      }
      if (all > 0) result[i] = open / all;
    }
  });
  return result;
}

void ModelRenderer::Scene::addVertexLight(const Mesh& model,
                                          const std::vector<Vector3d>& modelNormals,
                                          const std::vector<float>& modelOpenness,
                                          const VertexData<SurfacePoint>& onModel) {
  for (const SurfacePoint& point : onModel.values()) {
    const FaceId face = facesOf(model, point).front();
    const Vector3d weights = barycentricIn(model, point, face);
    Vector3d normal = Vector3d::Zero();
    double open = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = model.vertices(face)[static_cast<std::size_t>(k)].index();
      normal += weights[k] * modelNormals[v];
      open += weights[k] * static_cast<double>(modelOpenness[v]);
    }
    normals.push_back(normal.cast<float>());
    openness.push_back(static_cast<float>(open));
  }
}

void ModelRenderer::Scene::addPieces(const Pattern& pattern) {
  const Mesh& model = *pattern.document.model->mesh;
  const std::vector<Vector3d> modelNormals = vertexNormals(model);
  addModel(model);
  const std::vector<float> modelOpenness = computeOpenness(model, modelNormals);
  positions.clear();
  corners.clear();

  const std::vector<Colour> tints = pieceColours(pattern.cut);
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vector3d& p : piece.mesh->positions()) positions.push_back(p.cast<float>());
    for (const Triangle& triangle : piece.mesh->triangles()) {
      for (const VertexId v : triangle) corners.push_back(first + v.index());
      colourOfFace.push_back(static_cast<std::uint16_t>(i));
    }
    addVertexLight(model, modelNormals, modelOpenness, piece.onModel);
    colours.push_back(linearOf(tints[i]));
  }
  surface = RayScene::ofTriangles(positions, corners);
}

void ModelRenderer::Scene::addLines(const Pattern& pattern) {
  const Mesh& model = *pattern.document.model->mesh;
  for (const PlacedCurve& curve : pattern.curves) {
    if (curve.kind == CurveKind::Guide) continue;
    Line line{lineStyle(curve.kind), {}};
    for (const SurfacePoint& point : curve.path.points) {
      line.points.push_back(position(model, point));
    }
    if (curve.path.closed && !line.points.empty()) line.points.push_back(line.points.front());
    lines.push_back(std::move(line));
  }
  for (const std::vector<HalfedgeId>& loop : model.boundaryLoops()) {
    Line line{lineStyle(WireKind::Border), {}};
    for (const HalfedgeId h : loop) line.points.push_back(model.position(model.from(h)));
    line.points.push_back(line.points.front());
    lines.push_back(std::move(line));
  }
}

std::array<Vector2d, 2> ModelRenderer::Scene::extent(const Camera& camera) const {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const Vector3f& p : positions) {
    const Vector2d at = project(camera, p.cast<double>());
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  return {low, high};
}

Vector3d ModelRenderer::Scene::shade(const FirstHit& hit, const Camera& camera,
                                     const Vector3d& direction) const {
  const std::uint32_t* c = corners.data() + 3 * std::size_t{hit.primitive};
  const float w = 1 - hit.u - hit.v;
  Vector3d normal =
      (w * normals[c[0]] + hit.u * normals[c[1]] + hit.v * normals[c[2]]).cast<double>();
  double open =
      static_cast<double>(w * openness[c[0]] + hit.u * openness[c[1]] + hit.v * openness[c[2]]);
  normal.normalize();
  const Vector3f edgeA = positions[c[1]] - positions[c[0]];
  const Vector3f edgeB = positions[c[2]] - positions[c[0]];
  if (edgeA.cross(edgeB).cast<double>().dot(direction) > 0) {  // the inside of an open model
    normal = -normal;
    open *= 0.6;
  }
  const auto fromCamera = [&camera](double x, double y, double z) {
    return Vector3d(x * camera.right + y * camera.up - z * camera.forward).normalized();
  };
  static constexpr double kWrap = 0.25;  // a large soft lamp reaches past the terminator
  const Vector3d key = fromCamera(-0.55, 0.65, 0.60);
  const Vector3d fill = fromCamera(0.80, -0.10, 0.50);
  const double lit = std::max(0.0, (normal.dot(key) + kWrap) / (1 + kWrap));
  const double sky = open * (0.78 + 0.22 * normal.z());
  const double light = 0.46 * sky + 0.68 * lit * (0.30 + 0.70 * open) +
                       0.12 * std::max(0.0, normal.dot(fill)) * open;
  const Vector3d half = (key - direction).normalized();
  const double gloss = 0.035 * open * sharpened(normal.dot(half));
  return (light * colours[colourOfFace[hit.primitive]] + Vector3d::Constant(gloss))
      .unaryExpr(&toDisplay);
}

namespace {

DrawContext makeContext(const std::vector<Line>& lines, const Camera& camera,
                        const std::array<Vector2d, 2>& extent, double unit) {
  DrawContext context;
  context.camera = camera;
  context.unit = unit;
  // Lines stand out beyond the surface by half their width.
  const Vector2d rim = Vector2d::Constant(10 * unit);
  context.low = extent[0] - rim;
  context.high = extent[1] + rim;
  context.centre = 0.5 * (extent[0] + extent[1]);

  std::vector<Tube> tubes;
  std::vector<float> radii;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    double from = 0;
    const double radius = (lines[i].style.width / 2 + kCasing) * unit;
    for (std::size_t k = 0; k + 1 < lines[i].points.size(); ++k) {
      const Vector3d& a = lines[i].points[k];
      const Vector3d& b = lines[i].points[k + 1];
      const double length = (b - a).norm();
      if (length <= 0) continue;
      context.stretches.push_back({a, b, from, static_cast<std::uint32_t>(i)});
      tubes.push_back({a.cast<float>(), b.cast<float>()});
      radii.push_back(static_cast<float>(radius));
      from += length;
    }
  }
  context.tubes = RayScene::ofTubes(tubes, radii);
  return context;
}

/// Where the ray passes the stretch: how far along the line and how far from its axis, in px of
/// the line styles.
Vector2d passOf(const DrawContext& context, const Stretch& stretch, const Vector3d& direction) {
  const Vector3d axis = stretch.b - stretch.a;
  const Vector3d toEye = context.camera.eye - stretch.a;
  // Least distance between the ray and the segment, both as lines, then the segment clamped.
  const double aa = axis.squaredNorm();
  const double ad = axis.dot(direction);
  const double denominator = aa - ad * ad;  // the direction is of unit length
  double s =
      denominator > 1e-12 * aa ? (axis.dot(toEye) - ad * direction.dot(toEye)) / denominator : 0.0;
  s = std::clamp(s, 0.0, 1.0);
  const Vector3d offset = stretch.a + s * axis - context.camera.eye;
  const double across = (offset - offset.dot(direction) * direction).norm();
  return {(stretch.from + s * std::sqrt(aa)) / context.unit, across / context.unit};
}

}  // namespace

ModelRenderer::ModelRenderer(const Pattern& pattern) : scene_(std::make_unique<Scene>()) {
  scene_->addPieces(pattern);
  scene_->addLines(pattern);
}

ModelRenderer::~ModelRenderer() = default;

Vector2d ModelRenderer::size(const ModelView& view) const {
  const auto [low, high] = scene_->extent(makeCamera(scene_->middle, scene_->diagonal, view));
  return (high - low).cwiseMax(1e-6);
}

void ModelRenderer::draw(Picture& picture, const Frame& frame, const ModelView& view) const {
  const Scene& scene = *scene_;
  const PixelBox& box = frame.box;
  const Camera camera = makeCamera(scene.middle, scene.diagonal, view);
  const DrawContext context =
      makeContext(scene.lines, camera, scene.extent(camera), frame.mmPerPixel * frame.lineScale);
  const Vector3f eye = camera.eye.cast<float>();

  const auto sampleAt = [&](double x, double y, const Vector3d& ground) -> Sample {
    const double right = (x - box.width / 2.0) * frame.mmPerPixel + context.centre.x();
    const double up = (box.height / 2.0 - y) * frame.mmPerPixel + context.centre.y();
    const bool beside = right < context.low.x() || right > context.high.x() ||
                        up < context.low.y() || up > context.high.y();
    if (beside) return {ground, 0};
    const Vector3d direction =
        (camera.distance * camera.forward + right * camera.right + up * camera.up).normalized();
    const Vector3f ray = direction.cast<float>();
    const auto far = static_cast<float>(2 * camera.distance);
    const FirstHit hit = scene.surface.firstHit(eye, ray, 0, far);
    Sample sample{hit.exists() ? scene.shade(hit, camera, direction) : ground,
                  hit.exists() ? 1 + scene.colourOfFace[hit.primitive] : 0U};
    // Where a line runs towards the eye the casing of one stretch hides the ink of the next: look
    // on until there is ink or the surface.
    const float end = std::min(hit.t, far);
    bool cased = false;
    float near = 0;
    for (int pass = 0; pass < kMostTubes; ++pass) {
      const FirstHit tube = context.tubes.firstHit(eye, ray, near, end);
      if (!tube.exists()) break;
      const Stretch& stretch = context.stretches[tube.primitive];
      const LineStyle& style = scene.lines[stretch.line].style;
      const Vector2d place = passOf(context, stretch, direction);
      if (place.y() <= style.width / 2 && isInked(style, place.x(), place.y())) {
        return {displayOf(style.colour), 0x10000};
      }
      cased = true;
      near = tube.t + static_cast<float>(0.25 * context.unit);
    }
    if (cased && hit.exists()) {  // the casing helps the line on the body, not beside it
      sample.colour += kCasingOpacity * (Vector3d::Ones() - sample.colour);
      sample.seen = 0x20000;
    }
    return sample;
  };

  const auto groundAt = [&](int x, int y) -> Vector3d {
    const double dx = (box.x + x + 0.5 - frame.ground.x) / frame.ground.width - 0.5;
    const double dy = (box.y + y + 0.5 - frame.ground.y) / frame.ground.height - 0.45;
    const double t = std::min(1.0, 1.5 * std::sqrt(dx * dx + dy * dy));
    return (1 - t) * displayOf(kGroundCentre) + t * displayOf(kGroundEdge);
  };

  // One sample a pixel; many only where it differs from a neighbour: outlines and lines.
  const auto fineAt = [&](int x, int y) -> Vector3d {
    const int n = frame.samples + 1;
    const Vector3d ground = groundAt(x, y);
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < n * n; ++i) {
      const int column = i % n;
      const int row = i / n;
      sum += sampleAt(x + (column + 0.5) / n, y + (row + 0.5) / n, ground).colour;
    }
    return sum / (n * n);
  };
  const auto differ = [](const Sample& a, const Sample& b) {
    return a.seen != b.seen || (a.colour - b.colour).cwiseAbs().maxCoeff() > kContrastStep;
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
        coarseAt(x, y) = sampleAt(left + x + 0.5, top + y + 0.5, groundAt(left + x, top + y));
      }
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Sample& here = coarseAt(x, y);
        const bool edge = differ(here, coarseAt(x - 1, y)) || differ(here, coarseAt(x + 1, y)) ||
                          differ(here, coarseAt(x, y - 1)) || differ(here, coarseAt(x, y + 1));
        const Vector3d colour = edge ? fineAt(left + x, top + y) : here.colour;
        const Eigen::Matrix<std::uint32_t, 3, 1> rgb =
            (255 * colour + Vector3d::Constant(0.5)).cast<std::uint32_t>();
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
