// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/fair.h"

#include <algorithm>
#include <cmath>

#include "curve/bends.h"
#include "edit/nodes.h"
#include "edit/parts.h"
#include "toile/curve/curvature.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;

namespace {

std::vector<double> cornersOf(const WorkCurve& curve, const std::vector<double>& arcs) {
  std::vector<double> corners;
  for (std::size_t i = 0; i < curve.data.size(); ++i) {
    if (curve.isCorner[i]) corners.push_back(arcs[i]);
  }
  return corners;
}

/// Bends of a curve on the model that it comes from; none are known where it cannot be placed.
std::optional<int> sourceBends(Sketch& source, const std::string& id) {
  const Result<WorkCurve> work = source.load(id);
  if (!work) return std::nullopt;
  const SurfacePath path = detail::pathOf(*work);
  const std::vector<double> arcs = detail::arcsOf(source.mesh(), *work);
  const std::size_t count = detail::evenSampleCount(source.mesh(), arcs[work->linkCount()]);
  return measureRestlessness(sampleCurvature(source.mesh(), path, count), path.closed,
                             Angle::degrees(3), cornersOf(*work, arcs))
      .inflections;
}

/// The network of the curves that are faired, and what it was made from.
struct Drawing {
  std::vector<std::string> ids;
  std::vector<WorkCurve> work;
  FairNetwork network;
};

std::size_t nodeAt(FairNetwork& network, const SurfacePoint& point, bool isFixed) {
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    if (!(network.nodes[i].point == point)) continue;
    network.nodes[i].isFixed = network.nodes[i].isFixed || isFixed;
    return i;
  }
  network.nodes.push_back({point, isFixed});
  return network.nodes.size() - 1;
}

Result<Drawing> drawingOf(Sketch& sketch, const std::vector<std::string>& ids,
                          const FairCurvesOptions& options) {
  const Mesh& mesh = sketch.mesh();
  const detail::DataPoints points(sketch.design());
  std::optional<Sketch> source;
  if (options.source != nullptr) source.emplace(*options.source);
  Drawing drawing{ids, {}, {}};
  for (const std::string& id : ids) {
    Result<WorkCurve> loaded = sketch.load(id);
    if (!loaded) return loaded.error();
    FairLine line;
    line.path = detail::pathOf(*loaded);
    // The halves of a symmetric line meet square to the middle: that stays so.
    const bool isHalf = !sketch.imagesOf(id).empty();
    line.start = line.end = isHalf ? FairEnd::Clamped : options.ends;
    const std::vector<double> arcs = detail::arcsOf(mesh, *loaded);
    for (std::size_t i = 0; i < loaded->data.size(); ++i) {
      const bool isCorner = loaded->isCorner[i];
      bool isShared = false, isHeld = options.keepCrossings;
      for (const std::size_t c : points.curvesAt(toModelPoint(mesh, loaded->data[i]))) {
        const std::string& other = sketch.design().curves[c].id;
        if (other == id) continue;
        isShared = true;
        // A line that is not faired keeps its place, and with it the crossing.
        isHeld = isHeld || std::find(ids.begin(), ids.end(), other) == ids.end();
      }
      if (!isShared && !isCorner) continue;
      const std::size_t node =
          nodeAt(drawing.network, loaded->data[i], isShared ? isHeld : isCorner);
      line.stops.push_back({arcs[i], node, isCorner});
    }
    if (const auto given = options.inflections.find(id); given != options.inflections.end()) {
      line.inflections = given->second;
    } else if (source) {
      line.inflections = sourceBends(*source, id);
    }
    drawing.network.lines.push_back(std::move(line));
    drawing.work.push_back(*std::move(loaded));
  }
  return drawing;
}

