// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "tools/picking.h"

namespace toile::studio {

/// A line beside another.
class ParallelTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Parallel; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  void release(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;
  [[nodiscard]] bool isBusy() const override { return dragging_; }
  [[nodiscard]] std::optional<ToolSetting> setting() const override;
  void set(double value, ToolHost& host) override;

 private:
  void show(ToolHost& host) const;
  void keep(ToolHost& host);
  void cancel(ToolHost& host);

  std::string curve_;     ///< the line beside which it runs
  double distance_ = 10;  ///< mm, to its left
  bool dragging_ = false, moved_ = false;
  Selection hover_;
};

}  // namespace toile::studio
