// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "support/cut_checks.h"
#include "support/drawn_curves.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

/// All named curves of the bodies as lines of a design: seams, every third one a feature.
std::vector<PlacedCurve> readCurves(const Mesh& mesh, const std::filesystem::path& file) {
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in);
  std::vector<PlacedCurve> curves;
  for (const auto& [name, curve] : json.at("curves").items()) {
    SurfacePath path;
    path.closed = curve.at("closed");
    for (std::size_t i = 0; i < curve.at("tri").size(); ++i) {
      const FaceId face(curve.at("tri")[i].get<std::size_t>());
      const auto weights = curve.at("bary")[i].get<std::vector<double>>();
      path.points.push_back(
          makeSurfacePoint(mesh, face, {weights.at(0), weights.at(1), weights.at(2)}));
      path.faceOfSegment.push_back(face);
    }
    if (!path.closed) path.faceOfSegment.pop_back();
    const CurveKind kind = curves.size() % 3 == 2 ? CurveKind::Feature : CurveKind::Seam;
    curves.push_back(test::drawn(name, kind, std::move(path)));
  }
  return curves;
}

// Every line that the bodies come with, at once: 44 curves that meet, overlap and cross.
TEST(CutBody, CutsEveryBodyAlongAllItsCurves) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies");
  std::size_t pieces = 0;
  for (const std::string name : {"female_average", "male_heavy", "female_tall_slim_cycling"}) {
    ReadMeshOptions options;
    options.unit = FileUnit::Millimetre;
    const auto read = readMesh(path / (name + ".ply"), options);
    ASSERT_TRUE(read) << read.error();
    const auto curves = readCurves(read->mesh, path / "curves.json");
    auto model = std::make_shared<ReferenceModel>();
    model->mesh = std::make_shared<const Mesh>(read->mesh);
    const auto result = cut({std::make_shared<Design>(), model}, curves);
    ASSERT_TRUE(result) << name << ": " << result.error();
    test::expectSoundWires(*result);
    test::expectGluesBack(read->mesh, *result);
    if (pieces == 0) pieces = result->pieces.size();
    EXPECT_GT(pieces, 20U);
    EXPECT_EQ(result->pieces.size(), pieces) << name << ": the bodies share their connectivity";
    const double area = test::areaOf(read->mesh);
    EXPECT_NEAR(result->includedArea, area, 1e-12 * area);
    std::cout << name << ": " << result->pieces.size() << " pieces, " << result->mates.size()
              << " seams\n";
  }
}

}  // namespace
}  // namespace toile
