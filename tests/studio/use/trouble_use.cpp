// SPDX-License-Identifier: GPL-3.0-or-later
// What goes wrong at a desk: a stroke beside the body, ten lines through one point, a mesh of five
// million triangles, a disk that fills while saving, closing while work runs; and scans that are
// put below a design, which takes long and can be stopped.
//   toile_studio_trouble [FOLDER]   with FOLDER, pictures of the stages are put there
#include <sys/resource.h>

#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QMessageBox>
#include <QProgressDialog>
#include <QPushButton>
#include <QRadioButton>
#include <QTemporaryDir>
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <memory>
#include <numbers>

#include "app/palette.h"
#include "hand.h"
#include "start/card.h"
#include "start/unit_dialog.h"
#include "support/test_data.h"
#include "toile/design/design_file.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

/// The longest time for which the window took no events.
class Heartbeat {
 public:
  Heartbeat() {
    clock_.start();
    QObject::connect(&timer_, &QTimer::timeout, &timer_,
                     [this] { longest_ = std::max(longest_, clock_.restart()); });
    timer_.start(10);
  }
  [[nodiscard]] qint64 longest() const { return std::max(longest_, clock_.elapsed()); }

 private:
  QTimer timer_;
  QElapsedTimer clock_;
  qint64 longest_ = 0;
};

QByteArray content(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

/// A template of the start page; changes to the work before it are thrown away.
void openTemplate(MainWindow& window, const char* name) {
  beginAnew(window);
  window.showStart();
  window.findChild<Card*>(QString::fromLatin1(name))->click();
  Hand(window).settle();
}

/// Answers the box of that name by the button whose text begins so, each time it is asked.
QTimer* answer(const char* name, const QStringList& buttons, QString* said = nullptr,
               const std::function<void()>& before = {}) {
  auto* timer = new QTimer(qApp);
  auto* turn = new int(0);
  QObject::connect(timer, &QTimer::destroyed, qApp, [turn] { delete turn; });
  QObject::connect(timer, &QTimer::timeout, qApp, [=] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr || (*name != 0 && box->objectName() != QLatin1String(name))) return;
    if (said != nullptr) *said = box->text();
    if (before) before();
    const QString wanted = buttons[std::min(*turn, static_cast<int>(buttons.size()) - 1)];
    ++*turn;
    for (QAbstractButton* button : box->buttons()) {
      if (button->text().remove('&').startsWith(wanted)) return button->click();
    }
    require(false, qPrintable(QStringLiteral("the box has a button ") + wanted));
  });
  timer->start(50);
  return timer;
}

void strokeBesideTheBody(MainWindow& window) {
  beginAnew(window);
  Hand hand(window);
  Session& session = hand.session();
  hand.settle();
  window.viewport().setMotion(false);
  const ReferenceModel& model = *session.document().model;
  const double tall = model.mesh->boxMax().z();
  const auto pixel = [&](double x, double z) {
    return hand.pixel(model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position);
  };
  DrawingOptions options = session.options();
  options.symmetry = false;
  session.setOptions(options);
  hand.command("tool-pencil");
  const Vector2d from = pixel(20, 0.62 * tall), side = pixel(90, 0.6 * tall);
  QString hint;
  const auto watch = QObject::connect(&session, &Session::toolMoved, &session, [&] {
    const QString now = session.tool().hint(session);
    if (now.contains("left the body")) hint = now;
  });
  hand.drag({from, side, side + Vector2d(120, 0), side + Vector2d(130, 30)});
  QObject::disconnect(watch);
  require(!hint.isEmpty(), "a stroke that leaves the body is told while it is drawn");
  require(session.document().design->curves.size() == 1, "what was on the body is a line");
  const auto& line = *session.lines().all().front();
  require(line.length() > 30 && line.length() < 400, "that ends at the edge");
  // Wholly beside the body: nothing is drawn, nothing is lost.
  hand.drag({Vector2d(8, 120), Vector2d(30, 200), Vector2d(12, 300)});
  require(session.document().design->curves.size() == 1, "a stroke beside the body draws nothing");
  hand.settle();
}

