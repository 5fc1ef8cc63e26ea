// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>
#include <QWidget>
#include <optional>
#include <string>

#include "app/session.h"
#include "jobs/background.h"
#include "toile/develop/develop.h"

class QLabel;
class QPushButton;
class QSlider;

namespace toile::studio {

class NumberField;

/// The slider between a piece as it was drawn (0) and as developable as it can be made (1), with
/// both errors of area: of the plane against the changed shape, and against the shape as drawn.
class DevelopPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit DevelopPanel(Session& session, QWidget* parent = nullptr);

  void open(const std::string& piece);
  void leave();
  [[nodiscard]] const std::optional<DevelopReport>& report() const { return report_; }

 Q_SIGNALS:
  void ended();

 private:
  void setAmount(double amount);
  void compute();
  void showReport();
  void keep(double amount);

  Session& session_;
  Background work_;
  QTimer rest_;  ///< until the slider stands still
  std::string piece_;
  double amount_ = 0;
  std::optional<DevelopReport> report_;

  QLabel* about_ = nullptr;
  QSlider* slider_ = nullptr;
  NumberField* number_ = nullptr;
  QLabel *before_ = nullptr, *changed_ = nullptr, *drawn_ = nullptr, *move_ = nullptr;
  QLabel* state_ = nullptr;
  QPushButton* keep_ = nullptr;
};

}  // namespace toile::studio
