// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/number_field.h"

#include <QKeyEvent>
#include <QPainter>

#include "app/palette.h"

namespace toile::studio {

NumberField::NumberField(Kind kind, LengthUnit unit, QWidget* parent)
    : QLineEdit(parent), kind_(kind), unit_(unit) {
  setAlignment(Qt::AlignLeft);
  setMinimumWidth(96);
  setText(textOf(0));
}

QString NumberField::textOf(double value) const {
  switch (kind_) {
    case Kind::Length:
      return lengthText(value, unit_);
    case Kind::Share:
      return QStringLiteral("%1 %").arg(100 * value, 0, 'g', 4);
    case Kind::Angle:
      return QStringLiteral("%1°").arg(value, 0, 'g', 4);
  }
  return {};
}

std::optional<double> NumberField::typed() const {
  QString text = this->text();
  if (kind_ == Kind::Length) return evaluateLength(text, unit_);
  // A sum without units.
  text.remove(QLatin1Char('%')).remove(QChar(0xb0));
  const auto sum = evaluateLength(text, LengthUnit::Millimetre);
  return sum && kind_ == Kind::Share ? std::optional(*sum / 100) : sum;
}

void NumberField::setValue(double value) {
  value_ = value;
  isEmpty_ = false;
  if (!hasFocus() || !isModified()) setText(textOf(value));
}

void NumberField::setRange(double least, double most) {
  least_ = least;
  most_ = most;
}

void NumberField::setUnit(LengthUnit unit) {
  unit_ = unit;
  if (!isEmpty_) setText(textOf(value_));
}

void NumberField::setOptional(const QString& hint) {
  isOptional_ = true;
  setPlaceholderText(hint);
}

void NumberField::clearValue() {
  isEmpty_ = true;
  setText({});  // clear() would count as typed
}

void NumberField::take() {
  if (!isModified()) return;
  if (isOptional_ && text().trimmed().isEmpty()) {
    setModified(false);
    isEmpty_ = true;
    Q_EMIT valueCleared();
    return;
  }
  const auto value = typed();
  if (!value || *value < least_ || *value > most_) return giveBack();
  setModified(false);
  value_ = *value;
  isEmpty_ = false;
  setText(textOf(value_));
  Q_EMIT valueEntered(value_);
}

void NumberField::giveBack() {
  setText(isEmpty_ ? QString() : textOf(value_));
  setModified(false);
  selectAll();
}

void NumberField::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && isModified()) return giveBack();
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    take();
    selectAll();
    return;
  }
  QLineEdit::keyPressEvent(event);
}

void NumberField::focusOutEvent(QFocusEvent* event) {
  take();
  QLineEdit::focusOutEvent(event);
}

void NumberField::paintEvent(QPaintEvent* event) {
  QLineEdit::paintEvent(event);
  if (!isModified() || (isOptional_ && text().trimmed().isEmpty())) return;
  const auto value = typed();
  const bool isFine = value && *value >= least_ && *value <= most_;
  const QString result = isFine ? QStringLiteral("= ") + textOf(*value) : QString(QChar(0x25b3));
  const QFontMetrics metrics(font());
  if (metrics.horizontalAdvance(text() + result) + 28 > width()) return;
  QPainter painter(this);
  painter.setPen(isFine ? studio::palette().disabled : studio::palette().trouble);
  painter.drawText(rect().adjusted(8, 0, -10, 0), Qt::AlignRight | Qt::AlignVCenter, result);
}

}  // namespace toile::studio
