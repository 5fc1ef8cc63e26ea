// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractButton>
#include <QPixmap>

namespace toile::studio {

/// A picture with a name and a line below it, to be clicked.
class Card final : public QAbstractButton {
  Q_OBJECT
 public:
  Card(const QString& title, const QString& line, const QPixmap& picture, const QSize& size);
  [[nodiscard]] QSize sizeHint() const override { return size_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString line_;
  QPixmap picture_;
  QSize size_;
};

}  // namespace toile::studio
