// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>
#include <QTimer>
#include <filesystem>

#include "app/actions.h"
#include "app/palette.h"
#include "app/session.h"
#include "document/recovery.h"

class QDockWidget;
class QLabel;
class QSplitter;
class QTabWidget;
class QToolButton;

namespace toile::studio {

class PatternView;
class SelectionPanel;
class Viewport;

/// The window: body on the left, pattern on the right, panel beside them.
class MainWindow final : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] PatternView& patternView() { return *pattern_; }
  [[nodiscard]] Actions& actions() { return actions_; }

  void newWork();
  /// Offers the work of a program that did not end as it should. @return whether it is taken up
  bool offerLeftWork();
  /// A design or a model file; asks what it must (units), tells what is wrong.
  bool open(const std::filesystem::path& path);
  bool save();
  bool saveAs();
  bool saveTo(const std::filesystem::path& path);
  /// Writes the pattern as it is shown, once it is up to date.
  bool exportTo(const std::filesystem::path& folder);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makeActions();
  void makeToolActions();
  void makeMenus();
  void makeBars();
  void makeDock();
  void makeStatusBar();
  void connectSession();
  /// Asks whether changes are to be kept. @return whether the work may be left
  bool mayLeave();
  void openWithDialog();
  void exportPattern();
  void setKind(CurveKind kind);
  void nextKind();
  void setTheme(Theme theme);
  void showPanes(bool body, bool pattern);
  void showStrain(bool on);
  void showContextMenu(const QPoint& place);
  void keepBackup();
  void showTitle();
  void showTool();
  void showHint();
  void showPatternState();
  void showMessage(const QString& sentence);

  Session session_;
  Actions actions_;
  Viewport* viewport_ = nullptr;
  PatternView* pattern_ = nullptr;
  QSplitter* panes_ = nullptr;
  QDockWidget* dock_ = nullptr;
  SelectionPanel* selection_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  QLabel* toolName_ = nullptr;
  QToolButton* kinds_[4] = {};
  QLabel* hint_ = nullptr;
  QLabel* patternState_ = nullptr;
  QLabel* viewChip_ = nullptr;
  QLabel* scaleChip_ = nullptr;
  QToolButton* unitButton_ = nullptr;
  QTimer messageTimer_;
  QTimer backupTimer_;
  Recovery recovery_;
  QString message_;
};

}  // namespace toile::studio
