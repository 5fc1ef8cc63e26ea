// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/units.h"

#include <cmath>
#include <string>

#include "toile/core/units.h"

namespace toile::studio {

namespace {

double millimetres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre:
      return 1;
    case LengthUnit::Centimetre:
      return 10;
    case LengthUnit::Inch:
      return 25.4;
  }
  return 1;
}

/// A number, or a length in mm: sums need both sides alike, products a length once at most.
struct Value {
  double amount = 0;
  bool isLength = false;
};

/// Recursive descent: sum = product {+- product}, product = factor {*/ factor}, factor = number
/// [unit] | ( sum ) [unit] | - factor.
class Reader {
 public:
  Reader(std::string text, LengthUnit unit) : text_(std::move(text)), unit_(unit) {}

  std::optional<double> read() {
    const auto value = sum();
    skip();
    if (!value || at_ != text_.size()) return std::nullopt;
    const double mm = value->isLength ? value->amount : value->amount * millimetres(unit_);
    return std::isfinite(mm) ? std::optional(mm) : std::nullopt;
  }

 private:
  static constexpr int kDeepest = 50;

  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool takeWord(std::string_view word) {
    skip();
    if (text_.compare(at_, word.size(), word) != 0) return false;
    const std::size_t end = at_ + word.size();
    if (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end])) != 0 &&
        word != "\"") {
      return false;
    }
    at_ = end;
    return true;
  }
  std::optional<Value> withUnit(Value value) {
    double scale = 0;
    if (takeWord("mm"))
      scale = 1;
    else if (takeWord("cm"))
      scale = 10;
    else if (takeWord("m"))
      scale = 1000;
    else if (takeWord("inch") || takeWord("in") || takeWord("\""))
      scale = 25.4;
    else
      return value;
    if (value.isLength) return std::nullopt;
    return Value{value.amount * scale, true};
  }
  std::optional<Value> factor(bool mayHaveUnit = true) {
    if (++depth_ > kDeepest) return std::nullopt;
    std::optional<Value> value;
    if (take('-')) {
      value = factor();
      if (value) value->amount = -value->amount;
    } else if (take('(')) {
      value = sum();
      if (!value || !take(')')) return std::nullopt;
      value = withUnit(*value);
    } else {
      skip();
      std::size_t end = at_;
      while (end < text_.size() &&
             (std::isdigit(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '.')) {
        ++end;
      }
      const auto number = parseDouble(std::string_view(text_).substr(at_, end - at_));
      if (!number) return std::nullopt;
      at_ = end;
      value = Value{*number, false};
      if (mayHaveUnit) value = withUnit(*value);
    }
    --depth_;
    return value;
  }
  std::optional<Value> product() {
    auto left = factor();
    while (left) {
      const bool times = take('*');
      if (!times && !take('/')) return left;
      // "3/8in" is 3/8 of an inch: a divisor has no unit of its own.
      const auto right = factor(/*mayHaveUnit=*/times);
      if (!right || (times ? left->isLength && right->isLength : right->isLength)) {
        return std::nullopt;
      }
      left->amount = times ? left->amount * right->amount : left->amount / right->amount;
      left->isLength = left->isLength || right->isLength;
      if (const auto made = withUnit(*left)) left = made;  // "3/8in": the unit of the fraction
    }
    return std::nullopt;
  }
  std::optional<Value> sum() {
    auto left = product();
    while (left) {
      const bool plus = take('+');
      if (!plus && !take('-')) return left;
      auto right = product();
      if (!right) return std::nullopt;
      // A bare number beside a length is one in the usual unit.
      if (left->isLength != right->isLength) {
        Value& bare = left->isLength ? *right : *left;
        bare = {bare.amount * millimetres(unit_), true};
      }
      left->amount += plus ? right->amount : -right->amount;
    }
    return std::nullopt;
  }

  std::string text_;
  LengthUnit unit_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

QString symbol(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Millimetre:
      return QStringLiteral("mm");
    case LengthUnit::Centimetre:
      return QStringLiteral("cm");
    case LengthUnit::Inch:
      return QStringLiteral("in");
  }
  return {};
}

QString lengthNumber(double mm, LengthUnit unit) {
  const int decimals = unit == LengthUnit::Millimetre ? 1 : 2;
  const double value = mm / millimetres(unit);
  QString text = QString::number(std::abs(value), 'f', decimals);
  const bool isZero = text.toDouble() == 0;
  if (value < 0 && !isZero) text.prepend(QChar(0x2212));
  return text;
}

QString lengthText(double mm, LengthUnit unit) {
  return lengthNumber(mm, unit) + QChar(0x2009) + symbol(unit);
}

std::optional<double> evaluateLength(const QString& text, LengthUnit unit) {
  QString plain = text.trimmed().toLower();
  plain.replace(QChar(0x2212), '-').replace(QChar(0x2009), ' ').replace(QChar(0x00a0), ' ');
  plain.replace(',', '.').replace(QChar(0x00d7), '*').replace(QChar(0x2033), '"');
  if (plain.isEmpty() || plain.size() > 200) return std::nullopt;
  return Reader(plain.toStdString(), unit).read();
}

}  // namespace toile::studio
