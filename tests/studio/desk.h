// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "document/design_store.h"
#include "tools/picking.h"
#include "tools/tool.h"
#include "viewport/camera.h"

namespace toile::studio {

/// The program as tools see it, on the built-in body seen from the front.
class Desk final : public ToolHost {
 public:
  Desk() {
    document_ = *emptyDocument("builtin:body@1");
    middle_ = middleLines(*document_.model);
    lines_.update(document_);
    const Mesh& mesh = *document_.model->mesh;
    screen_.width = 800;
    screen_.height = 1000;
    screen_.view = fitted(Camera(), mesh.boxMin(), mesh.boxMax(), 0.8).view();
  }
  const Document& document() const override { return document_; }
  const PlacedLines& lines() const override { return lines_; }
  const Screen& screen() const override { return screen_; }
  const DrawingOptions& options() const override { return options_; }
  const Selection& selection() const override { return selection_; }
  const std::vector<std::vector<Eigen::Vector3d>>& middle() const override { return middle_; }
  std::optional<std::string> pieceAt(const SurfacePoint&) const override { return std::nullopt; }
  QString lengthText(double mm) const override { return QString::number(mm, 'f', 1); }
  void select(const Selection& selection) override { selection_ = selection; }
  void preview(const Document& document, bool) override {
    ++previews_;
    lines_.update(document);
  }
  void dropPreview() override { lines_.update(document_); }
  void commit(const QString& name, const Document& document) override {
    steps_.push_back(name);
    document_ = document;
    lines_.update(document_);
  }
  void tell(const QString& sentence) override { told_ = sentence; }

  /// The pixel of the front of the body at a place.
  Eigen::Vector2d pixel(double x, double z) const {
    const auto hit = document_.model->index->firstVisibleHit({x, -2000, z}, {0, 1, 0});
    return screen_.toPixel(hit->position).value();
  }
  void click(Tool& tool, const Eigen::Vector2d& at, bool ctrl = false) {
    PointerEvent event;
    event.at = at;
    event.ctrl = ctrl;
    tool.move(event, *this);
    tool.press(event, *this);
    tool.release(event, *this);
  }
  void drag(Tool& tool, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
            bool release = true) {
    PointerEvent event;
    event.at = from;
    tool.move(event, *this);
    tool.press(event, *this);
    for (int i = 1; i <= 10; ++i) {
      event.at = from + i / 10.0 * (to - from);
      event.seconds = 0.01 * i;
      tool.move(event, *this);
    }
    if (release) tool.release(event, *this);
  }
  const std::vector<StylingCurve>& curves() const { return document_.design->curves; }

  Document document_;
  PlacedLines lines_;
  Screen screen_;
  DrawingOptions options_;
  Selection selection_;
  std::vector<std::vector<Eigen::Vector3d>> middle_;
  std::vector<QString> steps_;
  QString told_;
  int previews_ = 0;
};

}  // namespace toile::studio
