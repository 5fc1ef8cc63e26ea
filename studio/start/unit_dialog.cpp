// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/unit_dialog.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/palette.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

constexpr double kFigureMm = 1700;
constexpr std::size_t kMostPoints = 20000;

/// The model as a cloud of its points, from the front, beside a figure, to one scale.
class SizePicture final : public QWidget {
 public:
  explicit SizePicture(const std::vector<Vector3d>& positions) {
    setMinimumSize(420, 320);
    const std::size_t step = std::max<std::size_t>(1, positions.size() / kMostPoints);
    for (std::size_t i = 0; i < positions.size(); i += step) {
      points_.append({positions[i].x(), positions[i].z()});
    }
    box_ = points_.boundingRect();
  }
  void setScale(double mmPerUnit) {
    mmPerUnit_ = mmPerUnit;
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Palette& colours = studio::palette();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), colours.field);
    const double modelHeight = mmPerUnit_ * box_.height(), modelWidth = mmPerUnit_ * box_.width();
    const double tallest = std::max(kFigureMm, modelHeight);
    const double widest = std::max(600.0, modelWidth);
    const double floor = height() - 30.0;
    const double scale = std::min((floor - 20) / tallest, (0.5 * width() - 30) / widest);
    painter.setPen(colours.divider);
    painter.drawLine(QPointF(10, floor), QPointF(width() - 10, floor));
    paintFigure(painter, {0.25 * width(), floor}, scale * kFigureMm);
    painter.setPen(colours.second);
    const QRectF left(0, floor + 4, 0.5 * width(), 20), right = left.translated(0.5 * width(), 0);
    painter.drawText(left, Qt::AlignCenter, UnitDialog::tr("170 cm"));
    if (mmPerUnit_ <= 0) {
      painter.drawText(right, Qt::AlignCenter, QStringLiteral("?"));
      return;
    }
    painter.drawText(right, Qt::AlignCenter, sizeText(modelHeight));
    painter.setPen(colours.text);
    const QPointF foot(0.75 * width(), floor);
    for (const QPointF& point : points_) {
      const QPointF from = (point - QPointF(box_.center().x(), box_.top())) * mmPerUnit_ * scale;
      painter.drawPoint(foot + QPointF(from.x(), -from.y()));
    }
  }

 private:
  static void paintFigure(QPainter& painter, const QPointF& foot, double height) {
    const double u = height / 8;  // heads
    painter.setPen(Qt::NoPen);
    painter.setBrush(studio::palette().clay);
    const auto at = [&](double x, double y) { return foot + QPointF(x * u, -y * u); };
    painter.drawEllipse(at(0, 7.5), 0.38 * u, 0.5 * u);
    painter.drawPolygon(QPolygonF(
        {at(-0.15, 7.1), at(0.15, 7.1), at(0.9, 6.6), at(1.25, 3.9), at(1.0, 3.9), at(0.7, 5.6),
         at(0.62, 4.2), at(0.55, 0), at(0.15, 0), at(0, 3.7), at(-0.15, 0), at(-0.55, 0),
         at(-0.62, 4.2), at(-0.7, 5.6), at(-1.0, 3.9), at(-1.25, 3.9), at(-0.9, 6.6)}));
  }

  QPolygonF points_;
  QRectF box_;
  double mmPerUnit_ = 0;
};

}  // namespace

QString sizeText(double mm) {
  const QString space(QChar(0x2009));
  if (mm >= 3000) return QString::number(mm / 1000, 'f', 1) + space + QStringLiteral("m");
  if (mm >= 100) return QString::number(mm / 10, 'f', 0) + space + QStringLiteral("cm");
  return QString::number(mm, 'f', mm < 10 ? 1 : 0) + space + QStringLiteral("mm");
}

UnitDialog::UnitDialog(const QString& name, const std::vector<Vector3d>& positions, QWidget* parent)
    : QDialog(parent) {
  setObjectName(QStringLiteral("unitDialog"));
  setWindowTitle(tr("Open %1").arg(name));
  auto* column = new QVBoxLayout(this);
  auto* question = new QLabel(tr("How big is it? The file does not say."));
  question->setObjectName(QStringLiteral("heading"));
  column->addWidget(question);
  auto* picture = new SizePicture(positions);
  column->addWidget(picture, 1);
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
  if (!positions.empty()) low = high = positions.front();
  for (const Vector3d& p : positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  units_ = new QButtonGroup(this);
  auto* row = new QHBoxLayout;
  for (const FileUnit unit :
       {FileUnit::Millimetre, FileUnit::Centimetre, FileUnit::Metre, FileUnit::Inch}) {
    const double size = millimetresPer(unit) * (high.z() - low.z());
    auto* choice = new QRadioButton(
        tr("%1: %2 tall").arg(QString::fromStdString(toString(unit)), sizeText(size)));
    units_->addButton(choice, static_cast<int>(unit));
    row->addWidget(choice);
    connect(choice, &QRadioButton::clicked, this, [this, picture, unit] {
      picture->setScale(millimetresPer(unit));
      open_->setEnabled(true);
      open_->setToolTip({});
    });
  }
  // A click or an arrow key chooses; the focus alone does not.
  column->addLayout(row);
  auto* foot = new QHBoxLayout;
  foot->addStretch();
  auto* cancel = new QPushButton(tr("Cancel"));
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  foot->addWidget(cancel);
  open_ = new QPushButton(tr("Open"));
  open_->setObjectName(QStringLiteral("primary"));
  open_->setDefault(true);
  open_->setEnabled(false);
  open_->setToolTip(tr("Choose a unit first"));
  connect(open_, &QPushButton::clicked, this, &QDialog::accept);
  foot->addWidget(open_);
  column->addLayout(foot);
}

std::optional<FileUnit> UnitDialog::unit() const {
  const int id = units_->checkedId();
  return id < 0 ? std::nullopt : std::optional(static_cast<FileUnit>(id));
}

}  // namespace toile::studio
