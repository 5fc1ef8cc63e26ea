// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/units.h"

#include <gtest/gtest.h>

#include "document/history.h"

namespace toile::studio {
namespace {

double mm(const char* text, LengthUnit unit = LengthUnit::Millimetre) {
  return evaluateLength(QString::fromUtf8(text), unit).value_or(-1e9);
}

TEST(LengthFields, TakeSumsAndUnits) {
  EXPECT_DOUBLE_EQ(mm("34.5+2cm"), 54.5);
  EXPECT_DOUBLE_EQ(mm("34,5 + 2 cm", LengthUnit::Centimetre), 365);
  EXPECT_DOUBLE_EQ(mm("2*(10mm+1cm)"), 40);
  EXPECT_DOUBLE_EQ(mm("3/8in"), 9.525);
  EXPECT_DOUBLE_EQ(mm("1", LengthUnit::Inch), 25.4);
  EXPECT_DOUBLE_EQ(mm("-5"), -5);
}

TEST(LengthFields, RefuseWhatIsNoLength) {
  for (const char* text : {"", "mm", "2cm*3cm", "1/0", "5+", "(3", "3 apples", "1e999"}) {
    EXPECT_FALSE(evaluateLength(QString::fromUtf8(text), LengthUnit::Millimetre)) << text;
  }
  EXPECT_FALSE(evaluateLength(QString(150, '('), LengthUnit::Millimetre));
}

TEST(LengthFields, NeverARoundedMinusZero) {
  EXPECT_EQ(lengthNumber(-0.01, LengthUnit::Millimetre), QStringLiteral("0.0"));
  EXPECT_EQ(lengthText(-2, LengthUnit::Millimetre), QString::fromUtf8("−2.0\u2009mm"));
}

TEST(History, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
  const auto named = [](const char* name) {
    auto design = std::make_shared<Design>();
    design->name = name;
    return Step{QString::fromUtf8(name), {}, {design, nullptr}, {}};
  };
  History history(named("a"));
  history.push(named("b"));
  history.push(named("c"));
  history.jumpTo(0);
  EXPECT_EQ(history.current().design->name, "a");
  EXPECT_TRUE(history.canRedo());
  history.push(named("d"));
  EXPECT_FALSE(history.canRedo());
  ASSERT_EQ(history.steps().size(), 2U);
  history.jumpTo(99);
  EXPECT_EQ(history.current().design->name, "d");
}

}  // namespace
}  // namespace toile::studio
