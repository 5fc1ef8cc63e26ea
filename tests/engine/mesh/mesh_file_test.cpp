// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/mesh/mesh_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "mesh/triangulate_polygon.h"
#include "support/meshes.h"
#include "support/result_printing.h"

namespace toile {
namespace {

Result<MeshFile> meshOf(std::string_view content, const std::string& name = "model.obj") {
  Result<PolygonSoup> soup = parsePolygonSoup(content, name);
  if (!soup) return soup.error();
  return makeMeshFromSoup(std::move(*soup), {.unit = FileUnit::Millimetre});
}

std::vector<std::string> codesOf(const std::vector<Finding>& findings) {
  std::vector<std::string> codes;
  for (const Finding& finding : findings) codes.push_back(finding.code);
  return codes;
}

/// Numbers that are hard to write: thirds, tiny and huge ones, the last bit set.
Mesh awkwardMesh() {
  const Mesh grid = test::grid(5, 4);
  std::vector<Eigen::Vector3d> positions = grid.positions();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Eigen::Vector3d& p : positions) {
    p += Eigen::Vector3d(uniform(random), uniform(random), uniform(random)) / 3;
  }
  positions[0].z() = std::numeric_limits<double>::denorm_min();
  positions[1].z() = -0.0;
  positions[2].z() = std::nextafter(1.0, 2.0);
  positions[3].z() = 1e22 / 3;
  return grid.withPositions(positions);
}

void expectSameBits(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles(), b.triangles());
  ASSERT_EQ(a.vertexCount(), b.vertexCount());
  for (std::size_t v = 0; v < a.vertexCount(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.position(VertexId(v))[axis]),
                std::bit_cast<std::uint64_t>(b.position(VertexId(v))[axis]))
          << v << " " << axis;
    }
  }
}

TEST(MeshFile, WhatIsWrittenReadsBackBitForBit) {
  const Mesh mesh = awkwardMesh();
  const std::string obj = writeObj(mesh);
  const std::string ply = writePly(mesh);
  for (const auto& [text, name] : {std::pair{obj, "a.obj"}, std::pair{ply, "a.ply"}}) {
    Result<PolygonSoup> soup = parsePolygonSoup(text, name);
    ASSERT_TRUE(soup) << soup.error();
    EXPECT_EQ(soup->unit, FileUnit::Millimetre);
    const Result<MeshFile> read = makeMeshFromSoup(std::move(*soup));
    ASSERT_TRUE(read) << read.error();
    expectSameBits(mesh, read->mesh);
  }
}

TEST(MeshFile, UnitsScaleAndMustBeKnown) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto sizeIn = [&](const std::string& content, std::optional<FileUnit> unit) {
    Result<PolygonSoup> soup = parsePolygonSoup(content, "a.obj");
    EXPECT_TRUE(soup) << soup.error();
    return makeMeshFromSoup(std::move(*soup), {.unit = unit});
  };
  const Result<MeshFile> unknown = sizeIn(text, std::nullopt);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::UnitsMissing);
  EXPECT_NE(unknown.error().message.find("--units"), std::string::npos);
  EXPECT_EQ(sizeIn(text, FileUnit::Inch)->mesh.boxMax().x(), 25.4);
  EXPECT_EQ(sizeIn("# toile-units: m\n" + text, std::nullopt)->mesh.boxMax().x(), 1000);
  const Result<MeshFile> both = sizeIn("# toile-units: m\n" + text, FileUnit::Inch);
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().code, ErrorCode::InvalidArgument);
  EXPECT_FALSE(parsePolygonSoup("# toile-units: ell\n" + text, "a.obj"));
  EXPECT_FALSE(parsePolygonSoup("# toile-units: m\n# toile-units: cm\n" + text, "a.obj"));
}