/// Ripples let two lines meet several times where they were meant to cross once, and would be held
/// up by those crossings. Of three and more within reach of each other along both lines the middle
/// one is kept, or the outer two: the lines change sides as before. Corners stay.
void thinCrossings(FairNetwork& network, double reach) {
  const std::size_t nodes = network.nodes.size();
  std::vector<std::vector<std::size_t>> linesOfNode(nodes);
  for (std::size_t l = 0; l < network.lines.size(); ++l) {
    for (const FairLine::Stop& stop : network.lines[l].stops) {
      auto& lines = linesOfNode[stop.node];
      if (lines.empty() || lines.back() != l) lines.push_back(l);
    }
  }
  std::vector<bool> isGone(nodes, false);
  for (std::size_t a = 0; a < network.lines.size(); ++a) {
    for (std::size_t b = a + 1; b < network.lines.size(); ++b) {
      struct Crossing {
        double onA, onB;
        std::size_t node;
      };
      std::vector<Crossing> row;
      for (const FairLine::Stop& onA : network.lines[a].stops) {
        if (linesOfNode[onA.node] != std::vector<std::size_t>{a, b} || onA.isCorner) continue;
        for (const FairLine::Stop& onB : network.lines[b].stops) {
          if (onB.node == onA.node && !onB.isCorner) row.push_back({onA.arc, onB.arc, onA.node});
        }
      }
      std::sort(row.begin(), row.end(),
                [](const Crossing& p, const Crossing& q) { return p.onA < q.onA; });
      for (std::size_t from = 0; from < row.size();) {
        std::size_t to = from + 1;
        while (to < row.size() && row[to].onA - row[to - 1].onA < reach &&
               std::abs(row[to].onB - row[to - 1].onB) < reach) {
          ++to;
        }
        const std::size_t count = to - from;
        for (std::size_t i = 0; i < count && count > 2; ++i) {
          const bool isKept = count % 2 == 1 ? i == count / 2 : i == 0 || i + 1 == count;
          isGone[row[from + i].node] = !isKept;
        }
        from = to;
      }
    }
  }
  for (FairLine& line : network.lines) {
    std::erase_if(line.stops, [&](const FairLine::Stop& stop) { return isGone[stop.node]; });
  }
}

/// The data points of a faired curve become controls where its controls were, by fraction; corners
/// are found again by their nodes.
void carryControls(const Mesh& mesh, const WorkCurve& old, const FairLine& line,
                   const std::vector<SurfacePoint>& nodes, WorkCurve& made) {
  const std::vector<double> before = detail::arcsOf(mesh, old);
  const std::vector<double> after = detail::arcsOf(mesh, made);
  const double all = before[old.linkCount()], now = after[made.linkCount()];
  for (std::size_t i = 0; i < old.data.size(); ++i) {
    if (!old.isControl[i] || old.isCorner[i]) continue;
    const double arc = before[i] / all * now;
    const auto next = std::lower_bound(
        after.begin(), after.begin() + static_cast<std::ptrdiff_t>(made.data.size()), arc);
    auto at = static_cast<std::size_t>(next - after.begin());
    if (at == made.data.size() || (at > 0 && arc - after[at - 1] < after[at] - arc)) --at;
    made.isControl[at] = true;
  }
  for (const FairLine::Stop& stop : line.stops) {
    if (!stop.isCorner) continue;
    const auto found = std::find(made.data.begin(), made.data.end(), nodes[stop.node]);
    if (found == made.data.end()) continue;
    const auto at = static_cast<std::size_t>(found - made.data.begin());
    made.isControl[at] = made.isCorner[at] = true;
  }
  detail::markEnds(made);
}

}  // namespace

Result<FairedDocument> fairCurves(const Document& document, std::span<const std::string> curves,
                                  const FairCurvesOptions& options) {
  // Crossings become data points of both lines first.
  Result<Edited> shared = shareCrossings(document, {});
  if (!shared) return shared.error();
  Sketch sketch(shared->document);
  const Mesh& mesh = sketch.mesh();
  std::vector<std::string> ids;
  for (const std::string& id : curves) {
    const auto target = sketch.targetOf(id);
    if (!target) return target.error();
    if (std::find(ids.begin(), ids.end(), target->id) == ids.end()) ids.push_back(target->id);
  }
  Result<Drawing> drawing = drawingOf(sketch, ids, options);
  if (!drawing) return drawing.error();
  FairNetwork& network = drawing->network;
  if (!options.keepCrossings) thinCrossings(network, options.fairing.maxDeviation.mm());
  Result<FairedNetwork> faired =
      fairNetwork(sketch.linker(), sketch.model().mesh, network, options.fairing);
  if (!faired) return faired.error();

  FairedDocument result;
  for (std::size_t l = 0; l < ids.size(); ++l) {
    const FairedLine& line = faired->lines[l];
    const WorkCurve& old = drawing->work[l];
    Result<WorkCurve> made = detail::makeWorkCurve(sketch.linker(), mesh, line.points, old.closed);
    if (!made) return made.error().during("curve \"" + ids[l] + "\"");
    carryControls(mesh, old, network.lines[l], faired->nodes, *made);
    sketch.store(ids[l], *made);
    result.curves.push_back({ids[l], line.wavelength, line.inflectionsBefore, line.inflectionsAfter,
                             line.variationBefore, line.variationAfter, line.deviation});
  }
  // Where lines cross anew, or cross those that stay elsewhere.
  Result<Edited> again = shareCrossings(sketch.document(), {});
  if (!again) return again.error();
  result.document = std::move(again->document);
  result.findings = std::move(again->findings);
  return result;
}

}  // namespace toile
