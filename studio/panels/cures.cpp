// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels/cures.h"

#include <QCoreApplication>
#include <algorithm>

#include "document/piece_edits.h"
#include "document/sheet_edits.h"
#include "toile/edit/lines.h"
#include "toile/pipeline/advice.h"

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(Cures)
};

QString nameOf(const Pattern& pattern, const std::string& id) {
  const auto piece = std::ranges::find(pattern.cut.pieces, id, &Piece::id);
  return QString::fromStdString(
      piece == pattern.cut.pieces.end() || piece->name.empty() ? id : piece->name);
}

std::vector<std::string> named(const std::vector<Element>& where, Element::Kind kind) {
  std::vector<std::string> names;
  for (const Element& element : where) {
    if (element.kind == kind) names.push_back(element.name);
  }
  return names;
}

Cure cutOpen(const std::string& piece) {
  return {Cure::Kind::CutOpen, Words::tr("Cut it open the shortest way"), {piece}};
}
Cure dartsThatOpen(const std::string& piece) {
  return {Cure::Kind::Darts, Words::tr("Look for darts that open it"), {piece}};
}
Cure leaveOut(const Pattern& pattern, const std::string& piece) {
  return {Cure::Kind::LeaveOut, Words::tr("Leave %1 out").arg(nameOf(pattern, piece)), {piece}};
}

/// Leaves pieces out of the pattern; those without a record get one.
std::optional<Document> without(const Document& document, const Pattern& pattern,
                                const std::vector<std::string>& pieces) {
  Document now = document;
  for (const std::string& piece : pieces) {
    const auto made =
        withPieceRecord(now, pattern, piece, [](PieceRecord& record) { record.include = false; });
    if (!made) return std::nullopt;
    now = *made;
  }
  return now;
}

}  // namespace

std::vector<Cure> curesOf(const Pattern& pattern, const std::string& code,
                          const std::vector<Element>& where) {
  const std::vector<std::string> pieces = named(where, Element::Kind::Piece);
  const std::vector<std::string> lines = named(where, Element::Kind::Curve);
  std::vector<Cure> cures;
  if (code == "unnamed-piece") {
    std::vector<std::string> all;  // the finding names some
    for (const Piece& piece : pattern.cut.pieces) {
      if (piece.recordIndices.empty() && piece.include) all.push_back(piece.id);
    }
    if (!all.empty()) {
      const QString label =
          Words::tr("Leave out what has no name (%n)", nullptr, static_cast<int>(all.size()));
      cures.push_back({Cure::Kind::LeaveOutNew, label, all});
    }
    return cures;
  }
  if (code == "hidden-curve" && !lines.empty()) {
    cures.push_back({Cure::Kind::RemoveLine, Words::tr("Remove the line"), {lines.front()}});
  }
  if (pieces.empty()) return cures;
  if (code == "tube-without-cut" || code == "handle-without-cut") {
    cures = {cutOpen(pieces.front()), leaveOut(pattern, pieces.front())};
  } else if (code == "closed-without-cut") {
    cures = {leaveOut(pattern, pieces.front())};
  } else if (code == "open-cut-end" && !lines.empty()) {
    cures.push_back({Cure::Kind::MakeDart, Words::tr("Make it a dart"), {lines.front()}});
  } else if (code == "two-anchors" && pieces.size() > 1) {
    cures.push_back({Cure::Kind::ForgetName,
                     Words::tr("One piece: %1").arg(nameOf(pattern, pieces.front())),
                     {pieces.begin() + 1, pieces.end()}});
  } else if (code == "layout-hand-overlap") {
    cures.push_back({Cure::Kind::BackInPlace, Words::tr("Put them back in their places"), pieces});
  } else if (code == "kept-apart") {
    cures = {dartsThatOpen(pieces.front())};
  } else if (code == "high-strain" || code == "over-limit") {
    cures.push_back({Cure::Kind::Darts, Words::tr("Look for darts"), {pieces.front()}});
    cures.push_back({Cure::Kind::Developable, Words::tr("Flatten the shape"), {pieces.front()}});
  }
  return cures;
}

std::vector<Cure> curesOf(const Pattern& pattern, std::size_t index, const Error& failure) {
  const Piece& piece = pattern.cut.pieces[index];
  if (!topology(piece).canLieFlat()) {
    if (topology(piece).boundaryLoops == 0) return {leaveOut(pattern, piece.id)};
    return {cutOpen(piece.id), leaveOut(pattern, piece.id)};
  }
  if (failure.code == ErrorCode::NotConverged) {
    return {dartsThatOpen(piece.id), leaveOut(pattern, piece.id)};
  }
  return {leaveOut(pattern, piece.id)};
}

void apply(Session& session, const Cure& cure) {
  const auto& pattern = session.fullPattern();
  if (!pattern || !session.isPatternCurrent()) {
    return session.tell(Words::tr("The pattern is being updated; ask again in a moment."));
  }
  const std::string& first = cure.about.front();
  const auto keep = [&](const QString& step, const Result<Document>& made) {
    if (!made) return session.tell(QString::fromStdString(made.error().message));
    session.commit(step, *made);
  };
  switch (cure.kind) {
    case Cure::Kind::Darts:
      session.select(Selection::piece(first));
      return session.openPanel(SidePanel::Darts, first);
    case Cure::Kind::Developable:
      session.select(Selection::piece(first));
      return session.openPanel(SidePanel::Developable, first);
    case Cure::Kind::CutOpen: {
      const auto index = session.pieceIndex(first);
      if (!index) return;
      const Result<Edited> made = withShortestCuts(*pattern, *index);
      if (!made) return session.tell(QString::fromStdString(made.error().message));
      session.commit(Words::tr("Cut %1 open").arg(nameOf(*pattern, first)), made->document);
      return session.select(Selection::line(made->curves.front()));
    }
    case Cure::Kind::LeaveOut:
    case Cure::Kind::LeaveOutNew: {
      const auto made = without(session.document(), *pattern, cure.about);
      if (!made) return;
      session.select({});
      return session.commit(cure.kind == Cure::Kind::LeaveOut
                                ? Words::tr("Leave out %1").arg(nameOf(*pattern, first))
                                : Words::tr("Leave out what has no name"),
                            *made);
    }
    case Cure::Kind::BackInPlace: {
      Document made = session.document();
      for (const std::string& piece : cure.about) made = withoutHand(made, piece);
      return session.commit(Words::tr("Put back %1").arg(nameOf(*pattern, first)), made);
    }
    case Cure::Kind::MakeDart:
      return keep(Words::tr("%1 becomes a dart").arg(QString::fromStdString(first)),
                  setCurveKind(session.document(), first, CurveKind::Dart));
    case Cure::Kind::RemoveLine:
      return keep(Words::tr("Delete %1").arg(QString::fromStdString(first)),
                  removeCurve(session.document(), first));
    case Cure::Kind::ForgetName: {
      Design design = *session.document().design;
      std::erase_if(design.pieces, [&](const PieceRecord& record) {
        return std::ranges::find(cure.about, record.id) != cure.about.end();
      });
      return session.commit(
          Words::tr("One piece, one name"),
          {std::make_shared<const Design>(std::move(design)), session.document().model});
    }
  }
}

}  // namespace toile::studio
