// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/rows.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace toile::studio {

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

}  // namespace toile::studio