TEST(MeshFile, ChainsAndTargetsAreReadAndFollowTheirVertices) {
  const std::string text =
      "# toile-units: mm\n"
      "v 9 9 9\nv 0 0 0\nv 100 0 0\nv 0 100 0\nv 100 100 0\n"  // the first has no face
      "f 2 3 4\nf 3 5 4\n"
      "l 2 4\n"
      "g wire_feature_waist\nl 3/1 4/2\n"
      "g other names\nl -1 -2 -3\n"
      "l 1 2\n"
      "# target wire_feature_waist 0 99.5\n";
  Result<PolygonSoup> soup = parsePolygonSoup(text, "a.obj");
  ASSERT_TRUE(soup) << soup.error();
  const Result<MeshFile> read = makeMeshFromSoup(std::move(*soup));
  ASSERT_TRUE(read) << read.error();
  ASSERT_EQ(read->chains.size(), 3U);
  EXPECT_EQ(read->chains[0].group, "");
  EXPECT_EQ(read->chains[0].vertices, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(read->chains[0].line, 9U);
  EXPECT_EQ(read->chains[1].group, "wire_feature_waist");
  EXPECT_EQ(read->chains[1].vertices, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(read->chains[2].group, "other names");
  EXPECT_EQ(read->chains[2].vertices, (std::vector<std::uint32_t>{3, 2, 1}));
  ASSERT_EQ(read->targets.size(), 1U);
  EXPECT_EQ(read->targets.at("wire_feature_waist 0"), 99.5);
  EXPECT_EQ(codesOf(read->findings),
            (std::vector<std::string>{"unused-vertices", "line-off-surface"}));
  EXPECT_FALSE(parsePolygonSoup("# target a b 1\nv 0 0 0\n", "a.obj"));
  EXPECT_FALSE(parsePolygonSoup("# target a 1 -1\nv 0 0 0\n", "a.obj"));
}

TEST(MeshFile, OffIsReadWithItsVariants) {
  const std::string body =
      "4 2 0\n0 0 0\n100 0 0 # a comment\n\n100 100 0\n0 100 0\n3 0 1 2\n3 0 2 3\n";
  const std::string colours =
      "4 1 0\n0 0 0 1 0 0 1\n100 0 0 1 0 0 1\n100 100 0 1 0 0 1\n"
      "0 100 0 1 0 0 1\n4 0 1 2 3 255 0 0\n";
  for (const std::string& text :
       {"OFF\n" + body, "OFF " + body, "# toile-units: mm\nOFF\n" + body, "COFF\n" + colours}) {
    const Result<MeshFile> read = meshOf(text, "a.off");
    if (text[0] == '#') {
      EXPECT_FALSE(read) << "the keyword comes first";
      continue;
    }
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->mesh.vertexCount(), 4U);
    EXPECT_EQ(read->mesh.faceCount(), 2U);
  }
  EXPECT_FALSE(meshOf("OFF\n4000000000 1 0\n0 0 0\n", "a.off"));
  EXPECT_FALSE(meshOf("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off"));
  EXPECT_FALSE(meshOf("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n", "a.off"));
  EXPECT_FALSE(meshOf("OFF BINARY\n", "a.off"));
}

// A few bytes that promise gigabytes.
TEST(MeshFile, HeadersThatLieAreRefusedAtOnce) {
  const auto ply = [](const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string faces = "property list uchar int vertex_indices\n";
  const std::vector<std::string> lies = {
      ply("ascii", "element vertex 4000000000\n" + xyz) + "0 0 0\n",
      ply("binary_little_endian", "element vertex 9000000000000000000\n" + xyz),
      ply("binary_little_endian", "element vertex -1\n" + xyz),
      ply("binary_little_endian", "element vertex 99999999999999999999\n" + xyz),
      ply("ascii", "element vertex 1\n" + xyz + "element face 4000000000\n" + faces) + "0 0 0\n",
      ply("ascii",
          "element vertex 1\n" + xyz + "element face 1\nproperty list uint int vertex_indices\n") +
          "0 0 0\n4000000000 0\n",
      ply("ascii", "element nothing 9000000000000000000\n"),
      ply("ascii", "element vertex 1\nproperty list int float x\n") + "0\n",
      ply("binary_middle_endian", ""),
      "ply\nend_header\n",
  };
  for (const std::string& lie : lies) {
    const Result<PolygonSoup> soup = parsePolygonSoup(lie, "a.ply");
    ASSERT_FALSE(soup) << lie;
    EXPECT_EQ(soup.error().code, ErrorCode::FileFormat) << soup.error();
  }
  std::string stl(84, '\0');
  stl[80] = stl[81] = stl[82] = stl[83] = '\x7f';
  EXPECT_FALSE(parsePolygonSoup(stl, "a.stl"));
}

std::vector<std::pair<std::string, std::string>> goodFiles() {
  const Mesh mesh = test::grid(3, 2);
  std::string asciiPly = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_index\n"
      "end_header\n",
      mesh.vertexCount(), mesh.faceCount());
  std::string off = fmt::format("OFF\n{} {} 0\n", mesh.vertexCount(), mesh.faceCount());
  std::string faces;
  for (const Eigen::Vector3d& p : mesh.positions()) {
    const std::string line = fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
    asciiPly += line;
    off += line;
  }
  std::string asciiStl = "solid a\n";
  std::string binaryStl(84, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.faceCount());
  std::memcpy(binaryStl.data() + 80, &count, 4);
  for (const Triangle& t : mesh.triangles()) {
    faces += fmt::format("3 {} {} {}\n", t[0].index(), t[1].index(), t[2].index());
    asciiStl += "facet normal 0 0 1\n outer loop\n";
    std::array<float, 12> numbers{0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.position(t[k]);
      asciiStl += fmt::format("  vertex {} {} {}\n", p.x(), p.y(), p.z());
      for (int axis = 0; axis < 3; ++axis) {
        numbers[3 + 3 * k + static_cast<std::size_t>(axis)] = static_cast<float>(p[axis]);
      }
    }
    asciiStl += " endloop\nendfacet\n";
    std::array<char, 50> record{};
    std::memcpy(record.data(), numbers.data(), sizeof numbers);
    binaryStl.append(record.data(), record.size());
  }
  asciiStl += "endsolid a\n";
  return {{"a.obj", writeObj(mesh) + "g wire_feature_a\nl 1 2 3\n# target wire_feature_a 0 9.5\n"},
          {"a.ply", writePly(mesh)},
          {"b.ply", asciiPly + faces},
          {"a.off", off + faces},
          {"a.stl", asciiStl},
          {"b.stl", binaryStl}};
}

TEST(MeshFile, FormatsAgree) {
  for (const auto& [name, content] : goodFiles()) {
    const Result<MeshFile> read = meshOf(content, name);
    ASSERT_TRUE(read) << name << read.error();
    EXPECT_EQ(read->mesh.vertexCount(), 12U) << name;
    EXPECT_EQ(read->mesh.faceCount(), 12U) << name;
    EXPECT_EQ(read->mesh.boxMax(), Eigen::Vector3d(30, 20, 0)) << name;
    EXPECT_TRUE(read->findings.empty()) << name;
  }
}

// Whatever is left of a file is read or refused; a binary one that was cut off is refused.
TEST(MeshFile, EveryTruncationIsReadOrRefused) {
  for (const auto& [name, content] : goodFiles()) {
    std::size_t refused = 0;
    for (std::size_t length = 0; length < content.size(); ++length) {
      const Result<MeshFile> read = meshOf(std::string_view(content).substr(0, length), name);
      refused += read ? 0 : 1;
      if (!read) {
        ASSERT_FALSE(read.error().message.empty());
      }
    }
    if (name == "a.ply" || name == "b.stl") {
      EXPECT_EQ(refused, content.size()) << name;
    }
    EXPECT_GT(refused, 0U) << name;
  }
}

TEST(MeshFile, FlippedBytesAreReadOrRefused) {
  std::mt19937 random(6);
  for (const auto& [name, content] : goodFiles()) {
    std::size_t refused = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      std::string damaged = content;
      const int flips = 1 + static_cast<int>(random() % 4);
      for (int i = 0; i < flips; ++i) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      const Result<MeshFile> read = meshOf(damaged, name);
      refused += read ? 0 : 1;
      if (!read) continue;
      for (const Eigen::Vector3d& p : read->mesh.positions()) ASSERT_TRUE(p.allFinite());
    }
    EXPECT_GT(refused, 100U) << name;
  }
}

