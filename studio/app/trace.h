// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QFile>
#include <QObject>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "toile/design/design.h"

namespace toile::studio {

class PatternView;
class Session;
class Viewport;
struct PatternAnswer;

/// What the hand waits for, measured while the program is used: `toile-studio --trace FILE`.
///
/// Time counts from the time stamp that the window system put on the mouse event, queue and
/// compression of events included, until the picture with the answer is given to it. A line of the
/// file is "time-ms <tab> kind <tab> waited-ms"; kinds:
///   redraw   move of a held mouse -> the picture with the line as it is then. Of moves that came
///            before one picture the first counts.
///   preview  move -> the preview of the pattern of that move
///   full     release of the button -> the exact pattern
/// and, of these, without queues and drawing:
///   line     the engine's work on the curve, on the thread that draws
///   drawing  of the body's pane
///   engine-preview, engine-full   its work on the pattern, on the other thread
/// It ends with "# kind count median p95 max" lines.
class Trace final : public QObject {
 public:
  Trace(Session& session, Viewport& viewport, PatternView& pattern,
        const std::filesystem::path& file);
  ~Trace() override;  ///< writes the summary

  [[nodiscard]] bool isOpen() const { return file_.isOpen(); }
  [[nodiscard]] const std::vector<double>& waits(const char* kind) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void linesChanged();
  void answered(const PatternAnswer& answer);
  void patternChanged();
  void shown();
  [[nodiscard]] double clockNow() const;
  void write(const char* kind, double since);
  void note(const char* kind, double waited);

  Session& session_;
  Viewport& viewport_;
  PatternView& pattern_;
  QFile file_;
  QElapsedTimer clock_;
  double eventAt_ = 0;  ///< ms, of the event that is handled: its time stamp
  double paintedFrom_ = 0;
  double handledAt_ = 0;  ///< when its handling began
  bool isDragging_ = false;
  std::optional<double> redrawSince_;  ///< the first move that no picture shows yet
  /// The move that led to a document whose preview may still come.
  std::map<std::shared_ptr<const Design>, double> moves_;
  std::optional<double> previewSince_;  ///< the move whose preview has come and is not painted
  std::optional<double> releaseSince_;
  bool fullCame_ = false;
  bool bodyPainted_ = false, patternPainted_ = false;
  std::map<std::string, std::vector<double>> waits_;
};

}  // namespace toile::studio
