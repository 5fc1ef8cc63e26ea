// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/scan/clean_scan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "scan/invented.h"
#include "scan/oriented_points.h"
#include "scan/parts.h"
#include "scan/poisson.h"
#include "scan/remesh.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/parallel.h"

namespace toile {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

#define TOILE_SCANS_OR_SKIP() TOILE_TEST_DATA_OR_SKIP(scans, "scans/child_10y_cloud.ply")

Scan readTestScan(const std::string& file) {
  return readScan(test::testDataFolder() / file, FileUnit::Millimetre).value();
}

/// Points on a sphere, even (Fibonacci), with noise along the radius.
Scan spherePoints(double radius, std::size_t count, double noise = 0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  Scan scan;
  scan.name = "sphere";
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    const double across = std::sqrt(1 - z * z);
    scan.points.push_back((radius + noise * normal(random)) *
                          Eigen::Vector3d(across * std::cos(angle), across * std::sin(angle), z));
  }
  return scan;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles()) {
    sum += mesh.position(t[0]).dot(mesh.position(t[1]).cross(mesh.position(t[2]))) / 6;
  }
  return sum;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) sum += mesh.area(FaceId(f));
  return sum;
}

void expectClosed(const Mesh& mesh, std::size_t parts) {
  EXPECT_EQ(mesh.boundaryLoops().size(), 0U);
  EXPECT_EQ(mesh.componentCount(), parts);
  EXPECT_GT(volume(mesh), 0) << "the faces look inwards";
}

/// Most edges are near the length that was asked for.
void expectEven(const Mesh& mesh, double edge) {
  std::vector<double> lengths;
  for (std::size_t e = 0; e < mesh.edgeCount(); ++e) lengths.push_back(mesh.length(EdgeId(e)));
  std::sort(lengths.begin(), lengths.end());
  EXPECT_GT(lengths[lengths.size() / 20], 0.55 * edge);
  EXPECT_LT(lengths[lengths.size() * 19 / 20], 1.5 * edge);
}

TEST(CleanScan, MakesASphereOfNoisyPoints) {
  const Scan scan = spherePoints(100, 6000, 0.5);
  const Result<CleanedScan> cleaned =
      cleanScan(scan, {.kind = ScanKind::Object, .edge = Length::mm(8)});
  ASSERT_TRUE(cleaned) << cleaned.error();
  const Mesh& mesh = *cleaned->model.mesh;
  expectClosed(mesh, 1);
  expectEven(mesh, 8);
  EXPECT_EQ(mesh.eulerCharacteristic(), 2);
  EXPECT_EQ(cleaned->report.crossings, 0U);
  EXPECT_EQ(cleaned->report.handles, 0);
  EXPECT_NEAR(volume(mesh), 4. / 3 * std::numbers::pi * 1e6, 0.02 * 4.2e6);
  EXPECT_NEAR(area(mesh), 4 * std::numbers::pi * 1e4, 0.02 * 1.26e5);
  EXPECT_NEAR(mesh.boxMin().z(), 0, 1e-9);
  EXPECT_EQ(cleaned->report.inventedArea, 0);
}

// A cap that was not seen is closed, and its size and place are told.
TEST(CleanScan, TellsWhatItInvents) {
  Scan scan = spherePoints(100, 6000);
  std::erase_if(scan.points, [](const Eigen::Vector3d& p) { return p.z() < -80; });
  const Result<CleanedScan> cleaned =
      cleanScan(scan, {.kind = ScanKind::Object, .edge = Length::mm(8)});
  ASSERT_TRUE(cleaned) << cleaned.error();
  expectClosed(*cleaned->model.mesh, 1);
  // The cap as a sphere has 2 pi 100 20 mm2, as a plane pi 60^2.
  ASSERT_EQ(cleaned->report.invented.size(), 1U);
  EXPECT_NEAR(cleaned->report.invented.front().area, 12000, 2500);
  EXPECT_EQ(cleaned->report.invented.front().place, "below");
  ASSERT_TRUE(cleaned->model.curves.contains("invented 1"));
  const SurfacePath& border = cleaned->model.curves.at("invented 1");
  EXPECT_TRUE(isValid(*cleaned->model.mesh, border));
  EXPECT_NEAR(length(*cleaned->model.mesh, border), 2 * std::numbers::pi * 60, 130);
}

