// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/model/reference_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/meshes.h"
#include "support/result_printing.h"
#include "support/run_program.h"
#include "support/test_data.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

Mesh body(const std::filesystem::path& folder, const std::string& name) {
  Result<MeshFile> read = readMesh(folder / (name + ".ply"), {.unit = FileUnit::Millimetre});
  EXPECT_TRUE(read) << read.error();
  return std::move(read->mesh);
}

std::string textOf(const std::filesystem::path& path) {
  Result<std::string> text = readFile(path);
  EXPECT_TRUE(text) << text.error();
  return std::move(*text);
}

/// Writes a file into the folder.
std::filesystem::path write(const test::TemporaryFolder& folder, const std::string& file,
                            const std::string& text) {
  test::writeText(folder.path() / file, text);
  return folder.path() / file;
}

TEST(ModelCurves, OfTheBodiesHaveTheirKnownLengths) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/curves.json");
  const std::filesystem::path folder = path.parent_path();
  std::ifstream in(folder / "curve_lengths.json");
  const nlohmann::json lengths = nlohmann::json::parse(in).at("lengths");
  const std::string text = textOf(path);
  std::size_t checked = 0;
  for (const auto& [bodyName, known] : lengths.items()) {
    const Mesh mesh = body(folder, bodyName);
    const auto curves = parseModelCurves(mesh, text, "curves.json");
    ASSERT_TRUE(curves) << curves.error();
    EXPECT_EQ(curves->size(), 44U);
    for (const auto& [name, curve] : *curves) {
      EXPECT_TRUE(isValid(mesh, curve)) << name;
      // The lengths are written with one decimal.
      EXPECT_NEAR(length(mesh, curve), known.at(name).get<double>(), 0.0501) << name;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 9U * 44U);
}

// Points that the file puts on an edge shared by successive triangles are exactly on it, so that
// cutting along the curve meets no needle.
TEST(ModelCurves, TouchBothFacesOfEachSegmentExactly) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/curves.json");
  const Mesh mesh = body(path.parent_path(), "female_average");
  const auto curves = parseModelCurves(mesh, textOf(path), "curves.json");
  ASSERT_TRUE(curves) << curves.error();
  for (const auto& [name, curve] : *curves) {
    for (std::size_t i = 0; i < curve.faceOfSegment.size(); ++i) {
      const SurfacePoint& a = curve.points[i];
      const SurfacePoint& b = curve.points[(i + 1) % curve.points.size()];
      ASSERT_TRUE(touches(mesh, a, curve.faceOfSegment[i])) << name << " " << i;
      ASSERT_TRUE(touches(mesh, b, curve.faceOfSegment[i])) << name << " " << i;
      ASSERT_FALSE(a == b) << name << " " << i;
    }
  }
}

struct BadCurve {
  const char* json;
  const char* message;
};

TEST(ModelCurves, ThatDoNotFitAreRefused) {
  const Mesh mesh = test::grid(2, 2);
  const BadCurve cases[] = {
      {R"({"curves": {"a": {"tri": [0, 99], "bary": [[1,0,0],[1,0,0]]}}})", "no triangle"},
      {R"({"curves": {"a": {"tri": [0], "bary": [[1,0,0]]}}})", "at least 2"},
      {R"({"curves": {"a": {"tri": [0, 1], "bary": [[1,0,0]]}}})", "equal length"},
      {R"({"curves": {"a": {"tri": [0, 1], "bary": [[1,0,0],[1,0]]}}})", "3 numbers"},
      {R"({"curves": {"a": {"tri": [0, 1], "bary": [[1,0,0],[0.5,0.2,0.2]]}}})", "add up to 1"},
      {R"({"curves": {"a": {"tri": [0, 1], "bary": [[1,0,0],[1.5,-0.5,0]]}}})", "not negative"},
      {R"({"curves": {"a": {"tri": [0, 7], "bary": [[0.3,0.3,0.4],[0.3,0.3,0.4]]}}})",
       "leaves the surface"},
      {R"({"curves": {"a": {"tri": [0, 0], "bary": [[1,0,0],[1,0,0]]}}})", "too few"},
      {R"({"curves": {"a": 3}})", "no object"},
      {R"({"curves": 3})", "missing"},
      {R"([])", "missing"},
      {R"({"curves": {)", "not JSON"},
      {R"({"triangles": 9, "curves": {}})", "made for a mesh with 9"},
  };
  for (const BadCurve& c : cases) {
    const auto curves = parseModelCurves(mesh, c.json, "bad.json");
    ASSERT_FALSE(curves) << c.json;
    EXPECT_NE(curves.error().message.find(c.message), std::string::npos) << curves.error();
    EXPECT_NE(curves.error().message.find("bad.json"), std::string::npos) << curves.error();
  }
}

