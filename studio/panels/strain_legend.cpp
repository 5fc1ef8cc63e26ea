// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/strain_legend.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "app/palette.h"
#include "document/strain_spots.h"

namespace toile::studio {

namespace {

constexpr double kScales[] = {0.05, 0.1, 0.2, 0.4};
constexpr double kMargin = 22;  // px beside the colours, for half a number

QString wordOf(StrainKind kind) {
  switch (kind) {
    case StrainKind::Area:
      return StrainLegend::tr("Area");
    case StrainKind::Along:
      return StrainLegend::tr("Along");
    case StrainKind::Across:
      return StrainLegend::tr("Across");
    case StrainKind::Shear:
      return StrainLegend::tr("Shear");
  }
  return {};
}

}  // namespace

/// The row of colours with its numbers and the limit of the fabric.
class StrainLegend::Scale final : public QWidget {
 public:
  explicit Scale(const Session& session) : session_(session) {
    setFixedHeight(54);
    setMinimumWidth(250);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const StrainLook& look = session_.strainLook();
    const bool oneSided = look.kind == StrainKind::Shear;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF bar(kMargin, 18, width() - 2 * kMargin, 12);
    QLinearGradient gradient(bar.topLeft(), bar.topRight());
    for (int i = 0; i <= 24; ++i) {
      const double t = i / 24.0;
      gradient.setColorAt(t, strainColour(oneSided ? t : 2 * t - 1));
    }
    painter.setPen(QPen(studio::palette().edge, 1));
    painter.setBrush(gradient);
    painter.drawRoundedRect(bar, 3, 3);
    QFont font = painter.font();
    font.setPixelSize(11);
    painter.setFont(font);
    painter.setPen(studio::palette().second);
    for (int i = 0; i <= 4; ++i) {
      const double t = i / 4.0;
      const double value = look.scale * (oneSided ? t : 2 * t - 1);
      painter.drawText(QRectF(bar.left() + t * bar.width() - 30, 34, 60, 16), Qt::AlignCenter,
                       percentText(value));
    }
    painter.drawText(QRectF(bar.left(), 0, bar.width(), 16), Qt::AlignLeft | Qt::AlignVCenter,
                     oneSided ? tr("square") : tr("too much cloth"));
    painter.drawText(QRectF(bar.left(), 0, bar.width(), 16), Qt::AlignRight | Qt::AlignVCenter,
                     oneSided ? tr("slanting") : tr("must stretch"));
    const auto limit = session_.strainLimit();
    if (!limit || *limit > look.scale) return;
    const double t = oneSided ? *limit / look.scale : 0.5 + 0.5 * *limit / look.scale;
    const double x = bar.left() + t * bar.width();
    painter.setPen(QPen(studio::palette().text, 2));
    painter.drawLine(QPointF(x, bar.top() - 3), QPointF(x, bar.bottom() + 3));
  }

 private:
  const Session& session_;
};

StrainLegend::StrainLegend(Session& session, QWidget* pane)
    : QFrame(pane), session_(session), scale_(new QComboBox), colours_(new Scale(session)) {
  setObjectName(QStringLiteral("chip"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 6, 8, 4);
  column->setSpacing(4);
  auto* title = new QLabel(tr("How far the cloth must stretch"));
  title->setObjectName(QStringLiteral("heading"));
  column->addWidget(title);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  for (std::size_t i = 0; i < kStrainKinds.size(); ++i) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("kind"));
    button->setCheckable(true);
    button->setText(wordOf(kStrainKinds[i]));
    button->setAccessibleName(tr("Strain: %1").arg(wordOf(kStrainKinds[i])));
    connect(button, &QToolButton::clicked, this, [this, i] { choose(kStrainKinds[i]); });
    row->addWidget(button);
    kinds_[i] = button;
  }
  row->addSpacing(8);
  scale_->setAccessibleName(tr("Scale of the colours"));
  for (const double scale : kScales) {
    scale_->addItem(QStringLiteral("± %1 %").arg(std::lround(100 * scale)), scale);
  }
  connect(scale_, &QComboBox::activated, this, [this](int index) {
    StrainLook look = session_.strainLook();
    look.scale = scale_->itemData(index).toDouble();
    session_.setStrainLook(look);
  });
  row->addWidget(scale_);
  column->addLayout(row);
  column->addWidget(colours_);
  connect(&session, &Session::strainChanged, this, &StrainLegend::refresh);
  connect(&session, &Session::patternChanged, this, &StrainLegend::refresh);
  refresh();
}

void StrainLegend::choose(StrainKind kind) {
  StrainLook look = session_.strainLook();
  look.kind = kind;
  session_.setStrainLook(look);
}

void StrainLegend::refresh() {
  const StrainLook& look = session_.strainLook();
  setVisible(look.on);
  if (!look.on) return;
  for (std::size_t i = 0; i < kStrainKinds.size(); ++i) {
    kinds_[i]->setChecked(kStrainKinds[i] == look.kind);
  }
  scale_->setCurrentIndex(scale_->findData(look.scale));
  const auto limit = session_.strainLimit();
  colours_->setToolTip(limit
                           ? tr("The line marks what the fabric bears: %1").arg(percentText(*limit))
                           : tr("The fabric says no limit of this strain."));
  adjustSize();
  colours_->update();
}

}  // namespace toile::studio
