// SPDX-License-Identifier: GPL-3.0-or-later
// What findings of real patterns offer, and that it helps.
#include "panels/cures.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "document/sheet_edits.h"
#include "support/meshes.h"
#include "toile/design/design_file.h"

namespace toile::studio {
namespace {

using Eigen::Vector3d;

Place at(const Vector3d& position) {
  return NearPosition{position, {}};
}

StylingCurve line(const std::string& id, const Vector3d& from, const Vector3d& to) {
  StylingCurve curve;
  curve.id = id;
  curve.way = SmoothWay{{at(from), at(to)}, SubdivisionRule::Auto, {}, {}};
  return curve;
}

PieceRecord record(const std::string& id, const Vector3d& anchor) {
  PieceRecord made;
  made.id = id;
  made.anchor = NearPosition{anchor, {}};
  return made;
}

Document documentOf(const Design& design, Mesh mesh) {
  return {std::make_shared<const Design>(design),
          std::make_shared<const ReferenceModel>(makeReferenceModel("cloth", std::move(mesh)))};
}

/// Work on a cloth of 400 x 240 mm, or on what is given, with its pattern.
class Cures : public testing::Test {
 protected:
  void SetUp() override {
    static int count = 1;
    static char name[] = "toile_studio_test";
    static char* arguments[] = {name, nullptr};
    if (QCoreApplication::instance() == nullptr) {
      app_ = std::make_unique<QCoreApplication>(count, arguments);
    }
    session_ = std::make_unique<Session>();
  }
  void TearDown() override { session_.reset(); }

  void start(const Design& design, Mesh mesh = test::grid(40, 24)) {
    session_->start(documentOf(design, std::move(mesh)), {}, QStringLiteral("start"));
    settle();
  }
  void settle() {
    QElapsedTimer clock;
    clock.start();
    while (!session_->isPatternCurrent() || session_->worker().isWorking()) {
      ASSERT_LT(clock.elapsed(), 30000) << "a pattern comes";
      ASSERT_FALSE(session_->patternError()) << session_->patternError()->message;
      QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    }
  }
  [[nodiscard]] const Design& design() const { return *session_->document().design; }
  [[nodiscard]] const Finding* find(const std::string& code) const {
    const auto& findings = session_->fullPattern()->findings;
    const auto found = std::ranges::find(findings, code, &Finding::code);
    return found == findings.end() ? nullptr : &*found;
  }
  /// Does the cure of that kind that the finding offers.
  void cure(const std::string& code, Cure::Kind kind) {
    const Finding* finding = find(code);
    ASSERT_NE(finding, nullptr) << code;
    const auto offered = curesOf(*session_->fullPattern(), code, finding->where);
    const auto chosen = std::ranges::find(offered, kind, &Cure::kind);
    ASSERT_NE(chosen, offered.end()) << code << " offers nothing of that kind";
    EXPECT_FALSE(chosen->label.isEmpty());
    apply(*session_, *chosen);
    settle();
  }
  /// One step, after which the finding is gone, and one undo brings all back.
  void curedInOneStep(const std::string& code, Cure::Kind kind) {
    const std::size_t steps = session_->history().at();
    const std::string before = writeDesign(design());
    cure(code, kind);
    if (HasFatalFailure()) return;
    EXPECT_EQ(session_->history().at(), steps + 1);
    EXPECT_EQ(find(code), nullptr) << "the finding is gone";
    session_->undo();
    settle();
    EXPECT_EQ(writeDesign(design()), before);
    session_->redo();
    settle();
  }

  std::unique_ptr<Session> session_;

