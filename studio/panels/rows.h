// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QFormLayout;
class QLabel;
class QVBoxLayout;
class QWidget;

namespace toile::studio {

// The rows that panels are made of.

[[nodiscard]] QLabel* secondLabel(const QString& text);
/// A heading, and a word on the right.
[[nodiscard]] QWidget* headingRow(const QString& text, const QString& right);
/// "word ........ number". @return the number
QLabel* numberRow(QVBoxLayout& column, const QString& word, const QString& value, bool strong);
[[nodiscard]] QFormLayout* addForm(QVBoxLayout& column);

}  // namespace toile::studio
