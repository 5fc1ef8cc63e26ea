// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/units_question.h"

#include <fmt/format.h>

#include <array>

namespace toile::scanning {

Error askForUnit(const std::string& name, const std::string& what, double number,
                 std::optional<FileUnit> taken, bool isPerson) {
  std::string choices;
  for (const FileUnit unit :
       {FileUnit::Millimetre, FileUnit::Centimetre, FileUnit::Inch, FileUnit::Metre}) {
    const double mm = number * millimetresPer(unit);
    if (isPerson && (mm < kShortestPerson || mm > kTallestPerson)) continue;
    choices += fmt::format("{}--units {} makes it {:.4g} cm {}", choices.empty() ? "" : ", ",
                           toString(unit), mm / 10, what);
  }
  std::string message =
      taken ? fmt::format("{} is {:.4g} cm {} in {}: no person is", name,
                          number * millimetresPer(*taken) / 10, what, toString(*taken))
            : fmt::format("{} does not say its unit", name);
  message += choices.empty() ? fmt::format(
                                   "; no unit makes a person of it ({:.4g} {} in its own "
                                   "numbers)",
                                   number, what)
                             : fmt::format("; which is it? {}", choices);
  return {ErrorCode::UnitsMissing, std::move(message), {}};
}

}  // namespace toile::scanning