void tenLinesThroughOnePoint(MainWindow& window) {
  beginAnew(window);
  Hand hand(window);
  Session& session = hand.session();
  hand.settle();
  const ReferenceModel& model = *session.document().model;
  const double tall = model.mesh->boxMax().z();
  const auto front = [&](double x, double z) {
    return model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position;
  };
  const double x = 30, z = 0.6 * tall;
  hand.command("tool-curve");
  for (int i = 0; i < 10; ++i) {
    const double a = std::numbers::pi * (i + 0.3) / 10;
    const double dx = 60 * std::cos(a), dz = 60 * std::sin(a);
    hand.click(front(x - dx, z - dz));
    hand.click(front(x, z));
    hand.click(front(x + dx, z + dz));
    hand.key(Qt::Key_Return);
  }
  require(session.document().design->curves.size() == 10, "ten lines through one point");
  hand.settle();
  require(!session.patternError().has_value(), "are cut without an error");
  hand.picture("ten-lines");
  // And one of them is dragged through the point by its end.
  hand.command("tool-select");
  session.select(Selection::line(session.document().design->curves.front().id));
  const auto points = session.tool().overlay(session).points;
  require(points.size() >= 3, "a line shows its points");
  const std::size_t steps = session.history().at();
  const Vector2d at = hand.pixel(points[points.size() / 2].place);
  hand.drag({at, at + Vector2d(6, -8), at + Vector2d(0, 0), at + Vector2d(-9, 4)});
  require(session.history().at() == steps + 1, "and dragged there");
  hand.settle();
  hand.command("undo");
  hand.settle();
}

/// A grid of triangles in the binary form of PLY: five million of them are read in seconds.
void writeHugeMesh(const QString& file, int columns, int rows) {
  QFile out(file);
  require(out.open(QIODevice::WriteOnly), "written");
  const long vertices = static_cast<long>(columns + 1) * (rows + 1);
  const long faces = 2L * columns * rows;
  out.write("ply\nformat binary_little_endian 1.0\nelement vertex " + QByteArray::number(vertices) +
            "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
            QByteArray::number(faces) + "\nproperty list uchar int vertex_indices\nend_header\n");
  QByteArray row;
  for (int j = 0; j <= rows; ++j) {
    row.clear();
    for (int i = 0; i <= columns; ++i) {
      const float xyz[3] = {static_cast<float>(i), static_cast<float>(j), 0};
      row.append(reinterpret_cast<const char*>(xyz), sizeof xyz);
    }
    out.write(row);
  }
  for (int j = 0; j < rows; ++j) {
    row.clear();
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
      for (const auto& corners : {std::array{a, b, c}, std::array{a, c, d}}) {
        row.append(char(3));
        row.append(reinterpret_cast<const char*>(corners.data()), sizeof corners);
      }
    }
    out.write(row);
  }
}

void fiveMillionTriangles(MainWindow& window) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("huge.ply");
  writeHugeMesh(file, 2000, 1250);
  const std::string before = writeDesign(*window.session().document().design);
  QString said;
  auto* box = answer("unopened", {"OK"}, &said);
  QElapsedTimer clock;
  clock.start();
  Heartbeat heart;
  require(!window.open(file.toStdString()), "five million triangles are not opened");
  const qint64 longest = heart.longest();
  delete box;
  std::printf("  %s\n  after %.1f s, without an answer for %lld ms at most\n",
              said.toUtf8().constData(), static_cast<double>(clock.elapsed()) / 1000,
              static_cast<long long>(longest));
  require(said.contains("5") && said.contains("reduce"), "told with their number, and what helps");
  require(longest < 1000, "and the window lives meanwhile");
  require(writeDesign(*window.session().document().design) == before, "the work is untouched");
}

