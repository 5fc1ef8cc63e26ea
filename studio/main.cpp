// SPDX-License-Identifier: GPL-3.0-or-later
// `toile-studio [FILE]`: the desktop program.
#include <QApplication>
#include <QCommandLineParser>
#include <QSettings>
#include <QTimer>
#include <cstdio>
#include <memory>

#include "app/main_window.h"
#include "app/palette.h"
#include "app/trace.h"
#include "toile/core/version.h"

int main(int argc, char** argv) {
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
  parser.addPositionalArgument(
      QStringLiteral("FILE"),
      QApplication::translate("main", "A design (.toile) or a model to open."),
      QStringLiteral("[FILE]"));
  const QCommandLineOption traceOption(
      QStringLiteral("trace"),
      QApplication::translate("main", "Write how long the hand waited to a file."),
      QStringLiteral("FILE"));
  parser.addOption(traceOption);
  parser.process(app);

  using namespace toile::studio;
  const bool dark = QSettings().value(QStringLiteral("theme")).toString() == QLatin1String("dark");
  applyTheme(app, dark ? Theme::Dark : Theme::Light);
  MainWindow window;
  std::unique_ptr<Trace> trace;
  if (parser.isSet(traceOption)) {
    trace = std::make_unique<Trace>(window.session(), window.viewport(), window.patternView(),
                                    parser.value(traceOption).toStdString());
    if (!trace->isOpen()) {
      std::fprintf(stderr, "toile-studio: %s cannot be written\n",
                   qPrintable(parser.value(traceOption)));
      return 2;
    }
  }
  window.showStart();
  window.show();
  const QStringList files = parser.positionalArguments();
  // After the window is there, so that it is never waited for.
  QTimer::singleShot(0, &window, [&window, files] {
    if (files.isEmpty() && window.offerLeftWork()) return;
    if (!files.isEmpty()) window.open(files.front().toStdString());
  });
  return QApplication::exec();
}
