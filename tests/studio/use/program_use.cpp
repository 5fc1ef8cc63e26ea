// SPDX-License-Identifier: GPL-3.0-or-later
// The program around the drawing: start page, files that are damaged, foreign or too large, a mesh
// that asks for its unit, another body, the export dialog, the list of keys.
//   toile_studio_program [FOLDER]   with FOLDER, pictures of the stages are put there
#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QRadioButton>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "app/keys_dialog.h"
#include "app/palette.h"
#include "export/export_dialog.h"
#include "export/preview.h"
#include "hand.h"
#include "start/card.h"
#include "start/recent_designs.h"
#include "start/start_page.h"
#include "start/unit_dialog.h"
#include "toile/design/design_file.h"
#include "toile/mesh/mesh_file.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

QString folderOfPictures;

void picture(QWidget& widget, const char* name) {
  if (folderOfPictures.isEmpty()) return;
  wait(300);
  widget.grab().save(folderOfPictures + '/' + QString::fromLatin1(name) + QStringLiteral(".png"));
}

/// What the program says when it opens a file that it cannot take.
QString refusal(MainWindow& window, const QString& file) {
  QString said;
  whenAsked<QMessageBox>([&](QMessageBox& box) {
    said = box.text();
    box.accept();
  });
  require(!window.open(file.toStdString()), "it is not opened");
  std::printf("  %s\n", said.toUtf8().constData());
  return said;
}

void write(const QString& file, const QByteArray& content) {
  QFile out(file);
  require(out.open(QIODevice::WriteOnly) && out.write(content) == content.size(), "written");
}

/// So many triangles in rows, without units.
QByteArray largeMesh(int triangles) {
  QByteArray text;
  const int rows = triangles / 2;
  for (int i = 0; i <= rows; ++i) {
    text += "v " + QByteArray::number(i) + " 0 0\nv " + QByteArray::number(i) + " 0 1\n";
  }
  for (int i = 0; i < rows; ++i) {
    const auto a = [&](int k) { return QByteArray::number(2 * i + k); };
    text += "f " + a(1) + ' ' + a(3) + ' ' + a(2) + "\nf " + a(2) + ' ' + a(3) + ' ' + a(4) + '\n';
  }
  return text;
}

void badFiles(MainWindow& window) {
  const QTemporaryDir folder;
  window.newWork();
  const std::string before = writeDesign(*window.session().document().design);
  write(folder.filePath("damaged.toile"), "{\"toile\": 1, \"models\": [{\"mod");
  require(refusal(window, folder.filePath("damaged.toile")).contains("not changed"),
          "a damaged design: told, and the file is left alone");
  write(folder.filePath("letter.obj"), "Dear Sir,\nplease find enclosed\n");
  require(!refusal(window, folder.filePath("letter.obj")).isEmpty(), "a foreign file: told");
  write(folder.filePath("cut.stl"), QByteArray("solid x\nfacet normal 0 0"));
  require(!refusal(window, folder.filePath("cut.stl")).isEmpty(), "a file cut off: told");
  write(folder.filePath("large.obj"), largeMesh(1'000'002));
  require(refusal(window, folder.filePath("large.obj")).contains("triangles"),
          "a mesh too large: told, with its size");
  require(writeDesign(*window.session().document().design) == before, "the work is untouched");
}

void meshWithoutUnit(MainWindow& window) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("tube.obj");
  QByteArray text = QByteArray::fromStdString(writeObj(*window.session().document().model->mesh));
  text = text.mid(text.indexOf("\nv ") + 1);  // without the comment that says mm
  write(file, text);
  bool wasChosen = true;
  whenAsked<UnitDialog>([&](UnitDialog& dialog) {
    wasChosen = dialog.unit().has_value();
    const auto choices = dialog.findChildren<QRadioButton*>();
    for (QRadioButton* choice : choices) std::printf("  %s\n", qPrintable(choice->text()));
    choices.front()->click();
    picture(dialog, "units");
    dialog.accept();
  });
  require(window.open(file.toStdString()), "a mesh without unit is opened");
  require(!wasChosen, "no unit was chosen beforehand");
  require(window.session().document().design->models.front().unit == FileUnit::Millimetre,
          "in the unit that was chosen");
}

void startPage(MainWindow& window) {
  window.showStart();
  wait(100);
  picture(window, "start");
  auto* card = window.findChild<Card*>(QStringLiteral("torso-vest"));
  require(card != nullptr && card->isVisible(), "the start page has templates");
  card->click();
  Hand(window).settle();
  require(window.session().document().design->curves.size() > 3, "a template is a design");
  require(window.session().path().empty(), "without a file of its own");
}

