// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/flow_layout.h"

#include <QWidget>
#include <algorithm>

namespace toile::studio {

FlowLayout::FlowLayout(QWidget* parent, int gap) : QLayout(parent), gap_(gap) {
  setContentsMargins(0, 0, 0, 0);
}

FlowLayout::~FlowLayout() {
  qDeleteAll(items_);
}

QLayoutItem* FlowLayout::takeAt(int index) {
  return index >= 0 && index < items_.size() ? items_.takeAt(index) : nullptr;
}

int FlowLayout::heightForWidth(int width) const {
  return place({0, 0, width, 0}, false);
}

QSize FlowLayout::minimumSize() const {
  QSize size;
  for (const QLayoutItem* item : items_) size = size.expandedTo(item->minimumSize());
  return size;
}

void FlowLayout::setGeometry(const QRect& room) {
  QLayout::setGeometry(room);
  place(room, true);
}

int FlowLayout::place(const QRect& room, bool really) const {
  int x = room.x(), y = room.y(), row = 0;
  for (QLayoutItem* item : items_) {
    const QSize size = item->sizeHint();
    if (x > room.x() && x + size.width() > room.right() + 1) {
      x = room.x();
      y += row + gap_;
      row = 0;
    }
    if (really) item->setGeometry({QPoint(x, y), size});
    x += size.width() + gap_;
    row = std::max(row, size.height());
  }
  return y + row - room.y();
}

}  // namespace toile::studio