TEST(CleanScan, LeavesOutSpecksAndKeepsTwoSheetsApart) {
  Scan scan = spherePoints(100, 6000);
  const Scan inner = spherePoints(2, 60);
  for (const Eigen::Vector3d& p : inner.points) {
    scan.points.push_back(p + Eigen::Vector3d(300, 0, 0));
  }
  scan.points.emplace_back(0, 0, 180);
  const Result<CleanedScan> cleaned =
      cleanScan(scan, {.kind = ScanKind::Object, .edge = Length::mm(8)});
  ASSERT_TRUE(cleaned) << cleaned.error();
  expectClosed(*cleaned->model.mesh, 1);
  EXPECT_EQ(cleaned->report.lonePoints, 1U);
  EXPECT_EQ(cleaned->report.flyingParts, 1U);
  EXPECT_EQ(cleaned->report.flyingPoints, 60U);
}

TEST(CleanScan, RefusesWhatItCannotRead) {
  EXPECT_THAT(cleanScan(spherePoints(100, 50)).error().message, HasSubstr("50 points"));
  Scan flat = spherePoints(100, 200);
  for (Eigen::Vector3d& p : flat.points) p.setZero();
  EXPECT_THAT(cleanScan(flat).error().message, HasSubstr("one place"));
  const CleanOptions object{.kind = ScanKind::Object};
  EXPECT_THAT(cleanScan(spherePoints(100, 300), object).error().message, HasSubstr("mm apart"));
  CleanOptions fine = object;
  fine.edge = Length::mm(0.001);
  EXPECT_THAT(cleanScan(spherePoints(100, 3000), fine).error().message, HasSubstr("out of range"));
}

/// On its back, front up, somewhere.
Eigen::Isometry3d lying() {
  return Eigen::Translation3d(700, -3000, 250) *
         Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
}

// Soles and crown are missing, 1 mm of noise; the true body is known.
TEST(CleanScan, StandsAPersonUprightAndClosesTheHoles) {
  TOILE_SCANS_OR_SKIP();
  Scan scan = readTestScan("scans/male_heavy_holes.ply");
  for (Eigen::Vector3d& p : scan.points) p = lying() * p;
  const Result<CleanedScan> cleaned = cleanScan(scan, {.edge = Length::mm(12)});
  ASSERT_TRUE(cleaned) << cleaned.error();
  const Mesh& mesh = *cleaned->model.mesh;
  const CleanReport& report = cleaned->report;
  expectClosed(mesh, 1);
  EXPECT_NEAR(mesh.boxMin().z(), 0, 1e-9);
  EXPECT_NEAR(report.height, 1740, 25);
  EXPECT_THAT(report.findings, Contains(Field(&Finding::code, "scan-turned")));
  // Upright, facing -y, as the body stood before it was laid down.
  const Eigen::Isometry3d moved = cleaned->standing * lying();
  EXPECT_LT(Eigen::AngleAxisd(moved.linear()).angle() * 180 / std::numbers::pi, 2.5);
  const Result<ReferenceModel> truth =
      readModel(test::testDataFolder() / "bodies/male_heavy.ply", FileUnit::Millimetre);
  ASSERT_TRUE(truth) << truth.error();
  std::vector<double> off;
  for (const Eigen::Vector3d& p : truth->mesh->positions()) {
    off.push_back(cleaned->model.index->closestPoint(moved * p).distance);
  }
  std::sort(off.begin(), off.end());
  std::cout << fmt::format(
      "turned by {:.2f} degrees; true body to model: median {:.2f}, 95 % {:.2f} mm; scan {:.2f} "
      "mm\n",
      Eigen::AngleAxisd(moved.linear()).angle() * 180 / std::numbers::pi, off[off.size() / 2],
      off[off.size() * 95 / 100], report.scanToModel.mean);
  // Half of its vertices are on hands and head, which edges of 12 mm show coarsely.
  EXPECT_LT(off[off.size() / 2], 4);
  EXPECT_LT(report.scanToModel.mean, 2.5);
  std::vector<std::string> places;
  for (const InventedPatch& patch : report.invented) places.push_back(patch.place);
  EXPECT_THAT(places, Contains("head, above"));
  EXPECT_THAT(places, Contains("left foot, below"));
  EXPECT_THAT(places, Contains("right foot, below"));
  const nlohmann::json json = nlohmann::json::parse(writeCleanReport(*cleaned));
  EXPECT_EQ(json["format"], "toile-scan");
  EXPECT_EQ(json["invented"].size(), report.invented.size());
}

