// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/dart_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <algorithm>

#include "app/palette.h"
#include "document/strain_spots.h"
#include "panels/rows.h"
#include "toile/pipeline/advice.h"

namespace toile::studio {

namespace {

constexpr std::size_t kMostShown = 4;

QString letterOf(std::size_t proposal) {
  return QString(QChar(u'A' + static_cast<int>(proposal)));
}

}  // namespace

DartPanel::DartPanel(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName(QStringLiteral("dartPanel"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(6);
  column->addWidget(headingRow(tr("Dart adviser"), {}));
  why_ = new QLabel;
  why_->setWordWrap(true);
  column->addWidget(why_);
  cards_ = new QVBoxLayout;
  cards_->setSpacing(6);
  column->addLayout(cards_);
  state_ = secondLabel({});
  column->addWidget(state_);
  auto* buttons = new QHBoxLayout;
  place_ = new QPushButton;
  place_->setObjectName(QStringLiteral("answer"));
  auto* notNow = new QPushButton(tr("Not now"));
  notNow->setObjectName(QStringLiteral("notNow"));
  buttons->addWidget(place_, 1);
  buttons->addWidget(notNow);
  column->addLayout(buttons);
  connect(place_, &QPushButton::clicked, this, &DartPanel::place);
  connect(notNow, &QPushButton::clicked, this, &DartPanel::ended);
  connect(&session, &Session::patternChanged, this, [this] {
    // Of another pattern the proposals would be wrong.
    if (!piece_.empty() && session_.isPatternCurrent() && session_.fullPattern() != pattern_)
      look();
  });
}

void DartPanel::open(const std::string& piece) {
  piece_ = piece;
  look();
}

void DartPanel::leave() {
  work_.stop();
  piece_.clear();
  pattern_.reset();
  proposals_.clear();
  session_.setGhosts({});
}

QString DartPanel::reason(std::size_t index) const {
  const Piece& piece = pattern_->cut.pieces[index];
  const QString name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
  if (!pattern_->flats[index]) return tr("<b>%1</b> lies on itself in the pattern.").arg(name);
  const Design& design = *pattern_->document.design;
  const Fabric* fabric = fabricOf(design, recordOf(design, piece.id));
  const auto& strains = session_.strains();
  if (strains && (*strains)[index] && !(*strains)[index]->worst.empty()) {
    const StrainSpot& spot = (*strains)[index]->worst.front();
    const QString place = QString::fromStdString(spot.place);
    QString text = (spot.value < 0 ? tr("<b>%1</b> has %2 too much cloth, %3.")
                                   : tr("<b>%1</b> must stretch %2, %3."))
                       .arg(name, percentText(std::abs(spot.value)).remove('+'), place);
    if (fabric != nullptr && spot.limit) {
      const QString fabricName =
          QString::fromStdString(fabric->name.empty() ? fabric->id : fabric->name);
      text +=
          ' ' + tr("<b>%1</b> allows %2.").arg(fabricName, percentText(*spot.limit).remove('+'));
    }
    return text;
  }
  return tr("<b>%1</b> changes its area by %2 in the mean.")
      .arg(name, percentText(pattern_->flats[index]->meanAreaError, 1).remove('+'));
}

void DartPanel::look() {
  proposals_.clear();
  chosen_ = 0;
  session_.setGhosts({});
  const auto index = session_.pieceIndex(piece_);
  if (!index) {
    showProposals();
    return;
  }
  pattern_ = session_.fullPattern();
  why_->setText(reason(*index));
  work_.begin(
      [this, pattern = pattern_, index = *index](Progress& progress) -> Background::Outcome {
        auto found = adviseDarts(*pattern, index, &progress);
        return [this, found = std::move(found)]() mutable {
          if (found) {
            proposals_ = std::move(*found);
            if (proposals_.size() > kMostShown) proposals_.resize(kMostShown);
          }
          showProposals();
          if (!found) state_->setText(QString::fromStdString(found.error().message));
        };
      });
  showProposals();
}

void DartPanel::showProposals() {
  if (content_ != nullptr) {
    content_->hide();
    content_->setParent(nullptr);
    content_->deleteLater();
  }
  content_ = new QWidget;
  auto* column = new QVBoxLayout(content_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  for (std::size_t i = 0; i < proposals_.size(); ++i) {
    const DartProposal& proposal = proposals_[i];
    const auto count = static_cast<int>(proposal.dartCount());
    const bool isDart = proposal.kind == DartProposal::Kind::Dart;
    const QString what = !isDart      ? tr("Seam across")
                         : count == 1 ? tr("Dart")
                                      : tr("%1 darts").arg(count);
    auto* choice = new QRadioButton(QStringLiteral("%1  %2").arg(letterOf(i), what));
    choice->setObjectName(QStringLiteral("proposal%1").arg(i));
    choice->setChecked(i == chosen_);
    column->addWidget(choice);
    QString size = session_.lengthText(proposal.length / count);
    if (isDart) size = tr("%1 wide, %2 long").arg(session_.lengthText(proposal.intake), size);
    auto* text = secondLabel(tr("%1 · + %2 sewing<br>strain %3 → <b>%4</b>")
                                 .arg(size, session_.lengthText(proposal.length),
                                      percentText(proposal.errorBefore, 1).remove('+'),
                                      percentText(proposal.errorAfter, 1).remove('+')));
    text->setContentsMargins(24, 0, 0, 0);
    column->addWidget(text);
    connect(choice, &QRadioButton::clicked, this, [this, i] { choose(i); });
  }
  cards_->addWidget(content_);
  place_->setVisible(!proposals_.empty());
  state_->setVisible(proposals_.empty());
  if (work_.isWorking()) {
    state_->setText(tr("Looking for darts…"));
  } else if (proposals_.empty()) {
    state_->setText(tr("No dart or seam would help by a tenth."));
  } else {
    choose(chosen_);
  }
}

void DartPanel::choose(std::size_t proposal) {
  const auto index = session_.pieceIndex(piece_);
  if (!index || proposal >= proposals_.size()) return;
  chosen_ = proposal;
  place_->setText(tr("Place %1").arg(letterOf(proposal)));
  std::vector<Ghost> ghosts;
  for (ProposedLine& line : proposedLines(*pattern_, *index, proposals_[proposal])) {
    ghosts.push_back(
        {std::move(line.onBody), std::move(line.normals), piece_, std::move(line.inPlane),
         proposals_[proposal].kind == DartProposal::Kind::Dart ? CurveKind::Dart : CurveKind::Seam,
         letterOf(proposal)});
  }
  session_.setGhosts(std::move(ghosts));
}

void DartPanel::place() {
  const auto index = session_.pieceIndex(piece_);
  if (!index || session_.fullPattern() != pattern_ || chosen_ >= proposals_.size()) {
    return session_.tell(tr("The pattern is being updated; place it in a moment."));
  }
  const Result<Edited> made = withProposal(*pattern_, *index, proposals_[chosen_]);
  if (!made) return session_.tell(QString::fromStdString(made.error().message));
  const Piece& piece = pattern_->cut.pieces[*index];
  const QString name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
  const bool isDart = proposals_[chosen_].kind == DartProposal::Kind::Dart;
  Q_EMIT ended();
  session_.commit((isDart ? tr("Darts in %1") : tr("Seam across %1")).arg(name), made->document);
}

}  // namespace toile::studio
