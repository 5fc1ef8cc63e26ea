// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace toile::studio {

class Actions;

/// All commands with their keys: searched by name or key, run, given other keys. Below them what
/// mouse and fixed keys do.
class KeysDialog final : public QDialog {
  Q_OBJECT
 public:
  KeysDialog(Actions& actions, QWidget* parent);
  /// Shows only what holds the words.
  void search(const QString& words);
  [[nodiscard]] int shownCount() const;

 private:
  void addFixed(const QString& keys, const QString& meaning);
  void showCurrent();
  void takeKey();
  void run();
  [[nodiscard]] class QAction* current() const;

  Actions& actions_;
  QLineEdit* words_;
  QTreeWidget* list_;
  QKeySequenceEdit* key_;
  QPushButton *take_, *back_, *run_;
  QLabel* clash_;
};

}  // namespace toile::studio
