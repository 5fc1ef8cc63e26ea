// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/body_layer.h"

#include <Eigen/Geometry>
#include <QMatrix4x4>
#include <QVector3D>
#include <cstddef>

#include "app/palette.h"

namespace toile::studio {

namespace {

constexpr const char* kGroundVertex = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(place * 2.0 - 1.0, 1.0, 1.0);
})";

constexpr const char* kGroundFragment = R"(#version 330 core
in vec2 place;
out vec4 colour;
uniform vec3 centre, edge;
void main() {
  float r = clamp(length((place - vec2(0.5, 0.55)) * vec2(1.1, 1.0)) * 1.35, 0.0, 1.0);
  // A little noise: without it 8 bits show rings.
  float noise = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
  colour = vec4(mix(centre, edge, smoothstep(0.0, 1.0, r)) + noise / 255.0, 1.0);
})";

constexpr const char* kBodyVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float openness;
layout(location = 3) in float strain;
layout(location = 4) in vec4 colour;
uniform mat4 clip;
out vec3 vPosition, vNormal;
out float vOpenness, vStrain;
out vec4 vColour;
out vec3 vCorner;
void main() {
  vPosition = position;
  vNormal = normal;
  vOpenness = openness;
  vStrain = strain;
  vColour = colour;
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = clip * vec4(position, 1.0);
})";

// Light comes with the eye: key from the upper left, a weak fill from the right, the sky dimmed
// where the surface folds.
constexpr const char* kBodyFragment = R"(#version 330 core
in vec3 vPosition, vNormal;
in float vOpenness, vStrain;
in vec4 vColour;
in vec3 vCorner;
out vec4 colour;
uniform vec3 right, up, back;
uniform vec3 stops[7];
uniform float strainScale, strainLimit;
uniform vec3 limitColour;
uniform bool oneSided, edges, ghost;
uniform vec4 through;      // a place, and how strongly what stands before it fades
uniform vec2 throughPixel;

vec3 strainColour(float t) {
  float place = (clamp(t, -1.0, 1.0) + 1.0) * 3.0;
  int stop = min(int(place), 5);
  return mix(stops[stop], stops[stop + 1], place - float(stop));
}

void main() {
  float faint = 0.0;
  if (through.w > 0.0) {
    float before = dot(vPosition - through.xyz, back);
    float near = 1.0 - smoothstep(110.0, 190.0, distance(gl_FragCoord.xy, throughPixel));
    faint = through.w * near * smoothstep(12.0, 30.0, before);
  }
  if (ghost ? faint <= 0.01 : faint > 0.01) discard;

  vec3 n = normalize(vNormal);
  if (!gl_FrontFacing) n = -n;
  vec3 v = vec3(dot(n, right), dot(n, up), dot(n, back));
  float key = max(0.0, (dot(v, normalize(vec3(-0.55, 0.62, 0.56))) + 0.15) / 1.15);
  float fill = max(0.0, dot(v, normalize(vec3(0.85, -0.05, 0.4))));
  float rim = pow(1.0 - max(v.z, 0.0), 3.0);
  float sky = (0.43 + 0.10 * n.z) * mix(0.35, 1.0, smoothstep(0.15, 0.95, vOpenness));
  float light = sky + 0.56 * key * mix(0.75, 1.0, vOpenness) + 0.13 * fill - 0.10 * rim;
  vec3 albedo = vColour.rgb;
  if (vColour.a < 0.5) {
    float t = vStrain / strainScale;
    albedo = strainColour(oneSided ? abs(t) : t);
    if (abs(t) > 1.0 && fract((gl_FragCoord.x + gl_FragCoord.y) / 8.0) < 0.3) albedo *= 0.82;
    light = mix(1.0, light, 0.5);
    if (strainLimit > 0.0) {
      float over = abs(vStrain) - strainLimit;
      float line = abs(over) / max(fwidth(over), 1e-6);
      albedo = mix(limitColour, albedo, smoothstep(0.4, 1.3, line));
    }
  }
  float gloss = pow(max(0.0, dot(v, normalize(vec3(-0.3, 0.4, 0.87)))), 24.0) * 0.05;
  vec3 shown = albedo * light + gloss;
  if (edges) {
    vec3 width = fwidth(vCorner);
    vec3 line = smoothstep(vec3(0.0), width * 1.2, vCorner);
    shown = mix(shown * 0.72, shown, min(line.x, min(line.y, line.z)));
  }
  if (!gl_FrontFacing) shown *= 0.72;
  colour = vec4(shown, ghost ? mix(1.0, 0.22, faint) : 1.0);
})";

QVector3D asVector(const QColor& colour) {
  return {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
          static_cast<float>(colour.blueF())};
}

std::unique_ptr<QOpenGLShaderProgram> makeProgram(const char* vertex, const char* fragment) {
  auto program = std::make_unique<QOpenGLShaderProgram>();
  program->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex);
  program->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment);
  program->link();
  return program;
}

}  // namespace

