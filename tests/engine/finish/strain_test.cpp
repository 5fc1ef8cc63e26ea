// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/finish/strain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "finish/strain_words.h"
#include "support/meshes.h"
#include "support/patches.h"
#include "support/result_printing.h"

// Strain in the threads' directions and its places in words.
namespace toile::test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

struct Cloth {
  Document document;
  Piece piece;
  FlatPiece flat;
  Vector2d grain = Vector2d::UnitY();
};

/// A flat sheet on the body, 160 by 140 mm, whose pattern is `map` of it.
Cloth makeCloth(const Matrix2d& map, const Vector2d& grain = {0, 1}) {
  const Mesh sheet = heightField(16, 14, 10, [](double, double) { return 0.0; });
  Cloth cloth;
  cloth.document.design = std::make_shared<const Design>();
  cloth.document.model = std::make_shared<const ReferenceModel>(makeReferenceModel("sheet", sheet));
  cloth.piece = patchOf(sheet);
  const Eigen::JacobiSVD<Matrix2d> svd(map);
  cloth.flat.position = VertexData<Vector2d>(sheet.vertexCount(), Vector2d::Zero());
  for (std::size_t v = 0; v < sheet.vertexCount(); ++v) {
    cloth.flat.position[VertexId(v)] = map * sheet.position(VertexId(v)).head<2>();
  }
  cloth.flat.distortion = FaceData<FaceDistortion>(sheet.faceCount());
  for (std::size_t f = 0; f < sheet.faceCount(); ++f) {
    cloth.flat.distortion[FaceId(f)] = {svd.singularValues()[0], svd.singularValues()[1]};
  }
  cloth.grain = grain;
  return cloth;
}

PieceStrain measure(const Cloth& cloth) {
  PatternPiece finished;
  finished.grain = {Vector2d::Zero(), cloth.grain};
  return measureStrain(cloth.document, cloth.piece, cloth.flat, finished);
}

Matrix2d matrix(double a, double b, double c, double d) {
  Matrix2d m;
  m << a, b, c, d;
  return m;
}

TEST(Strain, TellsWhatTheThreadsMustDo) {
  // The pattern is 5 % too narrow and 2 % too long.
  const PieceStrain strain = measure(makeCloth(matrix(1 / 1.05, 0, 0, 1 / 0.98)));
  for (const Strain& s : strain.faces.values()) {
    EXPECT_NEAR(s.across, 0.05, 1e-12);
    EXPECT_NEAR(s.along, -0.02, 1e-12);
    EXPECT_NEAR(s.shear, 0, 1e-12);
    EXPECT_NEAR(s.area, 1.05 * 0.98 - 1, 1e-12);
    EXPECT_NEAR(s.greatest, 0.05, 1e-12);
    EXPECT_NEAR(s.least, -0.02, 1e-12);
  }
  // Turned by a right angle the threads change their parts.
  const PieceStrain turned = measure(makeCloth(matrix(1 / 1.05, 0, 0, 1 / 0.98), {1, 0}));
  EXPECT_NEAR(turned.faces[FaceId(0)].along, 0.05, 1e-12);
  EXPECT_NEAR(turned.faces[FaceId(0)].across, -0.02, 1e-12);
}

TEST(Strain, OfAShearedSheetIsTheTangentOfItsAngle) {
  const PieceStrain strain = measure(makeCloth(matrix(1, 0.1, 0, 1)));
  const Strain& s = strain.faces[FaceId(7)];
  EXPECT_NEAR(s.shear, 0.1, 1e-12);
  EXPECT_NEAR(s.area, 0, 1e-12);
  EXPECT_NEAR(s.across, 0, 1e-12);
  // On the bias the same sheet does not shear but stretches.
  const double angle = 0.5 * std::atan2(2, 0.1) + std::numbers::pi / 2;
  const PieceStrain bias =
      measure(makeCloth(matrix(1, 0.1, 0, 1), Vector2d(std::cos(angle), std::sin(angle))));
  EXPECT_LT(bias.faces[FaceId(7)].shear, 0.01);
  EXPECT_GT(std::abs(bias.faces[FaceId(7)].along), 0.04);
}

TEST(Strain, CountsFromTheEasedSize) {
  Cloth cloth = makeCloth(Matrix2d::Identity());
  cloth.piece.targetSides = FaceData<std::array<double, 3>>(cloth.piece.mesh->faceCount());
  for (std::size_t f = 0; f < cloth.piece.mesh->faceCount(); ++f) {
    Cloth plain = makeCloth(Matrix2d::Identity());
    auto sides = targetSides(plain.piece, FaceId(f));
    for (double& side : sides) side *= 0.9;
    cloth.piece.targetSides[FaceId(f)] = sides;
  }
  EXPECT_NEAR(measure(cloth).faces[FaceId(0)].along, -0.1, 1e-12);
}

