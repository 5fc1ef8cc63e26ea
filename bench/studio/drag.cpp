// SPDX-License-Identifier: GPL-3.0-or-later
// A hand that drags points of a wetsuit's lines over the body, by events of the window system as a
// mouse makes them (xdotool), 60 a second, and how long it waits (app/trace.h).
//   toile_studio_drag TRACE DESIGN BODY LINE...   under a display of its own:
//   scripts/measure-studio
// BODY is a mesh file in mm in place of the design's own; "" for that.
#include <QApplication>
#include <QProcess>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/main_window.h"
#include "app/palette.h"
#include "app/trace.h"
#include "toile/pipeline.h"
#include "viewport/viewport.h"

namespace {

using namespace toile::studio;
using Eigen::Vector2d;

void wait(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
}

bool settle(const Session& session, PatternWorker& worker) {
  for (int i = 0; i < 1200; ++i) {
    wait(50);
    if (session.isPatternCurrent() && !worker.isWorking()) return true;
  }
  return false;
}

/// Two seconds of a hand: out, round and back.
QStringList gesture(const QPoint& from) {
  const auto go = [](const QPoint& to) {
    return QStringList{"mousemove", QString::number(to.x()), QString::number(to.y())};
  };
  QStringList words = go(from);
  words << "sleep"
        << "0.3"
        << "mousedown"
        << "1"
        << "sleep"
        << "0.05";
  constexpr int kMoves = 120;
  for (int i = 1; i <= kMoves; ++i) {
    const double t = 2 * M_PI * i / kMoves;
    const Vector2d offset(14 * std::sin(t), 10 * std::sin(2 * t) + 0.02 * i);
    words << go(from + QPoint(int(std::lround(offset.x())), int(std::lround(offset.y()))));
    words << "sleep"
          << "0.0167";
  }
  words << "mouseup"
        << "1";
  return words;
}

int drag(MainWindow& window, const QStringList& arguments) {
  Session& session = window.session();
  Viewport& view = window.viewport();
  view.setMotion(false);
  const std::string design = arguments[2].toStdString(), body = arguments[3].toStdString();
  if (body.empty()) {
    if (!window.open(design)) return 1;
  } else {
    const auto document = toile::openDocument(design, body, toile::FileUnit::Millimetre);
    if (!document) return std::printf("%s\n", document.error().message.c_str()), 1;
    session.start(*document, design, "open");
  }
  if (!settle(session, session.worker())) return 1;
  std::printf("%zu triangles, %zu pieces\n", session.document().model->mesh->faceCount(),
              session.pattern()->pieces.size());
  Trace trace(session, view, window.patternView(), arguments[1].toStdString());
  if (!trace.isOpen()) return 1;
  view.lookFrom(StandardView::Front);
  view.fitAll();
  for (const QString& name : arguments.mid(4)) {
    const std::string id = name.toStdString();
    const PlacedLine* line = session.lines().find(id);
    if (line == nullptr) return std::printf("no line %s\n", id.c_str()), 1;
    session.select(Selection::line(id));
    view.fitSelection();
    wait(300);
    const auto points = session.tool().overlay(session).points;
    if (points.size() < 3) return std::printf("%s has no points\n", id.c_str()), 1;
    const Screen screen{view.camera().view(), double(view.width()), double(view.height())};
    // The inner point that faces the eye most: the front is seen along +y.
    const auto inner =
        std::max_element(points.begin() + 1, points.end() - 1,
                         [](const auto& a, const auto& b) { return a.normal.y() > b.normal.y(); });
    const Vector2d at = screen.toPixel(inner->place).value();
    const std::size_t before = session.history().steps().size();
    QProcess hand;
    hand.start("xdotool", gesture(view.mapToGlobal(QPointF(at.x(), at.y())).toPoint()));
    while (hand.state() != QProcess::NotRunning) wait(20);
    wait(100);
    if (session.history().steps().size() != before + 1) {
      return std::printf("%s was not dragged\n", id.c_str()), 1;
    }
    if (!settle(session, session.worker())) return 1;
    wait(300);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  applyTheme(app, Theme::Light);
  MainWindow window;
  window.show();
  window.activateWindow();
  wait(500);
  return argc < 5 ? 2 : drag(window, QApplication::arguments());
}
