// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the main window: commands, menus, bars, panel, status line.
#include <QActionGroup>
#include <QApplication>
#include <QButtonGroup>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/icons.h"
#include "app/main_window.h"
#include "app/tool_setting_bar.h"
#include "panels/lists.h"
#include "panels/selection_panel.h"
#include "panels/side_panels.h"
#include "pattern/pattern_view.h"
#include "tools/drawing.h"
#include "tools/tool_info.h"
#include "viewport/viewport.h"

namespace toile::studio {

namespace {

constexpr CurveKind kKinds[4] = {CurveKind::Seam, CurveKind::Feature, CurveKind::Elastic,
                                 CurveKind::Opening};

/// A piece of line as it will be drawn.
QIcon kindIcon(CurveKind kind) {
  const LineLook look = lookOf(kind);
  QPixmap pixmap(44, 32);
  pixmap.setDevicePixelRatio(2);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  QPen pen(look.onPiece, look.width, Qt::SolidLine, look.dots ? Qt::RoundCap : Qt::FlatCap);
  if (look.dots) {
    pen.setDashPattern({0.01, look.dashes[1] / look.width});
  } else if (!look.dashes.isEmpty()) {
    QVector<qreal> dashes;
    for (const float dash : look.dashes) dashes << 0.6 * dash / look.width;
    pen.setDashPattern(dashes);
  }
  painter.setPen(pen);
  painter.drawLine(QPointF(1, 8), QPointF(21, 8));
  return QIcon(pixmap);
}

/// "<Enter> finish" with the key drawn as one.
QString withKeys(QString hint) {
  const Palette& colours = studio::palette();
  hint.replace(QStringLiteral("<b>"), QStringLiteral("\x01"))
      .replace(QStringLiteral("</b>"), QStringLiteral("\x02"));
  hint.replace(QLatin1Char('<'), QStringLiteral("\x03"))
      .replace(QLatin1Char('>'), QStringLiteral("\x04"));
  hint.replace(QStringLiteral("\x03"),
               QStringLiteral("<span style='background:%1; color:%2'>&nbsp;")
                   .arg(colours.field.name(), colours.text.name()));
  hint.replace(QStringLiteral("\x04"), QStringLiteral("&nbsp;</span>"));
  hint.replace(QStringLiteral("\x01"), QStringLiteral("<b>"))
      .replace(QStringLiteral("\x02"), QStringLiteral("</b>"));
  return hint;
}

}  // namespace

void MainWindow::makeActions() {
  const auto work = [this](void (Session::*what)()) {
    return [this, what] {
      if (session_.hasWork()) (session_.*what)();
    };
  };
  actions_.add("new", tr("&New"), "plus", QKeySequence("Ctrl+N"), [this] { newWork(); });
  actions_.add("open", tr("&Open…"), "open", QKeySequence("Ctrl+O"), [this] { openWithDialog(); });
  actions_.add("save", tr("&Save"), "save", QKeySequence("Ctrl+S"), [this] { save(); });
  actions_.add("save-as", tr("Save &as…"), "", QKeySequence("Ctrl+Shift+S"), [this] { saveAs(); });
  actions_.add("export", tr("&Export…"), "export", QKeySequence("Ctrl+E"),
               [this] { exportPattern(); });
  actions_.add("quit", tr("&Quit"), "", QKeySequence("Ctrl+Q"), [this] { close(); });
  actions_.add("undo", tr("&Undo"), "undo", QKeySequence("Ctrl+Z"), work(&Session::undo));
  actions_.add("redo", tr("&Redo"), "redo", QKeySequence("Ctrl+Shift+Z"), work(&Session::redo));
  actions_.add("name", tr("Na&me"), "", QKeySequence("F2"),
               [this] { side_->selection().editName(); });
  actions_.add("delete", tr("&Delete"), "trash", QKeySequence("Del"),
               [this] { session_.key(ToolKey::Delete); });
  actions_.add("next-kind", tr("Next line &kind"), "", QKeySequence("K"), [this] { nextKind(); });
  actions_.addToggle("symmetry", tr("Linked s&ymmetry"), "link", QKeySequence("Y"),
                     [this](bool on) {
                       DrawingOptions options = session_.options();
                       options.symmetry = on;
                       session_.setOptions(options);
                     });
  actions_.addToggle("snap", tr("S&nap"), "snap", QKeySequence(), [this](bool on) {
    DrawingOptions options = session_.options();
    options.snap = on;
    session_.setOptions(options);
  });
  actions_["symmetry"]->setChecked(true);
  actions_["snap"]->setChecked(true);

  actions_.addToggle("see-through", tr("See-&through"), "see-through", QKeySequence("X"),
                     [this](bool on) { viewport_->setSeeThrough(on); });
  actions_.addToggle("strain", tr("&Strain"), "strain", QKeySequence("S"),
                     [this](bool on) { showStrain(on); });
  const std::tuple<const char*, QString, const char*, bool PatternShown::*> shown[] = {
      {"show-allowance", tr("Seam &allowance"), "allowance", &PatternShown::allowance},
      {"show-notches", tr("&Notches"), "notch", &PatternShown::notches},
      {"show-grain", tr("&Grain"), "grain", &PatternShown::grain},
      {"show-labels", tr("Na&mes"), "label", &PatternShown::labels},
      {"show-features", tr("Feature &lines"), "fair", &PatternShown::features}};
  for (const auto& [id, text, icon, member] : shown) {
    actions_
        .addToggle(id, text, icon, QKeySequence(),
                   [this, member = member](bool on) {
                     PatternShown now = pattern_->shown();
                     now.*member = on;
                     pattern_->setShown(now);
                   })
        ->setChecked(true);
  }
  actions_
      .addToggle("show-names", tr("Names on the &body"), "label", QKeySequence(),
                 [this](bool on) { viewport_->setLabels(on); })
      ->setChecked(true);
  actions_.addToggle("edges", tr("Mesh &edges"), "", QKeySequence("W"),
                     [this](bool on) { viewport_->setEdges(on); });
  actions_.add("fit", tr("&Fit selection"), "fit", QKeySequence("F"),
               [this] { viewport_->fitSelection(); });
  actions_.add("fit-all", tr("Fit &all"), "", QKeySequence("Home"), [this] {
    viewport_->fitAll();
    pattern_->fitAll();
  });
  const std::tuple<const char*, QString, StandardView, const char*> views[] = {
      {"front", tr("Front"), StandardView::Front, "1"},
      {"back", tr("Back"), StandardView::Back, "2"},
      {"left", tr("Left"), StandardView::Left, "3"},
      {"right", tr("Right"), StandardView::Right, "4"},
      {"top", tr("Top"), StandardView::Top, "5"},
      {"bottom", tr("Bottom"), StandardView::Bottom, "6"}};
  for (const auto& [id, text, view, key] : views) {
    actions_.add(QStringLiteral("view-") + id, text, "", QKeySequence(key),
                 [this, view = view] { viewport_->lookFrom(view); });
  }
  actions_.add("straight", tr("&Look straight at it"), "", QKeySequence("0"),
               [this] { viewport_->lookStraightAtSelection(); });
  actions_.add("panes-body", tr("&Body only"), "", QKeySequence("Ctrl+1"),
               [this] { showPanes(true, false); });
  actions_.add("panes-both", tr("B&ody and pattern"), "", QKeySequence("Ctrl+2"),
               [this] { showPanes(true, true); });
  actions_.add("panes-pattern", tr("&Pattern only"), "", QKeySequence("Ctrl+3"),
               [this] { showPanes(false, true); });
  actions_.add("panel", tr("P&anel"), "", QKeySequence("F9"),
               [this] { dock_->setVisible(!dock_->isVisible()); });
  actions_.addToggle("dark", tr("&Dark"), "", QKeySequence(),
                     [this](bool on) { setTheme(on ? Theme::Dark : Theme::Light); });
  actions_["dark"]->setChecked(studio::palette().theme == Theme::Dark);
  for (QAction* action : actions_.all()) addAction(action);
}

void MainWindow::makeToolActions() {
  auto* group = new QActionGroup(this);
  for (const ToolInfo& info : allTools()) {
    QAction* action =
        actions_.add(QStringLiteral("tool-") + info.icon, nameOf(info), info.icon,
                     QKeySequence(info.key), [this, id = info.id] { session_.setTool(id); });
    action->setCheckable(true);
    group->addAction(action);
    addAction(action);
  }
  actions_["tool-select"]->setChecked(true);
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, std::initializer_list<const char*> ids) {
    for (const char* id : ids) {
      if (*id == '-') {
        menu->addSeparator();
      } else {
        menu->addAction(actions_[id]);
      }
    }
  };
  fill(menuBar()->addMenu(tr("&File")),
       {"new", "open", "-", "save", "save-as", "export", "-", "quit"});
  fill(menuBar()->addMenu(tr("&Edit")), {"undo", "redo", "-", "name", "delete"});
  QMenu* view = menuBar()->addMenu(tr("&View"));
  fill(view, {"fit",
              "fit-all",
              "straight",
              "-",
              "view-front",
              "view-back",
              "view-left",
              "view-right",
              "view-top",
              "view-bottom",
              "-",
              "see-through",
              "strain",
              "colour-fabric",
              "colour-piece",
              "show-names",
              "edges",
              "-",
              "show-allowance",
              "show-notches",
              "show-grain",
              "show-labels",
              "show-features",
              "-"});
  QMenu* navigation = view->addMenu(tr("&Navigation"));
  auto* presets = new QActionGroup(this);
  const int chosen = QSettings().value(QStringLiteral("navigation"), 0).toInt();
  for (int i = 0; i < kNavigationPresetCount; ++i) {
    const auto preset = static_cast<NavigationPreset>(i);
    QAction* action = navigation->addAction(nameOf(preset));
    action->setCheckable(true);
    presets->addAction(action);
    connect(action, &QAction::triggered, this, [this, preset, i] {
      viewport_->setNavigation(preset);
      QSettings().setValue(QStringLiteral("navigation"), i);
    });
    if (i == chosen) {
      action->setChecked(true);
      viewport_->setNavigation(preset);
    }
  }
  QMenu* line = menuBar()->addMenu(tr("&Line"));
  for (const ToolInfo& info : allTools())
    line->addAction(actions_[QStringLiteral("tool-") + info.icon]);
  line->addSeparator();
  fill(line, {"next-kind", "symmetry", "snap"});
  fill(menuBar()->addMenu(tr("&Piece")),
       {"name", "include", "fabrics", "-", "darts", "developable", "-", "merge", "back-in-place"});
  fill(menuBar()->addMenu(tr("&Window")),
       {"panes-body", "panes-both", "panes-pattern", "-", "panel", "dark"});
}

