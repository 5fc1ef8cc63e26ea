// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <algorithm>

#include "app/pane_corners.h"
#include "export/export_dialog.h"
#include "jobs/long_work.h"
#include "panels/lists.h"
#include "pattern/pattern_view.h"
#include "toile/pipeline.h"
#include "tools/drawing.h"
#include "viewport/viewport.h"

// Outside of any namespace, as Qt wants it.
static void initResources() {
  Q_INIT_RESOURCE(studio);
}

namespace toile::studio {

namespace {

const QString kUnit = QStringLiteral("unit");
constexpr int kBackupEvery = 5000;  // ms; at most 10 s of work may be lost

QString fromPath(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent), recovery_(recoveryFolder()) {
  setObjectName(QStringLiteral("mainWindow"));
  setAcceptDrops(true);
  initResources();
  resize(QSize(1600, 1000).boundedTo(screen()->availableSize()));
  viewport_ = new Viewport(session_);
  pattern_ = new PatternView(session_);
  panes_ = new QSplitter;
  panes_->setHandleWidth(5);
  panes_->setChildrenCollapsible(false);
  panes_->addWidget(viewport_);
  panes_->addWidget(pattern_);
  panes_->setSizes({510, 490});
  stack_ = new QStackedWidget;
  stack_->addWidget(panes_);
  setCentralWidget(stack_);
  session_.setUnit(static_cast<LengthUnit>(std::clamp(QSettings().value(kUnit, 0).toInt(), 0, 2)));
  makeActions();
  makeToolActions();
  makePieceActions();
  makeStartPage();
  makeMenus();
  makeBars();
  makeBodyMenu();
  makeHelpMenu();
  makeDock();
  makeStatusBar();
  addPaneCorners(*viewport_, *pattern_, session_, actions_);
  connectSession();
  connect(&backupTimer_, &QTimer::timeout, this, &MainWindow::keepBackup);
  backupTimer_.start(kBackupEvery);
  messageTimer_.setSingleShot(true);
  connect(&messageTimer_, &QTimer::timeout, this, [this] {
    message_.clear();
    showHint();
  });
}

MainWindow::~MainWindow() {
  // Widgets look at the session, which is a member and gone before QMainWindow deletes its
  // children.
  delete takeCentralWidget();
  delete dock_;
}

void MainWindow::connectSession() {
  connect(&session_, &Session::workStarted, this, &MainWindow::showWork);
  connect(&session_, &Session::historyChanged, this, &MainWindow::showTitle);
  connect(&session_, &Session::toolChanged, this, &MainWindow::showTool);
  connect(&session_, &Session::toolMoved, this, &MainWindow::showHint);
  connect(&session_, &Session::patternStateChanged, this, &MainWindow::showPatternState);
  connect(&session_, &Session::told, this, &MainWindow::showMessage);
  connect(&session_, &Session::toolChanged, this,
          [this] { QSettings().setValue(kUnit, static_cast<int>(session_.unit())); });
  connect(viewport_, &Viewport::contextMenuWanted, this, &MainWindow::showContextMenu);
}

// ---- the work

bool MainWindow::offerLeftWork() {
  const auto left = recovery_.findLeftWork();
  if (!left) return false;
  QMessageBox box(QMessageBox::Question, tr("Recovered work"),
                  tr("Toile closed unexpectedly. Your work of %1 is here.")
                      .arg(QLocale().toString(left->written, QLocale::ShortFormat)),
                  QMessageBox::NoButton, this);
  box.setObjectName(QStringLiteral("recovery"));
  QPushButton* take = box.addButton(tr("Continue with it"), QMessageBox::AcceptRole);
  const QAbstractButton* leave =
      box.addButton(left->original.empty() ? tr("Begin anew") : tr("Open the last saved file"),
                    QMessageBox::DestructiveRole);
  box.setDefaultButton(take);
  box.exec();
  if (box.clickedButton() == leave) {
    const std::filesystem::path original = left->original;
    Recovery::discard(*left);
    return !original.empty() && open(original);
  }
  const Result<Document> document = openDocument(left->backup);
  if (!document) {
    showMessage(QString::fromStdString(document.error().message));
    return false;
  }
  session_.startRecovered(*document, left->backup, left->original);
  keepBackup();  // in the copy of this program, before that of the other goes
  Recovery::discard(*left);
  return true;
}

void MainWindow::keepBackup() {
  if (!session_.hasWork()) return;
  // A point that is held for long: as far as it is dragged. Lines that are being drawn are kept
  // when they are whole.
  const bool isDrag = session_.tool().id() == ToolId::Select && session_.isPreview();
  if (!session_.isUnsaved() && !isDrag) return recovery_.forget();
  const auto kept = recovery_.keep(isDrag ? session_.shown() : session_.document(),
                                   session_.origin(), session_.path());
  if (!kept) showMessage(tr("No backup: %1").arg(QString::fromStdString(kept.error().message)));
}

bool MainWindow::save() {
  return session_.path().empty() ? saveAs() : saveTo(session_.path());
}

bool MainWindow::saveAs() {
  QString file = QFileDialog::getSaveFileName(this, tr("Save as"), session_.title() + ".toile",
                                              tr("Designs (*.toile)"));
  if (file.isEmpty()) return false;
  if (!file.endsWith(QStringLiteral(".toile"))) file += QStringLiteral(".toile");
  return saveTo(file.toStdString());
}

bool MainWindow::saveTo(const std::filesystem::path& path) {
  for (;;) {
    const Result<void> saved = session_.save(path);
    if (saved) {
      keepRecent();
      showMessage(tr("Saved as %1").arg(fromPath(path.filename())));
      return true;
    }
    QMessageBox box(QMessageBox::Warning, tr("Not saved"),
                    tr("Not saved: %1. Your last saved file is untouched and your work is still "
                       "here.")
                        // The engine's advice is for the command line.
                        .arg(QString::fromStdString(saved.error().message).section(';', 0, 0)),
                    QMessageBox::NoButton, this);
    const QAbstractButton* elsewhere = box.addButton(tr("Save elsewhere"), QMessageBox::AcceptRole);
    const QAbstractButton* again = box.addButton(tr("Try again"), QMessageBox::ActionRole);
    box.addButton(QMessageBox::Cancel);
    box.exec();
    if (box.clickedButton() == elsewhere) return saveAs();
    if (box.clickedButton() != again) return false;
  }
}

bool MainWindow::mayLeave() {
  if (!session_.hasWork() || !session_.isUnsaved()) return true;
  QMessageBox box(QMessageBox::Question, tr("Toile"),
                  tr("Keep the changes to %1?").arg(session_.title()), QMessageBox::NoButton, this);
  QPushButton* keep = box.addButton(tr("Save"), QMessageBox::AcceptRole);
  const QAbstractButton* discard = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  QPushButton* stay = box.addButton(tr("Stay"), QMessageBox::RejectRole);
  box.setDefaultButton(keep);
  box.setEscapeButton(stay);
  box.exec();
  if (box.clickedButton() == static_cast<QAbstractButton*>(keep)) return save();
  return box.clickedButton() == discard;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (isLongWorkRunning()) {
    event->ignore();
    if (closesWhenDone_) return;
    QMessageBox box(QMessageBox::Question, tr("Toile"),
                    tr("Work is still running. Close when it is done?"), QMessageBox::NoButton,
                    this);
    box.setObjectName(QStringLiteral("closeInWork"));
    QPushButton* wait = box.addButton(tr("Close when done"), QMessageBox::AcceptRole);
    const QAbstractButton* stop =
        box.addButton(tr("Stop it and close"), QMessageBox::DestructiveRole);
    box.setEscapeButton(box.addButton(tr("Stay"), QMessageBox::RejectRole));
    box.setDefaultButton(wait);
    box.exec();
    const bool isStop = box.clickedButton() == stop;
    if (!isStop && box.clickedButton() != static_cast<QAbstractButton*>(wait)) return;
    if (isStop) stopLongWork();
    closesWhenDone_ = true;
    auto* done = new QTimer(this);
    connect(done, &QTimer::timeout, this, [this, done] {
      if (isLongWorkRunning()) return;
      done->deleteLater();
      closesWhenDone_ = false;
      close();
    });
    done->start(50);
    return;
  }
  if (!mayLeave()) return event->ignore();
  keepRecent();
  backupTimer_.stop();
  recovery_.forget();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) {
      open(url.toLocalFile().toStdString());
      return;
    }
  }
}

