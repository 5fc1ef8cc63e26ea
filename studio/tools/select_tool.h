// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toile/edit/shape.h"
#include "tools/picking.h"

namespace toile::studio {

/// Selects lines, pieces and points, and moves points over the surface.
class SelectTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Select; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  void release(const PointerEvent& event, ToolHost& host) override;
  void doubleClick(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;
  [[nodiscard]] CursorShape cursor() const override;
  [[nodiscard]] bool isBusy() const override { return drag_.has_value(); }

 private:
  struct Drag {
    CurveDrag gesture;
    std::string curve;
    std::size_t handle = 0;
    Eigen::Vector2d grabbed;  ///< px from the point to the pointer, so that it does not jump
    Eigen::Vector2d pressed;
    Eigen::Vector2d slowFrom;  ///< px where Shift was pressed
    bool slow = false;
    bool moved = false;
    Eigen::Vector3d start;
    std::vector<Eigen::Vector3d> before, normalsBefore;
    std::optional<SnapMark> mark;
  };

  /// The handles of the selected line, as it is shown.
  const std::vector<Handle>& handles(const ToolHost& host) const;
  std::optional<std::size_t> handleAt(const PointerEvent& event, const ToolHost& host) const;
  bool beginDrag(std::size_t handle, const PointerEvent& event, ToolHost& host);
  void drag(const PointerEvent& event, ToolHost& host);
  void nudge(const Eigen::Vector2d& pixels, ToolHost& host);
  void remove(ToolHost& host);

  std::optional<Drag> drag_;
  Selection hover_;
  bool overPoint_ = false;
  mutable std::string handlesCurve_;
  mutable std::uint64_t handlesVersion_ = 0;
  mutable std::vector<Handle> handles_;
};

}  // namespace toile::studio
