// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <optional>

#include "tools/tool.h"

namespace toile::studio {

/// Points, snap marks and the label at the cursor, painted over body and lines.
void paintToolOverlay(QPainter& painter, const Overlay& overlay, const ToolHost& host,
                      const std::optional<Eigen::Vector2d>& cursor);

/// The dark label with rows "word value", beside a place of the window.
void paintReadOut(QPainter& painter, const std::vector<ReadOut>& rows, const QPointF& beside);

/// A disk with a number or letter: a spot of the list, a proposal.
void paintMarker(QPainter& painter, const QPointF& at, const QString& text, bool strong);

}  // namespace toile::studio
