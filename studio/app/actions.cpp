// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/actions.h"

#include <QSettings>

#include "app/icons.h"

namespace toile::studio {

namespace {

constexpr const char* kIcon = "iconName";
constexpr const char* kDefaultKey = "defaultKey";

}  // namespace

QAction* Actions::insert(QAction* action, const QString& id, const QString& iconName,
                         const QKeySequence& key) {
  action->setObjectName(id);
  action->setProperty(kIcon, iconName);
  action->setProperty(kDefaultKey, key.toString());
  if (!iconName.isEmpty()) action->setIcon(icon(iconName));
  const QVariant changed = QSettings().value(QStringLiteral("keys/") + id);
  action->setShortcut(changed.isValid() ? QKeySequence(changed.toString()) : key);
  describe(action);
  byId_.insert(id, action);
  all_.append(action);
  return action;
}

void Actions::describe(QAction* action) const {
  QString text = action->text();
  text.remove('&').remove(QStringLiteral("…"));
  const QString key = action->shortcut().toString(QKeySequence::NativeText);
  action->setToolTip(key.isEmpty() ? text : QStringLiteral("%1  (%2)").arg(text, key));
}

QAction* Actions::add(const QString& id, const QString& text, const QString& iconName,
                      const QKeySequence& key, const std::function<void()>& run) {
  auto* action = new QAction(text, this);
  connect(action, &QAction::triggered, this, [run] { run(); });
  return insert(action, id, iconName, key);
}

QAction* Actions::addToggle(const QString& id, const QString& text, const QString& iconName,
                            const QKeySequence& key, const std::function<void(bool)>& run) {
  auto* action = new QAction(text, this);
  action->setCheckable(true);
  connect(action, &QAction::triggered, this, run);
  return insert(action, id, iconName, key);
}

QKeySequence Actions::defaultKey(const QAction* action) const {
  return QKeySequence(action->property(kDefaultKey).toString());
}

QAction* Actions::withKey(const QKeySequence& key) const {
  if (key.isEmpty()) return nullptr;
  for (QAction* action : all_) {
    if (action->shortcut() == key) return action;
  }
  return nullptr;
}

void Actions::setKey(QAction* action, const QKeySequence& key) {
  action->setShortcut(key);
  describe(action);
  QSettings settings;
  const QString name = QStringLiteral("keys/") + action->objectName();
  if (key == defaultKey(action)) {
    settings.remove(name);
  } else {
    settings.setValue(name, key.toString());
  }
}

void Actions::redrawIcons() {
  for (QAction* action : all_) {
    const QString name = action->property(kIcon).toString();
    if (!name.isEmpty()) action->setIcon(icon(name));
  }
}

}  // namespace toile::studio
