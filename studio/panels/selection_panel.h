// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "app/session.h"

class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace toile::studio {

/// What is selected, with its numbers and what can be changed about it.
class SelectionPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit SelectionPanel(Session& session, QWidget* parent = nullptr);

  /// Puts the cursor into the name of what is selected.
  void editName();

 private:
  void rebuild();
  void showNothing(QVBoxLayout& column);
  void showLine(QVBoxLayout& column, const PlacedLine& line);
  void showPiece(QVBoxLayout& column, const std::string& id);
  void refreshNumbers();

  Session& session_;
  QWidget* content_ = nullptr;
  QLineEdit* name_ = nullptr;
  QLabel* length_ = nullptr;
};

}  // namespace toile::studio