TEST(Landmarks, AreVerticesOfTheMesh) {
  const Mesh mesh = test::grid(2, 2);
  const auto landmarks =
      parseLandmarks(mesh, R"({"about": "x", "vertices": 9, "landmarks": {"tip": 4}})", "l.json");
  ASSERT_TRUE(landmarks) << landmarks.error();
  EXPECT_EQ(landmarks->at("tip"), SurfacePoint{VertexId(4)});
  const auto past = parseLandmarks(mesh, R"({"landmarks": {"tip": 9}})", "l.json");
  ASSERT_FALSE(past);
  ASSERT_EQ(past.error().where.size(), 1U);
  EXPECT_EQ(past.error().where[0], Element::landmark("tip"));
  const auto other = parseLandmarks(mesh, R"({"vertices": 8, "landmarks": {}})", "l.json");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::ModelMismatch);
}

/// template_mirror.npy: a header that ends with a line, then int32.
std::vector<std::int32_t> readPartners(const std::filesystem::path& path) {
  const std::string bytes = textOf(path);
  const std::size_t begin = bytes.find('\n') + 1;
  std::vector<std::int32_t> partners((bytes.size() - begin) / sizeof(std::int32_t));
  std::memcpy(partners.data(), bytes.data() + begin, partners.size() * sizeof(std::int32_t));
  return partners;
}

void expectPartners(const VertexData<VertexId>& found, const std::vector<std::int32_t>& known) {
  ASSERT_EQ(found.size(), known.size());
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < known.size(); ++v) {
    wrong += found[VertexId(v)].index() == static_cast<std::uint32_t>(known[v]) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(SymmetryPairing, OfABodyIsTheTemplates) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/template_mirror.npy");
  const Mesh mesh = body(path.parent_path(), "female_average");
  const auto partner = findSymmetryPairing(mesh, {1, 0, 0}, 0, 0.01);
  ASSERT_TRUE(partner);
  expectPartners(*partner, readPartners(path));
}

TEST(SymmetryPairing, OfABodyInAPostureIsFoundByLandmarks) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/template_mirror.npy");
  const Mesh mesh = body(path.parent_path(), "female_tall_slim_cycling");
  const auto landmarks =
      parseLandmarks(mesh, textOf(path.parent_path() / "landmarks.json"), "landmarks.json");
  ASSERT_TRUE(landmarks) << landmarks.error();
  const auto partner = findSymmetryPairing(mesh, *landmarks);
  ASSERT_TRUE(partner);
  expectPartners(*partner, readPartners(path));
}

TEST(SymmetryPairing, WorksAcrossAnyPlaneAndWithABorder) {
  // Diagonals of an even grid alternate, so it is symmetric about its middle.
  const Mesh grid = test::grid(8, 5);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  const Mesh mesh = test::transformed(grid, turn.toRotationMatrix(), {100, -20, 5});
  const Eigen::Vector3d normal = turn * Eigen::Vector3d(2, 0, 0);
  const double offset = normal.dot(turn * Eigen::Vector3d(40, 0, 0) + Eigen::Vector3d(100, -20, 5));
  const auto partner = findSymmetryPairing(mesh, normal, offset, 1e-6);
  ASSERT_TRUE(partner);
  for (std::size_t j = 0; j <= 5; ++j) {
    for (std::size_t i = 0; i <= 8; ++i) {
      EXPECT_EQ((*partner)[VertexId(9 * j + i)], VertexId(9 * j + 8 - i));
    }
  }
  const Symmetry symmetry = makeSymmetry(mesh, *partner);
  EXPECT_NEAR(std::abs(symmetry.normal.dot(normal.normalized())), 1, 1e-12);
  EXPECT_NEAR(symmetry.offset * symmetry.normal.dot(normal.normalized()), offset / 2, 1e-9);
}

TEST(SymmetryPairing, PairsWholePartsWithEachOther) {
  const Mesh one = test::icosphere(10, 1);
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles = one.triangles();
  for (const Eigen::Vector3d& p : one.positions()) positions.emplace_back(p.x() + 30, p.y(), p.z());
  for (const Eigen::Vector3d& p : one.positions())
    positions.emplace_back(-p.x() - 30, p.y(), p.z());
  for (const auto& [a, b, c] : one.triangles()) {
    const std::size_t n = one.vertexCount();
    triangles.push_back(
        {VertexId(a.index() + n), VertexId(c.index() + n), VertexId(b.index() + n)});
  }
  const Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles));
  ASSERT_TRUE(mesh) << mesh.error();
  const auto partner = findSymmetryPairing(*mesh, {1, 0, 0}, 0, 1e-9);
  ASSERT_TRUE(partner);
  for (std::size_t v = 0; v < one.vertexCount(); ++v) {
    EXPECT_EQ((*partner)[VertexId(v)], VertexId(v + one.vertexCount()));
  }
}

TEST(SymmetryPairing, OfAnIrregularMeshIsNotFound) {
  EXPECT_FALSE(findSymmetryPairing(test::irregularGrid(8, 5), {1, 0, 0}, 40, 0.01));
  EXPECT_FALSE(findSymmetryPairing(test::grid(8, 5), {1, 0, 0}, 41, 0.01)) << "the wrong plane";
  EXPECT_FALSE(findSymmetryPairing(test::grid(8, 5), {0, 0, 0}, 0, 0.01));
}

