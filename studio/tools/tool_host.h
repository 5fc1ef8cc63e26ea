// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "document/placed_lines.h"
#include "document/selection.h"
#include "toile/edit/edited.h"
#include "viewport/screen.h"

namespace toile::studio {

/// How new lines are drawn.
struct DrawingOptions {
  CurveKind kind = CurveKind::Seam;
  bool symmetry = true;  ///< new lines get a linked twin on the other side
  bool snap = true;      ///< onto points, lines, the mid-plane
  double smoothing = 1;  ///< of the pencil: factor of its tolerance
};

/// Where a pointer was caught.
struct SnapMark {
  enum class Kind { End, Crossing, Control, Line, Middle, ModelCurve };
  Kind kind = Kind::Line;
  Eigen::Vector3d place;
  QString word;  ///< "end", "on Armhole R"
};

/// What tools know of the program. A test implements it without a window.
class ToolHost {
 public:
  virtual ~ToolHost() = default;
  /// The work as it was last committed.
  [[nodiscard]] virtual const Document& document() const = 0;
  /// The lines that are shown: of the work, or of the preview.
  [[nodiscard]] virtual const PlacedLines& lines() const = 0;
  [[nodiscard]] virtual const Screen& screen() const = 0;
  [[nodiscard]] virtual const DrawingOptions& options() const = 0;
  [[nodiscard]] virtual const Selection& selection() const = 0;
  /// The line in the middle of a symmetric body, see middleLines(); empty otherwise.
  [[nodiscard]] virtual const std::vector<std::vector<Eigen::Vector3d>>& middle() const = 0;
  /// The piece at a place of the body, by its id; nothing where no piece is.
  [[nodiscard]] virtual std::optional<std::string> pieceAt(const SurfacePoint& point) const = 0;
  /// As people write lengths here: "413.6 mm".
  [[nodiscard]] virtual QString lengthText(double mm) const = 0;

  virtual void select(const Selection& selection) = 0;
  /// Shows what the work would be, while a gesture is under way. The pattern follows if asked.
  virtual void preview(const Document& document, bool withPattern) = 0;
  virtual void dropPreview() = 0;
  /// A step of the work, with its name in the history. Ends a preview.
  virtual void commit(const QString& name, const Document& document) = 0;
  /// Why something cannot be done, or what is worth knowing: shown, never in the way.
  virtual void tell(const QString& sentence) = 0;
};

}  // namespace toile::studio
