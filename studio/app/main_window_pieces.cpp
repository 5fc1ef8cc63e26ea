// SPDX-License-Identifier: GPL-3.0-or-later
// The commands that are about a piece of the pattern.
#include <QActionGroup>
#include <algorithm>

#include "app/main_window.h"
#include "document/merge.h"
#include "document/piece_edits.h"
#include "document/sheet_edits.h"

namespace toile::studio {

void MainWindow::withPiece(const std::function<void(const std::string&)>& act) {
  if (!session_.hasWork()) return;
  if (session_.selection().kind == Selection::Kind::Piece) return act(session_.selection().id);
  showMessage(tr("Click a piece first, on the body or in the pattern."));
}

void MainWindow::makePieceActions() {
  actions_.add("darts", tr("&Darts…"), "dart", QKeySequence(), [this] {
    withPiece([this](const std::string& piece) { session_.openPanel(SidePanel::Darts, piece); });
  });
  actions_.add("developable", tr("F&latten the shape…"), "fair", QKeySequence(), [this] {
    withPiece(
        [this](const std::string& piece) { session_.openPanel(SidePanel::Developable, piece); });
  });
  actions_.add("fabrics", tr("&Fabrics…"), "settings", QKeySequence(), [this] {
    if (!session_.hasWork()) return;
    const bool isPiece = session_.selection().kind == Selection::Kind::Piece;
    session_.openPanel(SidePanel::Fabrics, isPiece ? session_.selection().id : std::string());
  });
  actions_.add("include", tr("&Leave out or take in"), "eye", QKeySequence(), [this] {
    withPiece([this](const std::string& piece) {
      const auto& pattern = session_.pattern();
      if (!pattern) return;
      bool on = false;
      const auto made =
          withPieceRecord(session_.document(), *pattern, piece, [&on](PieceRecord& record) {
            record.include = !record.include;
            on = record.include;
          });
      if (!made) return;
      const QString name = QString::fromStdString(piece);
      session_.commit((on ? tr("Take in %1") : tr("Leave out %1")).arg(name), *made);
    });
  });
  actions_.add("merge", tr("&Merge the pieces beside a seam"), "", QKeySequence(), [this] {
    if (!session_.hasWork()) return;
    if (session_.selection().kind != Selection::Kind::Line) {
      return showMessage(tr("Click the seam between the two pieces first."));
    }
    mergeAlong(session_, session_.selection().id);
  });
  actions_.add("back-in-place", tr("Put &back in its place"), "undo", QKeySequence(), [this] {
    withPiece([this](const std::string& piece) {
      const auto& layout = session_.document().design->layout;
      if (std::ranges::find(layout, piece, &HandPlacement::piece) == layout.end()) {
        return showMessage(tr("No hand has moved it."));
      }
      session_.commit(tr("Put back %1").arg(QString::fromStdString(piece)),
                      withoutHand(session_.document(), piece));
    });
  });
  auto* group = new QActionGroup(this);
  const std::tuple<const char*, QString, PieceColours> colours[] = {
      {"colour-fabric", tr("Colour by fa&bric"), PieceColours::Fabric},
      {"colour-piece", tr("Colour by p&iece"), PieceColours::Piece}};
  for (const auto& [id, text, which] : colours) {
    QAction* action =
        actions_.addToggle(id, text, "", QKeySequence(), [this, which = which](bool on) {
          if (on) session_.setPieceColours(which);
        });
    group->addAction(action);
  }
  actions_["colour-fabric"]->setIconText(tr("Fabric"));
  actions_["colour-piece"]->setIconText(tr("Piece"));
  actions_["colour-fabric"]->setChecked(true);
  for (const char* id : {"darts", "developable", "fabrics", "include", "merge", "back-in-place",
                         "colour-fabric", "colour-piece"}) {
    addAction(actions_[QString::fromLatin1(id)]);
  }
}

}  // namespace toile::studio
