// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/surface_random.h"
#include "toile/edit/draw.h"
#include "toile/edit/fair.h"
#include "toile/edit/lines.h"
#include "toile/edit/shape.h"
#include "toile/edit/symmetry.h"

namespace toile::test {

/// What a designer may do next, at random: every edit of the engine, on lines of a model. Some are
/// refused; that must leave the document as it was.
class RandomEdits {
 public:
  RandomEdits(const ReferenceModel& model, unsigned seed)
      : random_(*model.mesh, seed), size_((model.mesh->boxMax() - model.mesh->boxMin()).norm()) {
    view_.target = 0.5 * (model.mesh->boxMax() + model.mesh->boxMin());
    view_.eye = view_.target - Eigen::Vector3d(0, 4 * size_, 0);
    view_.height = size_;
    view_.perspective = false;
  }

  struct Step {
    std::string name;
    Result<Document> document;
    std::string curve{};  ///< that was pulled
  };
  Step next(const Document& document) {
    const auto of = [](std::string name, Result<Edited> edited) -> Step {
      if (!edited) return {std::move(name), edited.error()};
      return {std::move(name), edited->document};
    };
    const std::size_t curves = document.design->curves.size();
    if (curves == 0) return of("draw", draw(document));
    const std::string a = document.design->curves[random_.below(curves)].id;
    const std::string b = document.design->curves[random_.below(curves)].id;
    const double f = random_.number(), g = random_.number();
    const std::vector<std::string> one{a}, other{b};
    const std::size_t choice = random_.below(curves < 3 ? 34 : curves > 9 ? 30 : 32);
    if (choice >= 30) return of("draw", draw(document));
    switch (choice) {
      case 0:
        return of("split", splitCurve(document, a, std::vector<double>{f}));
      case 1:
        return of("split at crossings", splitAtCrossings(document, a, other));
      case 2:
        return of("trim", trimAtCrossings(document, a, f, other));
      case 3:
        return of("erase", eraseStretch(document, a, {std::min(f, g), std::max(f, g)}));
      case 4:
      case 5:
        return {"remove", curves > 5 ? removeCurve(document, a) : reverseCurve(document, a)};
      case 6:
        return {"join", joinCurves(document, a, b)};
      case 7:
        return {"close", closeCurve(document, a)};
      case 8:
        return {"extend", extendToCurve(document, a, f < 0.5 ? CurveEnd::Start : CurveEnd::End, b)};
      case 9:
        return of("offset", offsetCurve(document, a, Length::mm(0.02 * size_ * (f - 0.5))));
      case 10: {
        const SurfacePoint from = somePoint(document, a);
        return {"move", moveCurve(document, a, from, beside(document, from, 0.03))};
      }
      case 11:
        return {"reverse", reverseCurve(document, a)};
      case 12:
        return {"kind", setCurveKind(document, a, static_cast<CurveKind>(random_.below(7)))};
      case 13:
      case 14:
        return of("share", shareCrossings(document));
      case 15:
        return of("mirror", mirrorCurves(document, one, f < 0.7));
      case 16:
        return {"unlink", unlinkMirror(document, a)};
      case 17:
        return of("symmetric", makeSymmetric(document, a, f < 0.5 ? Side::Left : Side::Right));
      case 18: {
        Result<FairedDocument> faired = fairCurves(document, f < 0.5 ? one : other);
        if (!faired) return {"fair", faired.error()};
        return {"fair", faired->document};
      }
      case 19:
        return {"insert", insertControl(document, a, f)};
      case 20:
        return {"remove control", removeControl(document, a, f, Length::mm(0.05 * size_))};
      case 21:
        return of("dart", drawDart(document, a, random_.point()));
      case 22:
        return of("go on", continueStroke(document, a, view_, stroke(document, a)));
      case 23:
        return of("draw over", drawOver(document, a, view_, stroke(document, a)));
      default:
        return {"drag", drag(document, a, f, g), a};
    }
  }

 private:
  SurfacePoint somePoint(const Document& document, const std::string& curve) {
    const auto handles = handlesOf(document, curve);
    if (!handles || handles->empty()) return random_.point();
    return (*handles)[random_.below(handles->size())].point;
  }
  SurfacePoint beside(const Document& document, const SurfacePoint& point, double part) {
    Eigen::Vector3d way(random_.number() - 0.5, random_.number() - 0.5, random_.number() - 0.5);
    const Eigen::Vector3d p = position(*document.model->mesh, point);
    return document.model->index->closestPoint(p + 2 * part * size_ * way).point;
  }
  Result<Edited> draw(const Document& document) {
    const SurfacePoint start = random_.point();
    std::vector<SurfacePoint> points{start};
    const std::size_t count = 2 + random_.below(4);
    while (points.size() < count) points.push_back(beside(document, points.back(), 0.08));
    switch (random_.below(7)) {
      case 5:
        return drawStroke(document, view_,
                          strokeFrom(screen(position(*document.model->mesh, start))));
      case 6: {
        const Mesh& mesh = *document.model->mesh;
        std::vector<VertexId> vertices;
        for (const SurfacePoint& point : points) {
          vertices.push_back(mesh.vertices(facesOf(mesh, point).front())[0]);
        }
        return drawAlongEdges(document, vertices);
      }
      case 0:
        return drawGirth(document, start,
                         {random_.number() - 0.5, random_.number() - 0.5, random_.number()});
      case 1:
        return drawShortest(document, points);
      case 2:
        return drawThrough(document, points, points.size() > 3);
      default:
        return drawThrough(document, points, false);
    }
  }
  Result<Document> drag(const Document& document, const std::string& curve, double f, double g) {
    Stretch stretch{std::min(f, g), std::max(f, g)};
    if (random_.below(3) == 0) stretch = {0, 1};
    const auto handles = handlesOf(document, curve, stretch);
    if (!handles) return handles.error();
    if (handles->empty()) return insertControl(document, curve, f);
    const std::size_t handle = random_.below(handles->size());
    Result<CurveDrag> drag = CurveDrag::begin(document, curve, stretch, handle);
    if (!drag) return drag.error();
    Eigen::Vector3d place = position(*document.model->mesh, (*handles)[handle].point);
    for (int i = 0; i < 2; ++i) {
      place +=
          0.04 * size_ *
          Eigen::Vector3d(random_.number() - 0.5, random_.number() - 0.5, random_.number() - 0.5);
      if (const Result<void> moved = drag->moveTo(place); !moved) return moved.error();
    }
    return drag->document();
  }

  /// Where a place appears to an eye far in front of the model.
  Eigen::Vector2d screen(const Eigen::Vector3d& place) const {
    return {place.x() - view_.target.x(), place.z() - view_.target.z()};
  }
  /// A trembling stroke from there.
  std::vector<StrokeSample> strokeFrom(Eigen::Vector2d at) {
    std::vector<StrokeSample> samples;
    double direction = 2 * std::numbers::pi * random_.number();
    const double turn = random_.number() - 0.5, step = 0.004 * size_;
    for (int i = 0; i < 40; ++i) {
      samples.push_back({at, 0.01 * i, 1});
      direction += 0.2 * turn + 0.2 * (random_.number() - 0.5);
      at += step * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    }
    return samples;
  }
  std::vector<StrokeSample> stroke(const Document& document, const std::string& curve) {
    return strokeFrom(screen(position(*document.model->mesh, somePoint(document, curve))));
  }

  SurfaceRandom random_;
  double size_;
  View view_;
};

}  // namespace toile::test
