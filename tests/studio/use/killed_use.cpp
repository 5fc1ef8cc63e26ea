// SPDX-License-Identifier: GPL-3.0-or-later
// A program that is killed (SIGKILL, as by a power cut) in the middle of a drag: the next one
// offers the work, with the line as it was dragged no more than ten seconds before.
#include <QApplication>
#include <QDateTime>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>
#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/palette.h"
#include "document/recovery.h"
#include "hand.h"
#include "toile/core/file.h"
#include "toile/design/design_file.h"

namespace {

using namespace toile;
using namespace toile::studio;
using namespace toile::studio::use;

/// Draws a line, takes hold of a point and never lets go. Writes the design from before the drag.
int drag(MainWindow& window, const char* before) {
  Hand hand(window);
  window.viewport().setMotion(false);
  window.newWork();
  hand.settle();
  const ReferenceModel& model = *hand.session().document().model;
  const auto front = [&](double x, double z) {
    return model.index->firstVisibleHit({x, -2000, z}, {0, 1, 0})->position;
  };
  const double waist = 0.62 * model.mesh->boxMax().z();
  hand.command("tool-curve");
  for (const double x : {20.0, 60.0, 100.0}) hand.click(front(x, waist));
  hand.key(Qt::Key_Return);
  hand.command("tool-select");
  hand.settle();
  require(writeFileWhole(before, writeDesign(*hand.session().document().design)).hasValue(),
          "written");
  hand.click(front(60, waist));
  const Vector2d at = hand.pixel(front(60, waist));
  hand.send(QEvent::MouseMove, at, Qt::NoButton, false);
  hand.send(QEvent::MouseButtonPress, at, Qt::LeftButton, true);
  for (int i = 1;; ++i) {
    hand.send(QEvent::MouseMove, at + Vector2d(i % 2, 20 + i % 5), Qt::NoButton, true);
    if (i == 5) require(hand.session().isPreview(), "dragging");
    wait(100);
  }
}

int killAndReturn(const char* self) {
  const QTemporaryDir folder;
  const QString before = folder.filePath("before.toile");
  QProcess victim;
  victim.setProcessChannelMode(QProcess::MergedChannels);
  victim.start(QString::fromLocal8Bit(self), {"--drag", before});
  QByteArray said;
  while (!said.contains("ok: dragging") && victim.waitForReadyRead(60000)) {
    said += victim.readAllStandardOutput();
  }
  require(said.contains("ok: dragging"), "the other program drags");
  wait(7000);
  require(victim.state() == QProcess::Running, "and is still at it");
  victim.kill();
  victim.waitForFinished(10000);
  const QDateTime killed = QDateTime::currentDateTime();

  MainWindow window;
  window.show();
  QString question;
  QTimer::singleShot(500, &window, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    question = box->text();
    box->defaultButton()->click();
  });
  const auto left = Recovery(recoveryFolder()).findLeftWork();
  require(left && left->written.secsTo(killed) <= 10, "its work is at most 10 s old");
  require(window.offerLeftWork(), "the work is offered and taken up");
  require(question.contains("closed unexpectedly"), "with words");
  const Design& design = *window.session().document().design;
  require(window.session().isUnsaved(), "it counts as unsaved");
  std::ifstream in(before.toStdString(), std::ios::binary);
  const std::string start{std::istreambuf_iterator<char>(in), {}};
  require(design.curves.size() == 2, "the line and its twin are there");
  require(!start.empty() && writeDesign(design) != start, "as far as it was dragged");
  Hand hand(window);
  hand.settle();
  require(window.session().lines().all().size() == 2, "and lie on the body");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  applyTheme(app, Theme::Light);
  if (argc == 1) return killAndReturn(argv[0]);
  MainWindow window;
  window.show();
  window.activateWindow();
  wait(500);
  return drag(window, argv[2]);
}
