// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QScrollArea>

#include "app/actions.h"
#include "app/session.h"

namespace toile::studio {

class DartPanel;
class DevelopPanel;
class FabricPanel;
class SelectionPanel;

/// The top of the dock: what is selected, or in its place the adviser, the slider of developable
/// processing, the fabrics, which give it back when done. As high as what it shows; where the
/// window is low it scrolls, so that the lists below keep their room.
class SidePanels final : public QScrollArea {
  Q_OBJECT
 public:
  SidePanels(Session& session, const Actions& actions, QWidget* parent = nullptr);

  [[nodiscard]] SelectionPanel& selection() { return *selection_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void open(SidePanel panel, const std::string& piece);
  void show(SidePanel panel);

  Session& session_;
  SidePanel shown_ = SidePanel::Selection;
  SelectionPanel* selection_;
  DartPanel* darts_;
  DevelopPanel* developable_;
  FabricPanel* fabrics_;
};

}  // namespace toile::studio