double areaOf(const std::vector<Eigen::Vector3d>& polygon, const detail::PolygonTriangles& cut) {
  double area = 0;
  for (const auto& [a, b, c] : cut.corners) {
    area += 0.5 * (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]).norm();
  }
  return area;
}

TEST(TriangulatePolygon, ConvexOnesBecomeAFan) {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const detail::PolygonTriangles cut = detail::triangulatePolygon(square);
  EXPECT_TRUE(cut.isSimple);
  ASSERT_EQ(cut.corners.size(), 2U);
  EXPECT_EQ(cut.corners[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(cut.corners[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

// A comb with 40 teeth in a slanted plane, and corners in the middle of straight sides.
TEST(TriangulatePolygon, ConcaveOnesKeepTheirArea) {
  std::vector<Eigen::Vector3d> comb;
  const auto add = [&](double x, double y) { comb.emplace_back(x, y, 0.3 * x - 0.2 * y); };
  double flatArea = 0;
  for (int i = 0; i < 40; ++i) {
    add(2 * i, 0);
    add(2 * i + 1, 0);
    add(2 * i + 1, 10);
    add(2 * i + 2, 10);
    flatArea += 2 * 20 - 10;
  }
  add(80, 20);
  add(40, 20);
  add(0, 20);
  const detail::PolygonTriangles cut = detail::triangulatePolygon(comb);
  EXPECT_TRUE(cut.isSimple);
  EXPECT_EQ(cut.corners.size(), comb.size() - 2);
  EXPECT_NEAR(areaOf(comb, cut), flatArea * std::sqrt(1 + 0.09 + 0.04), 1e-9 * flatArea);
  for (const auto& [a, b, c] : cut.corners) {
    EXPECT_GT((comb[b] - comb[a]).cross(comb[c] - comb[a]).z(), 0) << a << " " << b << " " << c;
  }
}

TEST(TriangulatePolygon, CrossingOnesAreSaidToBe) {
  const std::vector<Eigen::Vector3d> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(detail::triangulatePolygon(bow).isSimple);
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_FALSE(detail::triangulatePolygon(line).isSimple);
}

TEST(MakeMeshFromSoup, NamesElementsAsTheFileNumbersThem) {
  // Vertex 0 is unused, so that the mesh's own numbers would be one less.
  const Result<MeshFile> fin = meshOf(
      "v 9 9 9\nv 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 -10 0\nv 0 0 10\n"
      "f 2 3 4\nf 3 2 5\nf 2 3 6\n");
  ASSERT_FALSE(fin);
  EXPECT_EQ(fin.error().code, ErrorCode::NotManifold);
  EXPECT_EQ(fin.error().where,
            (std::vector<Element>{Element::vertex(VertexId(1)), Element::vertex(VertexId(2))}));
  EXPECT_NE(fin.error().message.find("vertices 1 and 2 (faces 0, 1, 2)"), std::string::npos)
      << fin.error();
}

// A closed part inside another that faces inward is a hollow; one that stands apart is a mistake.
TEST(MakeMeshFromSoup, HollowsStayAndInvertedPartsAreTurned) {
  const auto inside = [](double shift) {
    PolygonSoup soup;
    soup.unit = FileUnit::Millimetre;
    for (const bool isInner : {false, true}) {
      const Mesh sphere = test::icosphere(isInner ? 30 : 100, 1);
      const auto base = static_cast<std::uint32_t>(soup.positions.size());
      for (const Eigen::Vector3d& p : sphere.positions()) {
        soup.positions.push_back(p + Eigen::Vector3d(isInner ? shift : 0, 0, 0));
      }
      for (const auto& [a, b, c] : sphere.triangles()) {
        soup.polygons.push_back({a.index() + base, b.index() + base, c.index() + base});
        if (isInner) std::swap(soup.polygons.back()[1], soup.polygons.back()[2]);
      }
    }
    return makeMeshFromSoup(std::move(soup));
  };
  const Result<MeshFile> hollow = inside(0);
  ASSERT_TRUE(hollow) << hollow.error();
  EXPECT_EQ(codesOf(hollow->findings), (std::vector<std::string>{"hollow", "components"}));
  const Result<MeshFile> apart = inside(300);
  ASSERT_TRUE(apart) << apart.error();
  EXPECT_EQ(codesOf(apart->findings), (std::vector<std::string>{"turned-surface", "components"}));
}

}  // namespace
}  // namespace toile
