// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tools/picking.h"

namespace toile::studio {

/// Copies lines to the other side of the body.
class MirrorCopyTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::MirrorCopy; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;

 private:
  void show(ToolHost& host) const;

  std::vector<std::string> curves_;
  Selection hover_;
};

}  // namespace toile::studio
