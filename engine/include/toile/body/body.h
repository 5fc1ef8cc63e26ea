// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toile/core/units.h"
#include "toile/model/reference_model.h"

namespace toile {

/// What a tape measure takes of a body, by ISO 8559-1.
enum class BodyMeasure {
  Height,
  Head,
  Neck,
  NeckBase,
  ShoulderLength,
  Chest,
  Underbust,
  Waist,
  HighHip,
  Hip,
  Thigh,
  MidThigh,
  Knee,
  Calf,
  Ankle,
  Armscye,
  UpperArm,
  Elbow,
  Wrist,
  ArmLength,
  BackLength,
  InsideLeg,
  FootLength
};
inline constexpr std::size_t kBodyMeasureCount = 23;

struct BodyMeasureInfo {
  BodyMeasure measure;
  std::string_view name;     ///< "chest", as an option and in "builtin:body@1?chest=920mm"
  std::string_view isoName;  ///< "bust girth"
  std::string_view how;      ///< along which curve or between what it is taken on the model
};
/// All of them, in the order of the enumeration.
std::span<const BodyMeasureInfo> bodyMeasures();

enum class Posture { APose, ArmsRaised, KneeBent, Seated };
/// "a-pose", "arms-raised", "knee-bent", "seated".
[[nodiscard]] std::string_view toString(Posture posture);
[[nodiscard]] Result<Posture> parsePosture(std::string_view text);

struct BodyOptions {
  std::map<BodyMeasure, Length> measures;  ///< what is left out follows from the others
  double masculine = 0;                    ///< 0 female .. 1 male
  /// Proportions: 0 adult .. 1 a child of about five; from the height (and form) if not said.
  std::optional<double> childlike;
  Posture posture = Posture::APose;
};

/// What a measure may be on a body with the other measures given.
struct BodyRange {
  Length expected;  ///< what it is if not given
  Length least, most;
};
/// Sets one option by its name and a text, as the command line and "builtin:body@1?..." hold it: a
/// measure ("chest", "920mm"), "form" ("female", "male" or a ratio between), "childlike" (a ratio),
/// "posture", "size" ("EU38F": what the size says, where nothing else is said).
/// @return InvalidArgument naming the option: unknown (with the nearest name), not readable.
Result<void> setBodyOption(BodyOptions& options, std::string_view name, std::string_view text);
/// The names that setBodyOption() knows, measures first.
[[nodiscard]] std::vector<std::string> bodyOptionNames();

/// For every measure, in order, given the others in `options`.
/// @return InvalidArgument for a height or form out of range.
Result<std::vector<BodyRange>> bodyRanges(const BodyOptions& options);

/// A parametric body: builtin:body@1. Closed, without handles or crossings, exactly symmetric
/// (except knee-bent), one connectivity for ever; the given measures are met within 2 mm on the
/// body in A-pose. Other postures bend that body. Curves and landmarks as in docs/body.md.
///
/// A hand-made net of quads, whose control points depend on form and one dial per measure, is
/// interpolated by a Catmull-Clark surface; the dials are solved for by Newton's method.
/// @return InvalidArgument naming the first measure that is out of range, and the nearest possible.
/// @par Cost  some ten milliseconds, twice that for the first body of a process
Result<ReferenceModel> makeBody(const BodyOptions& options);

/// The measures of a body in A-pose that has this connectivity, in the order of the enumeration.
std::vector<Length> measureBody(const Mesh& body);

}  // namespace toile
