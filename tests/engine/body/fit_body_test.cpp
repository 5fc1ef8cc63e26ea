// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/body/fit_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>

#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/core/file.h"

namespace toile {
namespace {

struct Expected {
  std::string scan;
  std::map<BodyMeasure, double> mm;  ///< the true body's curves of the same names
};

// The body knows its places from the scan alone, so a level may lie otherwise than on the true
// body.
TEST(FitBody, MeasuresScansOfStrangers) {
  std::vector<Expected> all{{"female_average_remesh",
                             {{BodyMeasure::Height, 1650},
                              {BodyMeasure::Chest, 884},
                              {BodyMeasure::Waist, 667},
                              {BodyMeasure::Hip, 956},
                              {BodyMeasure::Thigh, 542},
                              {BodyMeasure::Knee, 344},
                              {BodyMeasure::Calf, 348}}},
                            {"male_heavy_holes",
                             {{BodyMeasure::Height, 1740},
                              {BodyMeasure::Chest, 1167},
                              {BodyMeasure::Waist, 1060},
                              {BodyMeasure::Hip, 1195},
                              {BodyMeasure::Thigh, 675},
                              {BodyMeasure::Knee, 412},
                              {BodyMeasure::Calf, 438}}},
                            {"child_10y_cloud",
                             {{BodyMeasure::Height, 1385},
                              {BodyMeasure::Chest, 693},
                              {BodyMeasure::Waist, 564},
                              {BodyMeasure::Hip, 753},
                              {BodyMeasure::Thigh, 425},
                              {BodyMeasure::Knee, 283},
                              {BodyMeasure::Calf, 291}}}};
  if (std::getenv("TOILE_FIT_SWEEP") == nullptr) all.resize(1);
  for (const Expected& one : all) {
    TOILE_TEST_DATA_OR_SKIP(file, "scans/" + one.scan + ".ply");
    const Result<Scan> scan = readScan(file, FileUnit::Millimetre);
    ASSERT_TRUE(scan) << scan.error();
    const Result<BodyFit> fit = fitBody(*scan);
    ASSERT_TRUE(fit) << fit.error();
    const FitReport& r = fit->fit.report;
    std::cout << fmt::format("{}: scan to fit {:.2f} / {:.2f}, {:.1f} % stray, {} flips:", one.scan,
                             r.scanToFit.mean, r.scanToFit.percentile95, 100 * r.strayShare,
                             r.flippedFaces);
    EXPECT_TRUE(r.isOk()) << r.reasons.front().message;
    EXPECT_LT(r.scanToFit.mean, 1);
    ASSERT_EQ(fit->measures.size(), kBodyMeasureCount);
    for (const auto& [measure, mm] : one.mm) {
      const auto i = static_cast<std::size_t>(measure);
      std::cout << fmt::format(" {} {:.0f} ({:.0f})", bodyMeasures()[i].name, fit->measures[i].mm(),
                               mm);
      EXPECT_NEAR(fit->measures[i].mm(), mm, 0.04 * mm) << bodyMeasures()[i].name;
    }
    std::cout << "\n";
  }
}

}  // namespace
}  // namespace toile