void MainWindow::exportPattern() {
  if (!session_.pattern() || session_.pattern()->pieces.empty()) {
    return showMessage(tr("There is nothing to export yet: no piece is closed."));
  }
  if (!session_.isPatternCurrent()) {
    return showMessage(tr("The pattern is being updated; export it in a moment."));
  }
  ExportDialog dialog(session_.pattern(), session_.title(), viewport_->picture(), this);
  if (dialog.exec() == QDialog::Accepted) showMessage(tr("Exported"));
}

bool MainWindow::exportTo(const std::filesystem::path& folder) {
  if (!session_.isPatternCurrent()) {
    showMessage(tr("The pattern is being updated; export it in a moment."));
    return false;
  }
  const Result<WrittenPattern> written =
      longWork<WrittenPattern>(this, tr("The pattern is being written"),
                               [pattern = session_.pattern(), folder](Progress& progress) {
                                 return writePattern(*pattern, folder, &progress);
                               });
  if (!written) {
    // The engine's advice is for the command line.
    QMessageBox::warning(
        this, tr("Export"),
        tr("Not exported: %1. Choose another folder or make room.")
            .arg(QString::fromStdString(written.error().message).section(';', 0, 0)));
    return false;
  }
  showMessage(tr("%n files written to %1", nullptr, static_cast<int>(written->files.size()))
                  .arg(fromPath(folder)));
  return true;
}

// ---- what is shown

void MainWindow::setTheme(Theme theme) {
  applyTheme(*qApp, theme);
  actions_.redrawIcons();
  viewport_->themeChanged();
  pattern_->update();
  QSettings().setValue(QStringLiteral("theme"), theme == Theme::Dark ? "dark" : "light");
  Q_EMIT session_.toolChanged();
  Q_EMIT session_.historyChanged();
  Q_EMIT session_.patternChanged();
}

void MainWindow::showPanes(bool body, bool pattern) {
  viewport_->setVisible(body);
  pattern_->setVisible(pattern);
}

void MainWindow::showStrain(bool on) {
  StrainLook look = session_.strainLook();
  look.on = on;
  session_.setStrainLook(look);
}

void MainWindow::showTitle() {
  setWindowTitle(tr("%1[*] – Toile").arg(session_.title()));
  setWindowModified(session_.isUnsaved());
  actions_["undo"]->setEnabled(session_.history().canUndo());
  actions_["redo"]->setEnabled(session_.history().canRedo());
  const auto& steps = session_.history().steps();
  const std::size_t at = session_.history().at();
  actions_["undo"]->setStatusTip(session_.history().canUndo() ? steps[at].name : QString());
}

void MainWindow::showMessage(const QString& sentence) {
  message_ = sentence;
  messageTimer_.start(6000);
  showHint();
}

void MainWindow::setKind(CurveKind kind) {
  DrawingOptions options = session_.options();
  options.kind = kind;
  session_.setOptions(options);
}

}  // namespace toile::studio
