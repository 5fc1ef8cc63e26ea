// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toile/edit/lines.h"
#include "tools/picking.h"

namespace toile::studio {

// Tools that take a line and change it, or make another from it.

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
