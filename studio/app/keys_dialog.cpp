// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/keys_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "app/actions.h"

namespace toile::studio {

namespace {

constexpr int kId = Qt::UserRole;

QString plain(QString text) {
  return text.remove('&').remove(QStringLiteral("…"));
}

}  // namespace

KeysDialog::KeysDialog(Actions& actions, QWidget* parent)
    : QDialog(parent),
      actions_(actions),
      words_(new QLineEdit),
      list_(new QTreeWidget),
      key_(new QKeySequenceEdit),
      take_(new QPushButton(tr("Take this key"))),
      back_(new QPushButton(tr("As it was"))),
      run_(new QPushButton(tr("Run"))),
      clash_(new QLabel) {
  setObjectName(QStringLiteral("keysDialog"));
  setWindowTitle(tr("All keys"));
  resize(560, 640);
  auto* column = new QVBoxLayout(this);
  words_->setPlaceholderText(tr("Search by name or key"));
  words_->setAccessibleName(tr("Search by name or key"));
  words_->setClearButtonEnabled(true);
  column->addWidget(words_);
  list_->setAccessibleName(tr("All keys"));
  list_->setHeaderLabels({tr("Command"), tr("Key")});
  list_->setRootIsDecorated(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (const QAction* action : actions.all()) {
    auto* item = new QTreeWidgetItem(
        list_, {plain(action->text()), action->shortcut().toString(QKeySequence::NativeText)});
    item->setData(0, kId, action->objectName());
    item->setIcon(0, action->icon());
  }
  addFixed(tr("Enter"), tr("Finish a line"));
  addFixed(tr("Backspace"), tr("Take the last point back"));
  addFixed(tr("Esc"), tr("Back out one level"));
  addFixed(tr("Tab, Shift+Tab"), tr("Next point, point before"));
  addFixed(tr("Arrow keys"), tr("Move the point by 1 mm"));
  addFixed(tr("Ctrl held"), tr("Ignore snapping"));
  addFixed(tr("Shift held"), tr("Move slowly, tilt a girth"));
  addFixed(tr("Space + drag"), tr("Turn the view, also with a pen"));
  addFixed(tr("Wheel"), tr("Zoom to the cursor"));
  column->addWidget(list_, 1);

  auto* row = new QHBoxLayout;
  key_->setAccessibleName(tr("New key"));
  row->addWidget(key_, 1);
  for (QPushButton* button : {take_, back_, run_}) {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  column->addLayout(row);
  clash_->setWordWrap(true);
  column->addWidget(clash_);
  connect(words_, &QLineEdit::textChanged, this, &KeysDialog::search);
  connect(words_, &QLineEdit::returnPressed, this, &KeysDialog::run);
  connect(list_, &QTreeWidget::currentItemChanged, this, &KeysDialog::showCurrent);
  connect(list_, &QTreeWidget::itemActivated, this, &KeysDialog::run);
  connect(key_, &QKeySequenceEdit::keySequenceChanged, this, [this](const QKeySequence& key) {
    const QAction* other = actions_.withKey(key);
    const bool clashes = other != nullptr && other != current();
    clash_->setText(
        clashes
            ? tr("“%1” has this key. It will have none when you take it.").arg(plain(other->text()))
            : QString());
  });
  connect(take_, &QPushButton::clicked, this, &KeysDialog::takeKey);
  connect(back_, &QPushButton::clicked, this, [this] {
    if (current() == nullptr) return;
    key_->setKeySequence(actions_.defaultKey(current()));
    takeKey();
  });
  connect(run_, &QPushButton::clicked, this, &KeysDialog::run);
  list_->setCurrentItem(list_->topLevelItem(0));
  words_->setFocus();
}

void KeysDialog::addFixed(const QString& keys, const QString& meaning) {
  auto* item = new QTreeWidgetItem(list_, {meaning, keys});
  item->setToolTip(0, tr("This key is fixed"));
}

QAction* KeysDialog::current() const {
  const QTreeWidgetItem* item = list_->currentItem();
  const QString id = item == nullptr ? QString() : item->data(0, kId).toString();
  return id.isEmpty() ? nullptr : actions_[id];
}

void KeysDialog::search(const QString& words) {
  QTreeWidgetItem* first = nullptr;
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const bool holds = item->text(0).contains(words, Qt::CaseInsensitive) ||
                       item->text(1).compare(words, Qt::CaseInsensitive) == 0;
    item->setHidden(!holds);
    if (holds && first == nullptr) first = item;
  }
  list_->setCurrentItem(first);
}

int KeysDialog::shownCount() const {
  int count = 0;
  for (int i = 0; i < list_->topLevelItemCount(); ++i) count += !list_->topLevelItem(i)->isHidden();
  return count;
}

void KeysDialog::showCurrent() {
  const QAction* action = current();
  for (QWidget* widget : std::initializer_list<QWidget*>{key_, take_, back_, run_}) {
    widget->setEnabled(action != nullptr);
  }
  key_->setKeySequence(action == nullptr ? QKeySequence() : action->shortcut());
  clash_->clear();
}

void KeysDialog::takeKey() {
  QAction* action = current();
  if (action == nullptr) return;
  const QKeySequence key = key_->keySequence();
  QAction* other = actions_.withKey(key);
  if (other != nullptr && other != action) actions_.setKey(other, {});
  actions_.setKey(action, key);
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const QString id = item->data(0, kId).toString();
    if (!id.isEmpty()) {
      item->setText(1, actions_[id]->shortcut().toString(QKeySequence::NativeText));
    }
  }
  clash_->clear();
}

void KeysDialog::run() {
  QAction* action = current();
  if (action == nullptr || !action->isEnabled()) return;
  accept();
  action->trigger();
}

}  // namespace toile::studio
