// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/develop_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <cmath>

#include "app/number_field.h"
#include "document/piece_edits.h"
#include "document/strain_spots.h"
#include "panels/rows.h"
#include "toile/pipeline/advice.h"

namespace toile::studio {

namespace {

constexpr int kSteps = 100;
constexpr int kRest = 200;  // ms

}  // namespace

DevelopPanel::DevelopPanel(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName(QStringLiteral("developPanel"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(6);
  column->addWidget(headingRow(tr("Flatten the shape"), {}));
  about_ = secondLabel({});
  column->addWidget(about_);
  auto* row = new QHBoxLayout;
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setObjectName(QStringLiteral("developAmount"));
  slider_->setAccessibleName(tr("How far"));
  slider_->setRange(0, kSteps);
  number_ = new NumberField(NumberField::Kind::Share, session.unit());
  number_->setAccessibleName(tr("How far"));
  number_->setRange(0, 1);
  number_->setFixedWidth(96);
  row->addWidget(slider_, 1);
  row->addWidget(number_);
  column->addLayout(row);
  column->addWidget(secondLabel(tr("Mean change of area when laid flat")));
  before_ = numberRow(*column, tr("as drawn"), {}, false);
  changed_ = numberRow(*column, tr("flattened, from its own shape"), {}, true);
  drawn_ = numberRow(*column, tr("flattened, from the shape as drawn"), {}, true);
  move_ = numberRow(*column, tr("Farthest from the shape as drawn"), {}, false);
  state_ = secondLabel({});
  column->addWidget(state_);
  auto* buttons = new QHBoxLayout;
  keep_ = new QPushButton(tr("Keep"));
  keep_->setObjectName(QStringLiteral("answer"));
  auto* asDrawn = new QPushButton(tr("As drawn"));
  auto* notNow = new QPushButton(tr("Not now"));
  notNow->setObjectName(QStringLiteral("notNow"));
  buttons->addWidget(keep_, 1);
  buttons->addWidget(asDrawn);
  buttons->addWidget(notNow);
  column->addLayout(buttons);

  rest_.setSingleShot(true);
  rest_.setInterval(kRest);
  connect(&rest_, &QTimer::timeout, this, &DevelopPanel::compute);
  connect(slider_, &QSlider::valueChanged, this,
          [this](int value) { setAmount(static_cast<double>(value) / kSteps); });
  connect(number_, &NumberField::valueEntered, this, &DevelopPanel::setAmount);
  connect(keep_, &QPushButton::clicked, this, [this] { keep(amount_); });
  connect(asDrawn, &QPushButton::clicked, this, [this] { keep(0); });
  connect(notNow, &QPushButton::clicked, this, &DevelopPanel::ended);
}

void DevelopPanel::open(const std::string& piece) {
  piece_ = piece;
  report_.reset();
  const auto index = session_.pieceIndex(piece);
  if (!index) return;
  const Piece& about = session_.fullPattern()->cut.pieces[*index];
  about_->setText(
      tr("%1 is bent into a shape that lies flat with less strain; its seams stay where "
         "they are.")
          .arg(QString::fromStdString(about.name.empty() ? about.id : about.name)));
  const PieceRecord* record = recordOf(*session_.document().design, piece);
  const bool isSet = record != nullptr && record->develop && record->develop->amount;
  setAmount(isSet ? record->develop->amount->value() : 0.5);
}

void DevelopPanel::leave() {
  rest_.stop();
  work_.stop();
  piece_.clear();
}

void DevelopPanel::setAmount(double amount) {
  amount_ = amount;
  const QSignalBlocker blocker(slider_);
  slider_->setValue(static_cast<int>(std::lround(amount * kSteps)));
  number_->setValue(amount);
  state_->setText(tr("Trying it…"));
  rest_.start();
}

void DevelopPanel::compute() {
  const auto index = session_.pieceIndex(piece_);
  if (!index) {
    if (!piece_.empty()) rest_.start();  // the pattern is being made
    return;
  }
  work_.begin([this, pattern = session_.fullPattern(), index = *index,
               amount = amount_](Progress& progress) -> Background::Outcome {
    auto tried = tryDeveloping(*pattern, index, amount, &progress);
    return [this, tried = std::move(tried)] {
      if (tried) {
        report_ = tried->report;
        showReport();
      }
      state_->setText(tried ? QString() : QString::fromStdString(tried.error().message));
    };
  });
}

void DevelopPanel::showReport() {
  before_->setText(percentText(report_->errorBefore, 2).remove('+'));
  changed_->setText(percentText(report_->errorAgainstProcessed, 2).remove('+'));
  drawn_->setText(percentText(report_->errorAgainstOriginal, 2).remove('+'));
  move_->setText(session_.lengthText(report_->maxMove));
}

void DevelopPanel::keep(double amount) {
  const auto index = session_.pieceIndex(piece_);
  if (!index) return session_.tell(tr("The pattern is being updated; keep it in a moment."));
  const Piece& piece = session_.fullPattern()->cut.pieces[*index];
  const QString name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
  const auto made =
      withPieceRecord(session_.document(), *session_.fullPattern(), piece_, [&](PieceRecord& r) {
        if (amount == 0) return r.develop.reset();
        if (!r.develop) r.develop.emplace();
        r.develop->amount = Ratio::of(amount);
        r.develop->maxAreaError.reset();
      });
  Q_EMIT ended();
  if (made) {
    session_.commit((amount == 0 ? tr("%1 as drawn") : tr("Flatten %1")).arg(name), *made);
  }
}

}  // namespace toile::studio
