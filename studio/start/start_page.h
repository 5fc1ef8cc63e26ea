// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLineEdit;
class QVBoxLayout;

namespace toile::studio {

class Actions;

/// What the program begins with: templates, a model of one's own, the designs of before.
class StartPage final : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(Actions& actions);
  /// Shows the recent designs as they are now.
  void refresh();

 Q_SIGNALS:
  void templateChosen(const QString& resource, const QString& name);
  void emptyChosen();
  void fileWanted();
  void designChosen(const QString& file);
  void tourWanted();

 private:
  QWidget* makeSide(Actions& actions);
  QWidget* makeTemplates();
  QWidget* makeHint();

  QWidget* recentCards_ = nullptr;
  QVBoxLayout* recentPlace_ = nullptr;
  QLineEdit* search_ = nullptr;
};

}  // namespace toile::studio