void diskFillsWhileSaving(MainWindow& window) {
  Hand hand(window);
  Session& session = hand.session();
  const QTemporaryDir folder;
  const QString file = folder.filePath("lines.toile");
  require(window.saveTo(file.toStdString()), "saved");
  const QByteArray saved = content(file);
  require(saved.size() > 2048, "a file of some size");
  hand.command("undo");
  hand.command("undo");
  require(session.isUnsaved(), "the work goes on");
  hand.settle();
  // No file may grow beyond 1 kB: writing stops in the middle, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit full = before;
  full.rlim_cur = 1024;
  setrlimit(RLIMIT_FSIZE, &full);
  QString said;
  auto* box = answer("", {"Cancel"}, &said);
  require(!window.saveTo(file.toStdString()), "a full disk: not saved");
  delete box;
  std::printf("  %s\n", said.toUtf8().constData());
  require(said.contains("untouched") && said.contains("still here"), "told, nothing is lost");
  require(content(file) == saved, "the file of before is whole");
  require(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).size() == 1,
          "and nothing half is left beside it");
  require(session.isUnsaved(), "the work counts as unsaved");
  // The pattern's files: all of them, or none.
  const QString pattern = folder.filePath("pattern");
  said.clear();
  box = answer("", {"OK"}, &said);
  require(!window.exportTo(pattern.toStdString()), "a full disk: not exported");
  delete box;
  std::printf("  %s\n", said.toUtf8().constData());
  require(said.contains("another folder") && !said.contains("-o") &&
              QDir(pattern).entryList(QDir::Files | QDir::Hidden).isEmpty(),
          "told, and no file is half there");
  // Room again while the box asks.
  box = answer("", {"Try again"}, nullptr, [&] { setrlimit(RLIMIT_FSIZE, &before); });
  require(window.saveTo(file.toStdString()), "tried again with room: saved");
  delete box;
  setrlimit(RLIMIT_FSIZE, &before);
  require(content(file).toStdString() == writeDesign(*session.document().design), "whole");
}

void closeInTheMiddle() {
  QElapsedTimer clock;
  {
    MainWindow window;
    window.resize(1280, 800);
    window.showStart();
    window.show();
    window.findChild<Card*>(QStringLiteral("wetsuit-full"))->click();
    Session& session = window.session();
    require(session.worker().isWorking(), "the pattern is being made");
    clock.start();
    require(window.close(), "the window closes");
  }
  std::printf("  gone after %lld ms\n", static_cast<long long>(clock.elapsed()));
  require(clock.elapsed() < 3000, "and is gone soon");
}

// ---- bodies that come by file

/// The design on a scan in mm, through the question for its unit.
bool putOnScan(MainWindow& window, const std::filesystem::path& scan) {
  QTimer unit;
  QObject::connect(&unit, &QTimer::timeout, &unit, [] {
    auto* dialog = qobject_cast<UnitDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) return;
    dialog->findChildren<QRadioButton*>().front()->click();
    dialog->accept();
  });
  unit.start(20);
  return window.putOnFile(scan);
}

