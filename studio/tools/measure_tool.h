// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tools/picking.h"

namespace toile::studio {

/// Measures on the body: two clicks give the way between them; what the pointer is on tells its
/// own: a line its length, a crossing its angle, the body its girth.
class MeasureTool final : public Tool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Measure; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;

 private:
  /// The shortest way from the first place to another.
  struct Way {
    std::vector<Eigen::Vector3d> points;
    double onSurface = 0, straight = 0;
  };
  [[nodiscard]] std::optional<Way> wayTo(const Snapped& place, const ToolHost& host) const;
  void readAround(const PointerEvent& event, const ToolHost& host);

  std::optional<Snapped> first_, next_;
  bool isDone_ = false;  ///< both places are clicked
  std::optional<Way> way_;
  std::vector<Eigen::Vector3d> girth_;
  std::vector<ReadOut> around_;
  Selection hover_;
};

}  // namespace toile::studio
