// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <optional>

#include "app/actions.h"
#include "app/palette.h"
#include "app/session.h"
#include "document/bodies.h"
#include "document/recovery.h"

class QDockWidget;
class QLabel;
class QSplitter;
class QStackedWidget;
class QTabWidget;
class QToolButton;

namespace toile::studio {

class PatternView;
class SidePanels;
class StartPage;
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
  /// Templates, recent designs, the way to open others.
  void showStart();
  /// Offers the work of a program that did not end as it should. @return whether it is taken up
  bool offerLeftWork();
  /// A design or a model file; asks what it must (units), tells what is wrong.
  bool open(const std::filesystem::path& path);
  /// The same design on another body, by long work with Cancel. @return whether it is there now
  bool putOn(const ModelReference& body);
  bool putOnFile(const std::filesystem::path& path);
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
  void makeStartPage();
  void makeHelpMenu();
  void showWork();
  void startTour();
  void openTemplate(const QString& resource, const QString& name);
  [[nodiscard]] std::optional<Document> openModel(const std::filesystem::path& path);
  /// The unit of a mesh file, asked for where the file does not say: an empty inner value means
  /// that it says so itself, an empty outer one that the file is not to be opened.
  [[nodiscard]] std::optional<std::optional<FileUnit>> unitOf(const std::filesystem::path& path);
  void makeBodyMenu();
  void fillBodyMenu(QMenu& menu);
  void tellUnopened(const std::filesystem::path& path, const QString& why);
  void keepRecent();
  void connectSession();
  /// Asks whether changes are to be kept. @return whether the work may be left
  bool mayLeave();
  void openWithDialog();
  void exportPattern();
  void setKind(CurveKind kind);
  void nextKind();
  void makePieceActions();
  /// With the selected piece, or tells that there is none.
  void withPiece(const std::function<void(const std::string&)>& act);
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
  QStackedWidget* stack_ = nullptr;
  StartPage* start_ = nullptr;
  QSplitter* panes_ = nullptr;
  QDockWidget* dock_ = nullptr;
  SidePanels* side_ = nullptr;
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
  Bodies bodies_{bodiesFolder()};
  QString message_;
  bool closesWhenDone_ = false;
};

}  // namespace toile::studio
