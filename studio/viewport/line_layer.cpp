// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/line_layer.h"

#include <Eigen/Geometry>
#include <QMatrix4x4>
#include <array>
#include <cstddef>

#include "viewport/body_layer.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

/// A point of a line, once for each side. Neighbours give the direction on the screen.
struct LineVertex {
  std::array<float, 3> before, at, after, normal;
  float side;
  float arc;  ///< mm
};

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 at;
layout(location = 2) in vec3 after;
layout(location = 3) in vec3 normal;
layout(location = 4) in float side;
layout(location = 5) in float arc;
uniform mat4 clip;
uniform vec2 size;       // px
uniform float reach;     // px from the middle of the line to its outer edge, with the smooth rim
uniform vec3 eye;
uniform float lift;      // mm towards the eye, so that the line wins over the surface it lies on
uniform float pixelsPerMm;
out float vAcross, vAlong, vFacing;
vec2 pixel(vec4 p) { return p.xy / p.w * 0.5 * size; }
void main() {
  vec3 towards = normalize(eye - at);
  vec4 p = clip * vec4(at + lift * towards, 1.0);
  vec2 a = pixel(clip * vec4(before, 1.0)), b = pixel(p), c = pixel(clip * vec4(after, 1.0));
  vec2 u = b - a, v = c - b;
  float lu = length(u), lv = length(v);
  u = lu > 1e-4 ? u / lu : (lv > 1e-4 ? v / lv : vec2(1.0, 0.0));
  v = lv > 1e-4 ? v / lv : u;
  vec2 along = u + v;
  along = length(along) > 1e-3 ? normalize(along) : u;
  vec2 across = vec2(-along.y, along.x);
  // A mitre, not longer than twice the width.
  float stretch = 1.0 / max(abs(dot(across, vec2(-u.y, u.x))), 0.5);
  b += across * side * reach * stretch;
  gl_Position = vec4(b / (0.5 * size) * p.w, p.z, p.w);
  vAcross = side * reach;
  vAlong = arc * pixelsPerMm;
  vFacing = dot(normal, normal) > 0.0 ? dot(normal, towards) : 1.0;
})";

constexpr const char* kFragment = R"(#version 330 core
in float vAcross, vAlong, vFacing;
out vec4 colour;
uniform vec4 ink;
uniform float half_;
uniform vec4 dashes;  // px: on, off, on, off
void main() {
  float alpha = clamp(half_ + 0.5 - abs(vAcross), 0.0, 1.0);
  float period = dashes.x + dashes.y + dashes.z + dashes.w;
  if (period > 0.0) {
    float place = mod(vAlong, period);
    if (dashes.x <= 0.0) {
      vec2 d = vec2(place - 0.5 * period, vAcross);
      alpha = clamp(half_ + 0.5 - length(d), 0.0, 1.0);
    } else {
      float first = min(place + 0.5, dashes.x - place + 0.5);
      float second = min(place - dashes.x - dashes.y + 0.5,
                         dashes.x + dashes.y + dashes.z - place + 0.5);
      alpha *= clamp(dashes.z > 0.0 ? max(first, second) : first, 0.0, 1.0);
    }
  }
  alpha *= smoothstep(-0.04, 0.08, vFacing);
  if (alpha < 0.004) discard;
  colour = vec4(ink.rgb, ink.a * alpha);
})";

std::array<float, 3> floats(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void append(std::vector<LineVertex>& vertices, const DrawnLine& line) {
  const std::size_t count = line.points.size();
  const bool closed = count > 3 && line.points.front() == line.points.back();
  double arc = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) arc += (line.points[i] - line.points[i - 1]).norm();
    const Vector3d& before = i > 0 ? line.points[i - 1] : line.points[closed ? count - 2 : 0];
    const Vector3d& after =
        i + 1 < count ? line.points[i + 1] : line.points[closed ? 1 : count - 1];
    const Vector3d normal = line.normals.empty() ? Vector3d::Zero() : line.normals[i];
    for (const float side : {-1.0F, 1.0F}) {
      vertices.push_back({floats(before), floats(line.points[i]), floats(after), floats(normal),
                          side, static_cast<float>(arc)});
    }
  }
}

struct Stroke {
  QColor colour;
  double width;
  std::array<double, 4> dashes{};
};

}  // namespace