TEST(Strain, PutsWhatIsOverAFabricsLimitFirst) {
  Cloth cloth = makeCloth(matrix(1 / 1.05, 0, 0, 1 / 1.08));
  Design design;
  Fabric fabric;
  fabric.id = "jersey";
  fabric.stretchAlong = Ratio::percent(20);
  fabric.stretchAcross = Ratio::percent(4);
  design.fabrics.push_back(fabric);
  cloth.document.design = std::make_shared<const Design>(design);
  const PieceStrain strain = measure(cloth);
  EXPECT_EQ(strain.overLimit, 1);
  ASSERT_FALSE(strain.worst.empty());
  EXPECT_EQ(strain.worst.front().kind, StrainKind::Across) << "8 % along are allowed";
  EXPECT_EQ(describe(strain.worst.front()),
            "5.0 % stretch across the grain, over the limit of 4 %");
}

TEST(Strain, NamesNoPlaceWhereNothingIsStrained) {
  const PieceStrain strain = measure(makeCloth(Matrix2d::Identity()));
  EXPECT_TRUE(strain.worst.empty());
  EXPECT_EQ(strain.overLimit, 0);
}

TEST(StrainWords, SayWhereByTheNearestLandmark) {
  Cloth cloth = makeCloth(Matrix2d::Identity());
  const Mesh& mesh = *cloth.piece.mesh;
  ReferenceModel model = *cloth.document.model;
  const auto vertexAt = [&](double x, double y) {
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
      const Eigen::Vector3d& p = mesh.position(VertexId(v));
      if (std::hypot(p.x() - x, p.y() - y) < 1) return VertexId(v);
    }
    ADD_FAILURE() << "no vertex there";
    return VertexId(0);
  };
  model.landmarks["bust_point_l"] = SurfacePoint{vertexAt(40, 40)};
  cloth.document.model = std::make_shared<const ReferenceModel>(model);
  const auto place = [&](double x, double y) {
    return placeInWords(cloth.document, cloth.piece, cloth.flat, vertexAt(x, y));
  };
  EXPECT_EQ(place(40, 40), "at the left bust point");
  EXPECT_EQ(place(100, 40), "6 cm to the left of the left bust point");
  EXPECT_EQ(place(40, 20), "2 cm in front of the left bust point");
  EXPECT_EQ(place(40, 140), "10 cm behind the left bust point");
}

TEST(StrainWords, SayOnWhichSideAndHowFarBelow) {
  Cloth cloth = makeCloth(Matrix2d::Identity());
  ReferenceModel model = *cloth.document.model;
  model.landmarks["neck_front"] = SurfacePoint{VertexId(0)};
  cloth.document.model = std::make_shared<const ReferenceModel>(model);
  std::vector<Eigen::Vector3d> lower = cloth.piece.mesh->positions();
  for (Eigen::Vector3d& p : lower) p.z() -= 120;
  cloth.piece.mesh = std::make_shared<const Mesh>(cloth.piece.mesh->withPositions(lower));
  EXPECT_EQ(placeInWords(cloth.document, cloth.piece, cloth.flat, VertexId(0)),
            "front, 12 cm below the neck");
}

TEST(StrainWords, SayWhereByTheNearestEdgeOfAPieceWithoutLandmarks) {
  const Cloth cloth = makeCloth(Matrix2d::Identity());
  for (std::size_t v = 0; v < cloth.piece.mesh->vertexCount(); ++v) {
    const Eigen::Vector3d& p = cloth.piece.mesh->position(VertexId(v));
    if (std::hypot(p.x() - 30, p.y() - 120) > 1) continue;
    EXPECT_EQ(placeInWords(cloth.document, cloth.piece, cloth.flat, VertexId(v)),
              "2 cm from the border of the model, in the upper third");
  }
}

TEST(StrainWords, SayNamesAsPeopleDo) {
  EXPECT_EQ(nameInWords("crown"), "crown");
  EXPECT_EQ(nameInWords("neck_front"), "front of the neck");
  EXPECT_EQ(nameInWords("waist_side_l"), "left side of the waist");
  EXPECT_EQ(nameInWords("elbow_outer_r"), "outer side of the right elbow");
  EXPECT_EQ(nameInWords("gluteal_fold_r"), "right gluteal fold");
  EXPECT_EQ(nameInWords("wrist_little_l"), "little-finger side of the left wrist");
  EXPECT_EQ(nameInWords("little_tip_l"), "tip of the left little finger");
  EXPECT_EQ(nameInWords("nose_tip"), "tip of the nose");
  EXPECT_EQ(nameInWords("toe_big_r"), "right big toe");
}

}  // namespace
}  // namespace toile::test
