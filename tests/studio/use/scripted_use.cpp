// SPDX-License-Identifier: GPL-3.0-or-later
// A designer's first half hour in a minute, by mouse events on the window: a top drawn on the empty
// body with pencil and curves under linked symmetry, pieces named, a point pulled behind the arm, a
// dart, everything undone and done again, saved, opened, exported. The exported files are those
// that `toile make` writes for the saved design, byte for byte.
//   toile_studio_use TOILE [FOLDER]   with FOLDER, pictures of the stages are put there
#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/palette.h"
#include "hand.h"
#include "toile/design/design_file.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

std::string bytes(const QString& file) {
  std::ifstream in(file.toStdString(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

QStringList filesIn(const QString& folder) {
  QStringList files = QDir(folder).entryList(QDir::Files, QDir::Name);
  for (const QString& piece : QDir(folder + "/pieces").entryList(QDir::Files, QDir::Name)) {
    files << QStringLiteral("pieces/") + piece;
  }
  return files;
}

int drawATop(MainWindow& window, const QString& toile, const std::string& pictures) {
  Hand hand(window);
  hand.folder = pictures;
  Session& session = hand.session();
  window.viewport().setMotion(false);
  QObject::connect(&session, &Session::told, [](const QString& sentence) {
    std::printf("told: %s\n", sentence.toLocal8Bit().constData());
  });
  window.newWork();
  hand.settle();
  require(session.document().design->curves.empty(), "the body is empty at the start");
  const ReferenceModel& model = *session.document().model;
  const auto front = [&](double x, double z) {
    return model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position;
  };
  const double chest = 0.74 * model.mesh->boxMax().z(), hem = 0.58 * model.mesh->boxMax().z();

  // ---- half a top, drawn on the left side
  hand.command("tool-curve");
  hand.click(front(0, chest + 70));
  hand.click(front(50, chest + 85));
  hand.click(front(100, chest + 60));
  hand.key(Qt::Key_Return);
  require(session.document().design->curves.size() == 2, "a curve and its twin");
  hand.command("tool-pencil");
  std::vector<Vector2d> stroke;
  for (int i = 0; i <= 6; ++i) {
    const double t = i / 6.0;
    stroke.push_back(
        hand.pixel(front(100 + 8 * std::sin(3.1 * t), (1 - t) * (chest + 60) + t * hem)));
  }
  hand.drag(stroke);
  require(session.document().design->curves.size() == 4, "a pencil line and its twin");
  hand.command("tool-curve");
  hand.click(front(100, hem));
  hand.click(front(50, hem - 12));
  hand.click(front(0, hem - 15));
  hand.key(Qt::Key_Return);
  require(session.document().design->curves.size() == 6, "a hem and its twin");
  hand.settle();
  require(session.pattern()->cut.pieces.size() == 2, "the lines close a piece");
  hand.picture("drawn");

  // ---- names
  hand.command("tool-select");
  hand.click(front(30, 0.5 * (chest + hem)));
  require(session.selection().kind == Selection::Kind::Piece, "a click selects the piece");
  hand.namePiece(QStringLiteral("Front"));
  hand.settle();
  hand.click(front(0, hem - 120));
  hand.namePiece(QStringLiteral("Rest"));
  hand.settle();
  auto* include = window.findChild<QCheckBox*>(QStringLiteral("pieceIncluded"));
  require(include != nullptr, "a piece can be left out");
  include->click();
  hand.settle();
  require(session.pattern()->pieces.size() == 1, "the rest of the body is left out");
  require(session.document().design->pieces.size() == 2, "both pieces have records");
  require(session.document().design->pieces[0].name == "Front", "the name is in the design");

  // ---- a point pulled behind the arm
  const std::string side = session.document().design->curves[2].id;
  hand.click(session.lines().find(side)->points[session.lines().find(side)->points.size() / 3]);
  require(session.selection().isLine(side), "a click selects the line");
  const Overlay overlay = session.tool().overlay(session);
  require(overlay.points.size() >= 3, "the line shows its points");
  const Vector3d from = overlay.points[1].place;
  const Vector2d at = hand.pixel(from);
  Camera camera = window.viewport().camera();
  camera.azimuth = 0.9;
  window.viewport().lookFrom(camera);
  const Vector2d turnedAt = hand.pixel(from);
  const std::size_t steps = session.history().steps().size();
  hand.drag({turnedAt, turnedAt + Vector2d(14, 0), turnedAt + Vector2d(26, 4)});
  require((turnedAt - at).norm() > 1, "the view was turned");
  require(session.history().steps().size() == steps + 1, "a drag is one step");
  hand.settle();
  const PlacedLine* moved = session.lines().find(side);
  double nearest = 1e9;
  for (const Vector3d& p : moved->points) nearest = std::min(nearest, (p - from).norm());
  require(nearest > 1 && nearest < 120, "the line moved, and stayed on the body");
  hand.picture("moved");

  // ---- a dart
  window.viewport().lookFrom(StandardView::Front);
  window.viewport().fitAll();
  hand.command("tool-dart");
  const auto& points = session.lines().find(side)->points;
  // At the bust: a dart opens only where the surface is round, elsewhere its sides would overlap.
  hand.click(points[points.size() / 10]);
  hand.click(front(65, chest + 5));
  const auto& curves = session.document().design->curves;
  require(std::ranges::any_of(curves, [](const auto& c) { return c.kind == CurveKind::Dart; }),
          "the dart is drawn");
  hand.settle();
  if (const auto& error = session.patternError()) std::printf("%s\n", error->message.c_str());
  for (const auto& failure : session.pattern()->failures) {
    if (failure) std::printf("%s\n", failure->message.c_str());
  }
  require(!session.pattern()->pieces.empty(), "the pattern has the piece");
  hand.picture("dart");

  // ---- back to the start and forth again
  const std::string whole = writeDesign(*session.document().design);
  while (session.history().canUndo()) hand.command("undo");
  require(session.document().design->curves.empty(), "undone to the empty body");
  while (session.history().canRedo()) hand.command("redo");
  require(writeDesign(*session.document().design) == whole, "redone to the last bit");
  hand.settle();

  // ---- saved, opened, exported
  const QTemporaryDir folder;
  const std::string file = folder.filePath("top.toile").toStdString();
  require(window.saveTo(file), "saved");
  require(!session.isUnsaved(), "nothing unsaved after saving");
  require(window.open(file), "opened again");
  hand.settle();
  require(writeDesign(*session.document().design) == bytes(QString::fromStdString(file)),
          "the file is what is shown");
  require(window.exportTo(folder.filePath("studio").toStdString()), "exported");
  QProcess make;
  make.start(toile, {"make", QString::fromStdString(file), "-o", folder.filePath("make")});
  require(make.waitForFinished(120000), "`toile make` ends");
  const QStringList mine = filesIn(folder.filePath("studio"));
  require(mine.size() >= 6 && mine == filesIn(folder.filePath("make")), "the same files");
  for (const QString& name : mine) {
    if (bytes(folder.filePath("studio/" + name)) == bytes(folder.filePath("make/" + name)))
      continue;
    std::printf("differs: %s\n", name.toLocal8Bit().constData());
    require(false, "every byte is the same");
  }
  require(true, "every byte is the same");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  applyTheme(app, Theme::Light);
  MainWindow window;
  window.resize(1380, 860);
  window.show();
  window.activateWindow();
  wait(500);
  return argc < 2 ? 2 : drawATop(window, QString::fromLocal8Bit(argv[1]), argc > 2 ? argv[2] : "");
}
