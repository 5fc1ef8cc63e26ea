// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/palette.h"

#include <QApplication>
#include <QFont>
#include <QPalette>
#include <QStyleFactory>
#include <algorithm>
#include <array>
#include <cmath>

namespace toile::studio {

namespace {

Palette lightPalette() {
  Palette p;
  p.theme = Theme::Light;
  p.window = "#F3F2F0", p.panel = "#FBFAF8", p.field = "#FFFFFF";
  p.hover = "#E9E7E3", p.divider = "#DAD7D1", p.edge = "#8B877F";
  p.text = "#1F2124", p.second = "#55585E", p.disabled = "#8E9095";
  p.accent = "#1558D6", p.accentText = "#1558D6", p.accentSoft = "#E3ECFB";
  p.good = "#1F7A3D", p.attention = "#8A5A00", p.trouble = "#A8320B";
  p.groundCentre = "#ECEAE6", p.groundEdge = "#D3CFC8";
  p.sheet = "#EFEDE9", p.grid = "#E3E0DA", p.gridStrong = "#D0CCC4", p.piece = "#FFFFFF";
  p.readOut = "#26282B", p.readOutText = "#FFFFFF", p.readOutSecond = "#C9CCD1";
  p.clay = "#CCC6BE", p.cutLine = "#6B7078", p.selection = "#1558D6", p.middle = "#5A2CB0";
  return p;
}

Palette darkPalette() {
  Palette p;
  p.theme = Theme::Dark;
  p.window = "#26282B", p.panel = "#2C2E32", p.field = "#1E2023";
  p.hover = "#3A3D42", p.divider = "#3D4045", p.edge = "#8C929A";
  p.text = "#ECEDEE", p.second = "#B4B8BE", p.disabled = "#85898F";
  p.accent = "#2F6BE0", p.accentText = "#8DB4FF", p.accentSoft = "#26375A";
  p.good = "#66D08A", p.attention = "#F2C14E", p.trouble = "#FF9C7A";
  p.groundCentre = "#45484D", p.groundEdge = "#26282B";
  p.sheet = "#1F2123", p.grid = "#282A2D", p.gridStrong = "#34373B", p.piece = "#34373C";
  p.readOut = "#26282B", p.readOutText = "#FFFFFF", p.readOutSecond = "#C9CCD1";
  p.clay = "#B8B2AB", p.cutLine = "#8F959E", p.selection = "#6EA2FF", p.middle = "#B7A3F5";
  return p;
}

Palette& current() {
  static Palette palette = lightPalette();
  return palette;
}

QString styleSheet(const Palette& p) {
  QString sheet = QStringLiteral(R"(
QMainWindow, QMenuBar, QToolBar, QStatusBar, QDialog { background: @window; color: @text; }
QWidget { color: @text; }
QMenuBar { border: 0; padding: 2px 8px; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @hover; }
QMenu { background: @panel; border: 1px solid @divider; padding: 4px; }
QMenu::item { padding: 5px 24px 5px 12px; border-radius: 4px; }
QMenu::item:selected { background: @accentSoft; color: @text; }
QMenu::item:disabled { color: @disabled; }
QMenu::separator { height: 1px; background: @divider; margin: 4px 8px; }
QToolBar { border: 0; spacing: 4px; padding: 4px 8px; }
QToolBar#rail { border-right: 1px solid @divider; padding: 8px 5px; spacing: 4px; }
QToolBar#top { border-bottom: 1px solid @divider; }
QToolBar::separator { background: @divider; width: 1px; height: 1px; margin: 6px; }
QToolButton { border: 1px solid transparent; border-radius: 6px; padding: 4px; background: transparent; }
QToolButton:hover { background: @hover; }
QToolButton:checked { background: @accentSoft; color: @accentText; }
QToolButton:disabled { color: @disabled; }
QToolButton:focus { border: 2px solid @accent; }
QToolBar#rail QToolButton { min-width: 26px; min-height: 26px; }
QToolBar#rail QToolButton:checked { background: @accent; color: white; }
QToolButton#kind { border: 1px solid @edge; border-radius: 0; padding: 4px 10px; background: @field; }
QToolButton#kind:checked { border: 2px solid @accent; background: @accentSoft; color: @accentText; }
QPushButton { border: 1px solid @edge; border-radius: 6px; padding: 5px 12px; background: @field; min-height: 18px; }
QPushButton:hover { background: @hover; }
QPushButton:checked { background: @accentSoft; color: @accentText; border-color: @accent; }
QPushButton:focus { border: 2px solid @accent; padding: 4px 11px; }
QPushButton:disabled { color: @disabled; border-color: @divider; }
QPushButton#primary { background: @accent; color: white; border-color: @accent; }
QPushButton#primary:disabled { background: @hover; color: @disabled; border-color: @divider; }
QPushButton#answer { border-color: @accent; color: @accentText; }
QLineEdit, QComboBox, QSpinBox { background: @field; border: 1px solid @edge; border-radius: 6px; padding: 3px 8px; min-height: 20px; selection-background-color: @accent; }
QLineEdit:focus, QComboBox:focus { border: 2px solid @accent; padding: 2px 7px; }
QLineEdit:disabled, QComboBox:disabled { color: @disabled; border-color: @divider; }
QComboBox::drop-down { border: 0; width: 20px; }
QComboBox::down-arrow { image: url(:/templates/chevron-down.svg); width: 12px; height: 12px; }
QComboBox QAbstractItemView { background: @panel; selection-background-color: @accentSoft; selection-color: @text; }
QDockWidget, QDockWidget > QWidget, QScrollArea, QWidget#dock { background: @panel; border: 0; }
QWidget#panelFields { background: @panel; }
QWidget#dock { border-left: 1px solid @divider; }
QTabWidget::pane { border: 0; border-top: 1px solid @divider; background: @panel; }
QTabBar { background: @panel; }
QTabBar::tab { background: transparent; color: @second; padding: 8px 12px; border: 0; border-bottom: 2px solid transparent; }
QTabBar::tab:selected { color: @text; font-weight: 600; border-bottom: 2px solid @accent; }
QTabBar::tab:focus { border: 2px solid @accent; }
QListView, QTreeView, QTableView { background: @panel; border: 0; outline: 0; }
QListView::item, QTreeView::item { min-height: 30px; border: 0; padding: 0 8px; }
QListView#findings::item { padding: 0; }
QListView::item:hover, QTreeView::item:hover { background: @hover; }
QListView::item:selected, QTreeView::item:selected { background: @accentSoft; color: @text; }
QStatusBar { border-top: 1px solid @divider; min-height: 28px; }
QStatusBar::item { border: 0; }
QSplitter::handle { background: @divider; }
QLabel#second { color: @second; }
QLabel#heading { font-weight: 600; }
QLabel#chip, QFrame#chip { background: @panel; border: 1px solid @divider; border-radius: 7px; padding: 3px 8px; }
QFrame#line { background: @divider; max-height: 1px; border: 0; }
QScrollBar:vertical { background: transparent; width: 10px; }
QScrollBar::handle:vertical { background: @divider; border-radius: 4px; min-height: 24px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; width: 0; }
QToolTip { background: @readOut; color: white; border: 0; padding: 4px 6px; }
QCheckBox { spacing: 8px; }
QWidget#startPage, QWidget#startBody, QScrollArea { background: @panel; }
QWidget#startSide { background: @window; border-right: 1px solid @divider; }
QWidget#startSide QToolButton { padding: 6px 10px; text-align: left; }
QFrame#ownModel { border: 1px dashed @edge; border-radius: 9px; background: @panel; }
QFrame#firstHint { background: @accentSoft; border-radius: 9px; }
QListWidget#formats::item { border-radius: 6px; }
QScrollArea#filePreview, QScrollArea#filePreview > QWidget > QWidget { background: @window; }
QSlider::groove:horizontal { height: 4px; background: @divider; border-radius: 2px; }
QSlider::sub-page:horizontal { background: @accent; border-radius: 2px; }
QSlider::handle:horizontal { background: @field; border: 2px solid @accent; width: 12px; margin: -6px 0; border-radius: 8px; }
)");
  const std::pair<const char*, QColor> tokens[] = {{"@window", p.window},
                                                   {"@panel", p.panel},
                                                   {"@field", p.field},
                                                   {"@hover", p.hover},
                                                   {"@divider", p.divider},
                                                   {"@edge", p.edge},
                                                   {"@text", p.text},
                                                   {"@second", p.second},
                                                   {"@disabled", p.disabled},
                                                   {"@accentText", p.accentText},
                                                   {"@accentSoft", p.accentSoft},
                                                   {"@accent", p.accent},
                                                   {"@readOut", p.readOut}};
  for (const auto& [token, colour] : tokens) sheet.replace(QLatin1String(token), colour.name());
  return sheet;
}

}  // namespace

const Palette& palette() {
  return current();
}

void applyTheme(QApplication& app, Theme theme) {
  current() = theme == Theme::Dark ? darkPalette() : lightPalette();
  const Palette& p = current();
  app.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QPalette q;
  q.setColor(QPalette::Window, p.window);
  q.setColor(QPalette::WindowText, p.text);
  q.setColor(QPalette::Base, p.field);
  q.setColor(QPalette::AlternateBase, p.panel);
  q.setColor(QPalette::Text, p.text);
  q.setColor(QPalette::PlaceholderText, p.disabled);
  q.setColor(QPalette::Button, p.window);
  q.setColor(QPalette::ButtonText, p.text);
  q.setColor(QPalette::Highlight, p.accent);
  q.setColor(QPalette::HighlightedText, Qt::white);
  q.setColor(QPalette::ToolTipBase, p.readOut);
  q.setColor(QPalette::ToolTipText, Qt::white);
  q.setColor(QPalette::Link, p.accentText);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    q.setColor(QPalette::Disabled, role, p.disabled);
  }
  app.setPalette(q);
  // Inter where it is installed, else what the system has.
  static const QString kSystemFamily = app.font().family();
  QFont font = app.font();
  font.setFamilies({QStringLiteral("Inter"), kSystemFamily});
  font.setPixelSize(13);
  app.setFont(font);
  app.setStyleSheet(styleSheet(p));
}

