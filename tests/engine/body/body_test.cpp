// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/body/sizes.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_check.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

constexpr const char* kConnectivity = "804bc98dd6a520ae0f4efd8741c4cddd";

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

// Every standard size exists in every posture, without crossings.
TEST(Body, TakesEveryPostureInStandardSizes) {
  const std::vector<std::string> few{"EU32F", "EU38F", "EU54F", "EU44M", "EU62M", "EU104C"};
  const bool all = std::getenv("TOILE_BODY_SWEEP") != nullptr;
  for (const BodySize& size : standardSizes()) {
    BodyOptions options = size.options;
    const Result<ReferenceModel> standing = makeBody(options);
    ASSERT_TRUE(standing) << size.name << ": " << standing.error();
    expectMeasuresMet(options, *standing);
    if (!all && std::find(few.begin(), few.end(), size.name) == few.end()) continue;
    for (const Posture posture :
         {Posture::APose, Posture::ArmsRaised, Posture::KneeBent, Posture::Seated}) {
      options.posture = posture;
      SCOPED_TRACE(size.name + " " + std::string(toString(posture)));
      const Result<ReferenceModel> model = makeBody(options);
      ASSERT_TRUE(model) << model.error();
      const auto crossings = findCrossingFaces(*model->mesh);
      EXPECT_EQ(crossings.size(), 0U);
      if (!crossings.empty()) {
        const VertexId there = model->mesh->vertices(crossings.front().first)[0];
        ADD_FAILURE() << "faces cross at " << model->mesh->position(there).transpose();
      }
    }
  }
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
    const auto crossings = findCrossingFaces(*model->mesh);
    EXPECT_EQ(crossings.size(), 0U);
    if (!crossings.empty()) {
      const VertexId there = model->mesh->vertices(crossings.front().first)[0];
      ADD_FAILURE() << "faces cross at " << model->mesh->position(there).transpose();
    }
    narrowest = std::max(narrowest, narrowShare(*model->mesh));
  }
  std::cout << trials << " bodies, the slowest in " << slowest << " s, at most " << 100 * narrowest
            << " % of triangles below 20 degrees\n";
}

// Frozen for ever: designs hold places on it by vertex and face.
TEST(Body, KeepsItsConnectivity) {
  const Result<ReferenceModel> woman = makeBody({});
  ASSERT_TRUE(woman) << woman.error();
  EXPECT_EQ(woman->mesh->vertexCount(), 19842U);
  EXPECT_EQ(woman->mesh->faceCount(), 39680U);
  EXPECT_EQ(woman->mesh->connectivityHash().hex(), kConnectivity);
  BodyOptions seated;
  seated.masculine = 1;
  seated.posture = Posture::Seated;
  const Result<ReferenceModel> man = makeBody(seated);
  ASSERT_TRUE(man) << man.error();
  EXPECT_EQ(man->mesh->connectivityHash(), woman->mesh->connectivityHash());
}

TEST(Body, MeetsTheMeasuresOfTheReadme) {
  BodyOptions options;
  options.measures = {{BodyMeasure::Height, Length::mm(1720)},
                      {BodyMeasure::Chest, Length::mm(920)},
                      {BodyMeasure::Waist, Length::mm(740)},
                      {BodyMeasure::Hip, Length::mm(960)}};
  const Result<ReferenceModel> model = makeBody(options);
  ASSERT_TRUE(model) << model.error();
  expectMeasuresMet(options, *model);
  // Two ways agree: the tape and the named curves.
  const std::vector<Length> measured = measureBody(*model->mesh);
  for (const auto& [measure, curve] : {std::pair{BodyMeasure::Chest, "bust_girth"},
                                       {BodyMeasure::Waist, "waist_girth"},
                                       {BodyMeasure::Thigh, "thigh_girth_r"},
                                       {BodyMeasure::ArmLength, "arm_outer_r"}}) {
    EXPECT_NEAR(length(*model->mesh, model->curves.at(curve)),
                measured[static_cast<std::size_t>(measure)].mm(), 1e-6)
        << curve;
  }
  const Eigen::Vector3d size = model->mesh->boxMax() - model->mesh->boxMin();
  EXPECT_NEAR(size.z(), 1720, 1);
}

