// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLayout>

namespace toile::studio {

/// Rows of items, as many beside each other as there is room for.
class FlowLayout final : public QLayout {
 public:
  FlowLayout(QWidget* parent, int gap);
  ~FlowLayout() override;

  void addItem(QLayoutItem* item) override { items_.append(item); }
  [[nodiscard]] int count() const override { return static_cast<int>(items_.size()); }
  [[nodiscard]] QLayoutItem* itemAt(int index) const override { return items_.value(index); }
  QLayoutItem* takeAt(int index) override;
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override;
  [[nodiscard]] QSize sizeHint() const override { return minimumSize(); }
  [[nodiscard]] QSize minimumSize() const override;
  void setGeometry(const QRect& room) override;

 private:
  int place(const QRect& room, bool really) const;
  QList<QLayoutItem*> items_;
  int gap_;
};

}  // namespace toile::studio
