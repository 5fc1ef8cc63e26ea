// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "support/generated_pieces.h"
#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"
#include "unfold/over_bracing.h"
#include "unfold/problem.h"
#include "unfold/wire_bending.h"

namespace toile {
namespace {

using unfolding::Corner;
using unfolding::Plane;
using unfolding::Problem;

constexpr UnfoldOptions kPaper{.objective = UnfoldObjective::WireWarping,
                               .weights = WireWeights::Unit};

Plane planeOf(const FlatPiece& flat) {
  Plane q(2 * static_cast<Eigen::Index>(flat.position.size()));
  for (std::size_t v = 0; v < flat.position.size(); ++v) {
    q.segment<2>(2 * static_cast<Eigen::Index>(v)) = flat.position[VertexId(v)];
  }
  return q;
}

/// Faces that no wire parts: for each face the number of its patch.
std::vector<std::size_t> wirePatches(const Piece& piece, const Problem& problem) {
  const Mesh& mesh = *piece.mesh;
  EdgeData<char> isWire(mesh.edgeCount(), 0);
  for (const auto& edge : problem.wireEdges) {
    isWire[mesh.findEdge(VertexId(edge.a), VertexId(edge.b))] = 1;
  }
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> patch(mesh.faceCount(), kNone);
  std::size_t count = 0;
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (patch[seed] != kNone) continue;
    std::vector<std::size_t> stack{seed};
    patch[seed] = count;
    while (!stack.empty()) {
      const FaceId face(stack.back());
      stack.pop_back();
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh.halfedge(face, side);
        if (isWire[mesh.edge(h)] != 0 || !mesh.opposite(h).isValid()) continue;
        const std::size_t other = mesh.face(mesh.opposite(h)).index();
        if (patch[other] != kNone) continue;
        patch[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return patch;
}

/// At the minimum w (theta - alpha) is an affine function of the corner's place in each patch, plus
/// one number for each vertex off the border (algorithms of the paper, derived from its Jacobian).
/// @return how far it is from the nearest such function, relative to its greatest value.
double distanceFromOptimality(const Piece& piece, const FlatPiece& flat) {
  const Problem problem = *unfolding::makeProblem(piece);
  const Plane q = planeOf(flat);
  const std::vector<double> theta = unfolding::cornerAngles(problem, q);
  const std::vector<std::size_t> patch = wirePatches(piece, problem);
  const std::size_t patchCount = 1 + *std::max_element(patch.begin(), patch.end());
  std::map<std::uint32_t, Eigen::Index> inner;
  for (const Corner& corner : problem.corners) {
    if (!piece.mesh->isBorder(VertexId(corner.at))) {
      inner.try_emplace(corner.at, static_cast<Eigen::Index>(3 * patchCount + inner.size()));
    }
  }
  // A hole must close too: one more affine function, for the sum of all corners at its vertices.
  std::map<std::uint32_t, Eigen::Index> holeOf;
  auto columns = static_cast<Eigen::Index>(3 * patchCount + inner.size());
  for (std::size_t l = 0; l < problem.loops.size(); ++l) {
    if (l == problem.outerLoop) continue;
    for (const std::uint32_t v : problem.loops[l]) holeOf[v] = columns;
    columns += 3;
  }
  const auto rows = static_cast<Eigen::Index>(problem.corners.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::VectorXd b(rows);
  const double size = std::sqrt(problem.area);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Corner& corner = problem.corners[static_cast<std::size_t>(i)];
    const Eigen::Vector2d place = flat.position[VertexId(corner.at)] / size;
    const auto addAffine = [&](Eigen::Index first) {
      a(i, first) = 1;
      a(i, first + 1) = place.x();
      a(i, first + 2) = place.y();
    };
    addAffine(static_cast<Eigen::Index>(3 * patch[problem.sectorCorners[corner.sectorBegin] / 3]));
    if (const auto hole = holeOf.find(corner.at); hole != holeOf.end()) addAffine(hole->second);
    const auto vertex = inner.find(corner.at);
    if (vertex != inner.end()) a(i, vertex->second) = 1;
    b[i] = theta[static_cast<std::size_t>(i)] - corner.alpha;
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(a);
  const Eigen::VectorXd residual = a * solver.solve(b) - b;
  return residual.cwiseAbs().maxCoeff() / std::max(1e-9, b.cwiseAbs().maxCoeff());
}

TEST(WireWarping, EveryGeneratedPieceIsAtAMinimumOrCalledInfeasible) {
  const std::vector<test::GeneratedPiece> pieces = test::generatedPieces();
  EXPECT_GE(pieces.size(), 40U);
  for (const test::GeneratedPiece& each : pieces) {
    SCOPED_TRACE(each.name);
    const Result<FlatPiece> flat = unfold(each.piece, kPaper);
    ASSERT_EQ(flat.hasValue(), each.isFeasible);
    if (!flat) {
      EXPECT_EQ(flat.error().code, ErrorCode::LengthsInfeasible);
      continue;
    }
    EXPECT_LE(flat->check.maxLengthError, 1e-12);
    for (const Finding& finding : flat->findings) EXPECT_NE(finding.code, "step-limit");
    EXPECT_EQ(flat->check.crossings > 0, each.overlapsItself || each.wiresCross);
    if (each.wiresCross) continue;  // then no cloth fits between them, and the angles are not ours
    EXPECT_EQ(flat->check.flippedFaces, 0U);
    // Where there is nothing to bend only rounding is left to compare.
    if (flat->wireBending > 1e-12) {
      EXPECT_LT(distanceFromOptimality(each.piece, *flat), 1e-6);
    }
  }
}

/// Two lines that wander over a grid of n by n cells, one from left to right, one from below up.
std::vector<PolygonSoup::Chain> wanderingLines(int n, std::mt19937& random) {
  std::vector<PolygonSoup::Chain> lines(2);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    lines[k].group = "wire_feature_" + std::to_string(k);
    int along = 0;
    int across = 1 + static_cast<int>(random() % static_cast<unsigned>(n - 1));
    const auto add = [&] {
      const int column = k == 0 ? along : across, row = k == 0 ? across : along;
      lines[k].vertices.push_back(static_cast<std::uint32_t>(row * (n + 1) + column));
    };
    add();
    while (along < n) {
      ++along;
      add();
      const int next = across + static_cast<int>(random() % 3) - 1;
      if (along == n || next == across || next < 1 || next >= n) continue;
      across = next;
      add();
    }
  }
  return lines;
}

// Random networks on random surfaces. TOILE_TRIALS sets how many.
TEST(WireWarping, RandomNetworksAreAtAMinimum) {
  const char* wanted = std::getenv("TOILE_TRIALS");
  const int trials = wanted != nullptr ? std::atoi(wanted) : 12;
  constexpr int kCells = 14;
  std::mt19937 random(11);
  int bent = 0;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    const double a = 0.02 + 0.03 * static_cast<double>(random() % 100) / 100;
    const double b = static_cast<double>(random() % 100) / 30;
    const Mesh mesh = test::heightField(kCells, kCells, 10, [&](double x, double y) {
      return 12 * std::sin(a * x + b) * std::cos(0.03 * y - b);
    });
    const Piece piece = test::patchOf(mesh, wanderingLines(kCells, random));
    const Result<FlatPiece> flat = unfold(piece, kPaper);
    ASSERT_TRUE(flat) << flat.error();
    EXPECT_LE(flat->check.maxLengthError, 1e-12);
    if (flat->check.crossings > 0) continue;  // no cloth fits then, and the angles are not ours
    ++bent;
    EXPECT_LT(distanceFromOptimality(piece, *flat), 1e-6);
  }
  EXPECT_GT(bent, trials / 2);
}

// The same pieces with the default objective: nothing folds, nothing crosses unnoticed.
TEST(LeastStrain, EveryGeneratedPieceLiesFlatOrIsCalledInfeasible) {
  for (const test::GeneratedPiece& each : test::generatedPieces()) {
    SCOPED_TRACE(each.name);
    const Result<FlatPiece> flat = unfold(each.piece, {.keepApart = false});
    ASSERT_EQ(flat.hasValue(), each.isFeasible);
    if (!flat) {
      EXPECT_EQ(flat.error().code, ErrorCode::LengthsInfeasible);
      continue;
    }
    EXPECT_LE(flat->check.maxLengthError, 1e-9);
    EXPECT_LE(flat->steps, 25);
    EXPECT_EQ(flat->check.flippedFaces, 0U);
    EXPECT_EQ(flat->check.crossings > 0, each.overlapsItself);
  }
}

// The line along the inside of a torus is too long for the cloth beside it; the border is not.
TEST(LeastStrain, StiffensOnlyTheWireThatWouldWave) {
  const std::vector<test::GeneratedPiece> pieces = test::generatedPieces();
  const auto torus = std::find_if(pieces.begin(), pieces.end(),
                                  [](const auto& each) { return each.name == "torus-line"; });
  ASSERT_NE(torus, pieces.end());
  const Result<FlatPiece> flat = unfold(torus->piece);
  ASSERT_TRUE(flat) << flat.error();
  const auto stiffened = std::find_if(flat->findings.begin(), flat->findings.end(),
                                      [](const auto& f) { return f.code == "wires-stiffened"; });
  ASSERT_NE(stiffened, flat->findings.end());
  EXPECT_EQ(stiffened->where, std::vector<Element>{Element::curve("a")});
  EXPECT_GT(flat->wireStiffness, 0.05);
}

// A wave in the corners' angles costs J; the least strain does not know it.
TEST(WireWarping, BendsWiresLessThanTheLeastStrainDoes) {
  const Mesh mesh = test::saddle(12, 10, 0.003);
  const Piece piece = test::patchOf(mesh);
  const Problem problem = *unfolding::makeProblem(piece);
  const auto bending = [&](const FlatPiece& flat) {
    const std::vector<double> theta = unfolding::cornerAngles(problem, planeOf(flat));
    double sum = 0;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      sum += (theta[i] - problem.corners[i].alpha) * (theta[i] - problem.corners[i].alpha);
    }
    return sum;
  };
  const Result<FlatPiece> strained = unfold(piece), warped = unfold(piece, kPaper);
  ASSERT_TRUE(strained && warped);
  EXPECT_LT(bending(*warped), 0.5 * bending(*strained));
  EXPECT_NEAR(bending(*warped), warped->wireBending, 1e-9 * warped->wireBending);
  EXPECT_GT(warped->meanAreaError, 1.2 * strained->meanAreaError);
}

/// A cap whose rim has many short edges on one half.
Piece unevenCap() {
  const double radius = 100, half = 0.9;
  std::vector<double> around;
  for (int i = 0; i < 36; ++i) around.push_back(std::numbers::pi * i / 36);
  for (int i = 0; i < 6; ++i) around.push_back(std::numbers::pi * (1 + i / 6.0));
  std::vector<Eigen::Vector3d> positions{{0, 0, radius}};
  const std::size_t segments = around.size(), rows = 8;
  for (std::size_t j = 1; j <= rows; ++j) {
    const double polar = half * static_cast<double>(j) / rows;
    for (const double a : around) {
      positions.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(a),
                                                   std::sin(polar) * std::sin(a), std::cos(polar)));
    }
  }
  std::vector<Triangle> triangles;
  const auto at = [&](std::size_t j, std::size_t i) {
    return VertexId(j == 0 ? 0 : 1 + (j - 1) * segments + i % segments);
  };
  for (std::size_t i = 0; i < segments; ++i) {
    triangles.push_back({at(0, 0), at(1, i), at(1, i + 1)});
    for (std::size_t j = 1; j < rows; ++j) {
      triangles.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      triangles.push_back({at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  }
  return test::patchOf(*makeMesh(positions, triangles));
}

double widthOverHeight(const FlatPiece& flat, const Piece& piece) {
  double low = 1e9, high = 0;
  for (int degrees = 0; degrees < 180; degrees += 2) {
    const Eigen::Vector2d along(std::cos(degrees * std::numbers::pi / 180),
                                std::sin(degrees * std::numbers::pi / 180));
    double from = 1e9, to = -1e9;
    for (std::size_t v = 0; v < piece.mesh->vertexCount(); ++v) {
      from = std::min(from, along.dot(flat.position[VertexId(v)]));
      to = std::max(to, along.dot(flat.position[VertexId(v)]));
    }
    low = std::min(low, to - from);
    high = std::max(high, to - from);
  }
  return high / low;
}

// Curvature is spread by corners or by length: the rim of a cap is a circle only by length.
TEST(WireWarping, LengthWeightsDoNotSeeHowARimIsSampled) {
  const Piece piece = unevenCap();
  const Result<FlatPiece> unit = unfold(piece, kPaper);
  const Result<FlatPiece> length =
      unfold(piece, {.objective = UnfoldObjective::WireWarping, .weights = WireWeights::Length});
  ASSERT_TRUE(unit && length);
  EXPECT_GT(widthOverHeight(*unit, piece), 1.1);
  EXPECT_LT(widthOverHeight(*length, piece), 1.03);  // the six long edges are chords
}

TEST(OverBracing, CountsAsLamanDoes) {
  using Bars = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  const auto braced = [](std::size_t joints, const Bars& bars) {
    return unfolding::findOverBraced(joints, bars);
  };
  EXPECT_TRUE(braced(3, {{0, 1}, {1, 2}, {2, 0}}).empty());
  EXPECT_TRUE(braced(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}).empty());
  // A square with both diagonals has one bar too many, and any of the six may go.
  const auto square = braced(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}});
  ASSERT_EQ(square.size(), 1U);
  EXPECT_EQ(square[0].size(), 6U);
  // Two such squares joined by one bar: two sets, the joining bar in neither.
  const auto two = braced(8, {{0, 1},
                              {1, 2},
                              {2, 3},
                              {3, 0},
                              {0, 2},
                              {1, 3},
                              {3, 4},
                              {4, 5},
                              {5, 6},
                              {6, 7},
                              {7, 4},
                              {4, 6},
                              {5, 7}});
  ASSERT_EQ(two.size(), 2U);
  for (const auto& part : two) {
    EXPECT_EQ(part.size(), 6U);
    EXPECT_EQ(std::count(part.begin(), part.end(), 6U), 0);
  }
  // The graph of three houses and three wells is independent though no joint has two bars.
  Bars wells;
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t j = 3; j < 6; ++j) wells.emplace_back(i, j);
  }
  EXPECT_TRUE(braced(6, wells).empty());
  wells.emplace_back(0, 1);
  EXPECT_EQ(braced(6, wells).size(), 1U);
}

