// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <QString>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/tool_host.h"

namespace toile::studio {

enum class ToolId {
  Select,
  Pencil,
  Curve,
  LeastLength,
  Girth,
  Dart,
  Trim,
  Split,
  Join,
  Extend,
  Erase,
  Parallel,
  MirrorCopy,
  Fair,
  Measure
};

/// What a mouse or pen does on the body, as plain values: tools know no window.
struct PointerEvent {
  Eigen::Vector2d at{0, 0};  ///< px in the Screen of the host
  bool ctrl = false;         ///< snapping is ignored
  bool shift = false;        ///< slowly, or the other way
  bool pen = false;
  double pressure = 1;  ///< 0..1
  double seconds = 0;   ///< when; any zero

  /// px around a point in which it is caught.
  [[nodiscard]] double catchRadius() const { return pen ? 16 : 10; }
};

enum class PointerAction { Press, Move, Release, DoubleClick };

enum class ToolKey { Enter, Escape, Backspace, Delete, Next, Previous, Left, Right, Up, Down };

enum class CursorShape { Arrow, OpenHand, ClosedHand, Pencil, Cross, CrossRing };

/// A line that is being made, or picked out.
struct OverlayLine {
  enum class Style {
    Draft,   ///< of the kind that it will have
    Twin,    ///< its mirror image: the kind, dashed
    Before,  ///< how it was: fine dots
    Remove,  ///< what would go
    Picked,  ///< what will be worked on
    Comb,    ///< of curvature, beside a line
    Measure  ///< a way that is measured
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< empty: towards the eye
  CurveKind kind = CurveKind::Seam;
  Style style = Style::Draft;
};

struct OverlayPoint {
  enum class Shape { Control, Active, TwinControl, Tip };
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  Shape shape = Shape::Control;
};

/// A row of the label at the cursor: "line 413.6 mm".
struct ReadOut {
  QString word;
  QString value;
};

/// A short text at a place of the body: "seam 413.6 mm".
struct OverlayLabel {
  Eigen::Vector3d place;
  std::vector<ReadOut> rows;
};

/// A number that a tool works with, shown beside its name and typed there: "Distance 12 mm".
struct ToolSetting {
  enum class Kind { Length, Share };
  QString name;
  Kind kind = Kind::Length;
  double value = 0;  ///< mm, or 0..1
};

/// What a tool shows over body and lines.
struct Overlay {
  std::vector<OverlayLine> lines;
  std::vector<OverlayPoint> points;
  std::optional<SnapMark> snap;
  std::vector<ReadOut> readOut;  ///< at the pointer
  std::vector<OverlayLabel> labels;
  bool showMiddle = false;                      ///< the mid-plane line
  std::optional<Eigen::Vector3d> seeThroughTo;  ///< what stands before this place is see-through
  Selection hover;                              ///< what a click would select
};

/// A tool is a state machine: it takes events, asks the host for what is drawn, hands it edits of
/// the engine, and says what it shows and what it expects next.
class Tool {
 public:
  virtual ~Tool() = default;
  [[nodiscard]] virtual ToolId id() const = 0;

  /// Whether a press at this place is the tool's; otherwise it turns the view.
  [[nodiscard]] virtual bool takesPress(const PointerEvent& event, ToolHost& host) const;
  virtual void press(const PointerEvent& event, ToolHost& host) = 0;
  virtual void move(const PointerEvent& event, ToolHost& host) = 0;  ///< also without a button
  virtual void release(const PointerEvent&, ToolHost&) {}
  virtual void doubleClick(const PointerEvent&, ToolHost&) {}
  /// @return whether the key meant something in this state.
  virtual bool key(ToolKey key, ToolHost& host) = 0;
  /// Another tool is taken, or the work changed below it: gives up what is half done.
  virtual void leave(ToolHost& host) = 0;

  /// The status line, with keys between angle brackets: "<Enter> finish".
  [[nodiscard]] virtual QString hint(const ToolHost& host) const = 0;
  [[nodiscard]] virtual Overlay overlay(const ToolHost& host) const = 0;
  [[nodiscard]] virtual CursorShape cursor() const { return CursorShape::Cross; }
  [[nodiscard]] virtual std::optional<ToolSetting> setting() const { return std::nullopt; }
  /// The number was typed or its slider moved: what is under way follows.
  virtual void set(double, ToolHost&) {}
  /// A gesture is under way: autosave, undo and the like wait for it.
  [[nodiscard]] virtual bool isBusy() const { return false; }
};

[[nodiscard]] std::unique_ptr<Tool> makeTool(ToolId id);

}  // namespace toile::studio
