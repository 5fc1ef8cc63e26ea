// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pane_corners.h"

#include <QEvent>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "app/actions.h"
#include "panels/strain_legend.h"
#include "pattern/pattern_view.h"
#include "viewport/view_cube.h"
#include "viewport/viewport.h"

namespace toile::studio {

namespace {

/// Keeps a child in a corner of its pane.
class Corner final : public QObject {
 public:
  Corner(QWidget& pane, QWidget& child, Qt::Corner corner, QPoint margin)
      : QObject(&pane), pane_(pane), child_(child), corner_(corner), margin_(margin) {
    pane.installEventFilter(this);
    child.installEventFilter(this);
    place();
  }
  bool eventFilter(QObject* watched, QEvent* event) override {
    const bool isPane = watched == &pane_ && event->type() == QEvent::Resize;
    const bool isChild = watched == &child_ && event->type() == QEvent::LayoutRequest;
    if (isChild) child_.adjustSize();
    if (isPane || isChild) place();
    return false;
  }
  void place() {
    const QSize size = child_.size();
    const bool right = corner_ == Qt::TopRightCorner || corner_ == Qt::BottomRightCorner;
    const bool bottom = corner_ == Qt::BottomLeftCorner || corner_ == Qt::BottomRightCorner;
    child_.move(right ? pane_.width() - size.width() - margin_.x() : margin_.x(),
                bottom ? pane_.height() - size.height() - margin_.y() : margin_.y());
  }

 private:
  QWidget& pane_;
  QWidget& child_;
  Qt::Corner corner_;
  QPoint margin_;
};

QLabel* addChip(QWidget& pane, QPoint margin) {
  auto* chip = new QLabel(&pane);
  chip->setObjectName(QStringLiteral("chip"));
  chip->setAttribute(Qt::WA_TransparentForMouseEvents);
  new Corner(pane, *chip, Qt::TopLeftCorner, margin);
  return chip;
}

QFrame* addButtons(QWidget& pane, QPoint margin, const QList<QAction*>& actions) {
  auto* frame = new QFrame(&pane);
  frame->setObjectName(QStringLiteral("chip"));
  auto* column = new QVBoxLayout(frame);
  column->setContentsMargins(2, 2, 2, 2);
  column->setSpacing(2);
  for (QAction* action : actions) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setFixedSize(28, 28);
    button->setIconSize({18, 18});
    column->addWidget(button);
  }
  frame->adjustSize();
  new Corner(pane, *frame, Qt::TopRightCorner, margin);
  return frame;
}

/// What the colours mean while strain is not shown.
void addColourBy(Viewport& viewport, Session& session, Actions& actions) {
  auto* frame = new QFrame(&viewport);
  frame->setObjectName(QStringLiteral("chip"));
  auto* row = new QHBoxLayout(frame);
  row->setContentsMargins(8, 2, 2, 2);
  row->setSpacing(2);
  auto* word = new QLabel(Viewport::tr("Colour by"));
  word->setObjectName(QStringLiteral("second"));
  row->addWidget(word);
  for (const char* id : {"colour-fabric", "colour-piece"}) {
    auto* button = new QToolButton;
    button->setDefaultAction(actions[QString::fromLatin1(id)]);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    row->addWidget(button);
  }
  frame->adjustSize();
  new Corner(viewport, *frame, Qt::BottomLeftCorner, {10, 10});
  const auto refresh = [frame, &session] { frame->setVisible(!session.strainLook().on); };
  QObject::connect(&session, &Session::strainChanged, frame, refresh);
}

}  // namespace

void addPaneCorners(Viewport& viewport, PatternView& pattern, Session& session, Actions& actions) {
  QLabel* body = addChip(viewport, {10, 10});
  const auto showView = [body, &viewport] {
    body->setText(Viewport::tr("<b>Body</b>&nbsp; %1").arg(viewport.viewName()));
    body->adjustSize();
  };
  QObject::connect(&viewport, &Viewport::cameraChanged, body, showView);
  QObject::connect(&session, &Session::workStarted, body, showView);
  showView();
  auto* cube = new ViewCube(viewport);
  new Corner(viewport, *cube, Qt::TopRightCorner, {12, 10});
  addButtons(viewport, {20, 74}, {actions["fit"], actions["see-through"], actions["strain"]});

  auto* legend = new StrainLegend(session, &viewport);
  new Corner(viewport, *legend, Qt::BottomLeftCorner, {10, 10});
  addColourBy(viewport, session, actions);
  addButtons(pattern, {12, 32},
             {actions["show-allowance"], actions["show-notches"], actions["show-grain"],
              actions["show-labels"], actions["show-features"]});

  QLabel* sheet = addChip(pattern, {32, 32});
  const auto showScale = [sheet, &pattern] {
    // At 96 logical dots an inch; what matters is how much of the sheet is seen.
    const double scale = 96 / 25.4 / pattern.pixelsPerMm();
    const QString text = scale >= 1 ? QStringLiteral("1 : %1").arg(scale, 0, 'g', 2)
                                    : QStringLiteral("%1 : 1").arg(1 / scale, 0, 'g', 2);
    sheet->setText(PatternView::tr("<b>Pattern</b>&nbsp; scale %1").arg(text));
    sheet->adjustSize();
  };
  QObject::connect(&pattern, &PatternView::scaleChanged, sheet, showScale);
  showScale();
}

}  // namespace toile::studio