void MainWindow::makeBars() {
  auto* top = addToolBar(tr("Tool"));
  top->setObjectName(QStringLiteral("top"));
  top->setMovable(false);
  top->setIconSize({20, 20});
  top->addAction(actions_["undo"]);
  top->addAction(actions_["redo"]);
  top->addSeparator();
  toolName_ = new QLabel;
  toolName_->setObjectName(QStringLiteral("heading"));
  toolName_->setMinimumWidth(90);
  toolName_->setContentsMargins(8, 0, 8, 0);
  top->addWidget(toolName_);
  auto* kinds = new QWidget;
  auto* row = new QHBoxLayout(kinds);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  auto* group = new QButtonGroup(this);
  for (std::size_t i = 0; i < std::size(kKinds); ++i) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("kind"));
    button->setCheckable(true);
    button->setText(kindWord(kKinds[i]));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setIconSize({22, 16});
    button->setToolTip(tr("New lines are of this kind  (K for the next)"));
    connect(button, &QToolButton::clicked, this, [this, i] { setKind(kKinds[i]); });
    group->addButton(button);
    row->addWidget(button);
    kinds_[i] = button;
  }
  top->addWidget(kinds);
  top->addSeparator();
  for (const char* id : {"symmetry", "snap"}) {
    auto* button = new QToolButton;
    button->setDefaultAction(actions_[id]);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    top->addWidget(button);
  }
  actions_["symmetry"]->setIconText(tr("Symmetry"));
  auto* setting = new ToolSettingBar(session_);
  connect(setting, &ToolSettingBar::taken, this, [this] { viewport_->setFocus(); });
  top->addWidget(setting);
  auto* space = new QWidget;
  space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  top->addWidget(space);
  auto* exportButton = new QPushButton(icon("export", Qt::white), tr("Export…"));
  exportButton->setObjectName(QStringLiteral("primary"));
  connect(exportButton, &QPushButton::clicked, actions_["export"], &QAction::trigger);
  top->addWidget(exportButton);

  auto* rail = new QToolBar(tr("Tools"));
  rail->setObjectName(QStringLiteral("rail"));
  rail->setMovable(false);
  rail->setIconSize({20, 20});
  addToolBar(Qt::LeftToolBarArea, rail);
  int last = 0;
  for (const ToolInfo& info : allTools()) {
    if (info.group != last) rail->addSeparator();
    last = info.group;
    rail->addAction(actions_[QStringLiteral("tool-") + info.icon]);
  }
}

