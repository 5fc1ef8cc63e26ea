// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/lists.h"

#include <QSignalBlocker>
#include <algorithm>

#include "app/icons.h"
#include "app/palette.h"
#include "document/piece_colours.h"
#include "document/strain_spots.h"

namespace toile::studio {

namespace {

constexpr int kId = Qt::UserRole;
constexpr int kIsLine = Qt::UserRole + 1;
constexpr int kSpot = Qt::UserRole + 2;  // number of a place of strain
constexpr int kCure = Qt::UserRole + 3;  // number of what helps

QString nameOf(const Piece& piece) {
  return QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
}

}  // namespace

PiecesList::PiecesList(Session& session, QWidget* parent) : QListWidget(parent), session_(session) {
  setAccessibleName(tr("Pieces"));
  setObjectName(QStringLiteral("pieces"));
  connect(&session, &Session::patternChanged, this, &PiecesList::refill);
  connect(&session, &Session::coloursChanged, this, &PiecesList::refill);
  connect(&session, &Session::selectionChanged, this, &PiecesList::showSelection);
  connect(this, &QListWidget::itemSelectionChanged, this, [this] {
    const auto selected = selectedItems();
    if (selected.isEmpty()) return;
    session_.select(Selection::piece(selected.front()->data(kId).toString().toStdString()));
  });
}

void PiecesList::refill() {
  const auto pattern = session_.pattern();
  if (session_.isPatternPreview()) return;  // the pieces are the same, and the row stays in place
  const QSignalBlocker blocker(this);
  clear();
  pieces_ = 0;
  if (pattern) {
    for (std::size_t i = 0; i < pattern->cut.pieces.size(); ++i) {
      const Piece& piece = pattern->cut.pieces[i];
      const PieceRecord* record = recordOf(*pattern->document.design, piece.id);
      const bool isMade = pattern->flats[i] != nullptr;
      QString text = nameOf(piece);
      if (!piece.include) {
        text += tr("  · left out");
      } else if (!isMade) {
        text += tr("  · cannot lie flat");
      } else if (record == nullptr) {
        text += tr("  · no name yet");
      } else if (record->count > 1) {
        text += QStringLiteral("  × %1").arg(record->count);
      }
      QPixmap swatch(14, 14);
      swatch.fill(isMade ? pieceTint(*pattern, i, session_.pieceColours())
                         : studio::palette().divider);
      QIcon cloth(swatch);
      cloth.addPixmap(swatch, QIcon::Selected);  // the colour of a cloth stays what it is
      auto* item = new QListWidgetItem(
          isMade || !piece.include ? cloth
                                   : icon(QStringLiteral("warn"), studio::palette().attention),
          text, this);
      item->setData(kId, QString::fromStdString(piece.id));
      if (!piece.include) item->setForeground(studio::palette().disabled);
      if (piece.include) ++pieces_;
    }
  }
  showSelection();
  Q_EMIT countChanged(pieces_);
}

void PiecesList::showSelection() {
  const QSignalBlocker blocker(this);
  clearSelection();
  for (int row = 0; row < count(); ++row) {
    const std::string id = item(row)->data(kId).toString().toStdString();
    if (session_.selection().isPiece(id)) setCurrentRow(row);
  }
}

FindingsList::FindingsList(Session& session, QWidget* parent)
    : QListWidget(parent), session_(session) {
  setAccessibleName(tr("Findings"));
  setWordWrap(true);
  connect(&session, &Session::patternChanged, this, &FindingsList::refill);
  setObjectName(QStringLiteral("findings"));
  connect(this, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) { run(*item); });
  connect(this, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    if (hasFocus()) run(*item);  // by Enter
  });
  connect(&session, &Session::strainChanged, this, &FindingsList::refill);
}

void FindingsList::run(const QListWidgetItem& item) {
  if (const QVariant cure = item.data(kCure); cure.isValid()) {
    // The list is filled anew while it is done.
    const Cure chosen = cures_[static_cast<std::size_t>(cure.toInt())];
    return apply(session_, chosen);
  }
  const std::string id = item.data(kId).toString().toStdString();
  if (id.empty()) return;
  const int number = item.data(kSpot).toInt();
  session_.select(item.data(kIsLine).toBool() ? Selection::line(id) : Selection::piece(id));
  const auto& pattern = session_.fullPattern();
  if (number == 0 || !pattern || !session_.strains()) return;
  for (const PlacedSpot& spot :
       worstSpots(*pattern, *session_.strains(), session_.strainLook().kind)) {
    if (spot.number == number) session_.showPlace(spot.place, spot.normal);
  }
}

