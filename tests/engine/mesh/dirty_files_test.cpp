// SPDX-License-Identifier: GPL-3.0-or-later
// The files of the test data that break loaders, and what Toile does with each of them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

/// What is expected of one file. Counts of 0 are not looked at.
struct Case {
  std::string file;
  std::optional<ErrorCode> error;
  std::string message;  // part of the error's message
  std::vector<std::string> findings;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t components = 1;
  std::size_t borders = 0;  // loops
  std::optional<double> area;
  std::size_t elements = 0;  // in `where` of the error
};

Case good(std::string file, std::size_t vertices, std::size_t faces,
          std::vector<std::string> findings = {}) {
  Case c;
  c.file = std::move(file);
  c.vertices = vertices;
  c.faces = faces;
  c.findings = std::move(findings);
  return c;
}

Case withBorders(Case c, std::size_t loops) {
  c.borders = loops;
  return c;
}

Case withComponents(Case c, std::size_t components) {
  c.components = components;
  return c;
}

Case withArea(Case c, double area) {
  c.area = area;
  return c;
}

Case refused(std::string file, ErrorCode code, std::string message, std::size_t elements = 0) {
  Case c;
  c.file = std::move(file);
  c.error = code;
  c.message = std::move(message);
  c.elements = elements;
  return c;
}

std::vector<Case> cases() {
  using enum ErrorCode;
  return {
      refused("nonmanifold_edge.obj", NotManifold, "1 edge with more than two faces", 2),
      refused("nonmanifold_vertex.obj", NotManifold, "1 vertex where parts touch", 1),
      refused("nonmanifold_edge4.obj", NotManifold, "1 edge with more than two faces", 2),
      good("duplicate_faces.obj", 8, 12, {"duplicate-face"}),
      good("opposite_duplicate.obj", 8, 12, {"duplicate-face"}),
      good("degenerate_index.obj", 8, 12, {"degenerate-face"}),
      good("degenerate_area.obj", 8, 12, {"face-without-area", "unused-vertices"}),
      good("duplicate_vertices_soup.obj", 8, 12, {"welded"}),
      good("isolated_vertices.obj", 8, 12, {"unused-vertices"}),
      good("inverted.obj", 162, 320, {"turned-surface"}),
      good("mixed_orientation.obj", 162, 320, {"turned-faces"}),
      refused("moebius.obj", NotOrientable, "Moebius"),
      withComponents(good("disconnected.obj", 3 * 162, 3 * 320, {"components"}), 3),
      withComponents(good("self_intersecting.obj", 0, 640, {"components"}), 2),
      good("self_intersecting_one.obj", 162, 320),
      withBorders(good("one_triangle.obj", 3, 1), 1),
      withBorders(good("two_holes.obj", 0, 0, {"unused-vertices"}), 2),
      refused("nan_vertex.obj", FileFormat, "line "),
      refused("inf_vertex.obj", FileFormat, "line "),
      good("huge_coordinates.obj", 162, 320),
      good("tiny_scale.obj", 162, 320, {"unit-hint"}),
      good("metres.obj", 162, 320, {"unit-hint"}),
      refused("out_of_range_index.obj", FileFormat, "line "),
      refused("zero_index.obj", FileFormat, "line "),
      withBorders(good("negative_indices.obj", 0, 6, {"welded"}), 1),
      good("quads.obj", 8, 12),
      good("ngons.obj", 16, 28),
      withArea(withBorders(good("concave_ngon.obj", 5, 3), 1), 6000),
      good("missing_mtl.obj", 8, 12, {"material-file-missing"}),
      good("crlf.obj", 8, 12),
      good("cr_only.obj", 8, 12),
      good("no_final_newline.obj", 8, 12),
      good("tabs_spaces_continued.obj", 8, 12),
      good("vertex_colours.obj", 8, 12),
      good("texture_normals.obj", 8, 12),
      refused("comma_decimals.obj", FileFormat, "comma"),
      good("bom.obj", 8, 12),
      refused("points_only.obj", FileFormat, "no faces"),
      refused("empty.obj", FileFormat, "empty"),
      refused("only_comments.obj", FileFormat, "no vertices"),
      refused("text_not_mesh.stl", FileFormat, "neither ASCII STL"),
      good("sphere_binary.stl", 162, 320),
      refused("truncated_binary.stl", FileFormat, "cut off"),
      refused("wrong_count_binary.stl", FileFormat, "cut off"),
      good("solid_but_binary.stl", 162, 320),
      good("zero_normals_binary.stl", 162, 320),
      withBorders(good("ascii.stl", 0, 80), 1),
      refused("truncated_ascii.stl", FileFormat, "cut off"),
      good("big_endian.ply", 162, 320),
      good("normals_colours.ply", 162, 320),
      refused("truncated_binary.ply", FileFormat, "cut off"),
      refused("truncated_header.ply", FileFormat, "cut off"),
      good("ascii_odd_properties.ply", 8, 12),
      refused("face_count_lies.ply", FileFormat, "cut off"),
      refused("bad_index.ply", FileFormat, "vertex number"),
  };
}

