// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "toile/pipeline/live_pattern.h"

namespace toile::studio {

/// The strain of every piece, parallel to Pattern::cut.pieces.
using Strains = std::shared_ptr<const std::vector<std::optional<PieceStrain>>>;

/// What came of a document.
struct PatternAnswer {
  std::uint64_t request = 0;
  bool isPreview = false;
  Document document;  ///< that was asked about
  /// Null where nothing could be made; then `error` says why.
  std::shared_ptr<const Pattern> pattern;
  Strains strains;  ///< of a full answer
  std::optional<Error> error;
  /// The same document with its piece records moved after their pieces; null if none moved.
  std::shared_ptr<const Design> followed;
  double milliseconds = 0;
};

/// Why a pattern is asked for.
enum class AskedFor {
  Preview,  ///< a gesture is under way
  Step,     ///< a new step of the work: its piece records follow their pieces
  State     ///< a state as it is: opened, undone, redone
};

/// Makes the pattern of the newest document, off the UI thread.
///
/// One question waits at most: a newer one takes its place. A full answer that is being made for an
/// older document is stopped; a preview is short and runs to its end, so that something always
/// comes while a point is dragged. Answers come on the thread that this object lives on, those to
/// outdated questions never.
class PatternWorker : public QObject {
  Q_OBJECT
 public:
  explicit PatternWorker(QObject* parent = nullptr);
  ~PatternWorker() override;

  /// @return the number that the answer will have
  std::uint64_t ask(const Document& document, AskedFor what);
  /// What was asked last has not been answered in full.
  [[nodiscard]] bool isWorking() const;
  /// What the job is doing: "unfold Front (2 of 10)".
  [[nodiscard]] std::string step() const;
  void cancel();

 Q_SIGNALS:
  void answered(const toile::studio::PatternAnswer& answer);
  /// Began to work, or fell idle.
  void workingChanged();

 private:
  struct Question {
    std::uint64_t request = 0;
    AskedFor what = AskedFor::State;
    Document document;
  };
  class Job;

  void run();
  PatternAnswer answerOf(const Question& question, Progress& progress);
  void deliver(PatternAnswer answer);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Question> waiting_;
  std::shared_ptr<Job> running_;
  std::uint64_t lastRequest_ = 0;
  std::uint64_t answeredFully_ = 0;
  bool stopping_ = false;

  // Of the worker thread alone.
  toile::LivePattern live_;
  std::shared_ptr<const Pattern> lastFull_;
  std::thread thread_;
};

}  // namespace toile::studio
