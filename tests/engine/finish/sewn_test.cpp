// SPDX-License-Identifier: GPL-3.0-or-later
// The wetsuit with an allowance, as a sewer lays its pieces on each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "finish/polygon.h"
#include "support/sample_designs.h"
#include "toile/sew/sewing.h"

namespace toile::test {
namespace {

using Eigen::Vector2d;

class Sewn : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Result<Document> document = openDocument(exampleDesign("wetsuit-full.toile"));
    ASSERT_TRUE(document) << document.error();
    Design design = *document->design;
    design.finish.allowance = Length::mm(10);
    for (StylingCurve& curve : design.curves)
      curve.left.allowance = curve.right.allowance = std::nullopt;
    const Result<Pattern> made = makePattern(withDesign(*document, design));
    ASSERT_TRUE(made) << made.error();
    pattern_ = *made;
  }
  static void TearDownTestSuite() { pattern_.reset(); }
  static inline std::optional<Pattern> pattern_;
};

/// How far the allowance of a run goes on beyond the run's end, close below the cut line.
double reachBeyond(const PatternPiece& piece, const OutlineRun& run, bool atEnd) {
  const Outline& sew = piece.sewLines[run.loop];
  const std::size_t count = sew.size();
  const auto at = [&](std::size_t k) -> Vector2d { return sew[(run.first + k) % count].position; };
  const Vector2d end = atEnd ? at(run.edgeCount) : at(0);
  const Vector2d inner = atEnd ? at(run.edgeCount - 1) : at(1);
  const Vector2d d = (end - inner).normalized();
  // The piece lies to the left of its outline.
  const Vector2d out = atEnd ? Vector2d(d.y(), -d.x()) : Vector2d(-d.y(), d.x());
  const Vector2d from = end + 0.995 * run.allowance * out;
  double reach = std::numeric_limits<double>::infinity();
  for (const Outline& loop : piece.cutLines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d& a = loop[i].position;
      const Vector2d edge = loop[(i + 1) % loop.size()].position - a;
      const double determinant = cross(d, edge);
      if (std::abs(determinant) < 1e-9) continue;
      const double along = cross(a - from, edge) / determinant;
      const double onEdge = cross(a - from, d) / determinant;
      if (onEdge >= 0 && onEdge <= 1 && along >= 0) reach = std::min(reach, along);
    }
  }
  return isInside(positions(piece.cutLines), from) ? reach : 0;
}

/// Whether the outline goes on with a seam beyond the run's end. A hem's corner is mirrored, each
/// piece's in its own fold, and not made like its mate's.
bool meetsASeam(const PatternPiece& piece, const OutlineRun& run, bool atEnd) {
  const std::size_t count = piece.sewLines[run.loop].size();
  const auto isNext = [&](const OutlineRun& before, const OutlineRun& after) {
    return (before.first + before.edgeCount) % count == after.first;
  };
  return std::any_of(piece.runs.begin(), piece.runs.end(), [&](const OutlineRun& other) {
    return other.loop == run.loop && other.seam != 0 &&
           (atEnd ? isNext(run, other) : isNext(other, run));
  });
}

/// The first and the last run of each side of a seam that two sides have.
struct Side {
  const PatternPiece* piece;
  const OutlineRun* first;
  const OutlineRun* last;
};
std::map<int, std::vector<Side>> sidesOf(const Pattern& pattern) {
  std::map<int, std::vector<Side>> seams;
  const SewingPlan plan = planSewing(pattern);
  for (const SewEdge& edge : plan.edges) {
    const PatternPiece& piece = pattern.pieces[edge.piece];
    seams[edge.seam].push_back(
        {&piece, &piece.runs[edge.runs.front()], &piece.runs[edge.runs.back()]});
  }
  return seams;
}

