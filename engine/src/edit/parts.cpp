// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit/parts.h"

#include <algorithm>
#include <cmath>

namespace toile::detail {

void markEnds(WorkCurve& curve) {
  if (curve.closed || curve.data.empty()) return;
  curve.isControl.front() = curve.isControl.back() = true;
  curve.isCorner.front() = curve.isCorner.back() = false;
}

Result<void> storeAndMove(Sketch& sketch, const std::string& id, const WorkCurve& curve,
                          const Sketch::Moving& moving) {
  if (const Result<void> moved = sketch.moveHangers(id, moving); !moved) return moved;
  for (const std::string& image : sketch.imagesOf(id)) {
    if (const Result<void> moved = sketch.moveHangers(image,
                                                      [&](double f) {
                                                        std::optional<Sketch::Moved> to = moving(f);
                                                        if (to) to->id = image;
                                                        return to;
                                                      });
        !moved) {
      return moved;
    }
    sketch.edit(image).closed = curve.closed;
  }
  sketch.store(id, curve);
  return {};
}

Result<std::vector<std::string>> replaceByParts(Sketch& sketch, const std::string& id,
                                                const WorkCurve& old,
                                                const std::vector<KeptPart>& parts) {
  const Mesh& mesh = sketch.mesh();
  const double all = arcsOf(mesh, old)[old.linkCount()];
  std::vector<WorkCurve> made;
  for (const KeptPart& part : parts) {
    WorkCurve whole = old;
    std::size_t to = insertData(mesh, whole, part.to);
    const SurfacePoint last = whole.data[to];
    const std::size_t from = insertData(mesh, whole, part.from);
    const auto found = std::find(whole.data.begin(), whole.data.end(), last);
    if (!(whole.data[to] == last)) to = static_cast<std::size_t>(found - whole.data.begin());
    if (!whole.closed && to <= from) {
      return Error{ErrorCode::CurveInvalid, "a part without length would be left", {}};
    }
    made.push_back(partOf(whole, from, to));
    markEnds(made.back());
  }
  // Names first, so that hangers can be told where they go.
  std::vector<std::string> ids{id};
  const std::vector<std::string> images = sketch.imagesOf(id);
  std::vector<std::vector<std::string>> imageIds;
  for (const std::string& image : images) imageIds.push_back({image});
  for (std::size_t p = 1; p < parts.size(); ++p) {
    ids.push_back(sketch.addBeside(ids.back(), sketch.freeId(id + "-" + std::to_string(p + 1))));
    for (std::size_t m = 0; m < images.size(); ++m) {
      const std::string beside = sketch.addBeside(
          imageIds[m].back(), sketch.freeId(images[m] + "-" + std::to_string(p + 1)));
      imageIds[m].push_back(beside);
    }
  }
  const auto movingTo = [&](const std::vector<std::string>& names) {
    return [&, names](double fraction) -> std::optional<Sketch::Moved> {
      for (std::size_t p = 0; p < parts.size(); ++p) {
        for (const double turn : {0.0, all}) {
          const double arc = fraction * all + turn;
          if (turn > 0 && !old.closed) break;
          if (arc < parts[p].from || arc > parts[p].to) continue;
          return Sketch::Moved{names[p], (arc - parts[p].from) / (parts[p].to - parts[p].from)};
        }
      }
      return std::nullopt;
    };
  };
  if (const Result<void> moved = sketch.moveHangers(id, movingTo(ids)); !moved) {
    return moved.error();
  }
  for (std::size_t m = 0; m < images.size(); ++m) {
    if (const Result<void> moved = sketch.moveHangers(images[m], movingTo(imageIds[m])); !moved) {
      return moved.error();
    }
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    sketch.store(ids[p], made[p]);
    for (std::vector<std::string>& names : imageIds) {
      StylingCurve& image = sketch.edit(names[p]);
      image.mirrorOf = ids[p];
      image.closed = false;
      image.dataPoints.clear();
      image.way = SmoothWay{};
    }
  }
  return ids;
}

}  // namespace toile::detail
