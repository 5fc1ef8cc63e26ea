// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

namespace toile::studio {

class Viewport;

/// A small cube that shows from where the body is seen; a click on a side looks from there.
class ViewCube final : public QWidget {
  Q_OBJECT
 public:
  explicit ViewCube(Viewport& viewport);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  struct Side;
  [[nodiscard]] std::vector<Side> visibleSides() const;
  Viewport& viewport_;
};

}  // namespace toile::studio
