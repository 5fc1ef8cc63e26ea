// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>

#include "app/actions.h"
#include "app/session.h"

class QFormLayout;
class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace toile::studio {

/// What is selected, with its numbers and what can be changed about it.
class SelectionPanel final : public QWidget {
  Q_OBJECT
 public:
  SelectionPanel(Session& session, const Actions& actions, QWidget* parent = nullptr);

  /// Puts the cursor into the name of what is selected.
  void editName();

 private:
  void rebuild();
  void showNothing(QVBoxLayout& column);
  void showLine(QVBoxLayout& column, const PlacedLine& line);
  void showSeams(QVBoxLayout& column, const PlacedLine& line, const Pattern& pattern);
  void showPiece(QVBoxLayout& column, const std::string& id);
  void addPieceNumbers(QFormLayout& form, const std::string& id, const PieceRecord* record,
                       const QString& title);
  /// A step of the history.
  void changePiece(const std::string& id, const QString& step,
                   const std::function<void(PieceRecord&)>& change);
  void refreshNumbers();

  Session& session_;
  const Actions& actions_;
  QWidget* content_ = nullptr;
  QLineEdit* name_ = nullptr;
  QLabel* length_ = nullptr;
};

}  // namespace toile::studio
