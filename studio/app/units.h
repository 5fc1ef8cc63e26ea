// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <optional>

namespace toile::studio {

enum class LengthUnit { Millimetre, Centimetre, Inch };

/// "mm", "cm", "in": the same in every language.
[[nodiscard]] QString symbol(LengthUnit unit);
/// For people: one decimal in mm, two in cm and inch, a real minus sign, a thin space.
[[nodiscard]] QString lengthText(double mm, LengthUnit unit);
/// The number alone, for columns.
[[nodiscard]] QString lengthNumber(double mm, LengthUnit unit);

/// A sum with units, such as "34.5+2cm" or "(3/8in)*2", in mm. Numbers without unit are in `unit`;
/// a factor has none.
/// @return nothing for what is no length
[[nodiscard]] std::optional<double> evaluateLength(const QString& text, LengthUnit unit);

}  // namespace toile::studio