void scans(MainWindow& window, const std::filesystem::path& scan) {
  openTemplate(window, "wetsuit-short");
  Hand hand(window);
  Session& session = hand.session();
  require(true, "a suit is open");
  const Document home = session.document();
  const std::size_t pieces = session.pattern()->pieces.size();
  const std::size_t steps = session.history().at();

  // Cancel.
  QStringList told;
  auto* watch = new QTimer(qApp);
  QObject::connect(watch, &QTimer::timeout, qApp, [&] {
    auto* box = qobject_cast<QProgressDialog*>(QApplication::activeModalWidget());
    if (box == nullptr || box->objectName() != "longWork") return;
    const QString step = box->labelText().section('\n', 1);
    if (!step.isEmpty() && !told.contains(step)) {
      told << step;
      std::printf("  %s\n", step.toUtf8().constData());
      std::fflush(stdout);
    }
    if (told.size() >= 2) box->findChild<QPushButton*>()->click();
  });
  watch->start(20);
  QElapsedTimer clock;
  clock.start();
  require(!putOnScan(window, scan), "the fit to a scan is stopped by Cancel");
  delete watch;
  require(told.size() >= 2, "its steps were told");
  std::printf("  stopped after %.1f s\n", static_cast<double>(clock.elapsed()) / 1000);
  require(session.document().design == home.design, "and nothing is changed");

  // To the end, with the window alive.
  Heartbeat heart;
  clock.start();
  require(putOnScan(window, scan), "the design is put on the scan");
  const qint64 longest = heart.longest();
  std::printf("  there after %.1f s, without an answer for %lld ms at most\n",
              static_cast<double>(clock.elapsed()) / 1000, static_cast<long long>(longest));
  require(longest < 1000, "the window lives meanwhile");
  hand.settle();
  require(session.history().at() == steps + 1, "as one step");
  require(session.document().model != home.model, "on another body");
  require(session.pattern()->pieces.size() == pieces && session.pattern()->isComplete(),
          "with all pieces");
  require(session.document().design->models.size() == 2, "both bodies are kept");
  hand.picture("on-a-scan");

  // Saved with its body, opened elsewhere.
  const QTemporaryDir folder;
  const QString file = folder.filePath("suit.toile");
  require(window.saveTo(file.toStdString()), "saved");
  const QStringList beside = QDir(folder.path()).entryList(QDir::Files);
  require(beside.size() >= 3, "the fitted body is saved beside it");
  const Document onScan = session.document();
  require(window.open(file.toStdString()), "opened again");
  hand.settle();
  const auto &a = onScan.model->mesh->positions(), &b = session.document().model->mesh->positions();
  double farthest = a.size() == b.size() ? 0 : 1e9;
  for (std::size_t v = 0; v < std::min(a.size(), b.size()); ++v) {
    farthest = std::max(farthest, (a[v] - b[v]).norm());
  }
  std::printf("  farthest vertex %.2g mm\n", farthest);
  require(farthest < 1e-3, "on the same body");
  require(session.pattern()->pieces.size() == pieces, "with all pieces");

  // And switched.
  require(window.putOn(session.document().design->models[1]), "switched to the first body");
  hand.settle();
  require(session.pattern()->pieces.size() == pieces, "with all pieces");
  require(window.putOn(session.document().design->models[1]), "and back to the scan");
  hand.settle();
}

void closeDuringLongWork(const std::filesystem::path& scan) {
  auto window = std::make_unique<MainWindow>();
  window->resize(1280, 800);
  window->showStart();
  window->show();
  window->findChild<Card*>(QStringLiteral("wetsuit-short"))->click();
  Hand(*window).settle();
  QString said;
  auto* box = answer("closeInWork", {"Stop it"}, &said);
  QTimer::singleShot(1200, window.get(), [&] { window->close(); });
  require(!putOnScan(*window, scan), "closed while a fit runs: it is stopped");
  for (int i = 0; i < 100 && window->isVisible(); ++i) wait(50);
  delete box;
  std::printf("  %s\n", said.toUtf8().constData());
  require(said.contains("running"), "after asking");
  require(!window->isVisible(), "and the window is closed");
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  QApplication::setQuitOnLastWindowClosed(false);
  applyTheme(app, Theme::Light);
  if (argc > 1) Hand::folder = argv[1];
  MainWindow window;
  window.resize(1280, 800);
  window.show();
  window.activateWindow();
  wait(300);
  closeInTheMiddle();
  strokeBesideTheBody(window);
  tenLinesThroughOnePoint(window);
  diskFillsWhileSaving(window);
  fiveMillionTriangles(window);
  if (const auto scan = test::findTestData("scans/male_heavy_holes.ply")) {
    scans(window, *scan);
    closeDuringLongWork(*scan);
  } else {
    std::printf("no test data: scans are left out; set TOILE_TEST_DATA to its folder\n");
    if (test::isTestDataRequired()) return 1;
  }
  return 0;
}
