// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/fabric_panel.h"

#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

#include "app/icons.h"
#include "app/palette.h"
#include "panels/rows.h"
#include "toile/design/finish_limits.h"

namespace toile::studio {

namespace {

constexpr int kMostHeight = 330;  // px of the fields; more is scrolled

QString titleOf(const Fabric& fabric) {
  return QString::fromStdString(fabric.name.empty() ? fabric.id : fabric.name);
}

}  // namespace

FabricPanel::FabricPanel(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName(QStringLiteral("fabricPanel"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  connect(&session, &Session::historyChanged, this, [this] {
    if (isOpen_) rebuild();
  });
}

void FabricPanel::open(const std::string& piece) {
  isOpen_ = true;
  piece_ = piece;
  const Design& design = *session_.document().design;
  const Fabric* fabric = fabricOf(design, piece.empty() ? nullptr : recordOf(design, piece));
  fabric_ = fabric == nullptr ? std::string() : fabric->id;
  rebuild();
}

void FabricPanel::rebuild() {
  // Not below the hands of someone who types.
  if (const auto* field = qobject_cast<QLineEdit*>(focusWidget());
      field != nullptr && field->isModified() && field->hasFocus()) {
    return;
  }
  if (content_ != nullptr) {
    content_->hide();
    content_->setParent(nullptr);
    content_->deleteLater();
  }
  content_ = new QWidget;
  layout()->addWidget(content_);
  auto* column = new QVBoxLayout(content_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(headingRow(tr("Fabrics"), {}));
  const auto& fabrics = session_.document().design->fabrics;
  const auto shown = std::ranges::find(fabrics, fabric_, &Fabric::id);
  const Fabric* fabric = shown != fabrics.end() ? &*shown
                         : fabrics.empty()      ? nullptr
                                                : &fabrics.front();
  fabric_ = fabric == nullptr ? std::string() : fabric->id;

  auto* top = new QHBoxLayout;
  auto* which = new QComboBox;
  which->setObjectName(QStringLiteral("whichFabric"));
  which->setAccessibleName(tr("Fabric"));
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    QPixmap swatch(14, 14);
    const QString colour = QString::fromStdString(fabrics[i].colour);
    swatch.fill(colour.isEmpty() ? fabricTint(i) : QColor(colour));
    which->addItem(swatch, titleOf(fabrics[i]));
    if (fabrics[i].id == fabric_) which->setCurrentIndex(static_cast<int>(i));
  }
  connect(which, &QComboBox::activated, this, [this](int index) {
    fabric_ = session_.document().design->fabrics[static_cast<std::size_t>(index)].id;
    rebuild();
  });
  top->addWidget(which, 1);
  auto* add = new QPushButton(tr("New"));
  add->setObjectName(QStringLiteral("newFabric"));
  connect(add, &QPushButton::clicked, this, &FabricPanel::addFabric);
  top->addWidget(add);
  column->addLayout(top);

  if (fabric == nullptr) {
    which->setEnabled(false);
    column->addWidget(
        secondLabel(tr("Any cloth: nothing is known of how far it stretches. A fabric has limits, "
                       "which show in the strain, and ease.")));
  } else {
    auto* fields = new QWidget;
    fields->setObjectName(QStringLiteral("panelFields"));
    auto* form = new QFormLayout(fields);
    form->setContentsMargins(0, 0, 8, 0);
    form->setVerticalSpacing(6);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    addFields(*form, *fabric);
    auto* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("What can be set"));
    scroll->setWidget(fields);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setFixedHeight(std::min(kMostHeight, fields->sizeHint().height() + 4));
    column->addWidget(scroll);
  }
  auto* buttons = new QHBoxLayout;
  auto* done = new QPushButton(tr("Done"));
  done->setObjectName(QStringLiteral("answer"));
  connect(done, &QPushButton::clicked, this, [this] {
    isOpen_ = false;
    Q_EMIT ended();
  });
  buttons->addWidget(done, 1);
  auto* remove = new QPushButton(tr("Remove"));
  remove->setEnabled(fabric != nullptr);
  remove->setToolTip(tr("Its pieces are made of the first fabric then"));
  connect(remove, &QPushButton::clicked, this, &FabricPanel::removeFabric);
  buttons->addWidget(remove);
  column->addLayout(buttons);
}

void FabricPanel::addOptional(QFormLayout& form, const QString& word, const QString& name,
                              const Bounds& bounds, std::optional<double> value,
                              const std::function<void(Fabric&, std::optional<double>)>& set) {
  auto* field = new NumberField(bounds.kind, session_.unit());
  field->setObjectName(name);
  field->setAccessibleName(word);
  field->setRange(bounds.low, bounds.high);
  field->setOptional(bounds.kind == NumberField::Kind::Length ? tr("not said") : tr("no limit"));
  if (value) {
    field->setValue(*value);
  } else {
    field->clearValue();
  }
  form.addRow(secondLabel(word), field);
  const auto taken = [this, word, set](std::optional<double> number) {
    change(word, [&](Fabric& fabric) { set(fabric, number); });
  };
  connect(field, &NumberField::valueEntered, this, [taken](double number) { taken(number); });
  connect(field, &NumberField::valueCleared, this, [taken] { taken(std::nullopt); });
}

void FabricPanel::addFields(QFormLayout& form, const Fabric& fabric) {
  auto* name = new QLineEdit(titleOf(fabric));
  name->setObjectName(QStringLiteral("fabricName"));
  name->setAccessibleName(tr("Name"));
  form.addRow(secondLabel(tr("Name")), name);
  connect(name, &QLineEdit::editingFinished, this, [this, name] {
    if (!name->isModified()) return;
    name->setModified(false);
    const std::string text = name->text().trimmed().toStdString();
    change(tr("name"), [&](Fabric& f) { f.name = text; });
  });
  auto* colour = new QPushButton(fabric.colour.empty() ? tr("Choose…")
                                                       : QString::fromStdString(fabric.colour));
  colour->setAccessibleName(tr("Colour"));
  if (!fabric.colour.empty()) {
    QPixmap swatch(14, 14);
    swatch.fill(QColor(QString::fromStdString(fabric.colour)));
    colour->setIcon(swatch);
  }
  form.addRow(secondLabel(tr("Colour")), colour);
  connect(colour, &QPushButton::clicked, this, [this, fabric] { chooseColour(fabric); });

  const auto share = [](const std::optional<Ratio>& ratio) {
    return ratio ? std::optional(ratio->value()) : std::nullopt;
  };
  const std::tuple<QString, const char*, std::optional<Ratio> Fabric::*> limits[] = {
      {tr("Stretch along"), "stretchAlong", &Fabric::stretchAlong},
      {tr("Stretch across"), "stretchAcross", &Fabric::stretchAcross},
      {tr("Shear"), "shear", &Fabric::shear}};
  for (const auto& [word, id, member] : limits) {
    addOptional(form, word, QString::fromLatin1(id), {NumberField::Kind::Share, 0, 10},
                share(fabric.*member), [member = member](Fabric& f, std::optional<double> value) {
                  f.*member = value ? std::optional(Ratio::of(*value)) : std::nullopt;
                });
  }
  const std::tuple<QString, const char*, Ratio Ease::*> eases[] = {
      {tr("Ease round"), "easeGirth", &Ease::girth},
      {tr("Ease along"), "easeLength", &Ease::length}};
  for (const auto& [word, id, member] : eases) {
    auto* field = new NumberField(NumberField::Kind::Share, session_.unit());
    field->setObjectName(QString::fromLatin1(id));
    field->setAccessibleName(word);
    field->setToolTip(tr("Below 0: cut smaller than the body"));
    field->setRange(-0.5, 0.5);
    field->setValue((fabric.ease.*member).value());
    form.addRow(secondLabel(word), field);
    connect(field, &NumberField::valueEntered, this,
            [this, word = word, member = member](double value) {
              change(word, [&](Fabric& f) { f.ease.*member = Ratio::of(value); });
            });
  }
  auto* thickness = new NumberField(NumberField::Kind::Length, session_.unit());
  thickness->setObjectName(QStringLiteral("thickness"));
  thickness->setAccessibleName(tr("Thickness"));
  thickness->setRange(0, 50);
  thickness->setValue(fabric.thickness.mm());
  form.addRow(secondLabel(tr("Thickness")), thickness);
  connect(thickness, &NumberField::valueEntered, this, [this](double mm) {
    change(tr("thickness"), [&](Fabric& f) { f.thickness = Length::mm(mm); });
  });
  const auto length = [](const std::optional<Length>& value) {
    return value ? std::optional(value->mm()) : std::nullopt;
  };
  const auto lengthOf = [](std::optional<double> mm) {
    return mm ? std::optional(Length::mm(*mm)) : std::nullopt;
  };
  addOptional(form, tr("Width of the roll"), QStringLiteral("rollWidth"),
              {NumberField::Kind::Length, 1, 1e5}, length(fabric.rollWidth),
              [lengthOf](Fabric& f, std::optional<double> mm) { f.rollWidth = lengthOf(mm); });
  addOptional(form, tr("Seam allowance"), QStringLiteral("fabricAllowance"),
              {NumberField::Kind::Length, 0, kMostAllowance.mm()}, length(fabric.allowance),
              [lengthOf](Fabric& f, std::optional<double> mm) { f.allowance = lengthOf(mm); });
  auto* turns = new QComboBox;
  turns->setAccessibleName(tr("How pieces may lie"));
  turns->addItems({tr("one way (nap)"), tr("both ways"), tr("any way")});
  turns->setCurrentIndex(static_cast<int>(fabric.turns));
  form.addRow(secondLabel(tr("Pieces lie")), turns);
  connect(turns, &QComboBox::activated, this, [this](int index) {
    change(tr("how pieces lie"), [&](Fabric& f) { f.turns = static_cast<Turns>(index); });
  });
}

void FabricPanel::change(const QString& what, const std::function<void(Fabric&)>& change) {
  Design design = *session_.document().design;
  const auto found = std::ranges::find(design.fabrics, fabric_, &Fabric::id);
  if (found == design.fabrics.end()) return;
  change(*found);
  const QString step = tr("%1: %2").arg(titleOf(*found), what);
  session_.commit(step,
                  {std::make_shared<const Design>(std::move(design)), session_.document().model});
}

void FabricPanel::chooseColour(const Fabric& fabric) {
  const QColor before =
      fabric.colour.empty() ? QColor(Qt::gray) : QColor(QString::fromStdString(fabric.colour));
  const QColor colour =
      QColorDialog::getColor(before, this, tr("Colour of %1").arg(titleOf(fabric)));
  if (!colour.isValid()) return;
  change(tr("colour"), [&](Fabric& f) { f.colour = colour.name().toStdString(); });
}

void FabricPanel::addFabric() {
  Design design = *session_.document().design;
  Fabric fabric;
  for (int n = 1; fabric.id.empty(); ++n) {
    const std::string id = "fabric-" + std::to_string(n);
    if (std::ranges::find(design.fabrics, id, &Fabric::id) == design.fabrics.end()) fabric.id = id;
  }
  fabric.name = tr("Fabric %1").arg(design.fabrics.size() + 1).toStdString();
  fabric_ = fabric.id;
  const QString name = QString::fromStdString(fabric.name);
  design.fabrics.push_back(std::move(fabric));
  session_.commit(tr("New fabric, %1").arg(name),
                  {std::make_shared<const Design>(std::move(design)), session_.document().model});
}

void FabricPanel::removeFabric() {
  Design design = *session_.document().design;
  const auto found = std::ranges::find(design.fabrics, fabric_, &Fabric::id);
  if (found == design.fabrics.end()) return;
  const QString name = titleOf(*found);
  for (PieceRecord& record : design.pieces) {
    if (record.fabric == fabric_) record.fabric.clear();
  }
  design.fabrics.erase(found);
  session_.commit(tr("Remove %1").arg(name),
                  {std::make_shared<const Design>(std::move(design)), session_.document().model});
}

}  // namespace toile::studio
