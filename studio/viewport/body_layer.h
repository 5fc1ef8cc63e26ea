// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <memory>
#include <optional>
#include <vector>

#include "viewport/body_vertices.h"
#include "viewport/screen.h"

namespace toile::studio {

/// What stands before a place is drawn faintly, near that place on the screen.
struct SeeThrough {
  Eigen::Vector3d place;
  double strength = 1;  ///< 0..1, to fade in and out
  friend bool operator==(const SeeThrough&, const SeeThrough&) = default;
};

struct BodyLook {
  double strainScale = 0.2;     ///< end of the colours
  double strainLimit = 0;       ///< contour line; 0 = none
  bool strainOneSided = false;  ///< shear has no sign
  bool edges = false;
  std::optional<SeeThrough> seeThrough;
  friend bool operator==(const BodyLook&, const BodyLook&) = default;
};

/// Draws ground and body with OpenGL 3.3. All calls need the widget's context.
class BodyLayer {
 public:
  void initialize();
  void setVertices(const std::vector<BodyVertex>& vertices);
  void drawGround(QOpenGLExtraFunctions& gl);
  void draw(QOpenGLExtraFunctions& gl, const Screen& screen, const Eigen::Matrix4d& clip,
            const BodyLook& look);

 private:
  std::unique_ptr<QOpenGLShaderProgram> ground_, body_;
  std::unique_ptr<QOpenGLVertexArrayObject> array_;
  QOpenGLBuffer buffer_{QOpenGLBuffer::VertexBuffer};
  int count_ = 0;
};

[[nodiscard]] QMatrix4x4 toQt(const Eigen::Matrix4d& matrix);
[[nodiscard]] QVector3D toQt(const Eigen::Vector3d& vector);

}  // namespace toile::studio
