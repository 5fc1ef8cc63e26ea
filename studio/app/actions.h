// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAction>
#include <QHash>
#include <QList>
#include <QObject>
#include <functional>

namespace toile::studio {

/// All commands of the program by their ids, so that menus, tool bars, keys and the list of keys
/// speak of the same ones. Keys can be changed; changes are kept in the settings.
class Actions final : public QObject {
  Q_OBJECT
 public:
  explicit Actions(QObject* parent = nullptr) : QObject(parent) {}

  QAction* add(const QString& id, const QString& text, const QString& iconName,
               const QKeySequence& key, const std::function<void()>& run);
  /// With a check mark.
  QAction* addToggle(const QString& id, const QString& text, const QString& iconName,
                     const QKeySequence& key, const std::function<void(bool)>& run);
  /// Precondition: the action exists.
  [[nodiscard]] QAction* operator[](const QString& id) const { return byId_.value(id); }
  [[nodiscard]] const QList<QAction*>& all() const { return all_; }

  [[nodiscard]] QKeySequence defaultKey(const QAction* action) const;
  /// The command that has this key already.
  [[nodiscard]] QAction* withKey(const QKeySequence& key) const;
  void setKey(QAction* action, const QKeySequence& key);
  /// Draws icons anew after a change of theme.
  void redrawIcons();

 private:
  QAction* insert(QAction* action, const QString& id, const QString& iconName,
                  const QKeySequence& key);
  void describe(QAction* action) const;

  QHash<QString, QAction*> byId_;
  QList<QAction*> all_;
};

}  // namespace toile::studio
