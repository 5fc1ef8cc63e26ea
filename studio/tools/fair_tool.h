// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/edit/fair.h"
#include "tools/picking.h"

namespace toile::studio {

/// Calms a line: ripples shorter than a length vanish, the longer the calmer. A comb beside the
/// line shows how it bends, before and after.
class FairTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Fair; }
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
  /// Takes a line, with as much as leaves it the bends that it is meant to have.
  void take(const std::string& curve, ToolHost& host);
  void show(ToolHost& host);
  void cancel(ToolHost& host);

  std::string curve_;
  double strength_ = 0.3;  ///< 0..1
  double length_ = 0;      ///< mm, of the line as it is
  std::optional<Document> faired_;
  FairedCurve figures_;
  std::vector<OverlayLine> combBefore_, combAfter_;
  double combScale_ = 0;  ///< mm of tooth per 1/mm
  bool dragging_ = false;
  double pressedAt_ = 0, strengthAtPress_ = 0;
  Selection hover_;
};

}  // namespace toile::studio
