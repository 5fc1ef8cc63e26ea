// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "toile/design/design.h"

namespace toile {

// The words that stand in design files for the values of the enumerations.

inline constexpr std::array<std::pair<std::string_view, CurveKind>, 7> kCurveKindNames{{
    {"seam", CurveKind::Seam},
    {"opening", CurveKind::Opening},
    {"feature", CurveKind::Feature},
    {"elastic", CurveKind::Elastic},
    {"dart", CurveKind::Dart},
    {"mark", CurveKind::Mark},
    {"guide", CurveKind::Guide},
}};

inline constexpr std::array<std::pair<std::string_view, CornerStyle>, 4> kCornerStyleNames{{
    {"mitre", CornerStyle::Mitre},
    {"square", CornerStyle::Square},
    {"mirrored", CornerStyle::Mirrored},
    {"truncated", CornerStyle::Truncated},
}};
inline constexpr std::array<std::pair<std::string_view, NotchKind>, 6> kNotchKindNames{{
    {"slit", NotchKind::Slit},
    {"v", NotchKind::V},
    {"t", NotchKind::T},
    {"castle", NotchKind::Castle},
    {"check", NotchKind::Check},
    {"u", NotchKind::U},
}};
inline constexpr std::array<std::pair<std::string_view, SeamKind>, 3> kSeamKindNames{{
    {"butt", SeamKind::Butt},
    {"lapped", SeamKind::Lapped},
    {"hem", SeamKind::Hem},
}};

inline constexpr std::array<std::pair<std::string_view, SubdivisionRule>, 3> kRuleNames{{
    {"auto", SubdivisionRule::Auto},
    {"uniform", SubdivisionRule::Uniform},
    {"centripetal", SubdivisionRule::Centripetal},
}};

inline constexpr std::array<std::pair<std::string_view, Turns>, 3> kTurnsNames{{
    {"one-way", Turns::OneWay},
    {"two-way", Turns::TwoWay},
    {"any", Turns::Any},
}};

inline constexpr std::array<std::pair<std::string_view, Grain::Axis>, 3> kGrainAxisNames{{
    {"x", Grain::Axis::X},
    {"y", Grain::Axis::Y},
    {"z", Grain::Axis::Z},
}};

inline constexpr std::array<std::pair<std::string_view, TwinMode>, 2> kTwinModeNames{{
    {"identical", TwinMode::Identical},
    {"mean", TwinMode::Mean},
}};

template <class Names, class Value>
[[nodiscard]] constexpr std::string_view nameOf(const Names& names, Value value) {
  for (const auto& [name, candidate] : names) {
    if (candidate == value) return name;
  }
  return {};
}

}  // namespace toile
