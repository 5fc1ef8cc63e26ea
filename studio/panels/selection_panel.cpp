// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/selection_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/icons.h"
#include "app/number_field.h"
#include "app/palette.h"
#include "document/merge.h"
#include "document/piece_edits.h"
#include "panels/rows.h"
#include "toile/edit/lines.h"
#include "toile/edit/symmetry.h"
#include "tools/drawing.h"

namespace toile::studio {

namespace {

/// What is sewn together along a line: of a seam two pieces, of a dart or the seam of a tube both
/// edges of one. Parts between the same two pieces are added up.
struct SeamRow {
  std::uint32_t pieceA = 0, pieceB = 0;  ///< in the cut
  double a = 0, b = 0;                   ///< mm
};
std::vector<SeamRow> seamsOf(const Pattern& pattern, const std::string& curve) {
  const auto lengthOf = [&](std::uint32_t cutIndex, std::uint32_t wire) -> std::optional<double> {
    for (std::size_t i = 0; i < pattern.pieces.size(); ++i) {
      if (pattern.pieceIndex[i] != cutIndex) continue;
      for (const OutlineRun& run : pattern.pieces[i].runs) {
        if (run.wire == wire) return run.length;
      }
    }
    return std::nullopt;
  };
  std::vector<SeamRow> rows;
  for (const SeamMates& mates : pattern.cut.mates) {
    if (pattern.cut.pieces[mates.pieceA].wires[mates.wireA].curve != curve) continue;
    const auto a = lengthOf(mates.pieceA, mates.wireA), b = lengthOf(mates.pieceB, mates.wireB);
    if (!a || !b) continue;
    const auto known = std::ranges::find_if(rows, [&](const SeamRow& row) {
      return row.pieceA == mates.pieceA && row.pieceB == mates.pieceB;
    });
    if (known == rows.end()) {
      rows.push_back({mates.pieceA, mates.pieceB, *a, *b});
    } else {
      known->a += *a;
      known->b += *b;
    }
  }
  return rows;
}

QString nameOf(const Piece& piece) {
  return QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
}

}  // namespace

SelectionPanel::SelectionPanel(Session& session, const Actions& actions, QWidget* parent)
    : QWidget(parent), session_(session), actions_(actions) {
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
  showSeams(column, line, *session_.pattern());
}

void SelectionPanel::showSeams(QVBoxLayout& column, const PlacedLine& line,
                               const Pattern& pattern) {
  const std::string id = line.curve.id;
  bool partsTwoPieces = false;
  for (const SeamRow& seam : seamsOf(pattern, id)) {
    column.addSpacing(4);
    numberRow(column, tr("Seam %1").arg(nameOf(pattern.cut.pieces[seam.pieceA])),
              session_.lengthText(seam.a), false);
    numberRow(column, tr("Mate %1").arg(nameOf(pattern.cut.pieces[seam.pieceB])),
              session_.lengthText(seam.b), false);
    const double difference = seam.a - seam.b;
    const bool matches = std::abs(difference) < 0.05;
    QLabel* label = numberRow(
        column, tr("Difference"),
        (matches ? QStringLiteral("✓ ") : QStringLiteral("△ ")) + session_.lengthText(difference),
        true);
    label->setStyleSheet(
        QStringLiteral("color: %1")
            .arg((matches ? studio::palette().good : studio::palette().trouble).name()));
    partsTwoPieces |= seam.pieceA != seam.pieceB;
  }
  if (!partsTwoPieces || session_.isPatternPreview()) return;
  auto* merge = new QPushButton(tr("Merge the pieces beside it"));
  merge->setObjectName(QStringLiteral("mergePieces"));
  merge->setToolTip(tr("Takes the seam away: its two pieces become one"));
  column.addSpacing(4);
  column.addWidget(merge);
  connect(merge, &QPushButton::clicked, this, [this, id] { mergeAlong(session_, id); });
}

void SelectionPanel::changePiece(const std::string& id, const QString& step,
                                 const std::function<void(PieceRecord&)>& change) {
  if (!session_.pattern()) return;
  const auto made = withPieceRecord(session_.document(), *session_.pattern(), id, change);
  if (!made) return;
  // A piece keeps being selected under its new id.
  const bool isNew = recordOf(*session_.document().design, id) == nullptr;
  const std::string newId = isNew ? made->design->pieces.back().id : id;
  session_.commit(step, *made);
  session_.select(Selection::piece(newId));
}

void SelectionPanel::addPieceNumbers(QFormLayout& form, const std::string& id,
                                     const PieceRecord* record, const QString& title) {
  auto* grain = new NumberField(NumberField::Kind::Angle, session_.unit());
  grain->setObjectName(QStringLiteral("pieceGrain"));
  grain->setAccessibleName(tr("Grain, turned"));
  grain->setRange(-360, 360);
  grain->setValue(record != nullptr && record->grain ? record->grain->turn.degrees() : 0);
  form.addRow(secondLabel(tr("Grain")), grain);
  connect(grain, &NumberField::valueEntered, this, [this, id, title](double degrees) {
    changePiece(id, tr("Grain of %1").arg(title), [degrees](PieceRecord& r) {
      if (!r.grain) r.grain.emplace();
      r.grain->turn = Angle::degrees(degrees);
    });
  });
  const std::optional<Ease> own = record != nullptr ? record->ease : std::nullopt;
  const std::tuple<QString, QString, Ratio Ease::*> eases[] = {
      {tr("Ease round"), QStringLiteral("pieceEaseGirth"), &Ease::girth},
      {tr("Ease along"), QStringLiteral("pieceEaseLength"), &Ease::length}};
  for (const auto& [word, name, member] : eases) {
    auto* field = new NumberField(NumberField::Kind::Share, session_.unit());
    field->setObjectName(name);
    field->setAccessibleName(word);
    field->setRange(-0.5, 0.5);
    field->setOptional(tr("as its fabric"));
    if (own) {
      field->setValue(((*own).*member).value());
    } else {
      field->clearValue();
    }
    form.addRow(secondLabel(word), field);
    const QString step = tr("Ease of %1").arg(title);
    connect(field, &NumberField::valueEntered, this,
            [this, id, step, member = member](double share) {
              changePiece(id, step, [&](PieceRecord& r) {
                if (!r.ease) {
                  const Fabric* fabric = fabricOf(*session_.document().design, &r);
                  r.ease = fabric == nullptr ? Ease() : fabric->ease;
                }
                (*r.ease).*member = Ratio::of(share);
              });
            });
    connect(field, &NumberField::valueCleared, this,
            [this, id, step] { changePiece(id, step, [](PieceRecord& r) { r.ease.reset(); }); });
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

  const auto change = [this, id](const QString& step, const std::function<void(PieceRecord&)>& f) {
    changePiece(id, step, f);
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
  fabric->setObjectName(QStringLiteral("pieceFabric"));
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
  auto* fabricRow = new QHBoxLayout;
  fabricRow->addWidget(fabric, 1);
  auto* edit = new QToolButton;
  edit->setDefaultAction(actions_["fabrics"]);
  fabricRow->addWidget(edit);
  form->addRow(secondLabel(tr("Fabric")), fabricRow);
  connect(fabric, &QComboBox::activated, this, [this, change, title](int i) {
    const auto& fabrics = session_.document().design->fabrics;
    if (i < 0 || static_cast<std::size_t>(i) >= fabrics.size()) return;
    const std::string chosen = fabrics[static_cast<std::size_t>(i)].id;
    change(tr("Fabric of %1").arg(title), [chosen](PieceRecord& r) { r.fabric = chosen; });
  });

  auto* count = new QSpinBox;
  count->setRange(1, 999);
  count->setButtonSymbols(QAbstractSpinBox::NoButtons);
  count->setValue(record != nullptr ? record->count : 1);
  count->setAccessibleName(tr("How many to cut"));
  count->setKeyboardTracking(false);
  form->addRow(secondLabel(tr("To cut")), count);
  connect(count, &QSpinBox::valueChanged, this, [change, title](int n) {
    change(tr("Count of %1").arg(title), [n](PieceRecord& r) { r.count = n; });
  });

  addPieceNumbers(*form, id, record, title);

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
    auto* row = new QHBoxLayout;
    for (const char* action : {"darts", "developable"}) {
      auto* button = new QToolButton;
      button->setDefaultAction(actions_[QString::fromLatin1(action)]);
      button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
      row->addWidget(button);
    }
    row->addStretch();
    column.addLayout(row);
  } else if (pattern->failures[index]) {
    auto* why = secondLabel(QString::fromStdString(pattern->failures[index]->message));
    why->setStyleSheet(QStringLiteral("color: %1").arg(studio::palette().trouble.name()));
    column.addWidget(why);
  }
}

}  // namespace toile::studio
