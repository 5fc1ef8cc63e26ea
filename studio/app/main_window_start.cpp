// SPDX-License-Identifier: GPL-3.0-or-later
// How the main window begins: start page, opening of designs and models, recent designs, help.
#include <QApplication>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QTemporaryDir>
#include <QToolBar>

#include "app/keys_dialog.h"
#include "app/main_window.h"
#include "app/tour.h"
#include "document/design_store.h"
#include "jobs/long_work.h"
#include "start/recent_designs.h"
#include "start/start_page.h"
#include "start/unit_dialog.h"
#include "toile/pipeline.h"
#include "viewport/viewport.h"

namespace toile::studio {

namespace {

constexpr const char* kBody = "builtin:body@1";
/// Triangles of a model that can still be drawn on; the pattern of more takes minutes.
constexpr std::size_t kMostTriangles = 1'000'000;
constexpr int kPictureAfter = 2000;  // ms: the first picture of a design is there

QString words(const std::string& text) {
  return QString::fromStdString(text);
}

/// What a mesh file is before it has a unit.
struct Soup {
  std::vector<Eigen::Vector3d> positions;
  std::size_t triangles = 0;
  std::optional<FileUnit> unit;
};

Result<Soup> readSoup(const std::filesystem::path& path) {
  Result<PolygonSoup> soup = readPolygonSoup(path);
  if (!soup) return soup.error();
  Soup result;
  for (const auto& polygon : soup->polygons) {
    result.triangles += std::max<std::size_t>(polygon.size(), 2) - 2;
  }
  result.positions = std::move(soup->positions);
  result.unit = soup->unit;
  return result;
}

}  // namespace

void MainWindow::makeStartPage() {
  actions_.add("start", tr("Start &page"), "", QKeySequence(), [this] { showStart(); });
  actions_.add("tour", tr("Two-minute &tour"), "play", QKeySequence(), [this] { startTour(); });
  actions_.add("keys", tr("All &keys"), "help", QKeySequence("F1"),
               [this] { KeysDialog(actions_, this).exec(); });
  for (const char* id : {"start", "tour", "keys"}) addAction(actions_[QString::fromLatin1(id)]);
  start_ = new StartPage(actions_);
  stack_->addWidget(start_);
  connect(start_, &StartPage::emptyChosen, this, &MainWindow::newWork);
  connect(start_, &StartPage::fileWanted, this, &MainWindow::openWithDialog);
  connect(start_, &StartPage::tourWanted, this, &MainWindow::startTour);
  connect(start_, &StartPage::designChosen, this,
          [this](const QString& file) { open(file.toStdString()); });
  connect(start_, &StartPage::templateChosen, this, &MainWindow::openTemplate);
}

void MainWindow::makeHelpMenu() {
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  for (const char* id : {"keys", "tour", "start"}) help->addAction(actions_[id]);
}

void MainWindow::showStart() {
  keepRecent();
  start_->refresh();
  stack_->setCurrentWidget(start_);
  for (auto* bar : findChildren<QToolBar*>()) bar->hide();
  dock_->hide();
  hint_->setText(tr("Choose a template, or drop a file anywhere in this window"));
}

void MainWindow::showWork() {
  stack_->setCurrentWidget(panes_);
  for (auto* bar : findChildren<QToolBar*>()) bar->show();
  dock_->show();
  viewport_->setFocus();
}

void MainWindow::keepRecent() {
  if (!session_.hasWork() || session_.path().empty()) return;
  RecentDesigns::add(words(session_.path().string()), viewport_->picture());
}

void MainWindow::newWork() {
  if (!mayLeave()) return;
  const Result<Document> document = longWork<Document>(
      this, tr("The body is being made"), [](Progress&) { return emptyDocument(kBody); });
  if (!document) return showMessage(words(document.error().message));
  session_.start(*document, {}, tr("New, empty body"));
}

void MainWindow::startTour() {
  newWork();
  if (session_.hasWork()) new Tour(session_, *viewport_);
}

void MainWindow::openTemplate(const QString& resource, const QString& name) {
  if (!mayLeave()) return;
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("template.toile"));
  QFile::copy(resource, file);
  const Result<Document> document =
      longWork<Document>(this, tr("%1 is being opened").arg(name),
                         [file](Progress&) { return openDocument(file.toStdString()); });
  if (!document) return showMessage(words(document.error().message));
  session_.start(*document, {}, tr("From %1").arg(name));
}

void MainWindow::tellUnopened(const std::filesystem::path& path, const QString& why) {
  QMessageBox box(QMessageBox::Warning, tr("Open"),
                  tr("%1 could not be opened: %2. The file was not changed.")
                      .arg(words(path.filename().string()),
                           QString(why).remove(words(path.string()) + QStringLiteral(", "))),
                  QMessageBox::Ok, this);
  box.setObjectName(QStringLiteral("unopened"));
  box.exec();
}

std::optional<std::optional<FileUnit>> MainWindow::unitOf(const std::filesystem::path& path) {
  if (path.string().ends_with(".model.json")) return std::optional<FileUnit>();
  const QString name = words(path.filename().string());
  const Result<Soup> soup = longWork<Soup>(this, tr("%1 is being read").arg(name),
                                           [path](Progress&) { return readSoup(path); });
  if (!soup) {
    tellUnopened(path, words(soup.error().message));
    return std::nullopt;
  }
  if (soup->triangles > kMostTriangles) {
    tellUnopened(path,
                 tr("it has %L1 triangles, and lines can be drawn on up to %L2. Let the program of "
                    "the scanner reduce it; 50 000 are plenty for a body")
                     .arg(soup->triangles)
                     .arg(kMostTriangles));
    return std::nullopt;
  }
  if (soup->unit) return std::optional<FileUnit>();
  UnitDialog dialog(name, soup->positions, this);
  if (dialog.exec() != QDialog::Accepted || !dialog.unit()) return std::nullopt;
  return dialog.unit();
}

std::optional<Document> MainWindow::openModel(const std::filesystem::path& path) {
  const auto unit = unitOf(path);
  if (!unit) return std::nullopt;
  Result<Document> document =
      longWork<Document>(this, tr("%1 is being opened").arg(words(path.filename().string())),
                         [path, unit](Progress&) { return emptyDocumentOn(path, *unit); });
  if (!document) {
    tellUnopened(path, words(document.error().message));
    return std::nullopt;
  }
  return *document;
}

bool MainWindow::open(const std::filesystem::path& path) {
  if (!mayLeave()) return false;
  const QString name = words(path.filename().string());
  if (path.extension() != ".toile") {
    const auto document = openModel(path);
    if (!document) return false;
    session_.start(*document, {}, tr("New on %1").arg(name));
    return true;
  }
  const Result<Document> document = longWork<Document>(
      this, tr("%1 is being opened").arg(name), [path](Progress&) { return openDocument(path); });
  if (!document) {
    tellUnopened(path, words(document.error().message));
    return false;
  }
  session_.start(*document, path, tr("Open %1").arg(name));
  QTimer::singleShot(kPictureAfter, this, [this, path] {
    if (session_.path() == path) keepRecent();
  });
  return true;
}

void MainWindow::openWithDialog() {
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Open"), {},
      tr("Designs and models (*.toile *.obj *.ply *.stl *.off *.model.json);;All files (*)"));
  if (!file.isEmpty()) open(file.toStdString());
}

}  // namespace toile::studio
