// SPDX-License-Identifier: GPL-3.0-or-later
// Parting, trimming, erasing and removing of curves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edit/parts.h"
#include "toile/curve/crossing.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::KeptPart;
using detail::Sketch;
using detail::WorkCurve;

namespace {

/// Parts shorter than this are not made, mm.
constexpr double kShortestPart = 1e-3;

/// Between neighbouring places; of a closed curve also from the last over the start to the first.
std::vector<KeptPart> partsBetween(std::vector<double> arcs, double all, bool closed) {
  std::sort(arcs.begin(), arcs.end());
  std::vector<double> cuts;
  for (const double arc : arcs) {
    const bool isAtEnd = !closed && (arc < kShortestPart || all - arc < kShortestPart);
    if (!isAtEnd && (cuts.empty() || arc - cuts.back() > kShortestPart)) cuts.push_back(arc);
  }
  if (closed && cuts.size() > 1 && cuts.front() + all - cuts.back() < kShortestPart)
    cuts.pop_back();
  std::vector<KeptPart> parts;
  if (cuts.empty()) return parts;
  if (closed) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      parts.push_back({cuts[i], i + 1 < cuts.size() ? cuts[i + 1] : cuts.front() + all});
    }
    return parts;
  }
  cuts.insert(cuts.begin(), 0);
  cuts.push_back(all);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) parts.push_back({cuts[i], cuts[i + 1]});
  return parts;
}

struct Loaded {
  std::string id;
  WorkCurve curve;
  double length = 0;
};

Result<Loaded> loadTarget(Sketch& sketch, const std::string& id) {
  const auto target = sketch.targetOf(id);
  if (!target) return target.error();
  Result<WorkCurve> work = sketch.load(target->id);
  if (!work) return work.error();
  const double all = detail::arcsOf(sketch.mesh(), *work)[work->linkCount()];
  return Loaded{target->id, *std::move(work), all};
}

Error notMet(const std::string& curve) {
  return {ErrorCode::CurveInvalid,
          fmt::format("curve \"{}\" does not meet any of the others within its length", curve),
          {Element::curve(curve)}};
}

/// Where the curve `id`, as it was named, meets the others; arcs are the same on a mirror image.
/// The meetings become data points of the others.
Result<std::vector<double>> meetings(Sketch& sketch, const std::string& id,
                                     std::span<const std::string> others) {
  Result<WorkCurve> mine = sketch.load(id);
  if (!mine) return mine.error();
  std::vector<double> arcs;
  for (const std::string& other : others) {
    if (other == id) continue;
    Result<WorkCurve> theirs = sketch.load(other);
    if (!theirs) return theirs.error();
    const auto found = findMeetings(sketch.mesh(), detail::pathOf(*mine), detail::pathOf(*theirs));
    for (const PathMeeting& meeting : found) {
      arcs.push_back(meeting.a);
      detail::insertData(sketch.mesh(), *theirs, meeting.b);
    }
    const auto target = sketch.targetOf(other);
    if (!found.empty() && target && !target->isMirrored) sketch.store(other, *theirs);
  }
  return arcs;
}

Result<Edited> finish(Sketch& sketch, const std::string& id, const WorkCurve& curve,
                      const std::vector<KeptPart>& parts) {
  Result<std::vector<std::string>> ids = detail::replaceByParts(sketch, id, curve, parts);
  if (!ids) return ids.error().during("curve \"" + id + "\"");
  return Edited{sketch.document(), *std::move(ids), {}};
}

}  // namespace

Result<Edited> splitCurve(const Document& document, const std::string& curve,
                          std::span<const double> at) {
  Sketch sketch(document);
  Result<Loaded> loaded = loadTarget(sketch, curve);
  if (!loaded) return loaded.error();
  std::vector<double> arcs;
  for (const double f : at) {
    if (const Result<double> checked = detail::checkedFraction(f); !checked) return checked.error();
    const double turned = loaded->curve.closed && f == 1 ? 0 : f;
    arcs.push_back(turned * loaded->length);
  }
  const std::vector<KeptPart> parts = partsBetween(arcs, loaded->length, loaded->curve.closed);
  if (parts.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 "a curve is parted between its ends; there is no such place here",
                 {Element::curve(curve)}};
  }
  return finish(sketch, loaded->id, loaded->curve, parts);
}

