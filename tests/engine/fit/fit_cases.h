// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "support/test_data.h"
#include "toile/core/file.h"
#include "toile/fit/fit.h"

/// Fits of the bodies of the test data, whose true map is known.
namespace toile::test {

/// For every point of a scan its place on the template's connectivity.
struct TrueMap {
  std::vector<FaceId> face;
  std::vector<Eigen::Vector3d> weights;
};

/// Rows of four little-endian float32: face, three weights (NumPy format 1.0).
inline TrueMap readTrueMap(const std::filesystem::path& path) {
  const std::string bytes = readFile(path).value();
  constexpr std::size_t kRow = 4 * sizeof(float);
  TrueMap map;
  for (std::size_t at = bytes.find('\n') + 1; at + kRow <= bytes.size(); at += kRow) {
    std::array<float, 4> row{};
    std::memcpy(row.data(), bytes.data() + at, kRow);
    map.face.emplace_back(static_cast<std::size_t>(row[0]));
    map.weights.emplace_back(row[1], row[2], row[3]);
  }
  return map;
}

inline bool hasBodies() {
  return findTestData("bodies/landmarks.json") && findTestData("scans/child_10y_cloud.ply");
}

inline ReferenceModel readBody(const std::string& name) {
  const std::filesystem::path folder = testDataFolder() / "bodies";
  ReferenceModel model = readModel(folder / (name + ".ply"), FileUnit::Millimetre).value();
  const std::string landmarks = readFile(folder / "landmarks.json").value();
  const std::string curves = readFile(folder / "curves.json").value();
  model.landmarks = parseLandmarks(*model.mesh, landmarks, "landmarks.json").value();
  model.curves = parseModelCurves(*model.mesh, curves, "curves.json").value();
  return model;
}

inline std::vector<std::shared_ptr<const Mesh>> readFamily(const std::vector<std::string>& names) {
  std::vector<std::shared_ptr<const Mesh>> family;
  for (const std::string& name : names) family.push_back(readBody(name).mesh);
  return family;
}

/// Ascending distances of the scan's points from their true places on the fit.
inline std::vector<double> mapErrors(const TrueMap& truth, const Scan& scan, const Mesh& fit) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.face.size(); ++i) {
    const Triangle& t = fit.vertices(truth.face[i]);
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      p += truth.weights[i][k] * fit.position(t[static_cast<std::size_t>(k)]);
    }
    errors.push_back((p - scan.points[i]).norm());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// How long random sweeps are: TOILE_FIT_SWEEP, else as given.
inline int sweep(int usual) {
  const char* count = std::getenv("TOILE_FIT_SWEEP");
  return count == nullptr ? usual : std::atoi(count);
}

}  // namespace toile::test

#define TOILE_BODIES_OR_SKIP()                                         \
  if (!::toile::test::hasBodies()) {                                   \
    if (::toile::test::isTestDataRequired()) FAIL() << "no bodies";    \
    GTEST_SKIP() << "no test data; set TOILE_TEST_DATA to its folder"; \
  }
