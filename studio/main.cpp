// SPDX-License-Identifier: GPL-3.0-or-later
// `toile-studio [FILE]`: the desktop program.
#include <QApplication>
#include <QCommandLineParser>
#include <QSettings>
#include <QSurfaceFormat>
#include <QTimer>

#include "app/main_window.h"
#include "app/palette.h"
#include "toile/core/version.h"

int main(int argc, char** argv) {
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  QSurfaceFormat::setDefaultFormat(format);

  QApplication app(argc, argv);
  QApplication::setApplicationName(QStringLiteral("toile-studio"));
  QApplication::setOrganizationName(QStringLiteral("toile"));
  QApplication::setApplicationDisplayName(QStringLiteral("Toile"));
  QApplication::setApplicationVersion(QString::fromLatin1(toile::version()));

  QCommandLineParser parser;
  parser.setApplicationDescription(QApplication::translate(
      "main", "Draw styling lines on a body and watch the pattern change as you draw."));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(QStringLiteral("FILE"),
                               QApplication::translate("main", "A design (.toile) to open."),
                               QStringLiteral("[FILE]"));
  parser.process(app);

  using namespace toile::studio;
  const bool dark = QSettings().value(QStringLiteral("theme")).toString() == QLatin1String("dark");
  applyTheme(app, dark ? Theme::Dark : Theme::Light);
  MainWindow window;
  window.show();
  const QStringList files = parser.positionalArguments();
  // After the window is there, so that it is never waited for.
  QTimer::singleShot(0, &window, [&window, files] {
    if (files.isEmpty() && window.offerLeftWork()) return;
    if (files.isEmpty() || !window.open(files.front().toStdString())) window.newWork();
  });
  return QApplication::exec();
}