QMatrix4x4 toQt(const Eigen::Matrix4d& matrix) {
  QMatrix4x4 result;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      result(row, column) = static_cast<float>(matrix(row, column));
    }
  }
  return result;
}

QVector3D toQt(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void BodyLayer::initialize() {
  ground_ = makeProgram(kGroundVertex, kGroundFragment);
  body_ = makeProgram(kBodyVertex, kBodyFragment);
  array_ = std::make_unique<QOpenGLVertexArrayObject>();
  array_->create();
  buffer_ = QOpenGLBuffer(QOpenGLBuffer::VertexBuffer);
  buffer_.create();
  count_ = 0;
}

void BodyLayer::setVertices(const std::vector<BodyVertex>& vertices) {
  const QOpenGLVertexArrayObject::Binder binder(array_.get());
  buffer_.bind();
  buffer_.setUsagePattern(QOpenGLBuffer::DynamicDraw);
  buffer_.allocate(vertices.data(), static_cast<int>(vertices.size() * sizeof(BodyVertex)));
  constexpr int kStride = sizeof(BodyVertex);
  const auto attribute = [&](int index, GLenum type, std::size_t offset, int size) {
    body_->enableAttributeArray(index);
    body_->setAttributeBuffer(index, type, static_cast<int>(offset), size, kStride);
  };
  attribute(0, GL_FLOAT, offsetof(BodyVertex, position), 3);
  attribute(1, GL_FLOAT, offsetof(BodyVertex, normal), 3);
  attribute(2, GL_FLOAT, offsetof(BodyVertex, openness), 1);
  attribute(3, GL_FLOAT, offsetof(BodyVertex, strain), 1);
  attribute(4, GL_UNSIGNED_BYTE, offsetof(BodyVertex, colour), 4);  // normalised by Qt
  buffer_.release();
  count_ = static_cast<int>(vertices.size());
}

void BodyLayer::drawGround(QOpenGLExtraFunctions& gl) {
  gl.glDisable(GL_DEPTH_TEST);
  gl.glDisable(GL_BLEND);
  const QOpenGLVertexArrayObject::Binder binder(array_.get());
  ground_->bind();
  ground_->setUniformValue("centre", asVector(palette().groundCentre));
  ground_->setUniformValue("edge", asVector(palette().groundEdge));
  gl.glDrawArrays(GL_TRIANGLES, 0, 3);
  ground_->release();
}

void BodyLayer::draw(QOpenGLExtraFunctions& gl, const Screen& screen, const Eigen::Matrix4d& clip,
                     const BodyLook& look) {
  if (count_ == 0) return;
  const Eigen::Vector3d back = (screen.view.eye - screen.view.target).normalized();
  const Eigen::Vector3d right = screen.view.up.cross(back).normalized();
  const QOpenGLVertexArrayObject::Binder binder(array_.get());
  body_->bind();
  body_->setUniformValue("clip", toQt(clip));
  body_->setUniformValue("right", toQt(right));
  body_->setUniformValue("up", toQt(Eigen::Vector3d(back.cross(right))));
  body_->setUniformValue("back", toQt(back));
  for (int i = 0; i < 7; ++i) {
    body_->setUniformValue(QStringLiteral("stops[%1]").arg(i).toLatin1().constData(),
                           asVector(strainColour((i - 3) / 3.0)));
  }
  body_->setUniformValue("strainScale", static_cast<float>(look.strainScale));
  body_->setUniformValue("strainLimit", static_cast<float>(look.strainLimit));
  body_->setUniformValue("limitColour", asVector(QColor("#16202E")));
  body_->setUniformValue("oneSided", look.strainOneSided);
  body_->setUniformValue("edges", look.edges);
  QVector4D through;
  QVector2D pixel;
  if (look.seeThrough) {
    const auto& place = look.seeThrough->place;
    through = QVector4D(toQt(place), static_cast<float>(look.seeThrough->strength));
    if (const auto at = screen.toPixel(place)) {
      pixel = QVector2D(static_cast<float>(at->x()), static_cast<float>(screen.height - at->y()));
    }
  }
  body_->setUniformValue("through", through);
  body_->setUniformValue("throughPixel", pixel);

  gl.glEnable(GL_DEPTH_TEST);
  gl.glDepthFunc(GL_LESS);
  gl.glDisable(GL_BLEND);
  body_->setUniformValue("ghost", false);
  gl.glDrawArrays(GL_TRIANGLES, 0, count_);
  if (look.seeThrough) {
    gl.glEnable(GL_BLEND);
    gl.glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.glDepthMask(GL_FALSE);
    gl.glEnable(GL_CULL_FACE);
    body_->setUniformValue("ghost", true);
    gl.glDrawArrays(GL_TRIANGLES, 0, count_);
    gl.glDisable(GL_CULL_FACE);
    gl.glDepthMask(GL_TRUE);
    gl.glDisable(GL_BLEND);
  }
  body_->release();
}

}  // namespace toile::studio
