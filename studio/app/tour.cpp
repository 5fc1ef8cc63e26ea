// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/tour.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "app/session.h"

namespace toile::studio {

Tour::Tour(Session& session, QWidget& pane)
    : QFrame(&pane),
      session_(session),
      pane_(pane),
      words_(new QLabel),
      close_(new QPushButton(tr("Leave"))) {
  setObjectName(QStringLiteral("chip"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 8, 8, 8);
  words_->setWordWrap(true);
  words_->setTextFormat(Qt::RichText);
  row->addWidget(words_, 1);
  row->addWidget(close_, 0, Qt::AlignTop);
  connect(close_, &QPushButton::clicked, this, &QWidget::deleteLater);
  connect(&session, &Session::historyChanged, this, &Tour::look);
  connect(&session, &Session::patternChanged, this, &Tour::look);
  connect(&session, &Session::workStarted, this, &QWidget::deleteLater);
  pane.installEventFilter(this);
  curvesBefore_ = session.document().design->curves.size();
  tell();
  show();
}

void Tour::look() {
  const std::size_t curves = session_.document().design->curves.size();
  const std::size_t steps = session_.history().steps().size();
  if (step_ == 0 && curves > curvesBefore_) {
    step_ = 1;
    stepsBefore_ = steps;
  } else if (step_ == 1 && session_.isPatternCurrent() && session_.pattern() &&
             session_.pattern()->cut.pieces.size() > 1) {
    step_ = 2;
    stepsBefore_ = steps;
  } else if (step_ == 2 && steps > stepsBefore_) {
    step_ = 3;
  } else {
    return;
  }
  tell();
}

void Tour::tell() {
  switch (step_) {
    case 0:
      words_->setText(
          tr("<b>1 of 3</b>&nbsp; Press <b>P</b> and draw a line over the chest, from its middle "
             "to the side. Its twin appears on the other side by itself."));
      break;
    case 1:
      words_->setText(
          tr("<b>2 of 3</b>&nbsp; Draw on, down the side and back to the middle: once the lines "
             "close, the piece appears on the right."));
      break;
    case 2:
      words_->setText(
          tr("<b>3 of 3</b>&nbsp; Press <b>V</b>, click a line and drag one of its points. The "
             "pattern follows your hand."));
      break;
    default:
      words_->setText(
          tr("<b>That is all.</b>&nbsp; F1 has every key; the wetsuit on the start "
             "page is there to be changed."));
      close_->setText(tr("Close"));
  }
  place();
}

void Tour::place() {
  const int width = std::min(440, pane_.width() - 24);
  resize(width, heightForWidth(width) > 0 ? heightForWidth(width) : sizeHint().height());
  move(12, pane_.height() - height() - 12);
}

bool Tour::eventFilter(QObject*, QEvent* event) {
  if (event->type() == QEvent::Resize) place();
  return false;
}

}  // namespace toile::studio
