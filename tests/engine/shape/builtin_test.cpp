// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/shape/builtin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/result_printing.h"

namespace toile {
namespace {

using ::testing::HasSubstr;

ReferenceModel make(const std::string& reference) {
  Result<ReferenceModel> model = makeBuiltinModel(reference);
  if (!model) ADD_FAILURE() << reference << ": " << model.error();
  return model ? std::move(*model) : ReferenceModel();
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Smallest and largest corner angle of all faces.
struct Angles {
  double least = 180, most = 0;
};
Angles angles(const Mesh& mesh) {
  Angles out;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& corners = mesh.vertices(FaceId(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d at = mesh.position(corners[k]);
      const Eigen::Vector3d a = (mesh.position(corners[(k + 1) % 3]) - at).normalized();
      const Eigen::Vector3d b = (mesh.position(corners[(k + 2) % 3]) - at).normalized();
      const double angle = degrees(std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
      out.least = std::min(out.least, angle);
      out.most = std::max(out.most, angle);
    }
  }
  return out;
}

std::string mirrorName(std::string name) {
  if (name.ends_with("_l")) name.back() = 'r';
  return name;
}

/// Positions mirror each other to the last bit; points in faces to the rounding of their sums.
void expectExactSymmetry(const ReferenceModel& model) {
  ASSERT_TRUE(model.symmetry);
  const auto& partner = model.symmetry->partner;
  ASSERT_EQ(partner.size(), model.mesh->vertexCount());
  for (std::size_t v = 0; v < partner.size(); ++v) {
    const VertexId other = partner[VertexId(v)];
    const Eigen::Vector3d& here = model.mesh->position(VertexId(v));
    ASSERT_EQ(partner[other], VertexId(v));
    ASSERT_EQ(model.mesh->position(other), Eigen::Vector3d(-here.x(), here.y(), here.z()))
        << "vertex " << v;
  }
  for (const auto& [name, point] : model.landmarks) {
    if (!name.ends_with("_l")) continue;
    ASSERT_TRUE(model.landmarks.contains(mirrorName(name))) << name;
    const Eigen::Vector3d left = position(*model.mesh, point);
    const Eigen::Vector3d right = position(*model.mesh, model.landmarks.at(mirrorName(name)));
    EXPECT_LT((right - Eigen::Vector3d(-left.x(), left.y(), left.z())).norm(), 1e-9) << name;
  }
  for (const auto& [name, path] : model.curves) {
    EXPECT_TRUE(isValid(*model.mesh, path)) << name;
    if (!name.ends_with("_l")) continue;
    ASSERT_TRUE(model.curves.contains(mirrorName(name))) << name;
    const SurfacePath& right = model.curves.at(mirrorName(name));
    ASSERT_EQ(right.points.size(), path.points.size()) << name;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const Eigen::Vector3d l = position(*model.mesh, path.points[i]);
      const Eigen::Vector3d r = position(*model.mesh, right.points[i]);
      EXPECT_LT((r - Eigen::Vector3d(-l.x(), l.y(), l.z())).norm(), 1e-9) << name;
    }
  }
}

TEST(Builtin, TellsItsReferencesFromPaths) {
  EXPECT_TRUE(isBuiltin("builtin:torso@1"));
  EXPECT_FALSE(isBuiltin("bodies/female.ply"));
  for (const std::string& name : builtinNames()) {
    const Result<ReferenceModel> model = makeBuiltinModel("builtin:" + name);
    ASSERT_TRUE(model) << model.error();
    EXPECT_EQ(model->reference, "builtin:" + name);
  }
}

TEST(Builtin, NamesTheNearestOfWhatThereIs) {
  const auto message = [](const std::string& reference, ErrorCode code) {
    const Result<ReferenceModel> model = makeBuiltinModel(reference);
    EXPECT_FALSE(model) << reference;
    if (model) return std::string();
    EXPECT_EQ(model.error().code, code) << reference;
    return model.error().message;
  };
  EXPECT_THAT(message("builtin:bent-sleve@1", ErrorCode::NameNotFound),
              HasSubstr("did you mean \"bent-sleeve@1\"?"));
  EXPECT_THAT(message("builtin:bent-sleeve@1?lenght=500mm", ErrorCode::InvalidArgument),
              HasSubstr("no parameter \"lenght\"; did you mean \"length\"?"));
  EXPECT_THAT(message("builtin:bent-sleeve@1?length=500", ErrorCode::InvalidArgument),
              HasSubstr("parameter length"));
  EXPECT_THAT(message("builtin:bent-sleeve@1?length=5000mm", ErrorCode::InvalidArgument),
              HasSubstr("from 400mm to 900mm, not 5000mm"));
  EXPECT_THAT(message("builtin:bent-sleeve@1?bend=-1deg", ErrorCode::InvalidArgument),
              HasSubstr("from 0deg to 50deg"));
  EXPECT_THAT(message("builtin:bent-sleeve@1?bend=1deg&bend=2deg", ErrorCode::InvalidArgument),
              HasSubstr("bend stands twice"));
  message("builtin:bent-sleeve@1?=5mm", ErrorCode::InvalidArgument);
  message("builtin:bent-sleeve@1?length", ErrorCode::InvalidArgument);
  message("builtin:bent-sleeve@1?&", ErrorCode::InvalidArgument);
  message("builtin:", ErrorCode::NameNotFound);
  message("sleeve.ply", ErrorCode::InvalidArgument);
}

TEST(BentSleeve, IsAnOpenTube) {
  const ReferenceModel model = make("builtin:bent-sleeve@1");
  ASSERT_TRUE(model.mesh);
  EXPECT_EQ(model.mesh->boundaryLoops().size(), 2U);
  EXPECT_EQ(model.mesh->eulerCharacteristic(), 0);
  EXPECT_EQ(model.mesh->componentCount(), 1U);
  // The first face looks outwards: away from the centre line, to the front.
  EXPECT_LT(model.mesh->normal(FaceId(0)).y(), -0.9);
}

TEST(BentSleeve, IsSymmetricToTheLastBit) {
  expectExactSymmetry(make("builtin:bent-sleeve@1?bend=47deg"));
}

TEST(BentSleeve, HasTheMeasuresAskedFor) {
  const ReferenceModel model = make(
      "builtin:bent-sleeve@1?length=500mm&armhole-girth=380mm&elbow-girth=26cm&wrist-girth=170mm&"
      "bend=40deg");
  ASSERT_TRUE(model.mesh);
  const auto girth = [&](const char* name) { return length(*model.mesh, model.curves.at(name)); };
  EXPECT_NEAR(girth("armhole"), 380, 1e-9);
  EXPECT_NEAR(girth("elbow_girth"), 260, 1e-9);
  EXPECT_NEAR(girth("wrist_girth"), 170, 1e-9);
  // The plane of the wrist is turned by the bend: its front lies higher than its back by the sine.
  const Eigen::Vector3d across = position(*model.mesh, model.landmarks.at("wrist_thumb")) -
                                 position(*model.mesh, model.landmarks.at("wrist_little"));
  EXPECT_NEAR(degrees(std::atan2(across.z(), -across.y())), 40, 1e-9);
  // The centre line is 500 mm long: with the tube straight that is the height.
  const ReferenceModel straight = make("builtin:bent-sleeve@1?length=500mm&bend=0deg");
  EXPECT_NEAR(straight.mesh->boxMax().z() - straight.mesh->boxMin().z(), 500, 1e-9);
}

TEST(BentSleeve, KeepsItsTrianglesWellShapedInEveryCornerOfItsRanges) {
  const ReferenceModel usual = make("builtin:bent-sleeve@1");
  EXPECT_GT(angles(*usual.mesh).least, 20);
  for (int corner = 0; corner < 32; ++corner) {
    const auto pick = [&](int bit, const char* low, const char* high) {
      return std::string((corner >> bit) & 1 ? high : low);
    };
    const std::string reference = "builtin:bent-sleeve@1?length=" + pick(0, "400mm", "900mm") +
                                  "&armhole-girth=" + pick(1, "250mm", "600mm") +
                                  "&elbow-girth=" + pick(2, "180mm", "380mm") +
                                  "&wrist-girth=" + pick(3, "120mm", "380mm") +
                                  "&bend=" + pick(4, "0deg", "50deg");
    const ReferenceModel model = make(reference);
    ASSERT_TRUE(model.mesh);
    EXPECT_EQ(model.mesh->connectivityHash(), usual.mesh->connectivityHash());
    EXPECT_GT(angles(*model.mesh).least, 6) << reference;
    EXPECT_LT(angles(*model.mesh).most, 155) << reference;
  }
}

// A name@version keeps its connectivity for ever: designs hold its vertices and faces.
TEST(BentSleeve, ConnectivityIsFrozen) {
  EXPECT_EQ(make("builtin:bent-sleeve@1").mesh->connectivityHash().hex(),
            "762d208a57d96956f545ff6fe0687b65");
}

TEST(Torso, IsAClosedSurface) {
  const ReferenceModel model = make("builtin:torso@1");
  ASSERT_TRUE(model.mesh);
  EXPECT_TRUE(model.mesh->boundaryLoops().empty());
  EXPECT_EQ(model.mesh->eulerCharacteristic(), 2);
  EXPECT_EQ(model.mesh->componentCount(), 1U);
  EXPECT_EQ(model.mesh->faceCount(), 8576U);
  // Outwards: the volume is positive, and about a torso's (dm^3).
  double volume = 0;
  for (const Triangle& f : model.mesh->triangles()) {
    const auto& p = model.mesh->positions();
    volume += p[f[0].index()].dot(p[f[1].index()].cross(p[f[2].index()])) / 6;
  }
  EXPECT_GT(volume * 1e-6, 25);
  EXPECT_LT(volume * 1e-6, 45);
}

TEST(Torso, IsSymmetricToTheLastBit) {
  expectExactSymmetry(make("builtin:torso@1"));
  expectExactSymmetry(make("builtin:torso@1?bust-girth=1013mm&waist-girth=871mm&height=702mm"));
}

TEST(Torso, GirthsRunFromTheFrontOverTheLeftAndMirrorThemselves) {
  const ReferenceModel model = make("builtin:torso@1");
  for (const char* name : {"waist_girth", "bust_girth", "hip_girth", "neck_base", "neck_girth"}) {
    const SurfacePath& path = model.curves.at(name);
    ASSERT_TRUE(path.closed) << name;
    EXPECT_EQ(position(*model.mesh, path.points[0]).x(), 0) << name;
    for (const double part : {0.1, 0.25, 0.4}) {
      const Eigen::Vector3d left = position(*model.mesh, pointAtFraction(*model.mesh, path, part));
      const Eigen::Vector3d right =
          position(*model.mesh, pointAtFraction(*model.mesh, path, 1 - part));
      EXPECT_GT(left.x(), 0) << name;
      EXPECT_LT((right - Eigen::Vector3d(-left.x(), left.y(), left.z())).norm(), 1e-9) << name;
    }
  }
}

TEST(Torso, HasTheMeasuresAskedFor) {
  const ReferenceModel model =
      make("builtin:torso@1?bust-girth=1010mm&waist-girth=88cm&hip-girth=1100mm&height=702mm");
  ASSERT_TRUE(model.mesh);
  const auto girth = [&](const char* name) { return length(*model.mesh, model.curves.at(name)); };
  EXPECT_NEAR(girth("bust_girth"), 1010, 1e-6);
  EXPECT_NEAR(girth("waist_girth"), 880, 1e-6);
  EXPECT_NEAR(girth("hip_girth"), 1100, 1e-6);
  EXPECT_NEAR(model.mesh->boxMax().z() - model.mesh->boxMin().z(), 702, 1e-9);
}

TEST(Torso, HasTheNamesOfTheBodies) {
  const ReferenceModel model = make("builtin:torso@1");
  for (const char* name :
       {"centre_front", "centre_back", "side_l", "side_r", "shoulder_l", "neck_base", "neck_girth",
        "bust_girth", "underbust_girth", "waist_girth", "high_hip_girth", "hip_girth", "armhole_l",
        "armhole_r"}) {
    EXPECT_TRUE(model.curves.contains(name)) << name;
  }
  for (const char* name :
       {"neck_front",      "neck_back",     "neck_side_l",  "shoulder_l",   "armpit_l",
        "armpit_front_l",  "armpit_back_l", "bust_point_l", "bust_front",   "bust_back",
        "underbust_front", "waist_front",   "waist_back",   "waist_side_l", "hip_front",
        "hip_back",        "hip_side_l",    "buttock_l",    "crotch",       "crown",
        "arm_tip_l"}) {
    EXPECT_TRUE(model.landmarks.contains(name)) << name;
  }
  // Where curves meet they share a point, so that designs along them fit together.
  const auto at = [&](const SurfacePoint& point) { return position(*model.mesh, point); };
  const auto gap = [&](const SurfacePoint& point, const char* curve) {
    double least = 1e9;
    const SurfacePath& path = model.curves.at(curve);
    for (std::size_t i = 0; i < path.faceOfSegment.size(); ++i) {
      const Eigen::Vector3d a = at(path.points[i]);
      const Eigen::Vector3d b = at(path.points[(i + 1) % path.points.size()]);
      const double t = std::clamp((at(point) - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      least = std::min(least, (a + t * (b - a) - at(point)).norm());
    }
    return least;
  };
  EXPECT_LT(gap(model.curves.at("shoulder_l").points.front(), "neck_base"), 1e-9);
  EXPECT_LT(gap(model.curves.at("shoulder_l").points.back(), "armhole_l"), 1e-9);
  EXPECT_LT(gap(model.curves.at("side_r").points.front(), "armhole_r"), 1e-9);
  EXPECT_LT(gap(model.curves.at("centre_front").points.front(), "neck_base"), 1e-9);
  EXPECT_LT(gap(model.curves.at("centre_back").points.front(), "neck_base"), 1e-9);
  EXPECT_LT(at(model.landmarks.at("bust_point_l")).y(), -150);
  EXPECT_GT(at(model.landmarks.at("buttock_l")).y(), 80);
}

TEST(Torso, KeepsItsTrianglesWellShapedInEveryCornerOfItsRanges) {
  const ReferenceModel usual = make("builtin:torso@1");
  EXPECT_GT(angles(*usual.mesh).least, 15);
  for (int corner = 0; corner < 16; ++corner) {
    const auto pick = [&](int bit, const char* low, const char* high) {
      return std::string((corner >> bit) & 1 ? high : low);
    };
    const std::string reference = "builtin:torso@1?height=" + pick(0, "600mm", "900mm") +
                                  "&bust-girth=" + pick(1, "750mm", "1200mm") +
                                  "&waist-girth=" + pick(2, "560mm", "1100mm") +
                                  "&hip-girth=" + pick(3, "780mm", "1250mm");
    const ReferenceModel model = make(reference);
    ASSERT_TRUE(model.mesh);
    EXPECT_EQ(model.mesh->connectivityHash(), usual.mesh->connectivityHash());
    EXPECT_GT(angles(*model.mesh).least, 8) << reference;
    EXPECT_LT(angles(*model.mesh).most, 155) << reference;
  }
}

TEST(Torso, ConnectivityIsFrozen) {
  EXPECT_EQ(make("builtin:torso@1").mesh->connectivityHash().hex(),
            "3d9f68142a473b5fa0b42f987779858e");
}

}  // namespace
}  // namespace toile
