// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/picking.h"

namespace toile::studio {

/// Draws freehand: a stroke of mouse or pen becomes a smooth line of few points.
class PencilTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Pencil; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  void release(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;
  [[nodiscard]] CursorShape cursor() const override { return CursorShape::Pencil; }
  [[nodiscard]] bool isBusy() const override { return drawing_; }

 private:
  struct Sample {
    PointerEvent event;
    std::optional<Eigen::Vector3d> place;  ///< nothing where it is beside the body
    Eigen::Vector3d normal;
  };
  void add(const PointerEvent& event, ToolHost& host);
  void finish(ToolHost& host);

  bool drawing_ = false;
  std::vector<Sample> samples_;
  std::optional<Snapped> start_, end_;  ///< where the ends are caught
  std::optional<Snapped> hover_;
};

}  // namespace toile::studio
