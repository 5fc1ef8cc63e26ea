// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "toile/edit/lines.h"
#include "tools/picking.h"

namespace toile::studio {

/// Takes away the part of a line along which one draws.
class EraseTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Erase; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  void release(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;
  [[nodiscard]] bool isBusy() const override { return !curve_.empty(); }

 private:
  [[nodiscard]] Stretch stretch(bool closed) const;

  std::string curve_;         ///< empty: nothing is being erased
  double from_ = 0, to_ = 0;  ///< fractions; of a closed line they run on beyond 0 and 1
  std::optional<LinePick> hover_;
};

}  // namespace toile::studio