void recent(MainWindow& window) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("vest.toile");
  wait(500);
  require(window.saveTo(file.toStdString()), "saved");
  require(RecentDesigns::all().contains(file), "it is among the recent designs");
  require(!RecentDesigns::pictureOf(file).isNull(), "with a picture");
  QFile::remove(file);
  require(!RecentDesigns::all().contains(file), "until it is gone");
}

void fullDisk(MainWindow& window) {
  QString said;
  whenAsked<QMessageBox>([&](QMessageBox& box) {
    said = box.text();
    box.reject();
  });
  // A place that takes no files behaves as a full disk does: the new file cannot be written.
  require(!window.saveTo("/proc/no/such/place/vest.toile"), "not saved");
  require(said.contains("still"), "and told that the work is here");
  std::printf("  %s\n", said.toUtf8().constData());
}

void exportDialog(MainWindow& window) {
  const QTemporaryDir folder;
  ExportDialog dialog(window.session().pattern(), "vest", window.viewport().picture(), &window);
  dialog.setFolder(folder.filePath("pattern"));
  dialog.show();
  for (int i = 0; i < 1200 && !dialog.isReady(); ++i) wait(50);
  require(dialog.isReady(), "the files are made");
  wait(1500);
  picture(dialog, "export");
  auto* preview = dialog.findChild<FilePreview*>();
  require(preview->pageCount() > 1, "a PDF in tiles has pages, the first is their map");
  const auto formats = dialog.findChild<QListWidget*>(QStringLiteral("formats"));
  for (int row = 0; row < formats->count(); ++row) {
    formats->setCurrentRow(row);
    formats->item(row)->setCheckState(Qt::Checked);
    wait(30);
    if (row == 1) picture(dialog, "export-dxf");
  }
  const auto count = dialog.exportChosen();
  require(count && *count > 12, "all files are exported");
  for (const char* name : {"pattern.pdf", "pattern.dxf", "laser.dxf", "pattern.plt", "body.png"}) {
    require(QFile::exists(folder.filePath("pattern/") + name), name);
  }
  QFile dxf(folder.filePath("pattern/pattern.dxf"));
  require(dxf.open(QIODevice::ReadOnly), "read");
  require(!readDxfStrokes(dxf.readAll()).strokes.empty(), "the preview reads the cutter's file");
}

void anotherBody(MainWindow& window) {
  window.newWork();
  Hand hand(window);
  hand.settle();
  window.viewport().setMotion(false);
  const ReferenceModel& model = *window.session().document().model;
  const auto front = [&](double x, double z) {
    return model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position;
  };
  hand.command("tool-curve");
  for (const double x : {20.0, 60.0, 100.0}) hand.click(front(x, 0.62 * model.mesh->boxMax().z()));
  hand.key(Qt::Key_Return);
  hand.settle();
  Session& session = window.session();
  const Document home = session.document();
  require(window.putOn({"builtin:body@1?size=EU50M", std::nullopt, std::nullopt, {}}),
          "the design is put on a man");
  require(session.document().model != home.model && session.lines().all().size() == 2,
          "its lines lie on the other body");
  require(session.document().design->models.size() == 2, "both bodies are kept");
  hand.settle();
  picture(window, "another-body");
  require(window.putOn(session.document().design->models[1]), "and back");
  require(session.document().design == home.design, "to the very design it was");
  hand.command("undo");
  require(session.document().model != home.model, "undo goes to the other body");
  hand.settle();
}

void keys(MainWindow& window) {
  KeysDialog dialog(window.actions(), &window);
  dialog.show();
  const int all = dialog.shownCount();
  picture(dialog, "keys");
  dialog.search("pencil");
  require(dialog.shownCount() == 1 && all > 30, "keys are found by words");
  QAction* pencil = window.actions()["tool-pencil"];
  window.actions().setKey(pencil, QKeySequence("Q"));
  require(pencil->shortcut() == QKeySequence("Q"), "a key is changed");
  window.actions().setKey(pencil, window.actions().defaultKey(pencil));
}

}  // namespace

int main(int argc, char** argv) {
  QElapsedTimer clock;
  clock.start();
  QApplication app(argc, argv);
  if (argc > 1) folderOfPictures = QString::fromLocal8Bit(argv[1]);
  applyTheme(app, Theme::Light);
  MainWindow window;
  window.resize(1280, 800);
  window.showStart();
  window.show();
  window.activateWindow();
  QApplication::processEvents();
  std::printf("  window after %lld ms\n", static_cast<long long>(clock.elapsed()));
  startPage(window);
  recent(window);
  fullDisk(window);
  exportDialog(window);
  badFiles(window);
  meshWithoutUnit(window);
  anotherBody(window);
  keys(window);
  return 0;
}
