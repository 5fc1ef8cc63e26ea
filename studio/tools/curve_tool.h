// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/picking.h"

namespace toile::studio {

/// Draws a smooth line through clicked points.
class CurveTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Curve; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  void doubleClick(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;
  [[nodiscard]] CursorShape cursor() const override;

 private:
  /// The line through the points, and through where the pointer is.
  void show(ToolHost& host);
  void finish(bool closed, ToolHost& host);
  void cancel(ToolHost& host);

  std::vector<Snapped> points_;
  std::optional<Snapped> next_;
  bool closes_ = false;  ///< the pointer is on the first point
  std::string drawn_;    ///< id of the line in the preview
};

}  // namespace toile::studio
