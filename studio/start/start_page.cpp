// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/start_page.h"

#include <QFileInfo>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/actions.h"
#include "app/icons.h"
#include "app/palette.h"
#include "start/card.h"
#include "start/flow_layout.h"
#include "start/recent_designs.h"

namespace toile::studio {

namespace {

struct Template {
  const char* file;
  const char* name;
  const char* line;
};
constexpr Template kTemplates[] = {
    {"wetsuit-full", QT_TRANSLATE_NOOP("StartPage", "Wetsuit, full length"),
     QT_TRANSLATE_NOOP("StartPage", "20 pieces, long sleeves")},
    {"wetsuit-short", QT_TRANSLATE_NOOP("StartPage", "Wetsuit, short"),
     QT_TRANSLATE_NOOP("StartPage", "Short sleeves and legs")},
    {"torso-vest", QT_TRANSLATE_NOOP("StartPage", "Vest with princess seams"),
     QT_TRANSLATE_NOOP("StartPage", "On a dress form")},
    {"bent-sleeve", QT_TRANSLATE_NOOP("StartPage", "Two-piece sleeve"),
     QT_TRANSLATE_NOOP("StartPage", "On a bent arm")}};

constexpr QSize kTemplateCard(208, 250);
constexpr QSize kRecentCard(168, 164);

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  QFont font = label->font();
  font.setPixelSize(17);
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  return label;
}

/// "today 14:03", "yesterday", "12 Nov".
QString whenOf(const QDateTime& time) {
  const qint64 days = time.date().daysTo(QDate::currentDate());
  if (days == 0) {
    return StartPage::tr("today %1").arg(QLocale().toString(time.time(), QLocale::ShortFormat));
  }
  if (days == 1) return StartPage::tr("yesterday");
  return QLocale().toString(time.date(), QStringLiteral("d MMM yyyy"));
}

}  // namespace

