// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/picking.h"

namespace toile::studio {

// Tools of one or two clicks. Each shows what the next click would make, and makes it.

/// What tools of clicks share: the pointer, the first click, and the preview that goes with them.
class ClickTool : public Tool {
 public:
  bool key(ToolKey key, ToolHost& host) override;
  void leave(ToolHost& host) override;
  [[nodiscard]] Overlay overlay(const ToolHost& host) const override;

 protected:
  std::optional<Snapped> first_;
  std::optional<Snapped> next_;
};

/// The shortest way over the surface between two clicks.
class LeastLengthTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::LeastLength; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
};

/// The closed section of the body through a point; level, or with Shift square to the limb as it is
/// seen.
class GirthTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Girth; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
};

/// A dart: where it opens on a line, then its tip.
class DartTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Dart; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;

 private:
  std::optional<LinePick> mouth_;
};

/// Parts a line where it is clicked.
class SplitTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Split; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
};

/// Takes away the stretch between two crossings.
class TrimTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Trim; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;
};

/// Joins two lines at their nearest ends.
class JoinTool final : public ClickTool {
 public:
  [[nodiscard]] ToolId id() const override { return ToolId::Join; }
  void press(const PointerEvent& event, ToolHost& host) override;
  void move(const PointerEvent& event, ToolHost& host) override;
  bool key(ToolKey key, ToolHost& host) override;
  [[nodiscard]] QString hint(const ToolHost& host) const override;

 private:
  std::string line_;
};

}  // namespace toile::studio
