// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLineEdit>

#include "app/units.h"

namespace toile::studio {

/// A number with its unit that takes sums: "34.5+2cm", "3/8in*2". What a sum gives stands grey
/// behind it while it is typed; Enter takes it, Esc gives the old one back.
class NumberField final : public QLineEdit {
  Q_OBJECT
 public:
  enum class Kind {
    Length,  ///< mm
    Share,   ///< 0.05 is shown as 5 %
    Angle    ///< degrees
  };
  explicit NumberField(Kind kind, LengthUnit unit, QWidget* parent = nullptr);

  void setValue(double value);
  [[nodiscard]] double value() const { return value_; }
  /// Values beyond are not taken.
  void setRange(double least, double most);
  void setUnit(LengthUnit unit);
  /// May be empty: "no limit". Then valueCleared() is sent.
  void setOptional(const QString& hint);
  void clearValue();

 Q_SIGNALS:
  void valueEntered(double value);
  void valueCleared();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] std::optional<double> typed() const;
  [[nodiscard]] QString textOf(double value) const;
  void take();
  void giveBack();

  Kind kind_;
  LengthUnit unit_;
  double value_ = 0;
  double least_ = -1e6, most_ = 1e6;
  bool isOptional_ = false, isEmpty_ = false;
};

}  // namespace toile::studio