TEST(OverBracing, NamesTheFeaturesThatBraceEachOther) {
  // A wheel of single edges around the top of a dome, in a piece with other lines that do no harm.
  const Mesh mesh = test::heightField(8, 8, 10, [](double x, double y) {
    return 20 * std::exp(-((x - 40) * (x - 40) + (y - 40) * (y - 40)) / 400);
  });
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * 9 + i); };
  std::vector<PolygonSoup::Chain> chains;
  const auto line = [&](const char* id, std::vector<std::uint32_t> vertices) {
    chains.emplace_back();
    chains.back().group = std::string("wire_feature_") + id;
    chains.back().vertices = std::move(vertices);
  };
  const std::size_t top = at(4, 4);
  std::vector<std::uint32_t> rim;
  for (const FaceId face : mesh.facesAround(VertexId(top))) {
    for (const VertexId v : mesh.vertices(face)) {
      if (v.index() == top) continue;
      if (std::find(rim.begin(), rim.end(), v.index()) == rim.end()) rim.push_back(v.index());
    }
  }
  for (const std::uint32_t v : rim) line(("spoke" + std::to_string(v)).c_str(), {at(4, 4), v});
  for (const FaceId face : mesh.facesAround(VertexId(top))) {
    std::vector<std::uint32_t> side;
    for (const VertexId v : mesh.vertices(face)) {
      if (v.index() != top) side.push_back(v.index());
    }
    line(("rim" + std::to_string(side[0])).c_str(), side);
  }
  line("harmless", {at(0, 1), at(1, 1), at(2, 1)});
  const Result<FlatPiece> flat = unfold(test::patchOf(mesh, chains));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::LengthsInfeasible);
  ASSERT_GE(flat.error().where.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(flat.error().where[i].kind, Element::Kind::Curve);
    EXPECT_NE(flat.error().where[i].name, "harmless");
    EXPECT_NE(flat.error().where[i].name, "border");
  }
}

}  // namespace
}  // namespace toile