Result<Edited> splitAtCrossings(const Document& document, const std::string& curve,
                                std::span<const std::string> others) {
  Sketch sketch(document);
  const Result<std::vector<double>> arcs = meetings(sketch, curve, others);
  if (!arcs) return arcs.error();
  Result<Loaded> loaded = loadTarget(sketch, curve);
  if (!loaded) return loaded.error();
  const std::vector<KeptPart> parts = partsBetween(*arcs, loaded->length, loaded->curve.closed);
  if (parts.empty()) return notMet(curve);
  return finish(sketch, loaded->id, loaded->curve, parts);
}

Result<Edited> trimAtCrossings(const Document& document, const std::string& curve, double at,
                               std::span<const std::string> others) {
  if (const Result<double> checked = detail::checkedFraction(at); !checked) return checked.error();
  Sketch sketch(document);
  const Result<std::vector<double>> arcs = meetings(sketch, curve, others);
  if (!arcs) return arcs.error();
  Result<Loaded> loaded = loadTarget(sketch, curve);
  if (!loaded) return loaded.error();
  std::vector<KeptPart> parts = partsBetween(*arcs, loaded->length, loaded->curve.closed);
  const double arc = at * loaded->length;
  const bool wasMet = !parts.empty();
  const auto gone = std::find_if(parts.begin(), parts.end(), [&](const KeptPart& part) {
    return (arc >= part.from && arc <= part.to) ||
           (loaded->curve.closed && arc + loaded->length <= part.to);
  });
  if (!wasMet || gone == parts.end() || parts.size() < 2) return notMet(curve);
  // What is left on each side stays one curve.
  std::vector<KeptPart> left;
  if (loaded->curve.closed) {
    left.push_back({gone->to, gone->from + loaded->length});
    if (left[0].from >= loaded->length) left[0] = {left[0].from - loaded->length, gone->from};
  } else {
    if (gone->from > 0) left.push_back({0, gone->from});
    if (gone->to < loaded->length) left.push_back({gone->to, loaded->length});
  }
  return finish(sketch, loaded->id, loaded->curve, left);
}

Result<Edited> eraseStretch(const Document& document, const std::string& curve,
                            const Stretch& stretch) {
  for (const double f : {stretch.from, stretch.to}) {
    if (const Result<double> checked = detail::checkedFraction(f); !checked) return checked.error();
  }
  Sketch sketch(document);
  Result<Loaded> loaded = loadTarget(sketch, curve);
  if (!loaded) return loaded.error();
  const double all = loaded->length, from = stretch.from * all, to = stretch.to * all;
  std::vector<KeptPart> left;
  if (loaded->curve.closed) {
    if (std::abs(to - from) < kShortestPart) {
      return Error{ErrorCode::InvalidArgument, "the stretch to erase has no length", {}};
    }
    if (to > from && all - (to - from) > kShortestPart) left.push_back({to, from + all});
    if (to < from) left.push_back({to, from});
    if (!left.empty() && left[0].from >= all) left[0] = {left[0].from - all, left[0].to - all};
  } else {
    if (!(to - from > kShortestPart)) {
      return Error{ErrorCode::InvalidArgument, "the stretch to erase has no length", {}};
    }
    if (from > kShortestPart) left.push_back({0, from});
    if (all - to > kShortestPart) left.push_back({to, all});
  }
  if (left.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("nothing of curve \"{}\" would be left; remove it", curve),
                 {Element::curve(curve)}};
  }
  return finish(sketch, loaded->id, loaded->curve, left);
}

Result<Document> removeCurve(const Document& document, const std::string& curve) {
  Sketch sketch(document);
  if (const Result<void> removed = sketch.remove(curve); !removed) return removed.error();
  return sketch.document();
}

}  // namespace toile