constexpr const char* kModelJson = R"({
  "toile-model": 1,
  "name": "square",
  "mesh": "square.obj",
  "units": "cm",
  "curves": {"across": {"tri": [0, 0], "bary": [[1, 0, 0], [0, 1, 0]]}},
  "landmarks": {"middle": 4},
  "symmetry": {"normal": [2, 0, 0], "offset": 100}
})";

std::string squareWithoutUnits() {
  std::string text = writeObj(test::grid(2, 2));
  return text.substr(text.find('\n') + 1);
}

TEST(ReadModel, TakesMeshUnitNamesAndSymmetryFromItsFile) {
  const test::TemporaryFolder folder;
  write(folder, "square.obj", squareWithoutUnits());
  const Result<ReferenceModel> model = readModel(write(folder, "square.model.json", kModelJson));
  ASSERT_TRUE(model) << model.error();
  EXPECT_EQ(model->name, "square");
  EXPECT_EQ(model->mesh->vertexCount(), 9U);
  EXPECT_NEAR(model->mesh->boxMax().x(), 200, 1e-12) << "20 cm";
  EXPECT_EQ(model->landmarks.at("middle"), SurfacePoint{VertexId(4)});
  EXPECT_EQ(model->curves.size(), 1U);
  ASSERT_TRUE(model->symmetry);
  EXPECT_EQ(model->symmetry->normal, Eigen::Vector3d(1, 0, 0));
  ASSERT_EQ(model->symmetry->partner.size(), 9U);
  EXPECT_EQ(model->symmetry->partner[VertexId(3)], VertexId(5));
  EXPECT_EQ(&model->index->mesh(), model->mesh.get());
}

TEST(ReadModel, RefusesWhatDoesNotFit) {
  const test::TemporaryFolder folder;
  write(folder, "square.obj", squareWithoutUnits());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = kModelJson;
    text.replace(text.find(from), from.size(), to);
    return readModel(write(folder, "bad.model.json", text));
  };
  struct Case {
    const char* from;
    const char* to;
    ErrorCode code;
    const char* message;
  };
  const Case cases[] = {
      {"\"toile-model\": 1", "\"toile-model\": 2", ErrorCode::FileFormat, "version 2"},
      {"\"toile-model\": 1,", "", ErrorCode::FileFormat, "no model file"},
      {"square.obj", "none.obj", ErrorCode::FileNotFound, "none.obj"},
      {"\"cm\"", "\"ell\"", ErrorCode::FileFormat, "ell"},
      {"\"units\": \"cm\",", "", ErrorCode::UnitsMissing, "--units"},
      {"\"middle\": 4", "\"middle\": 40", ErrorCode::FileFormat, "middle"},
      {"[2, 0, 0]", "[0, 0, 0]", ErrorCode::FileFormat, "zero"},
      {"\"normal\": [2, 0, 0]", "\"partner\": [1, 0]", ErrorCode::FileFormat, "each of the 9"},
      {"\"normal\": [2, 0, 0]", "\"partner\": [1, 2, 0, 3, 4, 5, 6, 7, 8]", ErrorCode::FileFormat,
       "partner's partner"},
      {"}\n", "", ErrorCode::FileFormat, "not JSON"},
  };
  for (const Case& c : cases) {
    const Result<ReferenceModel> model = with(c.from, c.to);
    ASSERT_FALSE(model) << c.to;
    EXPECT_EQ(model.error().code, c.code) << model.error();
    EXPECT_NE(model.error().message.find(c.message), std::string::npos) << model.error();
  }
  const auto contradiction =
      readModel(write(folder, "square.model.json", kModelJson), FileUnit::Metre);
  ASSERT_FALSE(contradiction);
  EXPECT_EQ(contradiction.error().code, ErrorCode::InvalidArgument);
}

TEST(WithMesh, CarriesNamesToABodyOfTheSameConnectivity) {
  TOILE_TEST_DATA_OR_SKIP(path, "bodies/curves.json");
  ReferenceModel names =
      makeReferenceModel("female_average", body(path.parent_path(), "female_average"));
  const auto curves = parseModelCurves(*names.mesh, textOf(path), "curves.json");
  ASSERT_TRUE(curves) << curves.error();
  names.curves = *curves;
  names.symmetry = makeSymmetry(*names.mesh, *findSymmetryPairing(*names.mesh, {1, 0, 0}, 0, 0.01));
  EXPECT_EQ(names.symmetry->normal, Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR(names.symmetry->offset, 0, 1e-6);

  const auto heavy = withMesh(names, "male_heavy", body(path.parent_path(), "male_heavy"));
  ASSERT_TRUE(heavy) << heavy.error();
  EXPECT_EQ(heavy->curves.size(), 44U);
  // README of the data: waist of male_heavy.
  EXPECT_NEAR(length(*heavy->mesh, heavy->curves.at("waist_girth")), 1060, 1);
  EXPECT_EQ(heavy->symmetry->partner, names.symmetry->partner);

  const auto other = withMesh(names, "grid", test::grid(3, 3));
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::ModelMismatch);
}

}  // namespace
}  // namespace toile
