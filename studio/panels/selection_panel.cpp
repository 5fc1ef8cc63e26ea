// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/selection_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/icons.h"
#include "app/palette.h"
#include "document/piece_edits.h"
#include "toile/edit/lines.h"
#include "toile/edit/symmetry.h"
#include "tools/drawing.h"

namespace toile::studio {

namespace {

QLabel* secondLabel(const QString& text) {
  auto* label = new QLabel(text);
  label->setObjectName(QStringLiteral("second"));
  label->setWordWrap(true);
  return label;
}

QWidget* headingRow(const QString& text, const QString& right) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 4);
  auto* heading = new QLabel(text);
  heading->setObjectName(QStringLiteral("heading"));
  layout->addWidget(heading, 1);
  layout->addWidget(secondLabel(right));
  return row;
}

/// A row "word ........ number".
QLabel* numberRow(QVBoxLayout& column, const QString& word, const QString& value, bool strong) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 1, 0, 1);
  layout->addWidget(secondLabel(word), 1);
  auto* number = new QLabel(value);
  number->setAlignment(Qt::AlignRight);
  if (strong) number->setObjectName(QStringLiteral("heading"));
  layout->addWidget(number);
  column.addWidget(row);
  return number;
}

QFormLayout* addForm(QVBoxLayout& column) {
  auto* form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 4);
  form->setHorizontalSpacing(12);
  form->setVerticalSpacing(8);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  column.addLayout(form);
  return form;
}

/// A side of a line in the pattern, with its piece; parts of one piece's side are added up.
struct SeamSideRow {
  QString piece;
  double length = 0;
};
/// The sides of a curve in the pattern: of a seam its two pieces, of a dart or the seam of a tube
/// both edges of the one piece, which are sewn to each other.
std::vector<SeamSideRow> sidesOf(const Pattern& pattern, const std::string& curve) {
  std::vector<SeamSideRow> sides;
  for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
    const PatternPiece& piece = pattern.pieces[i];
    const QString name = QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
    const auto isSecondSide = [&](const OutlineRun& run) {
      return std::ranges::any_of(pattern.cut.mates, [&](const SeamMates& mates) {
        return mates.pieceA == mates.pieceB && mates.pieceA == pattern.pieceIndex[i] &&
               mates.wireB == run.wire;
      });
    };
    SeamSideRow first{name, 0}, second{name, 0};
    for (const OutlineRun& run : piece.runs) {
      if (run.curve == curve) (isSecondSide(run) ? second : first).length += run.length;
    }
    for (const SeamSideRow& side : {first, second}) {
      if (side.length > 0) sides.push_back(side);
    }
  }
  return sides;
}

}  // namespace

SelectionPanel::SelectionPanel(Session& session, QWidget* parent)
    : QWidget(parent), session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  connect(&session, &Session::selectionChanged, this, &SelectionPanel::rebuild);
  connect(&session, &Session::historyChanged, this, &SelectionPanel::rebuild);
  connect(&session, &Session::patternChanged, this, &SelectionPanel::rebuild);
  connect(&session, &Session::linesChanged, this, &SelectionPanel::refreshNumbers);
  rebuild();
}

void SelectionPanel::editName() {
  if (name_ == nullptr) return;
  name_->setFocus(Qt::ShortcutFocusReason);
  name_->selectAll();
}

