// SPDX-License-Identifier: GPL-3.0-or-later
// For those who work by keyboard or by ear: everything that can be worked in the window, its panels
// and its dialogs has a name that a screen reader tells, and what shows only an icon has a tooltip.
//   toile_studio_names
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QRadioButton>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QToolButton>
#include <set>

#include "app/keys_dialog.h"
#include "app/palette.h"
#include "export/export_dialog.h"
#include "hand.h"
#include "start/card.h"
#include "start/unit_dialog.h"
#include "tools/tool_info.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

std::size_t seen = 0;
std::set<QString> faults;

/// What a screen reader tells of it.
QString nameOf(QWidget& widget) {
  const QAccessibleInterface* accessible = QAccessible::queryAccessibleInterface(&widget);
  return accessible == nullptr ? QString() : accessible->text(QAccessible::Name).trimmed();
}

/// Parts that Qt makes inside of its own widgets, and bars that have nothing to be told.
bool isInner(const QWidget& widget) {
  const QString name = widget.objectName();
  if (name.startsWith(QStringLiteral("qt_")) || qobject_cast<const QScrollBar*>(&widget)) {
    return true;
  }
  const QWidget* parent = widget.parentWidget();
  return qobject_cast<const QAbstractSpinBox*>(parent) != nullptr ||
         qobject_cast<const QComboBox*>(parent) != nullptr ||
         qobject_cast<const QTabBar*>(parent) != nullptr ||
         widget.inherits("QComboBoxPrivateContainer") || widget.inherits("QComboBoxListView");
}

bool isWorked(const QWidget& widget) {
  return widget.focusPolicy() != Qt::NoFocus ||
         qobject_cast<const QAbstractButton*>(&widget) != nullptr ||
         qobject_cast<const QAbstractSlider*>(&widget) != nullptr;
}

void check(QWidget& widget, const char* where) {
  if (!widget.isVisible() || isInner(widget) || !isWorked(widget)) return;
  ++seen;
  const QString what =
      QStringLiteral("%1: %2 \"%3\" in %4")
          .arg(QString::fromLatin1(where), QString::fromLatin1(widget.metaObject()->className()),
               widget.objectName(),
               widget.parentWidget() == nullptr
                   ? QString()
                   : QString::fromLatin1(widget.parentWidget()->metaObject()->className()) + ' ' +
                         widget.parentWidget()->objectName());
  if (nameOf(widget).isEmpty()) faults.insert(what + QStringLiteral(" has no name"));
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  if (button == nullptr || button->toolTip().size() > 0) return;
  const auto* tool = qobject_cast<const QToolButton*>(&widget);
  const bool isIcon = button->text().isEmpty() ||
                      (tool != nullptr && tool->toolButtonStyle() == Qt::ToolButtonIconOnly &&
                       !tool->icon().isNull());
  if (isIcon) faults.insert(what + QStringLiteral(" is an icon without a tooltip"));
}

void checkAll(QWidget& window, const char* where) {
  QApplication::processEvents();
  check(window, where);
  for (QWidget* widget : window.findChildren<QWidget*>()) check(*widget, where);
}

/// Commands have words, wherever they are shown.
void checkCommands(MainWindow& window) {
  for (const QAction* action : window.actions().all()) {
    if (action->text().isEmpty() || action->toolTip().isEmpty()) {
      faults.insert(QStringLiteral("command %1 has no words").arg(action->objectName()));
    }
  }
  for (const QMenu* menu : window.findChildren<QMenu*>()) {
    for (const QAction* action : menu->actions()) {
      if (!action->isSeparator() && action->text().isEmpty()) {
        faults.insert(QStringLiteral("menu %1 has a line without words").arg(menu->title()));
      }
    }
  }
}

void panels(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  checkAll(window, "nothing selected");
  auto* tabs = window.findChild<QTabWidget*>();
  for (int tab = 0; tab < tabs->count(); ++tab) {
    tabs->setCurrentIndex(tab);
    checkAll(window, "lists");
  }
  session.select(Selection::line(session.document().design->curves.front().id));
  checkAll(window, "a line");
  const std::string piece = session.pattern()->cut.pieces.front().id;
  session.select(Selection::piece(piece));
  checkAll(window, "a piece");
  for (const SidePanel panel : {SidePanel::Darts, SidePanel::Developable, SidePanel::Fabrics}) {
    session.openPanel(panel, piece);
    hand.settle();
    checkAll(window, "a panel");
  }
  session.openPanel(SidePanel::Selection, piece);
  hand.command("strain");
  checkAll(window, "strain");
  hand.command("strain");
  for (const ToolInfo& info : allTools()) {
    session.setTool(info.id);
    checkAll(window, info.icon);
  }
  session.setTool(ToolId::Select);
}

void dialogs(MainWindow& window) {
  KeysDialog keys(window.actions(), &window);
  keys.show();
  checkAll(keys, "keys");
  keys.hide();
  UnitDialog unit(QStringLiteral("a.obj"), {{0, 0, 0}, {1, 2, 3}}, &window);
  unit.show();
  checkAll(unit, "unit");
  unit.hide();
  ExportDialog files(window.session().pattern(), QStringLiteral("vest"),
                     window.viewport().picture(), &window);
  files.show();
  for (int i = 0; i < 1200 && !files.isReady(); ++i) wait(50);
  require(files.isReady(), "the files are made");
  wait(500);
  checkAll(files, "export");
}

void tour(MainWindow& window) {
  beginAnew(window);
  window.actions()[QStringLiteral("tour")]->trigger();
  checkAll(window, "tour");
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  applyTheme(app, Theme::Light);
  MainWindow window;
  window.resize(1400, 880);
  window.showStart();
  window.show();
  window.activateWindow();
  wait(300);
  checkAll(window, "start page");
  window.findChild<Card*>(QStringLiteral("torso-vest"))->click();
  Hand(window).settle();
  checkCommands(window);
  panels(window);
  dialogs(window);
  tour(window);
  for (const QString& fault : faults) std::printf("  %s\n", qPrintable(fault));
  std::printf("  %zu looks\n", seen);
  require(seen > 500, "the walk goes through panels and dialogs");
  require(faults.empty(), "all that can be worked has a name, and each icon a tooltip");
  return 0;
}
