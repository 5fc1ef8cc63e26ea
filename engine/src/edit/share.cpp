// SPDX-License-Identifier: GPL-3.0-or-later
// Shared crossings of curves.
#include <fmt/format.h>

#include <algorithm>

#include "edit/sketch.h"
#include "toile/curve/crossing.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;

namespace {

constexpr std::size_t kRounds = 2;

struct Line {
  std::string id;
  WorkCurve curve;
  SurfacePath path;
  bool isChanged = false;
};

/// Puts a point in the place of another, a rounding away, in every line that has it.
Result<void> replaceEverywhere(Sketch& sketch, std::vector<Line>& lines, const SurfacePoint& old,
                               const SurfacePoint& now) {
  for (Line& line : lines) {
    for (std::size_t i = 0; i < line.curve.data.size(); ++i) {
      if (!(line.curve.data[i] == old)) continue;
      const Result<void> done =
          detail::replaceData(sketch.linker(), sketch.mesh(), line.curve, i, now);
      if (!done) return done;
      line.isChanged = true;
    }
  }
  return {};
}

/// Makes a meeting one data point of both lines. One that is there already is kept: others may
/// share it.
Result<void> share(Sketch& sketch, std::vector<Line>& lines, Line& first, Line& second,
                   const PathMeeting& meeting) {
  const Mesh& mesh = sketch.mesh();
  const std::size_t before = first.curve.data.size(), beforeSecond = second.curve.data.size();
  const std::size_t inFirst = detail::insertData(mesh, first.curve, meeting.a);
  const std::size_t inSecond = detail::insertData(mesh, second.curve, meeting.b);
  const bool isNewInFirst = first.curve.data.size() > before;
  const bool isNewInSecond = second.curve.data.size() > beforeSecond;
  first.isChanged = first.isChanged || isNewInFirst;
  second.isChanged = second.isChanged || isNewInSecond;
  const SurfacePoint a = first.curve.data[inFirst], b = second.curve.data[inSecond];
  if (a == b) return {};
  if (isNewInSecond && detail::nudgeData(mesh, second.curve, inSecond, a)) return {};
  if (isNewInFirst && detail::nudgeData(mesh, first.curve, inFirst, b)) return {};
  return replaceEverywhere(sketch, lines, b, a);
}

}  // namespace

Result<Edited> shareCrossings(const Document& document, std::span<const std::string> curves) {
  Sketch sketch(document);
  for (const std::string& id : curves) {
    if (const Result<std::size_t> known = sketch.indexOf(id); !known) return known.error();
  }
  Edited edited;
  const auto leaveOut = [&](const std::string& id, const std::string& why) {
    edited.findings.push_back(
        {"crossings-not-shared",
         fmt::format("the crossings of curve \"{}\" are not shared: {}", id, why),
         {Element::curve(id)}});
  };
  std::vector<Line> lines;
  for (const StylingCurve& curve : document.design->curves) {
    const bool isNamed = std::find(curves.begin(), curves.end(), curve.id) != curves.end();
    if (!curves.empty() && !isNamed) continue;
    const auto target = sketch.targetOf(curve.id);
    if (target && target->isMirrored) continue;
    Result<WorkCurve> loaded = target ? sketch.load(curve.id) : target.error();
    if (!loaded) {
      // What was asked for by name is refused; another curve that is not in order is passed over.
      if (isNamed) return loaded.error();
      leaveOut(curve.id, loaded.error().message);
      continue;
    }
    Line line{curve.id, *std::move(loaded), {}};
    line.path = detail::pathOf(line.curve);
    lines.push_back(std::move(line));
  }
  // Once more, since a point that was replaced can move a meeting next to it.
  for (std::size_t pair = 0; pair < kRounds * lines.size() * lines.size(); ++pair) {
    const std::size_t a = pair / lines.size() % lines.size(), b = pair % lines.size();
    if (b > a) {
      const auto meetings = findMeetings(sketch.mesh(), lines[a].path, lines[b].path);
      for (const PathMeeting& meeting : meetings) {
        if (const Result<void> done = share(sketch, lines, lines[a], lines[b], meeting); !done) {
          return done.error();
        }
      }
      if (meetings.empty()) continue;
      // Also where nothing had to be added the data points are the truth from now on.
      for (Line* line : {&lines[a], &lines[b]}) {
        line->isChanged = line->isChanged || sketch.edit(line->id).dataPoints.empty();
      }
      lines[a].path = detail::pathOf(lines[a].curve);
      lines[b].path = detail::pathOf(lines[b].curve);
    }
  }
  for (const Line& line : lines) {
    if (!line.isChanged) continue;
    sketch.store(line.id, line.curve);
    edited.curves.push_back(line.id);
  }
  edited.document = sketch.document();
  return edited;
}

}  // namespace toile
