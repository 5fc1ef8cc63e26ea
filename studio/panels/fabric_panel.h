// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>
#include <string>

#include "app/number_field.h"
#include "app/session.h"

class QComboBox;
class QFormLayout;

namespace toile::studio {

/// The fabrics of the design with what they bear, their ease, thickness and roll. Every change is a
/// step of the history.
class FabricPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit FabricPanel(Session& session, QWidget* parent = nullptr);

  /// @param piece whose fabric is shown; empty: the first
  void open(const std::string& piece);

 Q_SIGNALS:
  void ended();

 private:
  /// What a field takes.
  struct Bounds {
    NumberField::Kind kind;
    double low, high;
  };
  void rebuild();
  void addFields(QFormLayout& form, const Fabric& fabric);
  void addOptional(QFormLayout& form, const QString& word, const QString& name,
                   const Bounds& bounds, std::optional<double> value,
                   const std::function<void(Fabric&, std::optional<double>)>& set);
  void change(const QString& step, const std::function<void(Fabric&)>& change);
  void chooseColour(const Fabric& fabric);
  void addFabric();
  void removeFabric();

  Session& session_;
  std::string piece_;
  std::string fabric_;  ///< that is shown
  QWidget* content_ = nullptr;
  bool isOpen_ = false;
};

}  // namespace toile::studio
