// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of a design: the menu to switch between them, and to add another.
#include <QFileDialog>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

#include "app/icons.h"
#include "app/main_window.h"
#include "jobs/long_work.h"
#include "toile/body/sizes.h"
#include "toile/shape/builtin.h"

namespace toile::studio {

void MainWindow::makeBodyMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Body"));
  menu->setObjectName(QStringLiteral("bodies"));
  connect(menu, &QMenu::aboutToShow, this, [this, menu] { fillBodyMenu(*menu); });
  connect(&session_, &Session::workStarted, this, [this] { bodies_.forget(); });

  // The same menu in the bar above, before Export.
  auto* bar = findChild<QToolBar*>(QStringLiteral("top"));
  auto* chooser = new QToolButton;
  chooser->setObjectName(QStringLiteral("bodyChooser"));
  chooser->setIcon(icon(QStringLiteral("body")));
  chooser->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  chooser->setPopupMode(QToolButton::InstantPopup);
  chooser->setToolTip(tr("The body that is designed on"));
  chooser->setMenu(menu);
  bar->insertWidget(bar->actions().last(), chooser);
  connect(&session_, &Session::historyChanged, chooser, [this, chooser] {
    const auto& models = session_.document().design->models;
    chooser->setText(models.empty() ? tr("Body") : bodyName(models.front()));
  });
}

void MainWindow::fillBodyMenu(QMenu& menu) {
  menu.clear();
  if (!session_.hasWork()) {
    menu.addAction(tr("Open a design first"))->setEnabled(false);
    return;
  }
  const auto& models = session_.document().design->models;
  for (std::size_t i = 0; i < models.size(); ++i) {
    QAction* action = menu.addAction(bodyName(models[i]));
    action->setCheckable(true);
    action->setChecked(i == 0);
    connect(action, &QAction::triggered, this, [this, body = models[i], i] {
      if (i > 0) putOn(body);
    });
  }
  menu.addSeparator();
  menu.addAction(tr("Add a &scan or model…"), this, [this] {
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Another body"), {},
        tr("Models (*.obj *.ply *.stl *.off *.model.json);;All files (*)"));
    if (!file.isEmpty()) putOnFile(file.toStdString());
  });
  QMenu* sizes = menu.addMenu(tr("Add a &size"));
  const bool isBody =
      session_.document().design->models.front().reference.starts_with("builtin:body") ||
      models.back().reference.starts_with("builtin:body");
  sizes->setEnabled(isBody);
  if (!isBody) sizes->setToolTip(tr("Sizes are of the built-in body"));
  for (const BodySize& size : standardSizes()) {
    sizes->addAction(QString::fromStdString(size.name), this, [this, name = size.name] {
      putOn({"builtin:body@1?size=" + name, std::nullopt, std::nullopt, {}});
    });
  }
}

bool MainWindow::putOnFile(const std::filesystem::path& path) {
  const auto unit = unitOf(path);
  if (!unit) return false;
  return putOn({std::filesystem::absolute(path).string(), *unit, std::nullopt, {}});
}

bool MainWindow::putOn(const ModelReference& body) {
  const QString name = bodyName(body);
  const Document before = session_.document();
  const Result<Document> after =
      longWork<Document>(this, tr("The design is put on %1").arg(name), [&](Progress& progress) {
        return bodies_.putOn(before, body, session_.origin(), &progress);
      });
  if (!after) {
    if (after.error().code != ErrorCode::Cancelled) {
      QMessageBox::warning(this, tr("Another body"),
                           tr("The design could not be put on %1: %2. Nothing was changed.")
                               .arg(name, QString::fromStdString(after.error().message)));
    }
    return false;
  }
  session_.putOn(tr("On %1").arg(name), *after);
  return true;
}

}  // namespace toile::studio
