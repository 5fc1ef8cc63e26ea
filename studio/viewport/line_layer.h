// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <memory>
#include <span>
#include <vector>

#include "viewport/screen.h"

namespace toile::studio {

/// A thick line on the body.
struct DrawnLine {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< empty: seen from everywhere
  QColor colour;
  double width = 2;            ///< px
  double dash = 0, gap = 0;    ///< px; dash 0 with a gap: round dots
  double dash2 = 0, gap2 = 0;  ///< px; a second dash, for dash-dot
  double casing = 0.55;        ///< opacity of the light edge; 0 = none
  QColor halo;                 ///< drawn behind all lines; invalid = none
  double haloWidth = 8;
};

/// Draws lines as strips of triangles that face the screen, with smooth edges; OpenGL 3.3 has no
/// thick lines of its own. Lines hide behind the body that was drawn before.
class LineLayer {
 public:
  void initialize();
  /// @param through also what lies behind the body, as faint dots
  void draw(QOpenGLExtraFunctions& gl, const Screen& screen, const Eigen::Matrix4d& clip,
            double pixelRatio, std::span<const DrawnLine> lines, bool through);

 private:
  std::unique_ptr<QOpenGLShaderProgram> program_;
  std::unique_ptr<QOpenGLVertexArrayObject> array_;
  QOpenGLBuffer buffer_{QOpenGLBuffer::VertexBuffer};
};

}  // namespace toile::studio
