// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "app/session.h"

class QLabel;
class QSlider;

namespace toile::studio {

class NumberField;

/// The number that the tool in hand works with, beside its name: a field, and a slider where it is
/// a share. Hidden for tools without.
class ToolSettingBar final : public QWidget {
  Q_OBJECT
 public:
  explicit ToolSettingBar(Session& session, QWidget* parent = nullptr);

 Q_SIGNALS:
  void taken();  ///< a number was typed and taken; the hand may go on

 private:
  void refresh();
  void enter(double value);

  Session& session_;
  QLabel* name_;
  NumberField* length_;
  QSlider* slider_;
  NumberField* share_;
};

}  // namespace toile::studio
