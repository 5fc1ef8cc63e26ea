// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <random>
#include <set>

#include "support/result_printing.h"
#include "toile/body/sizes.h"
#include "toile/mesh/mesh_check.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

std::string described(const BodyOptions& options) {
  std::string text = "--form " + toString(Ratio::of(options.masculine));
  for (const auto& [measure, length] : options.measures) {
    text += " --" + std::string(bodyMeasures()[static_cast<std::size_t>(measure)].name) + " " +
            toString(length);
  }
  return text;
}

/// Share of triangles whose smallest angle is below 20 degrees.
double narrowShare(const Mesh& mesh) {
  std::size_t narrow = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& corners = mesh.vertices(FaceId(f));
    double least = std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d at = mesh.position(corners[k]);
      const Eigen::Vector3d a = (mesh.position(corners[(k + 1) % 3]) - at).normalized();
      const Eigen::Vector3d b = (mesh.position(corners[(k + 2) % 3]) - at).normalized();
      least = std::min(least, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
    }
    if (least < 20 * std::numbers::pi / 180) ++narrow;
  }
  return static_cast<double>(narrow) / static_cast<double>(mesh.faceCount());
}

void expectClosedAndSymmetric(const ReferenceModel& model) {
  EXPECT_TRUE(model.mesh->boundaryLoops().empty());
  EXPECT_EQ(model.mesh->componentCount(), 1U);
  EXPECT_EQ(model.mesh->eulerCharacteristic(), 2);
  ASSERT_TRUE(model.symmetry);
  std::size_t uneven = 0;
  for (std::size_t v = 0; v < model.mesh->vertexCount(); ++v) {
    const Eigen::Vector3d here = model.mesh->position(VertexId(v));
    const Eigen::Vector3d there = model.mesh->position(model.symmetry->partner[VertexId(v)]);
    if (here != Eigen::Vector3d(-there.x(), there.y(), there.z())) ++uneven;
  }
  EXPECT_EQ(uneven, 0U) << "vertices that are no mirror image of their partner";
}

void expectMeasuresMet(const BodyOptions& options, const ReferenceModel& model) {
  const std::vector<Length> measured = measureBody(*model.mesh);
  for (const auto& [measure, length] : options.measures) {
    const auto i = static_cast<std::size_t>(measure);
    EXPECT_NEAR(measured[i].mm(), length.mm(), 2.0) << bodyMeasures()[i].name;
  }
}

/// A random set of measures, each within its range after those chosen before.
BodyOptions randomOptions(std::mt19937& random) {
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  BodyOptions options;
  const double kind = uniform(0, 1);
  options.masculine = kind < 0.35 ? 0.0 : kind < 0.7 ? 1.0 : uniform(0, 1);
  options.measures[BodyMeasure::Height] = Length::mm(uniform(1000, 2100));
  std::vector<BodyMeasure> order{BodyMeasure::Chest, BodyMeasure::Waist, BodyMeasure::Hip};
  std::shuffle(order.begin(), order.end(), random);
  std::vector<BodyMeasure> rest;
  for (const BodyMeasureInfo& info : bodyMeasures()) {
    const bool isFirst = std::find(order.begin(), order.end(), info.measure) != order.end();
    if (!isFirst && info.measure != BodyMeasure::Height) rest.push_back(info.measure);
  }
  std::shuffle(rest.begin(), rest.end(), random);
  rest.resize(std::uniform_int_distribution<std::size_t>(0, rest.size())(random));
  order.insert(order.end(), rest.begin(), rest.end());
  for (const BodyMeasure measure : order) {
    const Result<std::vector<BodyRange>> ranges = bodyRanges(options);
    if (!ranges) break;
    const BodyRange& range = (*ranges)[static_cast<std::size_t>(measure)];
    BodyOptions next = options;
    next.measures[measure] = Length::mm(uniform(range.least.mm(), range.most.mm()));
    // A choice may push an earlier one out of its range: that set would be refused.
    const Result<std::vector<BodyRange>> after = bodyRanges(next);
    const bool isPossible =
        after && std::all_of(next.measures.begin(), next.measures.end(), [&](const auto& given) {
          const BodyRange& r = (*after)[static_cast<std::size_t>(given.first)];
          return given.second >= r.least && given.second <= r.most;
        });
    if (isPossible) options = next;
  }
  return options;
}

// The full sweep (500) takes minutes: set TOILE_BODY_SWEEP.
TEST(Body, IsSoundForRandomMeasures) {
  const char* count = std::getenv("TOILE_BODY_SWEEP");
  const int trials = count == nullptr ? 12 : std::atoi(count);
  std::mt19937 random(20261124);
  double slowest = 0, narrowest = 0;
  for (int i = 0; i < trials; ++i) {
    const BodyOptions options = randomOptions(random);
    SCOPED_TRACE(described(options));
    const auto start = std::chrono::steady_clock::now();
    const Result<ReferenceModel> model = makeBody(options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    slowest = std::max(slowest, seconds.count());
    if (!model) {
      ADD_FAILURE() << model.error();
      continue;
    }
    expectClosedAndSymmetric(*model);
    expectMeasuresMet(options, *model);
    EXPECT_EQ(findCrossingFaces(*model->mesh).size(), 0U);
    narrowest = std::max(narrowest, narrowShare(*model->mesh));
  }
  std::cout << trials << " bodies, the slowest in " << slowest << " s, at most " << 100 * narrowest
            << " % of triangles below 20 degrees\n";
}

}  // namespace
}  // namespace toile