void MainWindow::makeDock() {
  dock_ = new QDockWidget(this);
  dock_->setObjectName(QStringLiteral("panelDock"));
  dock_->setTitleBarWidget(new QWidget);
  dock_->setFeatures(QDockWidget::NoDockWidgetFeatures);
  auto* inner = new QWidget;
  inner->setObjectName(QStringLiteral("dock"));
  inner->setMinimumWidth(264);
  auto* column = new QVBoxLayout(inner);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  side_ = new SidePanels(session_, actions_);
  column->addWidget(side_);
  tabs_ = new QTabWidget;
  tabs_->setAccessibleName(tr("Lists"));
  auto* pieces = new PiecesList(session_);
  auto* findings = new FindingsList(session_);
  tabs_->addTab(pieces, tr("Pieces"));
  tabs_->addTab(findings, tr("Findings"));
  tabs_->addTab(new HistoryList(session_), tr("History"));
  connect(pieces, &PiecesList::countChanged, this,
          [this](int count) { tabs_->setTabText(0, tr("Pieces %1").arg(count)); });
  connect(findings, &FindingsList::countChanged, this,
          [this](int count) { tabs_->setTabText(1, tr("Findings %1").arg(count)); });
  tabs_->setMinimumHeight(220);
  column->addWidget(tabs_, 1);
  dock_->setWidget(inner);
  addDockWidget(Qt::RightDockWidgetArea, dock_);
  resizeDocks({dock_}, {296}, Qt::Horizontal);
}

