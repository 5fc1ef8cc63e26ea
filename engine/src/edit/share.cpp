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

/// A point that is shared moves the meetings beside it, by rounding over the angle of the lines.
constexpr int kMostRounds = 16;

struct Line {
  std::string id;
  WorkCurve curve;
  SurfacePath path;
  bool isMet = false;
  bool isStale = false;  ///< the path is not the curve's any more
  int lastRound = 0;     ///< in which it was changed
};

/// Puts a point in the place of another, a rounding away, in every line that has it.
Result<void> replaceEverywhere(Sketch& sketch, std::vector<Line>& lines, const SurfacePoint& old,
                               const SurfacePoint& now, int round) {
  for (Line& line : lines) {
    for (std::size_t i = 0; i < line.curve.data.size(); ++i) {
      if (!(line.curve.data[i] == old)) continue;
      const Result<void> done =
          detail::replaceData(sketch.linker(), sketch.mesh(), line.curve, i, now);
      if (!done) return done;
      line.lastRound = round;
      line.isStale = true;
    }
  }
  return {};
}

/// A common data point nearer than this to a meeting, mm, is that meeting: where lines run along
/// each other its place is known to rounding over their angle.
constexpr double kSameCrossing = 10 * kSameMeeting;

bool isShared(const Mesh& mesh, const Line& first, const Line& second, const PathMeeting& meeting) {
  const Eigen::Vector3d place = position(mesh, meeting.point);
  const auto& others = second.curve.data;
  return std::any_of(first.curve.data.begin(), first.curve.data.end(),
                     [&](const SurfacePoint& point) {
                       return (position(mesh, point) - place).norm() < kSameCrossing &&
                              std::find(others.begin(), others.end(), point) != others.end();
                     });
}

/// Makes a meeting one data point of both lines. One that is there already is kept: others may
/// share it.
Result<void> share(Sketch& sketch, std::vector<Line>& lines, Line& first, Line& second,
                   const PathMeeting& meeting, int round) {
  const Mesh& mesh = sketch.mesh();
  if (isShared(mesh, first, second, meeting)) return {};
  const std::size_t before = first.curve.data.size(), beforeSecond = second.curve.data.size();
  const std::size_t inFirst = detail::insertData(mesh, first.curve, meeting.a);
  const std::size_t inSecond = detail::insertData(mesh, second.curve, meeting.b);
  const bool isNewInFirst = first.curve.data.size() > before;
  const bool isNewInSecond = second.curve.data.size() > beforeSecond;
  for (auto& [line, isNew] : {std::pair(&first, isNewInFirst), {&second, isNewInSecond}}) {
    if (!isNew) continue;
    line->lastRound = round;
    line->isStale = true;
  }
  const SurfacePoint a = first.curve.data[inFirst], b = second.curve.data[inSecond];
  if (a == b) return {};
  if (isNewInSecond && detail::nudgeData(mesh, second.curve, inSecond, a)) return {};
  if (isNewInFirst && detail::nudgeData(mesh, first.curve, inFirst, b)) return {};
  return replaceEverywhere(sketch, lines, b, a, round);
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
  const auto pathOf = [](Line& line) -> const SurfacePath& {
    if (line.isStale) line.path = detail::pathOf(line.curve);
    line.isStale = false;
    return line.path;
  };
  // Until nothing changes any more: pairs of which one was changed since they were looked at.
  bool isSettled = false;
  for (int round = 1; round <= kMostRounds && !isSettled; ++round) {
    isSettled = true;
    for (std::size_t a = 0; a < lines.size(); ++a) {
      for (std::size_t b = a + 1; b < lines.size(); ++b) {
        Line &first = lines[a], &second = lines[b];
        if (std::max(first.lastRound, second.lastRound) + 1 < round) continue;
        const auto meetings = findMeetings(sketch.mesh(), pathOf(first), pathOf(second));
        for (const PathMeeting& meeting : meetings) {
          const Result<void> done = share(sketch, lines, first, second, meeting, round);
          if (!done) return done.error();
        }
        // Also where nothing had to be added the data points are the truth from now on.
        first.isMet = first.isMet || !meetings.empty();
        second.isMet = second.isMet || !meetings.empty();
      }
    }
    for (Line& line : lines) {
      if (line.lastRound < round) continue;
      isSettled = false;
      // As it will be read from its data points: also rounding moves the meetings of lines that run
      // along each other.
      detail::settle(sketch.linker(), sketch.mesh(), line.curve, detail::Links::All);
      line.isStale = true;
    }
  }
  for (const Line& line : lines) {
    const bool isNewlyPlaced = line.isMet && sketch.edit(line.id).dataPoints.empty();
    if (line.lastRound == 0 && !isNewlyPlaced) continue;
    sketch.store(line.id, line.curve);
    edited.curves.push_back(line.id);
  }
  edited.document = sketch.document();
  return edited;
}

}  // namespace toile