StartPage::StartPage(Actions& actions) {
  setObjectName(QStringLiteral("startPage"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(makeSide(actions));

  auto* page = new QWidget;
  page->setObjectName(QStringLiteral("startBody"));
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(56, 24, 56, 24);
  column->setSpacing(12);
  column->addWidget(heading(tr("Start with")));
  column->addWidget(makeTemplates());
  auto* recentRow = new QHBoxLayout;
  recentRow->addWidget(heading(tr("Recent")));
  recentRow->addStretch();
  search_ = new QLineEdit;
  search_->setPlaceholderText(tr("Search recent designs"));
  search_->setAccessibleName(tr("Search recent designs"));
  search_->setClearButtonEnabled(true);
  search_->setFixedWidth(220);
  connect(search_, &QLineEdit::textChanged, this, &StartPage::refresh);
  recentRow->addWidget(search_);
  column->addSpacing(8);
  column->addLayout(recentRow);
  recentPlace_ = new QVBoxLayout;
  column->addLayout(recentPlace_);
  if (!QSettings().value(QStringLiteral("hintSeen")).toBool()) column->addWidget(makeHint());
  column->addStretch();
  auto* scroll = new QScrollArea;
  scroll->setAccessibleName(tr("Templates and recent designs"));
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(page);
  row->addWidget(scroll, 1);
  refresh();
}

QWidget* StartPage::makeSide(Actions& actions) {
  auto* side = new QWidget;
  side->setObjectName(QStringLiteral("startSide"));
  side->setFixedWidth(240);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(14, 24, 14, 24);
  column->setSpacing(4);
  auto* name = new QLabel(QStringLiteral("Toile"));
  QFont font = name->font();
  font.setPixelSize(24);
  font.setWeight(QFont::DemiBold);
  name->setFont(font);
  name->setContentsMargins(10, 0, 0, 0);
  column->addWidget(name);
  auto* motto = new QLabel(tr("Draw on the body.\nCut from the cloth."));
  motto->setObjectName(QStringLiteral("second"));
  motto->setContentsMargins(10, 4, 0, 16);
  column->addWidget(motto);
  for (const char* id : {"new", "open", "tour", "keys"}) {
    auto* button = new QToolButton;
    button->setDefaultAction(actions[id]);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setIconSize({20, 20});
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setMinimumHeight(34);
    button->setFocusPolicy(Qt::StrongFocus);
    column->addWidget(button);
  }
  column->addStretch();
  auto* stays = new QLabel(tr("Everything stays on this computer."));
  stays->setObjectName(QStringLiteral("second"));
  stays->setWordWrap(true);
  stays->setContentsMargins(10, 0, 0, 0);
  column->addWidget(stays);
  return side;
}

QWidget* StartPage::makeTemplates() {
  auto* cards = new QWidget;
  auto* flow = new FlowLayout(cards, 16);
  auto* empty = new Card(tr("Empty body"), tr("No lines yet"),
                         QPixmap(QStringLiteral(":/templates/body.png")), kTemplateCard);
  empty->setObjectName(QStringLiteral("emptyBody"));
  connect(empty, &Card::clicked, this, &StartPage::emptyChosen);
  flow->addWidget(empty);
  for (const Template& one : kTemplates) {
    const QString file = QStringLiteral(":/templates/") + QString::fromLatin1(one.file);
    const QString name = tr(one.name);
    auto* card =
        new Card(name, tr(one.line), QPixmap(file + QStringLiteral(".png")), kTemplateCard);
    card->setObjectName(QString::fromLatin1(one.file));
    connect(card, &Card::clicked, this,
            [this, file, name] { Q_EMIT templateChosen(file + QStringLiteral(".toile"), name); });
    flow->addWidget(card);
  }
  auto* own = new QFrame;
  own->setObjectName(QStringLiteral("ownModel"));
  own->setFixedSize(kTemplateCard);
  auto* column = new QVBoxLayout(own);
  column->addStretch();
  auto* picture = new QLabel;
  picture->setPixmap(icon(QStringLiteral("folder"), studio::palette().accentText).pixmap(28, 28));
  picture->setAlignment(Qt::AlignCenter);
  column->addWidget(picture);
  auto* title = new QLabel(tr("Your own model"));
  title->setObjectName(QStringLiteral("heading"));
  title->setAlignment(Qt::AlignCenter);
  column->addWidget(title);
  auto* words = new QLabel(
      tr("Drop a scan, a last, a chair or a design here.\nOBJ, PLY, STL, OFF or .toile"));
  words->setObjectName(QStringLiteral("second"));
  words->setAlignment(Qt::AlignCenter);
  words->setWordWrap(true);
  column->addWidget(words);
  auto* choose = new QPushButton(tr("Choose a file…"));
  connect(choose, &QPushButton::clicked, this, &StartPage::fileWanted);
  column->addWidget(choose, 0, Qt::AlignHCenter);
  column->addStretch();
  flow->addWidget(own);
  return cards;
}

QWidget* StartPage::makeHint() {
  auto* hint = new QFrame;
  hint->setObjectName(QStringLiteral("firstHint"));
  auto* row = new QHBoxLayout(hint);
  row->setContentsMargins(14, 10, 10, 10);
  auto* words = new QLabel(
      tr("<b>First time here?</b> Draw one line, watch the pattern follow. Three steps on the "
         "built-in body, two minutes."));
  words->setWordWrap(true);
  row->addWidget(words, 1);
  auto* show = new QPushButton(tr("Show me"));
  row->addWidget(show);
  auto* close = new QToolButton;
  close->setIcon(icon(QStringLiteral("close")));
  close->setToolTip(tr("Do not show this again"));
  close->setAccessibleName(close->toolTip());
  row->addWidget(close);
  const auto dismiss = [hint] {
    QSettings().setValue(QStringLiteral("hintSeen"), true);
    hint->hide();
  };
  connect(close, &QToolButton::clicked, hint, dismiss);
  connect(show, &QPushButton::clicked, this, [this, dismiss] {
    dismiss();
    Q_EMIT tourWanted();
  });
  return hint;
}

void StartPage::refresh() {
  delete recentCards_;
  recentCards_ = new QWidget;
  auto* flow = new FlowLayout(recentCards_, 14);
  int shown = 0;
  for (const QString& file : RecentDesigns::all()) {
    const QFileInfo info(file);
    if (!info.completeBaseName().contains(search_->text(), Qt::CaseInsensitive)) continue;
    auto* card = new Card(info.completeBaseName(), whenOf(info.lastModified()),
                          QPixmap::fromImage(RecentDesigns::pictureOf(file)), kRecentCard);
    card->setToolTip(file);
    connect(card, &Card::clicked, this, [this, file] { Q_EMIT designChosen(file); });
    flow->addWidget(card);
    ++shown;
  }
  if (shown == 0) {
    auto* none = new QLabel(search_->text().isEmpty() ? tr("Your designs will appear here.")
                                                      : tr("No design of that name."));
    none->setObjectName(QStringLiteral("second"));
    flow->addWidget(none);
  }
  recentPlace_->addWidget(recentCards_);
}

}  // namespace toile::studio
