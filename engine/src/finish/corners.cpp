// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/corners.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

Corner cornerOf(const OutlineRun& before, CornerStyle styleBefore, const OutlineRun& next,
                CornerStyle styleNext) {
  Corner corner;
  const bool isSame = styleBefore == styleNext;
  for (const CornerStyle style : {CornerStyle::Mirrored, CornerStyle::Square}) {
    if (styleBefore != style && styleNext != style) continue;
    if (isSame && style == CornerStyle::Mirrored) return corner;  // two hems: neither rules
    corner.style = style;
    // Of two square sides the longer seam is sewn last.
    corner.byNext = isSame ? next.length > before.length : styleNext == style;
    return corner;
  }
  if (styleBefore == CornerStyle::Truncated || styleNext == CornerStyle::Truncated)
    corner.style = CornerStyle::Truncated;
  return corner;
}

}  // namespace

std::vector<std::vector<Corner>> planCorners(const SeamNet& net,
                                             const std::vector<std::vector<CornerStyle>>& styles) {
  std::vector<std::vector<Corner>> corners(net.pieces().size());
  for (std::size_t p = 0; p < corners.size(); ++p)
    corners[p].resize(net.pieces()[p].sew.runs.size());
  for (const RunId id : net.runs()) {
    const RunId before = net.previous(id);
    corners[id.piece][id.run] = cornerOf(net.at(before), styles[before.piece][before.run],
                                         net.at(id), styles[id.piece][id.run]);
  }
  for (const RunId id : net.runs()) {
    const auto mate = net.mate(id);
    if (!mate || net.at(id).folded) continue;
    // The end of this run is the begin of its mate.
    const RunId after = net.next(id);
    Corner& here = corners[after.piece][after.run];
    Corner& there = corners[mate->piece][mate->run];
    if (here.style != CornerStyle::Mitre || there.style != CornerStyle::Mitre) continue;
    const double own =
        cornerReach(net.pieces()[after.piece].sew, after.run, {.style = here.style}).before;
    const double other =
        cornerReach(net.pieces()[mate->piece].sew, mate->run, {.style = there.style}).next;
    if (own <= 0 || other <= 0 || std::abs(own - other) <= kCornerMatchMm) continue;
    here.reachBefore = there.reachNext = std::min(own, other);
  }
  return corners;
}

}  // namespace toile
