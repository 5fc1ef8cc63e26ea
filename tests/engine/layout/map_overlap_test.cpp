// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of a guiding map must not lie on themselves: pieces would be brought together that are
// apart on the body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "finish/polygon.h"
#include "support/result_printing.h"
#include "support/test_data.h"
#include "toile/model/guiding_map.h"
#include "toile/shape/builtin.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using Segment = std::array<Vector2d, 2>;

/// The borders of each chart, on the map.
std::vector<std::vector<Segment>> bordersOf(const Mesh& mesh, const GuidingMap& map) {
  using Key = std::array<std::size_t, 3>;  // chart, vertices
  std::map<Key, std::pair<int, Segment>> edges;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = t[k].index();
      const std::size_t b = t[(k + 1) % 3].index();
      auto& [count, segment] = edges[{map.chartOf[FaceId(f)], std::min(a, b), std::max(a, b)}];
      ++count;
      segment = {map.corners[FaceId(f)][k], map.corners[FaceId(f)][(k + 1) % 3]};
    }
  }
  std::vector<std::vector<Segment>> borders(map.charts.size());
  for (const auto& [key, edge] : edges)
    if (edge.first == 1) borders[key[0]].push_back(edge.second);
  return borders;
}

bool crossProperly(const Segment& s, const Segment& t) {
  const auto side = [](const Segment& line, const Vector2d& p) {
    return cross(line[1] - line[0], p - line[0]);
  };
  return side(s, t[0]) * side(s, t[1]) < 0 && side(t, s[0]) * side(t, s[1]) < 0;
}

/// No face turned over and hardly a border across another: fingers and toes, which no piece is cut
/// of, may lie on their neighbours, and so may the thighs of a seated body in its lap.
void expectNoChartOnItself(const ReferenceModel& model, const std::string& name) {
  const std::shared_ptr<const GuidingMap> map = guidingMap(model);
  std::size_t turned = 0;
  double drawn = 0;
  double whole = 0;
  for (std::size_t f = 0; f < model.mesh->faceCount(); ++f) {
    const std::array<Vector2d, 3>& c = map->corners[FaceId(f)];
    const double area = model.mesh->area(FaceId(f));
    whole += area;
    drawn += 0.5 * cross(c[1] - c[0], c[2] - c[0]);
    if (!(cross(c[1] - c[0], c[2] - c[0]) > 0)) ++turned;
  }
  EXPECT_EQ(turned, 0U) << name;
  EXPECT_NEAR(drawn / whole, 1, 0.005) << name;
  const std::vector<std::vector<Segment>> borders = bordersOf(*model.mesh, *map);
  for (std::size_t chart = 0; chart < borders.size(); ++chart) {
    std::vector<Segment> segments = borders[chart];
    const auto left = [](const Segment& s) { return std::min(s[0].x(), s[1].x()); };
    const auto right = [](const Segment& s) { return std::max(s[0].x(), s[1].x()); };
    std::sort(segments.begin(), segments.end(),
              [&](const Segment& a, const Segment& b) { return left(a) < left(b); });
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (std::size_t j = i + 1; j < segments.size() && left(segments[j]) < right(segments[i]);
           ++j)
        if (crossProperly(segments[i], segments[j])) ++crossings;
    constexpr std::size_t kFew = 12;
    EXPECT_LE(crossings, kFew) << name << ", chart " << map->charts[chart].name;
  }
}

TEST(GuidingMapOverlap, NoChartOfABodyLiesOnItself) {
  for (const char* name :
       {"builtin:body@1?size=EU38F", "builtin:body@1?size=EU128C",
        "builtin:body@1?size=EU38F&posture=seated", "builtin:body@1?size=EU50M&posture=seated",
        "builtin:body@1?size=EU44F&posture=knee-bent",
        "builtin:body@1?size=EU50M&posture=arms-raised"}) {
    const Result<ReferenceModel> model = makeBuiltinModel(name);
    ASSERT_TRUE(model) << model.error();
    expectNoChartOnItself(*model, name);
  }
}

TEST(GuidingMapOverlap, NoFingerOfAFineBodyLiesOnItself) {
  TOILE_TEST_DATA_OR_SKIP(folder, "bodies");
  for (const char* name :
       {"child_10y", "elderly", "female_average", "female_average_arms_raised", "female_tall_slim",
        "female_tall_slim_cycling", "male_average", "male_average_knee_bent", "male_heavy"}) {
    const Result<ReferenceModel> model =
        readModel(folder / (std::string(name) + ".ply"), FileUnit::Millimetre);
    ASSERT_TRUE(model) << model.error();
    expectNoChartOnItself(*model, name);
  }
}

TEST(GuidingMapOverlap, NoChartOfAThingLiesOnItself) {
  for (const char* name : {"lasts/last_female_average_flat_l.ply", "toys/armchair.ply",
                           "toys/squirrel.ply", "toys/spot.ply"}) {
    TOILE_TEST_DATA_OR_SKIP(path, name);
    const Result<ReferenceModel> model = readModel(path, FileUnit::Millimetre);
    ASSERT_TRUE(model) << model.error();
    expectNoChartOnItself(*model, name);
  }
}

}  // namespace
}  // namespace toile
