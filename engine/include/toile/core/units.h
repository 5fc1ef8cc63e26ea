// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "toile/core/result.h"

namespace toile {

/// A length; the unit is visible wherever a number goes in or comes out.
class Length {
 public:
  constexpr Length() = default;
  static constexpr Length mm(double value) { return Length(value); }
  static constexpr Length cm(double value) { return Length(value * 10.0); }
  static constexpr Length metres(double value) { return Length(value * 1000.0); }
  static constexpr Length inches(double value) { return Length(value * 25.4); }

  [[nodiscard]] constexpr double mm() const { return mm_; }
  [[nodiscard]] constexpr double inches() const { return mm_ / 25.4; }
  friend constexpr auto operator<=>(Length, Length) = default;

 private:
  constexpr explicit Length(double mm) : mm_(mm) {}
  double mm_ = 0;
};

class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * std::numbers::pi / 180.0); }

  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * 180.0 / std::numbers::pi; }
  friend constexpr auto operator<=>(Angle, Angle) = default;

 private:
  constexpr explicit Angle(double radians) : radians_(radians) {}
  double radians_ = 0;
};

/// A part of a whole: Ratio::percent(-5) is -0.05.
class Ratio {
 public:
  constexpr Ratio() = default;
  static constexpr Ratio of(double value) { return Ratio(value); }
  static constexpr Ratio percent(double value) { return Ratio(value / 100.0); }

  [[nodiscard]] constexpr double value() const { return value_; }
  [[nodiscard]] constexpr double percent() const { return value_ * 100.0; }
  friend constexpr auto operator<=>(Ratio, Ratio) = default;

 private:
  constexpr explicit Ratio(double value) : value_(value) {}
  double value_ = 0;
};

/// Unit of the coordinates of a mesh file; files of most formats do not say which.
enum class FileUnit { Millimetre, Centimetre, Metre, Inch };

/// How many mm one unit is.
[[nodiscard]] double millimetresPer(FileUnit unit);
/// "mm", "cm", "m", "in"; refuses anything else with the list of what is known.
[[nodiscard]] Result<FileUnit> parseFileUnit(std::string_view text);
[[nodiscard]] std::string toString(FileUnit unit);

/// "12mm", "1.5 cm", "0.9m", "3/8in", "1 1/2in". The unit is required; independent of the locale.
[[nodiscard]] Result<Length> parseLength(std::string_view text);
/// "2%", "0.02". @return InvalidArgument with the text and an example otherwise.
[[nodiscard]] Result<Ratio> parseRatio(std::string_view text);
/// "30deg", "0.5rad".
[[nodiscard]] Result<Angle> parseAngle(std::string_view text);
/// Shortest text that reads back bit for bit, with unit: "12.5mm", "2%", "30deg" (angles that are
/// not whole in degrees to the last bit are written in rad).
[[nodiscard]] std::string toString(Length length);
[[nodiscard]] std::string toString(Ratio ratio);
[[nodiscard]] std::string toString(Angle angle);

/// Shortest decimal text that reads back to the same double; "." always, never a locale.
[[nodiscard]] std::string formatExact(double value);
/// Whole text as a finite double, "." always; nullopt otherwise.
[[nodiscard]] std::optional<double> parseDouble(std::string_view text);

}  // namespace toile