void MainWindow::makeStatusBar() {
  statusBar()->setSizeGripEnabled(false);
  hint_ = new QLabel;
  hint_->setObjectName(QStringLiteral("hint"));
  hint_->setContentsMargins(8, 0, 8, 0);
  hint_->setTextFormat(Qt::RichText);
  statusBar()->addWidget(hint_, 1);
  patternState_ = new QLabel;
  patternState_->setObjectName(QStringLiteral("patternState"));
  patternState_->setContentsMargins(8, 0, 8, 0);
  statusBar()->addPermanentWidget(patternState_);
  unitButton_ = new QToolButton;
  unitButton_->setText(symbol(session_.unit()));
  unitButton_->setToolTip(tr("Unit of all lengths"));
  unitButton_->setPopupMode(QToolButton::InstantPopup);
  auto* units = new QMenu(unitButton_);
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Inch}) {
    units->addAction(symbol(unit), this, [this, unit] {
      session_.setUnit(unit);
      unitButton_->setText(symbol(unit));
      pattern_->update();
    });
  }
  unitButton_->setMenu(units);
  statusBar()->addPermanentWidget(unitButton_);
}

void MainWindow::nextKind() {
  std::size_t i = 0;
  while (i < std::size(kKinds) && kKinds[i] != session_.options().kind) ++i;
  setKind(kKinds[(i + 1) % std::size(kKinds)]);
}

void MainWindow::showTool() {
  const ToolInfo& info = infoOf(session_.tool().id());
  toolName_->setText(nameOf(info));
  actions_[QStringLiteral("tool-") + info.icon]->setChecked(true);
  for (std::size_t i = 0; i < std::size(kKinds); ++i) {
    kinds_[i]->setIcon(kindIcon(kKinds[i]));
    // Tools with a number take lines as they are; it has the room, so that nothing leaves the bar.
    kinds_[i]->setVisible(!session_.tool().setting());
    kinds_[i]->setChecked(kKinds[i] == session_.options().kind);
  }
  actions_["symmetry"]->setChecked(session_.options().symmetry);
  actions_["snap"]->setChecked(session_.options().snap);
  showHint();
}

void MainWindow::showHint() {
  if (!session_.hasWork()) return;
  hint_->setText(message_.isEmpty() ? withKeys(session_.tool().hint(session_))
                                    : message_.toHtmlEscaped());
}

void MainWindow::showPatternState() {
  if (!session_.hasWork()) return;
  if (session_.worker().isWorking()) {
    patternState_->setText(tr("Updating the pattern"));
  } else if (session_.patternError()) {
    patternState_->setText(tr("△ Pattern not made: see Findings"));
  } else if (!session_.pattern() || session_.pattern()->pieces.empty()) {
    patternState_->setText(tr("Waiting for a closed line"));
  } else {
    patternState_->setText(tr("✓ Pattern up to date"));
  }
}

void MainWindow::showContextMenu(const QPoint& place) {
  QMenu menu(this);
  const Selection under = session_.hover();
  if (under.kind != Selection::Kind::None) session_.select(under);
  if (session_.selection().kind != Selection::Kind::None) {
    menu.addAction(actions_["name"]);
    menu.addAction(actions_["delete"]);
    menu.addAction(actions_["fit"]);
    menu.addAction(actions_["straight"]);
    if (session_.selection().kind == Selection::Kind::Piece) {
      menu.addSeparator();
      for (const char* id : {"include", "fabrics", "darts", "developable", "back-in-place"}) {
        menu.addAction(actions_[QString::fromLatin1(id)]);
      }
    } else {
      menu.addAction(actions_["merge"]);
    }
    menu.addSeparator();
  }
  menu.addAction(actions_["undo"]);
  menu.addAction(actions_["redo"]);
  menu.addSeparator();
  for (const ToolInfo& info : allTools())
    menu.addAction(actions_[QStringLiteral("tool-") + info.icon]);
  menu.exec(place);
}

}  // namespace toile::studio
