// SPDX-License-Identifier: GPL-3.0-or-later
// What hands do with pieces: move and turn them on the sheet, turn their grain, give them fabrics,
// take darts from the adviser, flatten them, merge them, and what findings offer.
//   toile_studio_pieces [FOLDER]   with FOLDER, pictures of the stages are put there
#include <QAbstractButton>
#include <QComboBox>
#include <QListWidget>
#include <QSlider>
#include <QTabWidget>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <set>

#include "app/number_field.h"
#include "app/palette.h"
#include "hand.h"
#include "panels/dart_panel.h"
#include "panels/develop_panel.h"
#include "pattern/pattern_view.h"
#include "start/card.h"
#include "toile/design/design_file.h"
#include "toile/pipeline.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

const DrawnPiece& pieceOf(const PatternView& view, const std::string& id) {
  const auto found = std::ranges::find(view.pieces(), id, &DrawnPiece::id);
  require(found != view.pieces().end(), "the piece is in the pattern");
  return *found;
}

/// Where a piece is seen that is neither a line nor a handle.
QPointF graspOf(const PatternView& view, const DrawnPiece& piece) {
  return view.sheetView().toPixel(piece.label) + QPointF(9, 7);
}

double apart(const QPointF& a, const QPointF& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

template <class Widget>
Widget& find(MainWindow& window, const char* name) {
  QApplication::processEvents();
  // The last: those before it may wait to be deleted.
  Widget* found = nullptr;
  for (Widget* each : window.findChildren<Widget*>(QString::fromLatin1(name))) {
    if (each->isVisible()) found = each;
  }
  require(found != nullptr, name);
  return *found;
}

void openVest(MainWindow& window) {
  window.showStart();
  window.findChild<Card*>(QStringLiteral("torso-vest"))->click();
  Hand(window).settle();
  window.viewport().setMotion(false);
  require(window.session().pattern()->pieces.size() > 2, "the vest is open");
}

void moveAndTurn(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  PatternView& view = window.patternView();
  const std::string id = view.pieces().front().id;
  const std::string other = view.pieces().back().id;
  const QPointF before = view.sheetView().toPixel(pieceOf(view, id).middle);
  const QPointF otherBefore = view.sheetView().toPixel(pieceOf(view, other).middle);
  const std::size_t steps = session.history().at();
  const QPointF from = graspOf(view, pieceOf(view, id)), by(-70, 55);
  dragOver(view, from, from + by);
  require(session.history().at() == steps + 1, "moving a piece is one step");
  hand.settle();
  require(apart(view.sheetView().toPixel(pieceOf(view, id).middle), before + by) < 1,
          "it lies where it was put down");
  require(apart(view.sheetView().toPixel(pieceOf(view, other).middle), otherBefore) < 1,
          "the others stay where they are");
  require(session.document().design->layout.size() == 1, "and the design keeps it");
  hand.picture("moved-piece");

  // What is saved is laid out alike by the command.
  const QTemporaryDir folder;
  const std::string file = folder.filePath("moved.toile").toStdString();
  require(window.saveTo(file), "saved");
  const Result<Document> read = openDocument(file);
  require(read.hasValue(), "read");
  const Result<Pattern> made = makePattern(*read);
  require(made && made->layout.placements.size() == session.pattern()->layout.placements.size(),
          "made from the file");
  for (std::size_t i = 0; i < made->layout.placements.size(); ++i) {
    const Placement &a = made->layout.placements[i], &b = session.pattern()->layout.placements[i];
    require(a.angle == b.angle && a.offset == b.offset, "with the same places, bit for bit");
  }

  // Turned by the ring above it.
  session.select(Selection::piece(id));
  const QPointF middle = view.sheetView().toPixel(pieceOf(view, id).middle);
  const QPointF ring = turnHandle(pieceOf(view, id), view.sheetView());
  const double radius = apart(ring, middle);
  dragOver(view, ring, middle + QPointF(radius, 0));
  hand.settle();
  require(session.document().design->layout.size() == 1, "turned by hand");
  const double turn = session.document().design->layout.front().turn.degrees();
  require(std::abs(turn + 90) < 0.5, "a quarter to the right");
  require(apart(view.sheetView().toPixel(pieceOf(view, id).middle), middle) < 1.5,
          "about its middle");
  hand.command("undo");
  hand.settle();
  require(std::abs(session.document().design->layout.front().turn.degrees()) < 1, "and undone");
  session.select(Selection::piece(id));
  hand.command("back-in-place");
  hand.settle();
  require(session.document().design->layout.empty(), "put back in its place");
  view.fitAll();
}

void grainAndColours(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  PatternView& view = window.patternView();
  const std::string id = view.pieces().front().id;
  session.select(Selection::piece(id));
  const QLineF grain = pieceOf(view, id).grain;
  const QPointF middle = view.sheetView().toPixel(grain.center());
  const QPointF end = view.sheetView().toPixel(grain.p2());
  QLineF arm(middle, end);
  arm.setAngle(arm.angle() + 30);
  dragOver(view, end, arm.p2());
  hand.settle();
  const PieceRecord* record = recordOf(*session.document().design, id);
  require(record->grain && std::abs(record->grain->turn.degrees() - 30) < 0.5,
          "the grain is turned by its arrow");
  session.select(Selection::piece(id));
  type(find<NumberField>(window, "pieceGrain"), QStringLiteral("10+5"));
  hand.settle();
  record = recordOf(*session.document().design, id);
  require(std::abs(record->grain->turn.degrees() - 15) < 1e-9, "or by a number");
  hand.command("undo");
  hand.command("undo");
  hand.settle();

  const auto tints = [&] {
    std::set<QRgb> all;
    for (const DrawnPiece& piece : view.pieces()) all.insert(piece.tint.rgb());
    return all.size();
  };
  require(tints() == 1, "one cloth, one colour");
  hand.command("colour-piece");
  require(tints() > 2, "coloured by piece");
  hand.picture("colour-by-piece");
  hand.command("colour-fabric");
}

void fabrics(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  const auto first = [&]() -> const Fabric& { return session.document().design->fabrics.front(); };
  const std::size_t before = session.document().design->fabrics.size();
  hand.command("fabrics");
  find<QAbstractButton>(window, "newFabric").click();
  hand.settle();
  require(session.document().design->fabrics.size() == before + 1, "a new fabric");
  auto& which = find<QComboBox>(window, "whichFabric");
  which.setCurrentIndex(0);
  Q_EMIT which.activated(0);
  type(find<NumberField>(window, "stretchAcross"), QStringLiteral("12"));
  require(first().stretchAcross && std::abs(first().stretchAcross->value() - 0.12) < 1e-12,
          "with a limit");
  type(find<NumberField>(window, "thickness"), QStringLiteral("0.2cm+1"));
  require(std::abs(first().thickness.mm() - 3) < 1e-9, "with a thickness, from a sum");
  type(find<NumberField>(window, "easeGirth"), QStringLiteral("-5"));
  require(std::abs(first().ease.girth.value() + 0.05) < 1e-12, "with ease");
  hand.settle();
  hand.picture("fabric");
  for (int i = 0; i < 4; ++i) hand.command("undo");
  find<QAbstractButton>(window, "answer").click();
  hand.settle();
  require(session.document().design->fabrics.size() == before, "all of it undone");
}

std::size_t worstPiece(const Pattern& pattern) {
  std::size_t worst = 0;
  double error = -1;
  for (std::size_t i = 0; i < pattern.flats.size(); ++i) {
    if (!pattern.flats[i] || pattern.flats[i]->meanAreaError <= error) continue;
    error = pattern.flats[i]->meanAreaError;
    worst = i;
  }
  return worst;
}

void adviser(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  const std::size_t worst = worstPiece(*session.pattern());
  const std::string id = session.pattern()->cut.pieces[worst].id;
  const double before = session.pattern()->flats[worst]->meanAreaError;
  hand.command("strain");
  session.select(Selection::piece(id));
  window.viewport().lookStraightAtSelection();
  hand.command("darts");
  auto& panel = find<DartPanel>(window, "dartPanel");
  for (int i = 0; i < 600 && panel.isLooking(); ++i) wait(50);
  require(!panel.proposals().empty(), "the adviser proposes");
  require(!session.ghosts().empty() && !session.ghosts().front().flat.empty(),
          "and shows it in both panes");
  const double promised = panel.proposals().front().errorAfter;
  require(promised < panel.proposals().front().errorBefore, "with less strain");
  hand.picture("dart-adviser");
  const std::size_t steps = session.history().at();
  const std::string design = writeDesign(*session.document().design);
  find<QAbstractButton>(window, "answer").click();
  require(session.history().at() == steps + 1, "placing it is one step");
  require(session.ghosts().empty(), "what was proposed is drawn now");
  hand.settle();
  const auto index = session.pieceIndex(id);
  require(index && session.pattern()->flats[*index]->meanAreaError < before,
          "and the piece is strained less");
  std::printf("  %.2f %% -> %.2f %% promised, %.2f %% made\n", 100 * before, 100 * promised,
              100 * session.pattern()->flats[*index]->meanAreaError);
  hand.picture("darts-placed");
  hand.command("undo");
  hand.settle();
  require(writeDesign(*session.document().design) == design, "undone at once");
  hand.command("strain");
}

void developable(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  const std::size_t worst = worstPiece(*session.pattern());
  const std::string id = session.pattern()->cut.pieces[worst].id;
  session.select(Selection::piece(id));
  hand.command("developable");
  auto& panel = find<DevelopPanel>(window, "developPanel");
  find<QSlider>(window, "developAmount").setValue(70);
  for (int i = 0; i < 600 && !panel.report(); ++i) wait(50);
  require(panel.report().has_value(), "the slider tells both errors");
  const DevelopReport told = *panel.report();
  require(told.errorAgainstProcessed < told.errorBefore, "the flattened shape lies flat better");
  hand.picture("developable");
  find<QAbstractButton>(window, "answer").click();
  hand.settle();
  const auto index = session.pieceIndex(id);
  require(index && session.pattern()->developed[*index] != nullptr, "kept, it is in the pattern");
  require(std::abs(session.pattern()->developed[*index]->report.errorAgainstOriginal -
                   told.errorAgainstOriginal) < 1e-9,
          "with the errors that were told");
  hand.command("undo");
  hand.settle();
}

void merge(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  const Pattern& pattern = *session.pattern();
  const std::size_t pieces = pattern.cut.pieces.size();
  const auto mates = std::ranges::find_if(pattern.cut.mates,
                                          [](const SeamMates& m) { return m.pieceA != m.pieceB; });
  require(mates != pattern.cut.mates.end(), "there is a seam");
  const std::string curve = pattern.cut.pieces[mates->pieceA].wires[mates->wireA].curve;
  session.select(Selection::line(curve));
  hand.picture("seam");
  const std::size_t steps = session.history().at();
  find<QAbstractButton>(window, "mergePieces").click();
  require(session.history().at() == steps + 1, "merging is one step");
  hand.settle();
  require(session.pattern()->cut.pieces.size() < pieces, "two pieces are one");
  for (const Finding& finding : session.pattern()->findings) {
    require(finding.code != "two-anchors", "with one name");
  }
  hand.command("undo");
  hand.settle();
  require(session.pattern()->cut.pieces.size() == pieces, "and two again");
}

/// Clicks the row of the findings whose text begins so.
void clickRow(MainWindow& window, const QString& text) {
  auto* list = window.findChild<QListWidget*>(QStringLiteral("findings"));
  for (int row = 0; row < list->count(); ++row) {
    if (!list->item(row)->text().startsWith(text)) continue;
    Q_EMIT list->itemClicked(list->item(row));
    return;
  }
  for (int row = 0; row < list->count(); ++row) {
    std::printf("  %s\n", list->item(row)->text().toUtf8().constData());
  }
  require(false, qPrintable(QStringLiteral("the findings offer: ") + text));
}

void cures(MainWindow& window) {
  beginAnew(window);
  Hand hand(window);
  Session& session = hand.session();
  hand.settle();
  const ReferenceModel& model = *session.document().model;
  const double tall = model.mesh->boxMax().z();
  const auto front = [&](double x, double z) {
    return model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position;
  };
  // Two girths: a tube between them, and all else.
  hand.command("tool-girth");
  hand.click(front(10, 0.62 * tall));
  hand.click(front(10, 0.56 * tall));
  hand.command("tool-select");
  hand.settle();
  session.select({});
  hand.click(front(40, 0.59 * tall));
  require(session.selection().kind == Selection::Kind::Piece, "the tube is selected");
  hand.namePiece(QStringLiteral("Belt"));
  hand.settle();
  const auto made = [&] {
    const auto index = session.pieceIndex(session.document().design->pieces.front().id);
    return index && session.pattern()->flats[*index] != nullptr;
  };
  require(!made(), "a tube cannot lie flat");
  window.findChild<QTabWidget*>()->setCurrentIndex(1);
  hand.picture("tube");
  const std::size_t steps = session.history().at();
  clickRow(window, QStringLiteral("Leave out what has no name"));
  hand.settle();
  std::size_t included = 0;
  for (const Piece& piece : session.pattern()->cut.pieces) included += piece.include ? 1 : 0;
  require(included == 1, "all but the belt is left out");
  clickRow(window, QStringLiteral("Cut it open"));
  require(session.history().at() == steps + 2, "two steps");
  hand.settle();
  require(made() && session.pattern()->isComplete(), "cut open it lies flat");
  hand.picture("tube-cut");
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  applyTheme(app, Theme::Light);
  MainWindow window;
  window.resize(1280, 800);
  window.show();
  window.activateWindow();
  wait(300);
  openVest(window);
  if (argc > 1) Hand::folder = argv[1];
  moveAndTurn(window);
  grainAndColours(window);
  fabrics(window);
  adviser(window);
  developable(window);
  merge(window);
  cures(window);
  return 0;
}
