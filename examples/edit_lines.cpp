// SPDX-License-Identifier: GPL-3.0-or-later
// Editing lines with the engine: a stretch of a line is pulled on a body; an S-shaped disturbance
// is taken out of another. Writes the designs before and after, and tells what was measured.
//
//   edit_lines FOLDER
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "toile/core/file.h"
#include "toile/curve/crossing.h"
#include "toile/design/design_file.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/measure.h"
#include "toile/edit/shape.h"
#include "toile/shape/builtin.h"

namespace {

using namespace toile;
using Eigen::Vector3d;

constexpr const char* kBody = "builtin:body@1?size=EU38F";

template <class Value>
Value valueOf(Result<Value> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "edit_lines: %s\n", result.error().message.c_str());
  std::exit(1);
}

Document emptyDesign() {
  Design design;
  design.models.push_back({kBody, std::nullopt, std::nullopt, {}});
  return {std::make_shared<const Design>(design),
          std::make_shared<const ReferenceModel>(valueOf(makeBuiltinModel(kBody)))};
}

/// The point of the body's front at a width and a height.
SurfacePoint onFront(const Document& document, double x, double z) {
  const auto hit = document.model->index->firstVisibleHit({x, -1000, z}, {0, 1, 0});
  if (hit) return hit->point;
  std::fprintf(stderr, "edit_lines: nothing lies at %g, %g\n", x, z);
  std::exit(1);
}

Document drawn(const Document& document, const std::vector<SurfacePoint>& points,
               const NewCurve& curve, bool closed = false) {
  return valueOf(drawThrough(document, points, closed, curve)).document;
}

/// A small ring around a handle, so that it is seen.
Document ringed(Document document, const SurfacePoint& point, const std::string& id) {
  const Mesh& mesh = *document.model->mesh;
  const Vector3d middle = position(mesh, point);
  std::vector<SurfacePoint> ring;
  for (int k = 0; k < 8; ++k) {
    const double turn = std::numbers::pi * k / 4;
    ring.push_back(
        onFront(document, middle.x() + 5 * std::cos(turn), middle.z() + 5 * std::sin(turn)));
  }
  return drawn(document, ring, {id, "", CurveKind::Elastic}, true);
}

void write(const Document& document, const std::filesystem::path& folder, const std::string& name) {
  Design design = *document.design;
  design.name = name;
  const Result<void> written = writeFileWhole(folder / (name + ".toile"), writeDesign(design));
  if (written) return;
  std::fprintf(stderr, "edit_lines: %s\n", written.error().message.c_str());
  std::exit(1);
}

/// The article's figure 3: a stretch of a line from below the bust to the thigh is pulled to the
/// side.
void pullAStretch(const std::filesystem::path& folder) {
  const Document empty = emptyDesign();
  std::vector<SurfacePoint> points;
  for (const auto& [x, z] : {std::pair(66.0, 1175.0),
                             {67.0, 1135.0},
                             {70.0, 1090.0},
                             {75.0, 1045.0},
                             {82.0, 1000.0},
                             {89.0, 955.0},
                             {95.0, 905.0},
                             {98.0, 860.0}}) {
    points.push_back(onFront(empty, x, z));
  }
  const Document before = drawn(empty, points, {"line", "", CurveKind::Seam});
  const Stretch stretch{0.2, 0.8};
  const auto handles = valueOf(handlesOf(before, "line", stretch));
  const auto withHandles = [&](Document document) {
    const auto now = valueOf(handlesOf(document, "line", stretch));
    for (std::size_t i = 0; i < now.size(); ++i) {
      document = ringed(document, now[i].point, "handle-" + std::to_string(i));
    }
    return document;
  };
  write(withHandles(before), folder, "pull-before");

  const std::size_t taken = handles.size() / 2;
  CurveDrag drag = valueOf(CurveDrag::begin(before, "line", stretch, taken));
  const Vector3d start = position(*before.model->mesh, handles[taken].point);
  for (int i = 1; i <= 12; ++i) {
    const Result<void> moved = drag.moveTo(start + i * Vector3d(-2.5, 0, 0.5));
    if (!moved) std::fprintf(stderr, "edit_lines: %s\n", moved.error().message.c_str());
  }
  const Document after = valueOf(drag.document());
  // The line as it was, beside the new one.
  Design both = *after.design;
  StylingCurve old = before.design->curves.front();
  old.id = "before";
  old.kind = CurveKind::Feature;
  both.curves.push_back(old);
  write(withHandles({std::make_shared<const Design>(both), after.model}), folder, "pull-after");
}

/// The article's figure 12: a line over the hip with an S in it, as a transfer leaves it.
void takeOutAnS(const std::filesystem::path& folder) {
  const Document empty = emptyDesign();
  const auto line = [&](double amplitude) {
    std::vector<SurfacePoint> points;
    for (int k = 0; k <= 30; ++k) {
      const double t = k / 30.0, aside = (t - 0.5) / 0.16;
      const double s = amplitude * std::sin(2.2 * aside) * std::exp(-aside * aside);
      points.push_back(onFront(empty, -110 + 220 * t, 960 + 70 * t * t + s));
    }
    return points;
  };
  const Document plain = drawn(empty, line(0), {"line", "", CurveKind::Seam});
  const Document before = drawn(empty, line(16), {"line", "", CurveKind::Seam});
  const std::vector<std::string> ids{"line"};
  FairCurvesOptions options;
  options.source = &plain;
  const FairedDocument faired = valueOf(fairCurves(before, ids, options));
  const auto withMeant = [&](const Document& document) -> Document {
    Design both = *document.design;
    StylingCurve meant = plain.design->curves.front();
    meant.id = "undisturbed";
    meant.kind = CurveKind::Feature;
    both.curves.push_back(meant);
    return {std::make_shared<const Design>(both), document.model};
  };
  write(withMeant(before), folder, "fair-before");
  write(withMeant(faired.document), folder, "fair-after");

  const auto pathOf = [&](const Document& document) {
    GeodesicLinker linker(document.model->mesh);
    return valueOf(placeCurves(*document.design, *document.model, ids, linker)).front().path;
  };
  const Mesh& mesh = *empty.model->mesh;
  const SurfacePath meant = pathOf(plain);
  const auto offMeant = [&](const Document& document) {
    const SurfacePath path = pathOf(document);
    double farthest = 0;
    for (int i = 0; i <= 400; ++i) {
      const Vector3d place = position(mesh, pointAtFraction(mesh, path, i / 400.0));
      farthest = std::max(farthest, nearestOnPath(mesh, meant, place).distance);
    }
    return farthest;
  };
  const FairedCurve& told = faired.curves.front();
  const auto undisturbed = valueOf(fairCurves(plain, ids, options)).curves.front();
  std::printf("| | undisturbed | disturbed | faired |\n|---|---|---|---|\n");
  std::printf("| bends | %d | %d | %d |\n", undisturbed.inflectionsBefore, told.inflectionsBefore,
              told.inflectionsAfter);
  std::printf("| variation of geodesic curvature, 1/m | %.1f | %.1f | %.1f |\n",
              1000 * undisturbed.variationBefore, 1000 * told.variationBefore,
              1000 * told.variationAfter);
  std::printf("| farthest from the undisturbed line, mm | 0 | %.1f | %.1f |\n", offMeant(before),
              offMeant(faired.document));
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: edit_lines FOLDER\n");
    return 2;
  }
  pullAStretch(words[1]);
  takeOutAnS(words[1]);
  return 0;
}
