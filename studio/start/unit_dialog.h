// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <QDialog>
#include <optional>
#include <vector>

#include "toile/core/units.h"

class QButtonGroup;
class QPushButton;

namespace toile::studio {

/// "How big is it? The file does not say." The model beside a figure of 170 cm, for each unit. None
/// is chosen beforehand.
class UnitDialog final : public QDialog {
  Q_OBJECT
 public:
  UnitDialog(const QString& name, const std::vector<Eigen::Vector3d>& positions, QWidget* parent);
  [[nodiscard]] std::optional<FileUnit> unit() const;

 private:
  QButtonGroup* units_ = nullptr;
  QPushButton* open_ = nullptr;
};

/// "165 cm", "16.5 m", "4 mm": so that a wrong unit leaps to the eye.
[[nodiscard]] QString sizeText(double mm);

}  // namespace toile::studio