void SelectionPanel::rebuild() {
  // Not below the hands of someone who types.
  if (name_ != nullptr && name_->hasFocus() && name_->isModified()) return;
  const bool hadFocus = name_ != nullptr && name_->hasFocus();
  name_ = nullptr;
  length_ = nullptr;
  if (content_ != nullptr) {
    content_->hide();
    content_->setParent(nullptr);
    content_->deleteLater();
  }
  content_ = new QWidget(this);
  layout()->addWidget(content_);
  auto* column = new QVBoxLayout(content_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  if (!session_.hasWork()) return;
  const Selection& selection = session_.selection();
  const PlacedLine* line =
      selection.kind == Selection::Kind::Line ? session_.lines().find(selection.id) : nullptr;
  if (line != nullptr) {
    showLine(*column, *line);
  } else if (selection.kind == Selection::Kind::Piece) {
    showPiece(*column, selection.id);
  } else {
    showNothing(*column);
  }
  if (hadFocus) editName();
}

void SelectionPanel::showNothing(QVBoxLayout& column) {
  const Design& design = *session_.document().design;
  column.addWidget(headingRow(session_.title(), {}));
  if (design.curves.empty()) {
    column.addWidget(
        secondLabel(tr("Nothing drawn yet. Take the pencil (P) and draw a line on the body.")));
    return;
  }
  column.addWidget(secondLabel(tr("Click a line or a piece to see its lengths here.")));
}

void SelectionPanel::refreshNumbers() {
  if (length_ == nullptr) return;
  if (const PlacedLine* line = session_.lines().find(session_.selection().id)) {
    length_->setText(session_.lengthText(line->length()));
  }
}

void SelectionPanel::showLine(QVBoxLayout& column, const PlacedLine& line) {
  const std::string id = line.curve.id;
  const QString title = QString::fromStdString(line.title());
  auto* top = headingRow(title, kindWord(line.curve.kind));
  auto* lock = new QToolButton;
  const bool isLocked = line.curve.unknown.contains("locked");
  lock->setIcon(icon(isLocked ? QStringLiteral("lock") : QStringLiteral("unlock")));
  lock->setCheckable(true);
  lock->setChecked(isLocked);
  lock->setToolTip(isLocked ? tr("Locked: the line cannot be moved") : tr("Lock the line"));
  lock->setAccessibleName(tr("Lock"));
  top->layout()->addWidget(lock);
  column.addWidget(top);
  connect(lock, &QToolButton::clicked, this, [this, id, title](bool locked) {
    const auto made = withCurve(session_.document(), id, [&](StylingCurve& curve) {
      if (locked) {
        curve.unknown["locked"] = "true";
      } else {
        curve.unknown.erase("locked");
      }
    });
    if (made) session_.commit((locked ? tr("Lock %1") : tr("Unlock %1")).arg(title), *made);
  });

  QFormLayout* form = addForm(column);
  name_ = new QLineEdit(QString::fromStdString(line.curve.name));
  name_->setAccessibleName(tr("Name"));
  form->addRow(secondLabel(tr("Name")), name_);
  connect(name_, &QLineEdit::editingFinished, this, [this, id, field = name_] {
    if (!field->isModified()) return;
    field->setModified(false);
    const std::string name = field->text().trimmed().toStdString();
    const auto made =
        withCurve(session_.document(), id, [&](StylingCurve& curve) { curve.name = name; });
    if (made) session_.commit(tr("Name %1").arg(field->text().trimmed()), *made);
  });

  auto* kind = new QComboBox;
  kind->setAccessibleName(tr("Kind"));
  const std::array kinds = {CurveKind::Seam,    CurveKind::Opening, CurveKind::Feature,
                            CurveKind::Elastic, CurveKind::Dart,    CurveKind::Mark,
                            CurveKind::Guide};
  for (const CurveKind each : kinds) kind->addItem(kindWord(each));
  kind->setCurrentIndex(
      static_cast<int>(std::ranges::find(kinds, line.curve.kind) - kinds.begin()));
  form->addRow(secondLabel(tr("Kind")), kind);
  connect(kind, &QComboBox::activated, this, [this, id, kinds, title](int index) {
    const auto chosen = kinds[static_cast<std::size_t>(index)];
    const Result<Document> made = setCurveKind(session_.document(), id, chosen);
    if (!made) return session_.tell(QString::fromStdString(made.error().message));
    session_.commit(tr("%1 becomes %2").arg(title, kindWord(chosen)), *made);
  });

  // The twin: a mirror image that follows, or the line that this one follows.
  std::string twin = line.curve.mirrorOf.value_or("");
  for (const auto& other : session_.lines().all()) {
    if (other->curve.mirrorOf == id) twin = other->curve.id;
  }
  if (session_.document().model->symmetry) {
    auto* link = new QComboBox;
    link->setAccessibleName(tr("Twin"));
    link->addItem(icon(QStringLiteral("link")), tr("Linked"));
    link->addItem(icon(QStringLiteral("unlink")), tr("Free"));
    link->setCurrentIndex(twin.empty() ? 1 : 0);
    form->addRow(secondLabel(tr("Twin")), link);
    const std::string image = line.curve.mirrorOf ? id : twin;
    connect(link, &QComboBox::activated, this, [this, id, image, title](int index) {
      const bool wantsLink = index == 0;
      if (wantsLink == !image.empty()) return;
      if (wantsLink) {
        const std::vector<std::string> ids{id};
        const Result<Edited> made = mirrorCurves(session_.document(), ids, /*linked=*/true);
        if (!made) return session_.tell(QString::fromStdString(made.error().message));
        session_.commit(tr("Link %1").arg(title), made->document);
      } else {
        const Result<Document> made = unlinkMirror(session_.document(), image);
        if (!made) return session_.tell(QString::fromStdString(made.error().message));
        session_.commit(tr("Unlink %1").arg(title), *made);
      }
    });
  }

  column.addSpacing(6);
  column.addWidget(headingRow(tr("Lengths"), {}));
  length_ = numberRow(column, tr("Line on the body"), session_.lengthText(line.length()), true);
  if (!session_.pattern()) return;
  const std::vector<SeamSideRow> runs = sidesOf(*session_.pattern(), id);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const QString word = runs.size() == 2 && i == 1 ? tr("Mate %1") : tr("Seam %1");
    numberRow(column, word.arg(runs[i].piece), session_.lengthText(runs[i].length), false);
  }
  if (runs.size() == 2) {
    const double difference = runs[0].length - runs[1].length;
    const bool matches = std::abs(difference) < 0.05;
    QLabel* label = numberRow(
        column, tr("Difference"),
        (matches ? QStringLiteral("✓ ") : QStringLiteral("△ ")) + session_.lengthText(difference),
        true);
    label->setStyleSheet(
        QStringLiteral("color: %1")
            .arg((matches ? studio::palette().good : studio::palette().trouble).name()));
  }
}

