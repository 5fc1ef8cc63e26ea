// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/side_panels.h"

#include <QEvent>
#include <QVBoxLayout>
#include <algorithm>

#include "panels/dart_panel.h"
#include "panels/develop_panel.h"
#include "panels/fabric_panel.h"
#include "panels/selection_panel.h"

namespace toile::studio {

SidePanels::SidePanels(Session& session, const Actions& actions, QWidget* parent)
    : QScrollArea(parent),
      session_(session),
      selection_(new SelectionPanel(session, actions)),
      darts_(new DartPanel(session)),
      developable_(new DevelopPanel(session)),
      fabrics_(new FabricPanel(session)) {
  auto* inner = new QWidget;
  inner->setObjectName(QStringLiteral("panelFields"));
  auto* column = new QVBoxLayout(inner);
  column->setContentsMargins(0, 0, 0, 0);
  setWidget(inner);
  setAccessibleName(tr("What is selected"));
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  inner->installEventFilter(this);
  for (QWidget* panel : {static_cast<QWidget*>(selection_), static_cast<QWidget*>(darts_),
                         static_cast<QWidget*>(developable_), static_cast<QWidget*>(fabrics_)}) {
    column->addWidget(panel);
  }
  show(SidePanel::Selection);
  const auto back = [this] { show(SidePanel::Selection); };
  connect(darts_, &DartPanel::ended, this, back);
  connect(developable_, &DevelopPanel::ended, this, back);
  connect(fabrics_, &FabricPanel::ended, this, back);
  connect(&session, &Session::panelWanted, this, &SidePanels::open);
  connect(&session, &Session::workStarted, this, back);
  // Another piece: what was about the one before gives way.
  connect(&session, &Session::selectionChanged, this, [this] {
    const Selection& now = session_.selection();
    const bool isAbout = shown_ == SidePanel::Darts || shown_ == SidePanel::Developable;
    if (isAbout && now.kind == Selection::Kind::Piece) open(shown_, now.id);
  });
}

QSize SidePanels::sizeHint() const {
  const int width = std::max(264, viewport()->width());
  const QWidget& inner = *widget();
  const int height =
      inner.hasHeightForWidth() ? inner.heightForWidth(width) : inner.sizeHint().height();
  return {width, std::max(height, inner.minimumSizeHint().height())};
}

QSize SidePanels::minimumSizeHint() const {
  return {264, 96};
}

bool SidePanels::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

void SidePanels::open(SidePanel panel, const std::string& piece) {
  if (panel != SidePanel::Fabrics && panel != SidePanel::Selection && !session_.pieceIndex(piece)) {
    return session_.tell(tr("The pattern is being updated; ask again in a moment."));
  }
  show(panel);
  if (panel == SidePanel::Darts) darts_->open(piece);
  if (panel == SidePanel::Developable) developable_->open(piece);
  if (panel == SidePanel::Fabrics) fabrics_->open(piece);
}

void SidePanels::show(SidePanel panel) {
  if (shown_ == SidePanel::Darts) darts_->leave();
  if (shown_ == SidePanel::Developable) developable_->leave();
  shown_ = panel;
  selection_->setVisible(panel == SidePanel::Selection);
  darts_->setVisible(panel == SidePanel::Darts);
  developable_->setVisible(panel == SidePanel::Developable);
  fabrics_->setVisible(panel == SidePanel::Fabrics);
}

}  // namespace toile::studio
