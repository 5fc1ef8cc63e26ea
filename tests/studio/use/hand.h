// SPDX-License-Identifier: GPL-3.0-or-later
// A hand on the window, by mouse and key events, for the scripted uses.
#pragma once

#include <QAbstractButton>
#include <QApplication>
#include <QLineEdit>
#include <QMessageBox>
#include <QMouseEvent>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "app/main_window.h"
#include "viewport/viewport.h"

namespace toile::studio::use {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline void require(bool holds, const char* what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  std::fflush(stdout);
  if (!holds) std::exit(1);
}

inline void wait(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
}

/// Waits for a dialog of that kind and gives it to `act`, which must close it.
template <class Dialog>
void whenAsked(const std::function<void(Dialog&)>& act) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, qApp, [timer, act] {
    auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) return;
    timer->stop();
    timer->deleteLater();
    act(*dialog);
  });
  timer->start(50);
}

/// An empty body; changes to the work before it are thrown away.
inline void beginAnew(MainWindow& window) {
  QTimer discard;
  QObject::connect(&discard, &QTimer::timeout, &discard, [] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    for (QAbstractButton* button : box->buttons()) {
      if (box->buttonRole(button) == QMessageBox::DestructiveRole) return button->click();
    }
  });
  discard.start(20);
  window.newWork();
}

/// A drag with the left button over any widget.
inline void dragOver(QWidget& widget, const QPointF& from, const QPointF& to) {
  const auto send = [&](QEvent::Type type, const QPointF& at, Qt::MouseButton button, bool held) {
    QMouseEvent event(type, at, widget.mapToGlobal(at), button,
                      held ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&widget, &event);
    QApplication::processEvents();
  };
  send(QEvent::MouseMove, from, Qt::NoButton, false);
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, true);
  for (int step = 1; step <= 8; ++step) {
    send(QEvent::MouseMove, from + step / 8.0 * (to - from), Qt::NoButton, true);
  }
  send(QEvent::MouseButtonRelease, to, Qt::LeftButton, false);
}

/// Types into a field, as after a click into it, and takes it by Enter.
inline void type(QLineEdit& field, const QString& text) {
  field.setFocus();
  field.selectAll();
  for (const QChar letter : text) {
    QKeyEvent event(QEvent::KeyPress, 0, Qt::NoModifier, QString(letter));
    QApplication::sendEvent(&field, &event);
  }
  QKeyEvent enter(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier);
  QApplication::sendEvent(&field, &enter);
  QApplication::processEvents();
}

class Hand {
 public:
  explicit Hand(MainWindow& window) : window_(window), view_(window.viewport()) {}

  Session& session() { return window_.session(); }

  void send(QEvent::Type type, const Vector2d& at, Qt::MouseButton button, bool held) {
    const QPointF place(at.x(), at.y());
    QMouseEvent event(type, place, view_.mapToGlobal(place), button,
                      held ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view_, &event);
    QApplication::processEvents();
  }
  Vector2d pixel(const Vector3d& place) {
    const Screen screen{view_.camera().view(), double(view_.width()), double(view_.height())};
    return screen.toPixel(place).value();
  }
  void click(const Vector2d& at) {
    send(QEvent::MouseMove, at, Qt::NoButton, false);
    send(QEvent::MouseButtonPress, at, Qt::LeftButton, true);
    send(QEvent::MouseButtonRelease, at, Qt::LeftButton, false);
  }
  void click(const Vector3d& place) { click(pixel(place)); }
  void drag(const std::vector<Vector2d>& way) {
    send(QEvent::MouseMove, way.front(), Qt::NoButton, false);
    send(QEvent::MouseButtonPress, way.front(), Qt::LeftButton, true);
    for (std::size_t i = 1; i < way.size(); ++i) {
      for (int step = 1; step <= 8; ++step) {
        const double t = step / 8.0;
        send(QEvent::MouseMove, (1 - t) * way[i - 1] + t * way[i], Qt::NoButton, true);
      }
    }
    send(QEvent::MouseButtonRelease, way.back(), Qt::LeftButton, false);
  }
  void key(int code) {
    for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) {
      QKeyEvent event(type, code, Qt::NoModifier);
      QApplication::sendEvent(&view_, &event);
    }
    QApplication::processEvents();
  }
  void command(const char* id) {
    window_.actions()[QString::fromLatin1(id)]->trigger();
    QApplication::processEvents();
  }
  void settle() {
    for (int i = 0; i < 600; ++i) {
      wait(50);
      if (session().isPatternCurrent() && !session().worker().isWorking()) return;
    }
    require(false, "the pattern comes within 30 s");
  }
  void picture(const std::string& name) {
    if (folder.empty()) return;
    wait(400);
    window_.grab().save(QString::fromStdString(folder + "/" + name + ".png"));
  }
  void namePiece(const QString& name) {
    auto* field = window_.findChild<QLineEdit*>(QStringLiteral("pieceName"));
    require(field != nullptr, "a selected piece shows its name");
    type(*field, name);
  }
  inline static std::string folder;  ///< for pictures; none without

 private:
  MainWindow& window_;
  Viewport& view_;
};

}  // namespace toile::studio::use
