// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/merge.h"

#include <QCoreApplication>
#include <algorithm>

#include "document/piece_edits.h"
#include "toile/edit/lines.h"
#include "tools/drawing.h"
#include "tools/picking.h"

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Merge)
};

double areaOf(const Piece& piece) {
  double area = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) area += piece.mesh->area(FaceId(f));
  return area;
}

QString nameOf(const Piece& piece) {
  return QString::fromStdString(piece.name.empty() ? piece.id : piece.name);
}

/// The line and its linked twin, the twin first, since it has no points of its own.
std::vector<std::string> withTwin(const Design& design, const std::string& curve) {
  std::vector<std::string> ids{curve};
  for (const StylingCurve& each : design.curves) {
    if (each.mirrorOf == curve) ids.insert(ids.begin(), each.id);
    if (each.id == curve && each.mirrorOf) ids.push_back(*each.mirrorOf);
  }
  return ids;
}

}  // namespace

void mergeAlong(Session& session, const std::string& curve) {
  const auto& pattern = session.fullPattern();
  const PlacedLine* line = session.lines().find(curve);
  if (!pattern || !session.isPatternCurrent() || line == nullptr) return;
  if (refuseLocked(session, curve)) return;
  const std::vector<Piece>& pieces = pattern->cut.pieces;
  const std::string& onPiece = session.selection().onPiece;
  const auto idsOf = withTwin(*session.document().design, curve);

  // What lies on the two sides of the line, and of its twin.
  std::vector<std::pair<const Piece*, const Piece*>> pairs;
  const Wire* run = nullptr;
  const Piece* runOf = nullptr;
  for (const SeamMates& mates : pattern->cut.mates) {
    const Piece &a = pieces[mates.pieceA], &b = pieces[mates.pieceB];
    const std::string& of = a.wires[mates.wireA].curve;
    if (mates.pieceA == mates.pieceB || std::ranges::find(idsOf, of) == idsOf.end()) continue;
    pairs.emplace_back(&a, &b);
    if (of != curve || (a.id != onPiece && b.id != onPiece)) continue;
    run = a.id == onPiece ? &a.wires[mates.wireA] : &b.wires[mates.wireB];
    runOf = a.id == onPiece ? &a : &b;
  }
  if (pairs.empty()) return session.tell(Words::tr("No two pieces are sewn together along it."));

  Document document = session.document();
  std::vector<std::pair<const Piece*, const Piece*>> merged = pairs;
  const bool isPart = run != nullptr && pairs.size() > 2;
  if (isPart) {
    // The stretch between the crossings on either side of the run that was pointed at.
    const VertexId middle = run->vertices[run->vertices.size() / 2];
    const LinePick place = nearestOnLine(session, *line, runOf->mesh->position(middle));
    const Result<Edited> made =
        trimAtCrossings(document, curve, place.fraction, othersThan(session, curve));
    if (!made) return session.tell(QString::fromStdString(made.error().message));
    document = made->document;
    std::erase_if(merged, [&](const auto& pair) {
      return pair.first->id != onPiece && pair.second->id != onPiece;
    });
  } else {
    for (const std::string& id : idsOf) {
      const Result<Document> made = removeCurve(document, id);
      if (!made) return session.tell(QString::fromStdString(made.error().message));
      document = *made;
    }
  }
  // One name for what is one piece now: that of the larger.
  Design design = *document.design;
  QString names;
  for (const auto& [a, b] : merged) {
    const Piece& lesser = areaOf(*a) < areaOf(*b) ? *a : *b;
    if (recordOf(design, a->id) != nullptr && recordOf(design, b->id) != nullptr) {
      std::erase_if(design.pieces, [&](const PieceRecord& r) { return r.id == lesser.id; });
      std::erase_if(design.layout, [&](const HandPlacement& h) { return h.piece == lesser.id; });
    }
    if (names.isEmpty()) names = Words::tr("%1 and %2").arg(nameOf(*a), nameOf(*b));
  }
  session.select({});
  session.commit(Words::tr("Merge %1").arg(names),
                 {std::make_shared<const Design>(std::move(design)), document.model});
}

}  // namespace toile::studio
