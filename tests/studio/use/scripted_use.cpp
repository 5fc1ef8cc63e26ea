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
#include <functional>
#include <iterator>
#include <set>

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
  Hand::folder = pictures;
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
  const double tall = model.mesh->boxMax().z();
  const double chest = 0.74 * tall, hem = 0.58 * tall;
  const auto ids = [&] {
    std::set<std::string> all;
    for (const auto& curve : session.document().design->curves) all.insert(curve.id);
    return all;
  };
  /// Draws, and gives the line that was drawn: with a twin, or across the middle by itself.
  const auto drawn = [&](const char* what, bool hasTwin, const std::function<void()>& draw) {
    const std::set<std::string> before = ids();
    draw();
    std::string line;
    std::size_t count = 0;
    for (const auto& curve : session.document().design->curves) {
      if (before.contains(curve.id)) continue;
      ++count;
      if (!curve.mirrorOf) line = curve.id;
    }
    require(count == (hasTwin ? 2 : 1) && !line.empty(), what);
    return line;
  };
  const auto pointOf = [&](const std::string& line,
                           const std::function<double(const Vector3d&)>& measure) {
    const auto& points = session.lines().find(line)->points;
    return *std::ranges::max_element(points, {}, measure);
  };

  // ---- a top, of which the left half is drawn
  const std::string neck = drawn("a neckline round the neck", false, [&] {
    hand.command("tool-girth");
    hand.click(front(0, 0.845 * tall));
  });
  const std::string waist = drawn("a hem round the waist", false, [&] {
    hand.command("tool-girth");
    hand.click(front(0, hem));
  });
  // The arm stands off the trunk below the armpit: there the sleeve ends.
  double sleeve = chest, middle = 0;
  for (bool gap = false; !gap; sleeve -= 5) {
    require(sleeve > hem, "the arm stands off the trunk");
    double outer = 0;
    for (double x = 500; x > 120 && !gap; x -= 2) {
      const bool isBody =
          model.index->firstVisibleHit({x, -2000, sleeve - 15}, {0, 1, 0}).has_value();
      if (isBody && outer == 0) outer = x;
      if (!isBody && outer > 0) gap = true, middle = 0.5 * (outer + x);
    }
  }
  const std::string cuff = drawn("a sleeve's end round the arm, and its twin", true, [&] {
    hand.command("tool-girth");
    hand.click(front(middle, sleeve - 15));
  });
  const std::string side = drawn("a pencil line from sleeve to hem, and its twin", true, [&] {
    hand.command("tool-pencil");
    std::vector<Vector2d> way{hand.pixel(pointOf(cuff, [](const auto& p) { return -p.y(); }))};
    for (const auto& [x, z] : {std::pair(middle - 25, sleeve + 30), std::pair(165.0, sleeve + 45),
                               std::pair(125.0, sleeve), std::pair(110.0, 0.5 * (sleeve + hem))}) {
      way.push_back(hand.pixel(front(x, z)));
    }
    way.push_back(hand.pixel(
        pointOf(waist, [](const auto& p) { return -p.y() - 10 * std::abs(p.x() - 105); })));
    hand.drag(way);
  });
  const std::string shoulder = drawn("a shoulder seam by curve, and its twin", true, [&] {
    Camera above = window.viewport().camera();
    above.azimuth = 0.7;
    above.elevation = 0.45;
    window.viewport().lookFrom(above);
    const Vector3d from = pointOf(neck, [](const auto& p) { return p.x(); });
    const Vector3d to = pointOf(cuff, [](const auto& p) { return p.x(); });
    hand.command("tool-curve");
    hand.click(from);
    for (const double t : {0.35, 0.7}) {
      const Vector3d on = (1 - t) * from + t * to;
      hand.click(model.index->firstVisibleHit({on.x(), on.y(), 3000}, {0, 0, -1})->position);
    }
    hand.click(to);
    hand.key(Qt::Key_Return);
    window.viewport().lookFrom(StandardView::Front);
    window.viewport().fitAll();
  });
  hand.settle();
  for (const Piece& piece : session.pattern()->cut.pieces) {
    std::printf("  %s %zu faces\n", piece.id.c_str(), piece.mesh->faceCount());
  }
  // Front and back, the head, two hands, the legs.
  hand.picture("drawn");
  require(session.pattern()->cut.pieces.size() == 6, "the lines close front and back");

  // ---- names
  hand.command("tool-select");
  hand.click(front(30, 0.5 * (chest + hem)));
  require(session.selection().kind == Selection::Kind::Piece, "a click selects the piece");
  hand.namePiece(QStringLiteral("Front"));
  hand.settle();
  const auto leaveOut = [&](const Vector3d& place, const QString& name) {
    hand.click(place);
    hand.namePiece(name);
    hand.settle();
    auto* include = window.findChild<QCheckBox*>(QStringLiteral("pieceIncluded"));
    require(include != nullptr, "a piece can be left out");
    include->click();
    hand.settle();
  };
  leaveOut(front(0, 0.93 * tall), QStringLiteral("Head"));
  leaveOut(front(80, 0.3 * tall), QStringLiteral("Legs"));
  const Vector3d hand1 = pointOf(cuff, [](const auto& p) { return -p.y(); });
  leaveOut(front(hand1.x() + 12, hand1.z() - 30), QStringLiteral("Hand left"));
  leaveOut(front(-hand1.x() - 12, hand1.z() - 30), QStringLiteral("Hand right"));
  window.viewport().lookFrom(StandardView::Back);
  hand.click(model.index->firstVisibleHit({0, 2000, 0.5 * (chest + hem)}, {0, -1, 0})->position);
  hand.namePiece(QStringLiteral("Back"));
  hand.settle();
  window.viewport().lookFrom(StandardView::Front);
  hand.picture("named");
  require(session.pattern()->pieces.size() == 2, "front and back are the pattern");
  require(session.document().design->pieces.size() == 6, "all pieces have records");
  require(session.document().design->pieces[0].name == "Front", "the name is in the design");

  // ---- a point pulled behind the arm
  const auto& way = session.lines().find(side)->points;
  hand.click(way[2 * way.size() / 3]);
  require(session.selection().isLine(side), "a click selects the line");
  const Overlay overlay = session.tool().overlay(session);
  require(overlay.points.size() >= 3, "the line shows its points");
  // In the flank, beside the arm that hangs before it when the body is seen from its left.
  const double flank = 0.6 * sleeve + 0.4 * hem;
  const Vector3d from =
      std::ranges::min_element(overlay.points, {}, [&](const OverlayPoint& point) {
        return std::abs(point.place.z() - flank);
      })->place;
  const Vector2d at = hand.pixel(from);
  Camera camera = window.viewport().camera();
  camera.azimuth = 0.9;
  window.viewport().lookFrom(camera);
  const Vector2d turnedAt = hand.pixel(from);
  const std::size_t steps = session.history().steps().size();
  hand.drag({turnedAt, turnedAt + Vector2d(14, 0), turnedAt + Vector2d(30, 4)});
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
  // Below the bust: a dart opens only where the surface is round, elsewhere its sides would
  // overlap.
  const Vector3d bust = position(*model.mesh, model.landmarks.at("bust_point_l"));
  hand.click(pointOf(side, [&](const auto& p) { return -std::abs(p.z() - bust.z() + 40); }));
  hand.click(front(70, bust.z() - 12));
  const auto& curves = session.document().design->curves;
  require(std::ranges::any_of(curves, [](const auto& c) { return c.kind == CurveKind::Dart; }),
          "the dart is drawn");
  hand.settle();
  if (const auto& error = session.patternError()) std::printf("%s\n", error->message.c_str());
  for (const auto& failure : session.pattern()->failures) {
    if (failure) std::printf("%s\n", failure->message.c_str());
  }
  hand.picture("dart");
  require(session.pattern()->pieces.size() == 2, "front and back are the pattern still");

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
