// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>

#include "app/session.h"
#include "panels/cures.h"

namespace toile::studio {

/// All pieces; the selected one is the same as in both panes.
class PiecesList final : public QListWidget {
  Q_OBJECT
 public:
  explicit PiecesList(Session& session, QWidget* parent = nullptr);
  [[nodiscard]] int pieceCount() const { return pieces_; }

 Q_SIGNALS:
  void countChanged(int pieces);

 private:
  void refill();
  void showSelection();
  Session& session_;
  int pieces_ = 0;
};

/// What is worth knowing, in words; a row leads to its place, the rows below it to what helps.
class FindingsList final : public QListWidget {
  Q_OBJECT
 public:
  explicit FindingsList(Session& session, QWidget* parent = nullptr);

 Q_SIGNALS:
  void countChanged(int findings);

 private:
  void refill();
  void add(const QString& iconName, const QColor& colour, const QString& text,
           const std::vector<Element>& where);
  void addCures(const std::vector<Cure>& cures);
  void addSpots();
  void run(const QListWidgetItem& item);
  Session& session_;
  std::vector<Cure> cures_;  ///< of the rows that offer one
};

/// Every step with its name, newest first; a click goes there.
class HistoryList final : public QListWidget {
  Q_OBJECT
 public:
  explicit HistoryList(Session& session, QWidget* parent = nullptr);

 private:
  void refill();
  Session& session_;
};

}  // namespace toile::studio
