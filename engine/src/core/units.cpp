// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/units.h"

#include <array>
#include <charconv>
#include <cmath>

namespace toile {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// "12.5", "3/8" or "1 1/2".
std::optional<double> parseNumberOrFraction(std::string_view text) {
  text = trimmed(text);
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return parseDouble(text);
  const auto denominator = parseDouble(trimmed(text.substr(slash + 1)));
  if (!denominator || *denominator <= 0) return std::nullopt;
  const std::string_view before = trimmed(text.substr(0, slash));
  const std::size_t blank = before.find_last_of(" \t");
  if (blank == std::string_view::npos) {
    const auto numerator = parseDouble(before);
    if (!numerator) return std::nullopt;
    return *numerator / *denominator;
  }
  const auto whole = parseDouble(trimmed(before.substr(0, blank)));
  const auto numerator = parseDouble(before.substr(blank + 1));
  if (!whole || !numerator || *numerator < 0) return std::nullopt;
  return *whole + std::copysign(*numerator / *denominator, *whole);
}

/// Splits "12mm" into the number's text and the unit's.
std::array<std::string_view, 2> splitUnit(std::string_view text) {
  text = trimmed(text);
  std::size_t unit = text.size();
  const auto isUnitLetter = [](char c) { return (c >= 'a' && c <= 'z') || c == '%'; };
  while (unit > 0 && isUnitLetter(text[unit - 1])) --unit;
  return {trimmed(text.substr(0, unit)), text.substr(unit)};
}

Error badValue(std::string_view what, std::string_view text, std::string_view example) {
  return {ErrorCode::InvalidArgument,
          "\"" + std::string(text) + "\" is not " + std::string(what) + "; write it like " +
              std::string(example),
          {}};
}

}  // namespace

double millimetresPer(FileUnit unit) {
  switch (unit) {
    case FileUnit::Millimetre:
      return 1;
    case FileUnit::Centimetre:
      return 10;
    case FileUnit::Metre:
      return 1000;
    case FileUnit::Inch:
      return 25.4;
  }
  return 1;
}

Result<FileUnit> parseFileUnit(std::string_view text) {
  if (text == "mm") return FileUnit::Millimetre;
  if (text == "cm") return FileUnit::Centimetre;
  if (text == "m") return FileUnit::Metre;
  if (text == "in") return FileUnit::Inch;
  return badValue("a unit that files can have", text, "mm, cm, m or in");
}

std::string toString(FileUnit unit) {
  switch (unit) {
    case FileUnit::Millimetre:
      return "mm";
    case FileUnit::Centimetre:
      return "cm";
    case FileUnit::Metre:
      return "m";
    case FileUnit::Inch:
      return "in";
  }
  return "";
}

Result<Length> parseLength(std::string_view text) {
  const auto [numberText, unitText] = splitUnit(text);
  const auto number = parseNumberOrFraction(numberText);
  const auto unit = parseFileUnit(unitText);
  if (!number || !unit) return badValue("a length with its unit", text, "12mm, 1.5cm or 3/8in");
  return Length::mm(*number * millimetresPer(*unit));
}

Result<Ratio> parseRatio(std::string_view text) {
  const auto [numberText, unitText] = splitUnit(text);
  const auto number = parseDouble(numberText);
  if (!number || !(unitText.empty() || unitText == "%")) {
    return badValue("a ratio", text, "2% or 0.02");
  }
  return unitText.empty() ? Ratio::of(*number) : Ratio::percent(*number);
}

Result<Angle> parseAngle(std::string_view text) {
  const auto [numberText, unitText] = splitUnit(text);
  const auto number = parseDouble(numberText);
  if (number && unitText == "deg") return Angle::degrees(*number);
  if (number && unitText == "rad") return Angle::radians(*number);
  return badValue("an angle with its unit", text, "30deg or 0.5rad");
}

std::string toString(Length length) {
  return formatExact(length.mm()) + "mm";
}

std::string toString(Ratio ratio) {
  const double percent = ratio.percent();
  if (Ratio::percent(percent) == ratio) return formatExact(percent) + "%";
  return formatExact(ratio.value());
}

std::string toString(Angle angle) {
  const double degrees = angle.degrees();
  if (Angle::degrees(degrees) == angle) return formatExact(degrees) + "deg";
  return formatExact(angle.radians()) + "rad";
}

std::string formatExact(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  TOILE_ASSERT(error == std::errc());
  return {buffer.data(), end};
}

std::optional<double> parseDouble(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace toile
