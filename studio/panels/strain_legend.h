// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

#include "app/session.h"

class QComboBox;
class QToolButton;

namespace toile::studio {

/// What the colours of strain mean, and which strain is shown: in a corner of the body's pane while
/// strain is on.
class StrainLegend final : public QFrame {
  Q_OBJECT
 public:
  StrainLegend(Session& session, QWidget* pane);

 private:
  void refresh();
  void choose(StrainKind kind);

  class Scale;
  Session& session_;
  std::array<QToolButton*, kStrainKinds.size()> kinds_{};
  QComboBox* scale_;
  Scale* colours_;
};

}  // namespace toile::studio