void SelectionPanel::showPiece(QVBoxLayout& column, const std::string& id) {
  const auto pattern = session_.pattern();
  if (!pattern) return;
  const auto cut =
      std::ranges::find_if(pattern->cut.pieces, [&](const Piece& piece) { return piece.id == id; });
  if (cut == pattern->cut.pieces.end()) return;
  const auto index = static_cast<std::size_t>(cut - pattern->cut.pieces.begin());
  const Design& design = *session_.document().design;
  const PieceRecord* record = recordOf(design, id);
  const QString title = record != nullptr && !record->name.empty()
                            ? QString::fromStdString(record->name)
                            : QString::fromStdString(id);
  column.addWidget(headingRow(title, tr("Piece")));

  // Changes are steps of the history; a piece keeps being selected under its new id.
  const auto change = [this, id](const QString& step, const std::function<void(PieceRecord&)>& f) {
    if (!session_.pattern()) return;
    const auto made = withPieceRecord(session_.document(), *session_.pattern(), id, f);
    if (!made) return;
    const bool isNew = recordOf(*session_.document().design, id) == nullptr;
    const std::string newId = isNew ? made->design->pieces.back().id : id;
    session_.commit(step, *made);
    session_.select(Selection::piece(newId));
  };

  QFormLayout* form = addForm(column);
  name_ = new QLineEdit(record != nullptr ? QString::fromStdString(record->name) : QString());
  name_->setPlaceholderText(QString::fromStdString(id));
  name_->setAccessibleName(tr("Name"));
  name_->setObjectName(QStringLiteral("pieceName"));
  form->addRow(secondLabel(tr("Name")), name_);
  connect(name_, &QLineEdit::editingFinished, this, [change, field = name_] {
    if (!field->isModified()) return;
    field->setModified(false);
    const QString name = field->text().trimmed();
    change(tr("Name piece %1").arg(name), [name](PieceRecord& r) { r.name = name.toStdString(); });
  });

  auto* fabric = new QComboBox;
  fabric->setAccessibleName(tr("Fabric"));
  if (design.fabrics.empty()) fabric->addItem(tr("Any cloth"));
  for (std::size_t i = 0; i < design.fabrics.size(); ++i) {
    QPixmap swatch(14, 14);
    const QString colour = QString::fromStdString(design.fabrics[i].colour);
    swatch.fill(colour.isEmpty() ? fabricTint(i) : QColor(colour));
    const Fabric& each = design.fabrics[i];
    fabric->addItem(swatch, QString::fromStdString(each.name.empty() ? each.id : each.name));
  }
  const Fabric* used = fabricOf(design, record);
  if (used != nullptr) fabric->setCurrentIndex(static_cast<int>(used - design.fabrics.data()));
  form->addRow(secondLabel(tr("Fabric")), fabric);
  connect(fabric, &QComboBox::activated, this, [this, change, title](int i) {
    const auto& fabrics = session_.document().design->fabrics;
    if (i < 0 || static_cast<std::size_t>(i) >= fabrics.size()) return;
    const std::string chosen = fabrics[static_cast<std::size_t>(i)].id;
    change(tr("Fabric of %1").arg(title), [chosen](PieceRecord& r) { r.fabric = chosen; });
  });

  auto* count = new QSpinBox;
  count->setRange(1, 999);
  count->setValue(record != nullptr ? record->count : 1);
  count->setAccessibleName(tr("How many to cut"));
  count->setKeyboardTracking(false);
  form->addRow(secondLabel(tr("To cut")), count);
  connect(count, &QSpinBox::valueChanged, this, [change, title](int n) {
    change(tr("Count of %1").arg(title), [n](PieceRecord& r) { r.count = n; });
  });

  auto* include = new QCheckBox(tr("Part of the pattern"));
  include->setObjectName(QStringLiteral("pieceIncluded"));
  include->setChecked(cut->include);
  column.addWidget(include);
  connect(include, &QCheckBox::clicked, this, [change, title](bool on) {
    change((on ? tr("Take in %1") : tr("Leave out %1")).arg(title),
           [on](PieceRecord& r) { r.include = on; });
  });

  column.addSpacing(6);
  double area = 0;
  for (std::size_t f = 0; f < cut->mesh->faceCount(); ++f) area += cut->mesh->area(FaceId(f));
  numberRow(column, tr("Area on the body"), QStringLiteral("%1 cm²").arg(area / 100, 0, 'f', 0),
            false);
  if (const auto& flat = pattern->flats[index]) {
    numberRow(column, tr("Stretch, mean of area"),
              QStringLiteral("%1 %").arg(100 * flat->meanAreaError, 0, 'f', 1), false);
    numberRow(column, tr("Stretch, worst of area"),
              QStringLiteral("%1 %").arg(100 * flat->maxAreaError, 0, 'f', 1), false);
  } else if (pattern->failures[index]) {
    auto* why = secondLabel(QString::fromStdString(pattern->failures[index]->message));
    why->setStyleSheet(QStringLiteral("color: %1").arg(studio::palette().trouble.name()));
    column.addWidget(why);
  }
}

}  // namespace toile::studio