std::string refusal(const Scan& scan) {
  const Result<CleanedScan> cleaned = cleanScan(scan, {.edge = Length::mm(16)});
  return cleaned ? "none" : cleaned.error().message;
}

TEST(CleanScan, AsksOrRefusesWhatIsNoPerson) {
  TOILE_SCANS_OR_SKIP();
  EXPECT_THAT(refusal(readTestScan("toys/armchair.ply")), HasSubstr("--kind object"));
  const Scan child = readTestScan("scans/child_10y_cloud.ply");
  const auto part = [&](const auto& isKept) {
    return scanning::keepPoints(child, [&](std::size_t i) { return isKept(child.points[i]); });
  };
  EXPECT_NE(refusal(part([](const auto& p) { return p.z() > 700; })), "none");
  EXPECT_NE(refusal(part([](const auto& p) { return p.y() < 0; })), "none");
  Scan metres = child;
  for (Eigen::Vector3d& p : metres.points) p /= 1000;
  EXPECT_THAT(refusal(metres), HasSubstr("--units m makes it 13"));
  Scan two = child;
  for (const Eigen::Vector3d& p : child.points) two.points.emplace_back(p.x() + 1500, p.y(), p.z());
  EXPECT_THAT(refusal(two), HasSubstr("another person"));
  std::size_t number = 0;
  EXPECT_THAT(refusal(part([&](const auto&) { return number++ % 40 == 0; })),
              HasSubstr("mm apart"));
}

// A mirrored mesh is inside out; whether it was only turned nobody can see.
TEST(CleanScan, AsksWhyFacesLookInwards) {
  TOILE_SCANS_OR_SKIP();
  Scan scan = readTestScan("bodies/female_average.ply");
  for (Eigen::Vector3d& p : scan.points) p.x() = -p.x();
  CleanOptions options{.edge = Length::mm(16)};
  const Result<CleanedScan> asked = cleanScan(scan, options);
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().code, ErrorCode::NotOrientable);
  EXPECT_THAT(asked.error().message, HasSubstr("--inward-faces mirrored"));
  options.inwardFaces = InwardFaces::Mirrored;
  const Result<CleanedScan> back = cleanScan(scan, options);
  ASSERT_TRUE(back) << back.error();
  expectClosed(*back->model.mesh, 1);
}

TEST(CleanScan, AsksForTheUnitOfAFile) {
  TOILE_SCANS_OR_SKIP();
  const Result<Scan> scan = readRawScan(test::testDataFolder() / "scans/child_10y_cloud.ply",
                                        std::nullopt, ScanKind::Body);
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().code, ErrorCode::UnitsMissing);
  EXPECT_THAT(scan.error().message, HasSubstr("--units mm makes it"));
  EXPECT_THAT(scan.error().message, ::testing::Not(HasSubstr("--units m makes")));
}

TEST(CleanScan, IsTheSameOnAnyNumberOfThreads) {
  const Scan scan = spherePoints(100, 4000, 0.5);
  std::vector<std::vector<Eigen::Vector3d>> positions;
  for (const std::size_t threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    const Result<CleanedScan> cleaned =
        cleanScan(scan, {.kind = ScanKind::Object, .edge = Length::mm(10)});
    ASSERT_TRUE(cleaned) << cleaned.error();
    positions.push_back(cleaned->model.mesh->positions());
  }
  EXPECT_TRUE(positions[0] == positions[1]);
}

TEST(SpreadEvenly, KeepsSheetsThatFaceApart) {
  // Two squares back to back, 1 mm apart, seen in cubes of 10 mm.
  Scan scan;
  std::vector<Eigen::Vector3d> normals;
  for (const double z : {4.0, 5.0}) {
    for (const auto& [x, y] : {std::pair{0., 0.}, {100., 0.}, {100., 100.}, {0., 100.}}) {
      scan.points.emplace_back(x, y, z);
      normals.emplace_back(0, 0, z > 4.5 ? 1 : -1);
    }
  }
  const auto v = [](std::size_t i) { return VertexId(i); };
  scan.triangles = {{v(0), v(2), v(1)}, {v(0), v(3), v(2)}, {v(4), v(5), v(6)}, {v(4), v(6), v(7)}};
  const scanning::OrientedPoints points = scanning::spreadEvenly(scan, normals, 10);
  EXPECT_EQ(points.points.size(), 200U);
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    EXPECT_NEAR(points.points[i].z(), points.normals[i].z() > 0 ? 5 : 4, 1e-12);
  }
}

}  // namespace
}  // namespace toile
