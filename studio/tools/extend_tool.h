// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/edit/lines.h"
#include "tools/picking.h"

namespace toile::studio {

/// Continues a line from one of its ends until it meets another.
class ExtendTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Extend; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;

 private:
  struct End {
    std::string curve;
    CurveEnd end = CurveEnd::End;
    Eigen::Vector3d place, normal;
  };
  [[nodiscard]] static std::optional<End> endNear(const PointerEvent& event, const ToolHost& host);

  std::optional<End> hover_, taken_;
};

}  // namespace toile::studio