LineLook lookOf(CurveKind kind) {
  const bool dark = palette().theme == Theme::Dark;
  const auto look = [dark](const char* light, const char* darkPiece, double width,
                           QVector<float> dashes = {}, bool dots = false) {
    return LineLook{QColor(light), QColor(dark ? darkPiece : light), width, std::move(dashes),
                    dots};
  };
  switch (kind) {
    case CurveKind::Seam:
      return look("#16202E", "#F2F3F5", 2.4);
    case CurveKind::Opening:
      return look("#16202E", "#F2F3F5", 2.4, {14, 3, 3, 3});
    case CurveKind::Feature:
      return look("#0A6650", "#5FD9B4", 2.2, {10, 4});
    case CurveKind::Elastic:
      return look("#B01C80", "#EE78BA", 3.0, {0, 5.5F}, true);
    case CurveKind::Dart:
      return look("#A34700", "#FFB061", 2.0);
    case CurveKind::Mark:
      return look("#55585E", "#B4B8BE", 1.4, {4, 3});
    case CurveKind::Guide:
      return look("#55585E", "#B4B8BE", 1.0, {1.5F, 3});
  }
  return {};
}

QColor fabricTint(std::size_t index) {
  static constexpr std::array<const char*, 6> kTints = {"#BCC6CC", "#D8C8B0", "#C6D2BE",
                                                        "#D9C3C9", "#C9C4DC", "#D3D0C8"};
  return QColor(kTints[index % kTints.size()]);
}

QColor strainColour(double t) {
  static const std::array<QColor, 7> kStops = {
      QColor("#1B3B8C"), QColor("#5B86CF"), QColor("#B4C9E6"), QColor("#EFEBE4"),
      QColor("#F3C48E"), QColor("#DE7E2E"), QColor("#8F2E06")};
  const double place = (std::clamp(t, -1.0, 1.0) + 1) * 3;
  const auto stop = std::min<std::size_t>(5, static_cast<std::size_t>(place));
  const double part = place - static_cast<double>(stop);
  const auto mix = [&](int a, int b) { return static_cast<int>(std::lround(a + part * (b - a))); };
  const QColor &a = kStops[stop], &b = kStops[stop + 1];
  return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

}  // namespace toile::studio
