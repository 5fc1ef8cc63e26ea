// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "unfold/box_minimum.h"

namespace toile {
namespace {

/// A grid of n x n cells with a line across its middle row.
Piece withMiddleLine(const Mesh& mesh, int n, WireKind kind = WireKind::Elastic) {
  PolygonSoup::Chain chain;
  chain.group = kind == WireKind::Elastic ? "wire_elastic_waist" : "wire_feature_waist";
  for (int i = 0; i <= n; ++i) {
    chain.vertices.push_back(static_cast<std::uint32_t>(n / 2 * (n + 1) + i));
  }
  return test::patchOf(mesh, {chain});
}

std::vector<Wire*> linesOf(Piece& piece) {
  std::vector<Wire*> lines;
  for (Wire& wire : piece.wires) {
    if (wire.curve == "waist") lines.push_back(&wire);
  }
  return lines;
}

void setRange(Piece& piece, double range) {
  for (Wire* wire : linesOf(piece)) wire->elasticRange = range;
}

/// Every edge of the line has 1 + ratio times its target in the plane.
void expectOneRatio(Piece& piece, const FlatPiece& flat, double ratio) {
  for (const Wire* wire : linesOf(piece)) {
    for (std::size_t i = 0; i + 1 < wire->vertices.size(); ++i) {
      const double length =
          (flat.position[wire->vertices[i]] - flat.position[wire->vertices[i + 1]]).norm();
      EXPECT_NEAR(length / wire->targetLength[i], 1 + ratio, 1e-11);
    }
  }
}

Mesh dome(int n) {
  return test::heightField(n, n, 10, [n](double x, double y) {
    const double u = x / (10 * n) - 0.5, w = y / (10 * n) - 0.5;
    return 6.0 * n * (0.5 - u * u - w * w);
  });
}

TEST(ElasticLine, TakesBackWhatItsTargetIsTooLong) {
  Piece piece = withMiddleLine(test::irregularGrid(8, 8), 8);
  for (Wire* wire : linesOf(piece)) {
    for (double& target : wire->targetLength) target *= 1.03;
  }
  setRange(piece, 0.05);
  const Result<FlatPiece> flat = unfold(piece);
  ASSERT_TRUE(flat) << flat.error();
  ASSERT_EQ(flat->elastic.lines.size(), 1U);
  EXPECT_EQ(flat->elastic.lines[0].curve, "waist");
  EXPECT_NEAR(flat->elastic.lines[0].ratio, 1 / 1.03 - 1, 1e-6);
  EXPECT_LT(flat->maxAreaError, 1e-5) << "then the piece is flat";
  EXPECT_TRUE(flat->check.passes());
  expectOneRatio(piece, *flat, flat->elastic.lines[0].ratio);
}

TEST(ElasticLine, NeverLeavesItsRange) {
  for (const double range : {0.001, 0.01, 0.03, 0.3}) {
    SCOPED_TRACE(range);
    Piece piece = withMiddleLine(dome(10), 10);
    setRange(piece, range);
    const Result<FlatPiece> flat = unfold(piece);
    ASSERT_TRUE(flat) << flat.error();
    const double ratio = flat->elastic.lines.at(0).ratio;
    EXPECT_LE(std::abs(ratio), range);
    if (range <= 0.01) {
      EXPECT_EQ(ratio, -range) << "a dome wants more than that";
    }
    EXPECT_LE(flat->check.maxLengthError, 1e-12);
    EXPECT_EQ(flat->check.flippedFaces, 0U);
    expectOneRatio(piece, *flat, ratio);
  }
}

// The ratio found is where the cost of other ratios is least, and the model of that cost is right:
// both from answers with the line kept at other lengths.
TEST(ElasticLine, FindsTheRatioOfTheLeastCost) {
  Piece piece = withMiddleLine(dome(10), 10);
  setRange(piece, 0.3);
  const UnfoldOptions options{.wireStiffness = 0.1};
  const Result<FlatPiece> free = unfold(piece, options);
  ASSERT_TRUE(free) << free.error();
  const double found = free->elastic.lines.at(0).ratio;
  ASSERT_LT(found, -0.01);
  ASSERT_GT(found, -0.3);
  EXPECT_NEAR(free->elastic.gradient[0] / free->elastic.stiffness(0, 0), 0, 1e-4);
  // What a line costs that is held at a ratio: its own answer with next to no range.
  const auto slopeAt = [&](double ratio) {
    Piece held = withMiddleLine(dome(10), 10);
    for (Wire* wire : linesOf(held)) {
      for (double& target : wire->targetLength) target *= 1 + ratio;
    }
    setRange(held, 1e-12);
    return unfold(held, options)->elastic.gradient[0];
  };
  constexpr double kStep = 0.003;
  const double low = slopeAt(found - kStep), high = slopeAt(found + kStep);
  EXPECT_LT(low, 0);
  EXPECT_GT(high, 0);
  EXPECT_NEAR((high - low) / (2 * kStep), free->elastic.stiffness(0, 0),
              0.1 * free->elastic.stiffness(0, 0));
}

TEST(ElasticLine, WithoutARangeIsAFeature) {
  Piece elastic = withMiddleLine(dome(8), 8);
  setRange(elastic, 0);
  const Result<FlatPiece> a = unfold(elastic);
  const Result<FlatPiece> b = unfold(withMiddleLine(dome(8), 8, WireKind::Feature));
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->elastic.lines.empty());
  EXPECT_EQ(a->position.values(), b->position.values());
}

TEST(ElasticLine, IsSettledBeforeWiresAreWarped) {
  Piece piece = withMiddleLine(dome(8), 8);
  setRange(piece, 0.01);
  const Result<FlatPiece> flat =
      unfold(piece, {.objective = UnfoldObjective::WireWarping, .weights = WireWeights::Unit});
  ASSERT_TRUE(flat) << flat.error();
  EXPECT_EQ(flat->elastic.lines.at(0).ratio, -0.01);
  EXPECT_LE(flat->check.maxLengthError, 1e-9);
  expectOneRatio(piece, *flat, -0.01);
}

TEST(ElasticLine, RefusesARangeThatMeansNothing) {
  for (const double range : {-0.1, 1.5, std::nan("")}) {
    Piece piece = withMiddleLine(test::grid(4, 4), 4);
    setRange(piece, range);
    const Result<FlatPiece> flat = unfold(piece);
    ASSERT_FALSE(flat);
    EXPECT_EQ(flat.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(flat.error().where.at(0), Element::curve("waist"));
  }
}

TEST(BoxMinimum, IsTheLeastOnAGrid) {
  Eigen::Matrix2d hessian;
  hessian << 2, 1.2, 1.2, 3;
  const Eigen::Vector2d low(-1, -0.5), high(0.5, 2);
  for (const Eigen::Vector2d& gradient :
       {Eigen::Vector2d(0.3, -0.4), Eigen::Vector2d(5, -9), Eigen::Vector2d(-4, 1)}) {
    const auto value = [&](const Eigen::Vector2d& x) {
      return gradient.dot(x) + 0.5 * x.dot(hessian * x);
    };
    const Eigen::Vector2d found = unfolding::minimumInBox(gradient, hessian, low, high);
    EXPECT_TRUE((found.array() >= low.array()).all() && (found.array() <= high.array()).all());
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; j <= 200; ++j) {
        const Eigen::Vector2d x =
            low + Eigen::Vector2d((high - low).x() * i / 200.0, (high - low).y() * j / 200.0);
        EXPECT_GE(value(x), value(found) - 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace toile