 private:
  std::unique_ptr<QCoreApplication> app_;
};

TEST_F(Cures, ACutThatEndsInsideAPieceBecomesADart) {
  Design drawn;
  drawn.curves = {line("slit", {100, 0, 0}, {120, 130, 0})};
  drawn.pieces = {record("front", {300, 200, 0})};
  start(drawn);
  curedInOneStep("open-cut-end", Cure::Kind::MakeDart);
  EXPECT_EQ(design().curves.front().kind, CurveKind::Dart);
}

TEST_F(Cures, ALineBelowAnotherIsRemoved) {
  Design drawn;
  drawn.curves = {line("first", {200, 0, 0}, {200, 240, 0}),
                  line("second", {200, 0, 0}, {200, 240, 0})};
  drawn.pieces = {record("left", {100, 100, 0}), record("right", {300, 100, 0})};
  start(drawn);
  const Finding* hidden = find("hidden-curve");
  ASSERT_NE(hidden, nullptr);
  const std::string gone = hidden->where.front().name;
  curedInOneStep("hidden-curve", Cure::Kind::RemoveLine);
  ASSERT_EQ(design().curves.size(), 1U);
  EXPECT_NE(design().curves.front().id, gone);
  EXPECT_EQ(session_->fullPattern()->pieces.size(), 2U) << "the pieces are as before";
}

TEST_F(Cures, OfTwoNamesForOnePieceTheFirstStays) {
  Design drawn;
  drawn.curves = {line("seam", {200, 0, 0}, {200, 240, 0})};
  drawn.pieces = {record("yoke", {50, 50, 0}), record("pocket", {150, 200, 0}),
                  record("back", {300, 100, 0})};
  start(drawn);
  curedInOneStep("two-anchors", Cure::Kind::ForgetName);
  ASSERT_EQ(design().pieces.size(), 2U);
  EXPECT_EQ(design().pieces[0].id, "yoke");
  EXPECT_EQ(design().pieces[1].id, "back");
}

TEST_F(Cures, PiecesThatAHandLaidOnEachOtherGoBack) {
  Design drawn;
  drawn.curves = {line("seam", {200, 0, 0}, {200, 240, 0})};
  drawn.pieces = {record("left", {100, 100, 0}), record("right", {300, 100, 0})};
  start(drawn);
  const Pattern& pattern = *session_->fullPattern();
  Document moved = session_->document();
  const auto onto = withPieceOnSheet(moved, pattern, 0, pattern.layout.placements[0]);
  ASSERT_TRUE(onto);
  Placement there = pattern.layout.placements[1];
  there.offset = pattern.layout.placements[0].offset + Eigen::Vector2d(40, 10);
  const auto both = withPieceOnSheet(*onto, pattern, 1, there);
  ASSERT_TRUE(both);
  session_->commit(QStringLiteral("laid on each other"), *both);
  settle();
  curedInOneStep("layout-hand-overlap", Cure::Kind::BackInPlace);
  EXPECT_TRUE(design().layout.empty());
}

// A level strip of 1.3 turns: its end would lie on its beginning.
TEST_F(Cures, APieceThatWouldLieOnItselfIsOfferedDarts) {
  constexpr int kColumns = 104, kRows = 6;
  std::vector<Vector3d> positions;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kColumns; ++i) {
      const double turn = -2 * std::numbers::pi * 1.3 * i / kColumns;
      const double radius = 80 + 40.0 * j / kRows + 10.0 * i / kColumns;
      positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                             100.0 * i / kColumns);
    }
  }
  Design drawn;
  drawn.pieces = {record("frill", positions[3 * (kColumns + 1) + 60])};
  start(drawn, test::grid(kColumns, kRows).withPositions(positions));
  std::string asked;
  QObject::connect(session_.get(), &Session::panelWanted, session_.get(),
                   [&](SidePanel panel, const std::string& piece) {
                     if (panel == SidePanel::Darts) asked = piece;
                   });
  cure("kept-apart", Cure::Kind::Darts);
  EXPECT_EQ(asked, "frill") << "the adviser opens for it";
  EXPECT_TRUE(session_->selection().isPiece("frill"));
}

}  // namespace
}  // namespace toile::studio
