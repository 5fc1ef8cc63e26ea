// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/drawing.h"

#include <QCoreApplication>
#include <algorithm>
#include <limits>
#include <set>

#include "toile/curve/geodesic.h"
#include "toile/edit/shape.h"
#include "toile/edit/symmetry.h"

namespace toile::studio {

using Eigen::Vector3d;

namespace {

/// mm on both sides from which a line runs across the middle, and not beside it.
constexpr double kAcross = 5;

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Drawing)
};

const StylingCurve* findCurve(const Design& design, const std::string& id) {
  const auto found =
      std::ranges::find_if(design.curves, [&](const StylingCurve& c) { return c.id == id; });
  return found == design.curves.end() ? nullptr : &*found;
}

/// How far a line reaches to the right (negative) and to the left of the middle, mm.
struct Reach {
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
};
Reach reachOf(const Design& design, const StylingCurve& curve, const ReferenceModel& model) {
  const std::vector<std::string> ids{curve.id};
  GeodesicLinker linker(model.mesh);
  // A dart has no points of its own: where it runs only placing tells.
  const Result<std::vector<PlacedCurve>> placed = placeCurves(design, model, ids, linker);
  Reach reach;
  if (!placed) return reach;
  for (const SurfacePoint& point : placed->front().dataPoints) {
    const double side =
        model.symmetry->normal.dot(position(*model.mesh, point)) - model.symmetry->offset;
    reach.least = std::min(reach.least, side);
    reach.most = std::max(reach.most, side);
  }
  return reach;
}

}  // namespace

QString kindWord(CurveKind kind) {
  switch (kind) {
    case CurveKind::Seam:
      return Words::tr("Seam");
    case CurveKind::Opening:
      return Words::tr("Opening");
    case CurveKind::Feature:
      return Words::tr("Feature");
    case CurveKind::Elastic:
      return Words::tr("Elastic");
    case CurveKind::Dart:
      return Words::tr("Dart");
    case CurveKind::Mark:
      return Words::tr("Mark");
    case CurveKind::Guide:
      return Words::tr("Guide");
  }
  return {};
}

NewCurve nextCurve(const ToolHost& host, CurveKind kind) {
  std::set<std::string> names;
  for (const StylingCurve& curve : host.document().design->curves) names.insert(curve.name);
  NewCurve next;
  next.kind = kind;
  for (int number = 1;; ++number) {
    next.name = QStringLiteral("%1 %2").arg(kindWord(kind)).arg(number).toStdString();
    if (!names.contains(next.name)) return next;
  }
}

NewCurve nextCurve(const ToolHost& host) {
  return nextCurve(host, host.options().kind);
}

Document withTwins(ToolHost& host, const Edited& drawn) {
  const ReferenceModel& model = *drawn.document.model;
  Document document = drawn.document;
  if (!host.options().symmetry || !model.symmetry) return document;
  for (const std::string& id : drawn.curves) {
    const StylingCurve* curve = findCurve(*document.design, id);
    if (curve == nullptr || curve->mirrorOf) continue;
    const Reach reach = reachOf(*document.design, *curve, model);
    if (reach.most < kAcross && reach.least > -kAcross) continue;  // on the middle
    const bool isAcross = reach.most > kAcross && reach.least < -kAcross;
    if (isAcross && curve->closed) continue;
    const std::vector<std::string> ids{id};
    const Result<Edited> made =
        isAcross ? makeSymmetric(document, id, reach.most > -reach.least ? Side::Left : Side::Right)
                 : mirrorCurves(document, ids, /*linked=*/true);
    if (made) {
      document = made->document;
    } else {
      host.tell(QString::fromStdString(made.error().message));
    }
  }
  return document;
}

QString titleOf(const ToolHost& host, const std::string& id) {
  const PlacedLine* line = host.lines().find(id);
  return QString::fromStdString(line == nullptr ? id : line->title());
}

std::vector<std::string> othersThan(const ToolHost& host, const std::string& curve) {
  std::vector<std::string> ids;
  for (const StylingCurve& each : host.document().design->curves) {
    if (each.id != curve) ids.push_back(each.id);
  }
  return ids;
}

bool isLocked(const ToolHost& host, const std::string& curve) {
  const StylingCurve* found = findCurve(*host.document().design, curve);
  return found != nullptr && found->unknown.contains("locked");
}

bool refuseLocked(ToolHost& host, const std::string& curve) {
  if (!isLocked(host, curve)) return false;
  host.tell(Words::tr("%1 is locked; unlock it in the panel.").arg(titleOf(host, curve)));
  return true;
}

void showEdit(ToolHost& host, const Result<Edited>& made) {
  if (made) {
    host.preview(withTwins(host, *made), /*withPattern=*/false);
  } else {
    host.dropPreview();
  }
}

void keepEdit(ToolHost& host, const QString& step, const Result<Edited>& made) {
  host.dropPreview();
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  const Document document = withTwins(host, *made);
  host.commit(step, document);
  if (!made->curves.empty()) host.select(Selection::line(made->curves.front()));
}

void keepEdit(ToolHost& host, const QString& step, const Result<Document>& made) {
  host.dropPreview();
  if (!made) return host.tell(QString::fromStdString(made.error().message));
  host.commit(step, *made);
}

Document withEndAt(const Document& document, const std::string& curve, bool atStart,
                   const SurfacePoint& place) {
  const Result<std::vector<Handle>> handles = handlesOf(document, curve);
  if (!handles || handles->size() < 2) return document;
  const Result<Document> moved =
      moveHandle(document, curve, {}, atStart ? 0 : handles->size() - 1, place);
  return moved ? *moved : document;
}

std::vector<std::string> newLines(const Document& before, const Document& after) {
  std::vector<std::string> ids;
  for (const StylingCurve& curve : after.design->curves) {
    const StylingCurve* known = findCurve(*before.design, curve.id);
    if (known == nullptr || !(*known == curve)) ids.push_back(curve.id);
  }
  return ids;
}

}  // namespace toile::studio