void FindingsList::addCures(const std::vector<Cure>& cures) {
  for (const Cure& cure : cures) {
    // Of a tube two findings tell, the cut's and the piece's; it is offered once.
    const bool isThere = std::ranges::any_of(cures_, [&](const Cure& other) {
      return other.kind == cure.kind && other.about == cure.about;
    });
    if (isThere) continue;
    auto* item = new QListWidgetItem(
        icon(QStringLiteral("chevron-right"), studio::palette().accentText), cure.label, this);
    QFont font = item->font();
    font.setWeight(QFont::DemiBold);
    item->setFont(font);
    item->setForeground(studio::palette().accentText);
    item->setToolTip(tr("Does it: one step, Ctrl+Z takes it back"));
    item->setData(kCure, static_cast<int>(cures_.size()));
    cures_.push_back(cure);
  }
}

void FindingsList::add(const QString& iconName, const QColor& colour, const QString& text,
                       const std::vector<Element>& where) {
  auto* item = new QListWidgetItem(icon(iconName, colour), text, this);
  for (const Element& element : where) {
    if (element.kind != Element::Kind::Curve && element.kind != Element::Kind::Piece) continue;
    item->setData(kId, QString::fromStdString(element.name));
    item->setData(kIsLine, element.kind == Element::Kind::Curve);
    break;
  }
}

/// The worst places of strain, numbered as in both panes.
void FindingsList::addSpots() {
  const auto& pattern = session_.fullPattern();
  if (!pattern || !session_.strains()) return;
  for (const PlacedSpot& spot :
       worstSpots(*pattern, *session_.strains(), session_.strainLook().kind)) {
    const Piece& piece = pattern->cut.pieces[spot.piece];
    const QString what = QString::fromStdString(describe(spot.spot));
    const QString where = QString::fromStdString(spot.spot.place);
    const Palette& colours = studio::palette();
    auto* item = new QListWidgetItem(
        spot.isOverLimit ? icon(QStringLiteral("warn"), colours.trouble)
                         : icon(QStringLiteral("strain"), colours.second),
        QStringLiteral("%1  %2: %3, %4").arg(spot.number).arg(nameOf(piece), what, where), this);
    item->setData(kId, QString::fromStdString(piece.id));
    item->setData(kIsLine, false);
    item->setData(kSpot, spot.number);
    if (spot.isOverLimit) addCures(curesOf(*pattern, "over-limit", {Element::piece(piece.id)}));
  }
}

void FindingsList::refill() {
  if (session_.isPatternPreview()) return;
  clear();
  cures_.clear();
  const Palette& colours = studio::palette();
  const auto& error = session_.patternError();
  if (error) {
    add(QStringLiteral("warn"), colours.trouble, QString::fromStdString(error->message),
        error->where);
  }
  int mates = 0, found = error ? 1 : 0;
  if (const auto pattern = session_.pattern()) {
    mates = static_cast<int>(pattern->cut.mates.size());
    for (std::size_t i = 0; i < pattern->failures.size(); ++i) {
      const auto& failure = pattern->failures[i];
      if (!failure) continue;
      add(QStringLiteral("warn"), colours.trouble, QString::fromStdString(failure->message),
          failure->where);
      addCures(curesOf(*pattern, i, *failure));
      ++found;
    }
    for (const Finding& finding : pattern->findings) {
      add(QStringLiteral("info"), colours.attention, QString::fromStdString(finding.message),
          finding.where);
      addCures(curesOf(*pattern, finding.code, finding.where));
      ++found;
    }
  }
  if (session_.strainLook().on) addSpots();
  if (found == 0 && mates > 0) {
    add(QStringLiteral("ok"), colours.good,
        tr("No findings. All %n seams match their mates.", nullptr, mates), {});
  }
  Q_EMIT countChanged(found);
}

HistoryList::HistoryList(Session& session, QWidget* parent)
    : QListWidget(parent), session_(session) {
  setAccessibleName(tr("History"));
  setObjectName(QStringLiteral("history"));
  connect(&session, &Session::historyChanged, this, &HistoryList::refill);
  connect(this, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
    session_.jumpTo(static_cast<std::size_t>(item->data(kId).toULongLong()));
  });
}

void HistoryList::refill() {
  clear();
  const History& history = session_.history();
  for (std::size_t i = history.steps().size(); i-- > 0;) {
    const Step& step = history.steps()[i];
    auto* item = new QListWidgetItem(icon(step.icon), step.name, this);
    item->setData(kId, static_cast<qulonglong>(i));
    item->setToolTip(step.time.toString(QStringLiteral("HH:mm:ss")));
    if (i > history.at()) item->setForeground(studio::palette().disabled);
    if (i == history.at()) setCurrentItem(item);
  }
}

}  // namespace toile::studio