double areaOf(const Mesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) area += mesh.area(FaceId(f));
  return area;
}

double volumeAboutCentre(const Mesh& mesh) {
  const Eigen::Vector3d centre = 0.5 * (mesh.boxMin() + mesh.boxMax());
  double volume = 0;
  for (const Triangle& t : mesh.triangles()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = mesh.position(t[static_cast<std::size_t>(k)]) - centre;
    }
    volume += corners.determinant() / 6;
  }
  return volume;
}

void expectCase(const Case& c, const std::filesystem::path& folder) {
  SCOPED_TRACE(c.file);
  const Result<MeshFile> read = readMesh(folder / c.file, {.unit = FileUnit::Millimetre});
  if (c.error) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, *c.error) << read.error();
    EXPECT_NE(read.error().message.find(c.message), std::string::npos) << read.error();
    EXPECT_NE(read.error().message.find(c.file), std::string::npos) << read.error();
    if (c.elements > 0) {
      EXPECT_EQ(read.error().where.size(), c.elements) << read.error();
    }
    if (c.message == "line ") {
      ASSERT_EQ(read.error().where.size(), 1U);
      EXPECT_EQ(read.error().where[0].kind, Element::Kind::Line);
    }
    return;
  }
  ASSERT_TRUE(read) << read.error();
  std::vector<std::string> codes;
  for (const Finding& finding : read->findings) codes.push_back(finding.code);
  EXPECT_EQ(codes, c.findings);
  const Mesh& mesh = read->mesh;
  if (c.vertices > 0) {
    EXPECT_EQ(mesh.vertexCount(), c.vertices);
  }
  if (c.faces > 0) {
    EXPECT_EQ(mesh.faceCount(), c.faces);
  }
  EXPECT_EQ(mesh.componentCount(), c.components);
  EXPECT_EQ(mesh.boundaryLoops().size(), c.borders);
  if (c.borders == 0) {
    EXPECT_GT(volumeAboutCentre(mesh), 0) << "faces inward";
  }
  if (c.area) {
    EXPECT_NEAR(areaOf(mesh), *c.area, 1e-9 * *c.area);
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    ASSERT_TRUE(mesh.normal(FaceId(f)).allFinite());
  }
}

TEST(DirtyFiles, EachIsReadOrRefusedAsItShould) {
  TOILE_TEST_DATA_OR_SKIP(path, "dirty/expected.json");
  std::ifstream in(path);
  const nlohmann::json list = nlohmann::json::parse(in);
  std::set<std::string> known;
  for (const Case& c : cases()) {
    known.insert(c.file);
    EXPECT_TRUE(list.contains(c.file)) << c.file;
    expectCase(c, path.parent_path());
  }
  for (const auto& [file, what] : list.items()) {
    EXPECT_TRUE(known.count(file) == 1) << file << " has no case here: " << what;
  }
}

TEST(DirtyFiles, FarAwaySphereKeepsItsVolume) {
  TOILE_TEST_DATA_OR_SKIP(path, "dirty/huge_coordinates.obj");
  const Result<MeshFile> read = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(read) << read.error();
  EXPECT_NEAR(volumeAboutCentre(read->mesh), 4.05e6, 0.02 * 4.05e6);
}

TEST(DirtyFiles, MetresAreHintedAt) {
  TOILE_TEST_DATA_OR_SKIP(path, "dirty/metres.obj");
  const Result<MeshFile> read = readMesh(path, {.unit = FileUnit::Millimetre});
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->findings.size(), 1U);
  EXPECT_NE(read->findings[0].message.find("--units m"), std::string::npos)
      << read->findings[0].message;
}

}  // namespace
}  // namespace toile