void LineLayer::initialize() {
  program_ = std::make_unique<QOpenGLShaderProgram>();
  program_->addShaderFromSourceCode(QOpenGLShader::Vertex, kVertex);
  program_->addShaderFromSourceCode(QOpenGLShader::Fragment, kFragment);
  program_->link();
  array_ = std::make_unique<QOpenGLVertexArrayObject>();
  array_->create();
  buffer_ = QOpenGLBuffer(QOpenGLBuffer::VertexBuffer);
  buffer_.create();
}

void LineLayer::draw(QOpenGLExtraFunctions& gl, const Screen& screen, const Eigen::Matrix4d& clip,
                     double pixelRatio, std::span<const DrawnLine> lines, bool through) {
  std::vector<LineVertex> vertices;
  std::vector<int> first;
  for (const DrawnLine& line : lines) {
    first.push_back(static_cast<int>(vertices.size()));
    if (line.points.size() > 1) append(vertices, line);
  }
  first.push_back(static_cast<int>(vertices.size()));
  if (vertices.empty()) return;

  const QOpenGLVertexArrayObject::Binder binder(array_.get());
  program_->bind();
  buffer_.bind();
  buffer_.setUsagePattern(QOpenGLBuffer::StreamDraw);
  buffer_.allocate(vertices.data(), static_cast<int>(vertices.size() * sizeof(LineVertex)));
  const auto attribute = [&](int index, std::size_t offset, int size) {
    program_->enableAttributeArray(index);
    program_->setAttributeBuffer(index, GL_FLOAT, static_cast<int>(offset), size,
                                 sizeof(LineVertex));
  };
  attribute(0, offsetof(LineVertex, before), 3);
  attribute(1, offsetof(LineVertex, at), 3);
  attribute(2, offsetof(LineVertex, after), 3);
  attribute(3, offsetof(LineVertex, normal), 3);
  attribute(4, offsetof(LineVertex, side), 1);
  attribute(5, offsetof(LineVertex, arc), 1);

  program_->setUniformValue("clip", toQt(clip));
  program_->setUniformValue("eye", toQt(screen.view.eye));
  program_->setUniformValue("size", QVector2D(static_cast<float>(screen.width * pixelRatio),
                                              static_cast<float>(screen.height * pixelRatio)));
  program_->setUniformValue("pixelsPerMm", static_cast<float>(screen.pixelsPerMm() * pixelRatio));
  // Facets of the surface stand a little over the line, and the line's own width reaches over them.
  const double lift = 1.5 + 3.0 / screen.pixelsPerMm();
  program_->setUniformValue("lift", static_cast<float>(lift));

  gl.glEnable(GL_DEPTH_TEST);
  gl.glEnable(GL_BLEND);
  gl.glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.glDepthMask(GL_FALSE);
  const auto stroke = [&](std::size_t i, const Stroke& look) {
    const auto half = static_cast<float>(0.5 * look.width * pixelRatio);
    const auto scaled = [&](double px) { return static_cast<float>(px * pixelRatio); };
    program_->setUniformValue("half_", half);
    program_->setUniformValue("reach", half + 1.0F);
    program_->setUniformValue("ink", look.colour);
    program_->setUniformValue("dashes", QVector4D(scaled(look.dashes[0]), scaled(look.dashes[1]),
                                                  scaled(look.dashes[2]), scaled(look.dashes[3])));
    gl.glDrawArrays(GL_TRIANGLE_STRIP, first[i], first[i + 1] - first[i]);
  };

  gl.glDepthFunc(GL_LEQUAL);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].halo.isValid()) stroke(i, {lines[i].halo, lines[i].haloWidth});
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].casing <= 0) continue;
    stroke(i, {QColor::fromRgbF(1, 1, 1, static_cast<float>(lines[i].casing)), lines[i].width + 2});
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DrawnLine& line = lines[i];
    if (line.width <= 0) continue;
    stroke(i, {line.colour, line.width, {line.dash, line.gap, line.dash2, line.gap2}});
  }
  if (through) {
    gl.glDepthFunc(GL_GREATER);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      QColor faint = lines[i].colour;
      faint.setAlphaF(0.4F);
      if (lines[i].width > 0) stroke(i, {faint, 1.4, {2, 4, 0, 0}});
    }
  }
  gl.glDepthMask(GL_TRUE);
  gl.glDepthFunc(GL_LESS);
  gl.glDisable(GL_BLEND);
  buffer_.release();
  program_->release();
}

}  // namespace toile::studio