// As a tape would lie.
TEST(Body, HasLevelGirthsAndPairedNames) {
  const Result<ReferenceModel> model = makeBody({});
  ASSERT_TRUE(model) << model.error();
  for (const char* name : {"hip_girth", "high_hip_girth", "waist_girth", "thigh_girth_l"}) {
    double low = 1e9, high = 0;
    for (const SurfacePoint& point : model->curves.at(name).points) {
      low = std::min(low, position(*model->mesh, point).z());
      high = std::max(high, position(*model->mesh, point).z());
    }
    EXPECT_LT(high - low, 8) << name;
  }
  for (const auto& [name, path] : model->curves) {
    EXPECT_TRUE(isValid(*model->mesh, path)) << name;
    if (!name.ends_with("_l")) continue;
    const std::string other = name.substr(0, name.size() - 1) + "r";
    ASSERT_TRUE(model->curves.contains(other)) << other;
    EXPECT_NEAR(length(*model->mesh, path), length(*model->mesh, model->curves.at(other)), 1e-9);
  }
}

// A place that exists on the bodies of the test data is here under the same name, on the same side.
TEST(Body, UsesTheNamesOfTheTestData) {
  TOILE_TEST_DATA_OR_SKIP(mesh, "bodies/female_average.ply");
  TOILE_TEST_DATA_OR_SKIP(curves, "bodies/curves.json");
  TOILE_TEST_DATA_OR_SKIP(landmarks, "bodies/landmarks.json");
  const Result<MeshFile> file = readMesh(mesh, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(file) << file.error();
  const auto text = [](const std::filesystem::path& path) { return readFile(path).value(); };
  const auto theirs = parseModelCurves(file->mesh, text(curves), "curves.json");
  const auto places = parseLandmarks(file->mesh, text(landmarks), "landmarks.json");
  ASSERT_TRUE(theirs && places);
  const Result<ReferenceModel> body = makeBody({});
  ASSERT_TRUE(body) << body.error();
  for (const auto& [name, path] : *theirs) {
    ASSERT_TRUE(body->curves.contains(name)) << name;
    const SurfacePath& ours = body->curves.at(name);
    EXPECT_EQ(ours.closed, path.closed) << name;
    if (name.ends_with("_l")) {
      EXPECT_GT(position(*body->mesh, ours.points.front()).x(), -1) << name;
    }
  }
  const std::set<std::string> fingers{"thumb_tip", "index_tip", "ring_tip", "little_tip"};
  for (const auto& [name, point] : *places) {
    const std::string place = name.substr(0, name.find_last_of('_'));
    if (fingers.contains(place)) continue;
    ASSERT_TRUE(body->landmarks.contains(name)) << name;
    // In thousandths of the height the places are near: nothing is named for something else.
    const double height = position(*body->mesh, body->landmarks.at(name)).z() / 1680;
    EXPECT_NEAR(height, position(file->mesh, point).z() / 1650, 0.035) << name;
  }
}

TEST(Body, RefusesWhatIsImpossibleAndNamesTheNearest) {
  BodyOptions options;
  options.measures[BodyMeasure::Height] = Length::mm(900);
  const Result<ReferenceModel> small = makeBody(options);
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, ErrorCode::InvalidArgument);
  EXPECT_THAT(small.error().message, HasSubstr("height 900 mm"));
  EXPECT_THAT(small.error().message, HasSubstr("nearest: 1000 mm"));

  options.measures = {{BodyMeasure::Neck, Length::mm(900)}};
  const Result<ReferenceModel> thick = makeBody(options);
  ASSERT_FALSE(thick);
  EXPECT_THAT(thick.error().message, HasSubstr("neck 900 mm is not possible"));
  // The nearest value that it tells is possible.
  const std::string message = thick.error().message;
  const double nearest = std::stod(message.substr(message.rfind("nearest: ") + 9));
  options.measures = {{BodyMeasure::Neck, Length::mm(nearest)}};
  EXPECT_TRUE(makeBody(options));

  options.measures = {{BodyMeasure::Waist, Length::mm(std::nan(""))}};
  EXPECT_FALSE(makeBody(options));
  options.measures = {{BodyMeasure::Chest, Length::mm(900)}, {BodyMeasure::Waist, Length::mm(-5)}};
  const Result<ReferenceModel> negative = makeBody(options);
  ASSERT_FALSE(negative);
  EXPECT_THAT(negative.error().message, HasSubstr("waist -5mm"));
}

}  // namespace
}  // namespace toile
