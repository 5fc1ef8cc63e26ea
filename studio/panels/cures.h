// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <string>
#include <vector>

#include "app/session.h"

namespace toile::studio {

/// What helps against a finding, offered below it.
struct Cure {
  enum class Kind {
    CutOpen,      ///< along the shortest way
    Darts,        ///< opens the adviser
    Developable,  ///< opens the slider
    LeaveOut,     ///< the piece
    LeaveOutNew,  ///< all pieces that have no name yet
    BackInPlace,  ///< pieces that a hand had moved
    MakeDart,     ///< of a cut that ends inside a piece
    RemoveLine,
    ForgetName  ///< of two for one piece, the later ones
  };
  Kind kind;
  QString label;
  std::vector<std::string> about;  ///< pieces or lines
};

/// @param code of a finding
/// @param where what it is about
[[nodiscard]] std::vector<Cure> curesOf(const Pattern& pattern, const std::string& code,
                                        const std::vector<Element>& where);
/// Of a piece that could not be made.
[[nodiscard]] std::vector<Cure> curesOf(const Pattern& pattern, std::size_t piece,
                                        const Error& failure);

/// Does it: one step of the history, or the panel that leads to one.
void apply(Session& session, const Cure& cure);

}  // namespace toile::studio