TEST_F(Sewn, AllowancesEndOnEachOther) {
  constexpr double kMatchMm = 0.6;  // mitres may differ by 0.5
  std::size_t compared = 0;
  for (const auto& [number, sides] : sidesOf(*pattern_)) {
    ASSERT_EQ(sides.size(), 2u);
    for (const bool atEnd : {true, false}) {
      const PatternPiece& a = *sides[0].piece;
      const PatternPiece& b = *sides[1].piece;
      const OutlineRun& runA = atEnd ? *sides[0].last : *sides[0].first;
      const OutlineRun& runB = atEnd ? *sides[1].first : *sides[1].last;
      if (!meetsASeam(a, runA, atEnd) || !meetsASeam(b, runB, !atEnd)) continue;
      const double own = reachBeyond(a, runA, atEnd);
      const double other = reachBeyond(b, runB, !atEnd);
      // Where the outline goes straight on, or turns inwards, there is no corner of the allowance.
      if (own < 0.1 || other < 0.1 || own > 40 || other > 40) continue;
      ++compared;
      EXPECT_NEAR(own, other, kMatchMm) << a.name << ", " << b.name << ", " << runA.curve;
    }
  }
  EXPECT_GE(compared, 12u);
  RecordProperty("compared", static_cast<int>(compared));
}

TEST_F(Sewn, NotchesKeepAwayFromCorners) {
  std::size_t seen = 0;
  for (const PatternPiece& piece : pattern_->pieces) {
    for (const Notch& notch : piece.notches) {
      ++seen;
      const auto check = [&](const std::vector<Outline>& lines, const Vector2d& place) {
        for (const Outline& loop : lines)
          for (const OutlinePoint& p : loop)
            if (p.corner) {
              EXPECT_GT((p.position - place).norm(), notch.depth) << piece.name;
            }
      };
      check(piece.sewLines, notch.onSewLine);
      check(piece.cutLines, notch.position);
    }
  }
  EXPECT_GT(seen, 80u);
}

TEST_F(Sewn, NotchesAreDoubleAtTheBackOnly) {
  constexpr double kPairMm = 9;
  std::size_t doubles = 0;
  for (const auto& [number, sides] : sidesOf(*pattern_)) {
    std::array<std::size_t, 2> pairs{};
    double normals = 0;
    double points = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      const PatternPiece& piece = *sides[s].piece;
      std::map<int, std::vector<Vector2d>> places;
      for (const Notch& notch : piece.notches)
        if (notch.seam == sides[s].first->curve && notch.number > 0)
          places[notch.number].push_back(notch.onSewLine);
      for (const OutlineRun& run : piece.runs) {
        if (run.seam != number) continue;
        const auto p = static_cast<std::size_t>(&piece - pattern_->pieces.data());
        const Piece& cut = pattern_->cut.pieces[pattern_->pieceIndex[p]];
        const std::vector<VertexId>& line = cut.wires[run.wire].vertices;
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
          const EdgeId e = cut.mesh->findEdge(line[k], line[k + 1]);
          if (!e.isValid()) continue;
          normals += cut.mesh->normal(cut.mesh->face(cut.mesh->halfedge(e))).y();
          ++points;
        }
        // Its own notches stand on this run's points' chords.
        for (const auto& [mark, list] : places) {
          if (list.size() != 2 || (list[0] - list[1]).norm() > kPairMm) continue;
          const Outline& sew = piece.sewLines[run.loop];
          double off = std::numeric_limits<double>::infinity();
          for (std::size_t k = 0; k < run.edgeCount; ++k) {
            const Vector2d& a = sew[(run.first + k) % sew.size()].position;
            const Vector2d d = sew[(run.first + k + 1) % sew.size()].position - a;
            const double t = std::clamp((list[0] - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
            off = std::min(off, (a + t * d - list[0]).norm());
          }
          if (off < 1e-6) ++pairs[s];
        }
      }
    }
    EXPECT_EQ(pairs[0], pairs[1]) << sides[0].piece->name << ", " << sides[0].first->curve;
    doubles += pairs[0];
    if (pairs[0] > 0) {
      EXPECT_GT(normals / points, 0.2) << sides[0].piece->name << ", " << sides[0].first->curve;
    }
  }
  EXPECT_GE(doubles, 4u);
  RecordProperty("doubles", static_cast<int>(doubles));
}

}  // namespace
}  // namespace toile::test
