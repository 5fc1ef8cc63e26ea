// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/edit/fair.h"

#include <algorithm>
#include <cmath>

#include "edit/parts.h"
#include "toile/curve/curvature.h"
#include "toile/edit/lines.h"

namespace toile {

using detail::Sketch;
using detail::WorkCurve;

namespace {

constexpr std::size_t kSourceSamples = 100;

/// Bends of a curve on the model that it comes from.
std::optional<int> sourceBends(Sketch& source, const std::string& id) {
  Result<WorkCurve> work = source.load(id);
  if (!work) return std::nullopt;
  const SurfacePath path = detail::pathOf(*work);
  return measureRestlessness(sampleCurvature(source.mesh(), path, kSourceSamples), path.closed)
      .inflections;
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
  std::optional<Sketch> source;
  if (options.source != nullptr) source.emplace(*options.source);

  FairNetwork network;
  std::vector<WorkCurve> work;
  const auto nodeOf = [&](const SurfacePoint& point, bool isFixed) {
    const auto found = std::find_if(network.nodes.begin(), network.nodes.end(),
                                    [&](const FairNode& node) { return node.point == point; });
    if (found != network.nodes.end()) {
      found->isFixed = found->isFixed || isFixed;
      return static_cast<std::size_t>(found - network.nodes.begin());
    }
    network.nodes.push_back({point, isFixed});
    return network.nodes.size() - 1;
  };
  for (const std::string& id : ids) {
    Result<WorkCurve> loaded = sketch.load(id);
    if (!loaded) return loaded.error();
    FairLine line;
    line.path = detail::pathOf(*loaded);
    line.start = line.end = options.ends;
    const std::vector<double> arcs = detail::arcsOf(mesh, *loaded);
    for (std::size_t i = 0; i < loaded->data.size(); ++i) {
      const ModelPoint here = toModelPoint(mesh, loaded->data[i]);
      bool isShared = false, isHeld = options.keepCrossings;
      for (const StylingCurve& other : sketch.design().curves) {
        if (other.id == id || std::find(other.dataPoints.begin(), other.dataPoints.end(), here) ==
                                  other.dataPoints.end()) {
          continue;
        }
        isShared = true;
        // A line that is not faired keeps its place, and with it the crossing.
        isHeld = isHeld || std::find(ids.begin(), ids.end(), other.id) == ids.end();
      }
      if (isShared) line.stops.push_back({arcs[i], nodeOf(loaded->data[i], isHeld)});
    }
    if (const auto given = options.inflections.find(id); given != options.inflections.end()) {
      line.inflections = given->second;
    } else if (source) {
      line.inflections = sourceBends(*source, id);
    }
    network.lines.push_back(std::move(line));
    work.push_back(*std::move(loaded));
  }
  Result<FairedNetwork> faired =
      fairNetwork(sketch.linker(), sketch.model().mesh, network, options.fairing);
  if (!faired) return faired.error();

  FairedDocument result;
  for (std::size_t l = 0; l < ids.size(); ++l) {
    const FairedLine& line = faired->lines[l];
    Result<WorkCurve> made =
        detail::makeWorkCurve(sketch.linker(), mesh, line.points, work[l].closed);
    if (!made) return made.error().during("curve \"" + ids[l] + "\"");
    // Control points go to the data points at the same fractions.
    const std::vector<double> before = detail::arcsOf(mesh, work[l]);
    const std::vector<double> after = detail::arcsOf(mesh, *made);
    const double all = before[work[l].linkCount()], now = after[made->linkCount()];
    for (std::size_t i = 0; i < work[l].data.size(); ++i) {
      if (!work[l].isControl[i]) continue;
      const double arc = before[i] / all * now;
      const auto next = std::lower_bound(
          after.begin(), after.begin() + static_cast<std::ptrdiff_t>(made->data.size()), arc);
      auto at = static_cast<std::size_t>(next - after.begin());
      if (at == made->data.size() || (at > 0 && arc - after[at - 1] < after[at] - arc)) --at;
      made->isControl[at] = true;
    }
    detail::markEnds(*made);
    sketch.store(ids[l], *made);
    result.curves.push_back({ids[l], line.wavelength, line.inflectionsBefore, line.inflectionsAfter,
                             line.variationBefore, line.variationAfter, line.deviation});
  }
  result.document = sketch.document();
  return result;
}

}  // namespace toile
