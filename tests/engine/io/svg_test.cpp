// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/svg.h"

#include <gtest/gtest.h>

#include <sstream>

#include "finish/polygon.h"
#include "support/hand_made_pattern.h"

namespace toile {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// The points of the first path after `key`.
Points2 pathAfter(const std::string& svg, const std::string& key) {
  const std::size_t from = svg.find(" d=\"", svg.find(key)) + 4;
  std::string path = svg.substr(from, svg.find('"', from) - from);
  for (char& c : path)
    if (c == 'M' || c == 'L' || c == 'Z') c = ' ';
  std::istringstream in(path);
  Points2 points;
  for (double x = 0, y = 0; in >> x >> y;) points.emplace_back(x, y);
  return points;
}

TEST(Svg, DrawsThePiecesRightSideUpInMillimetres) {
  const Pattern pattern = test::makeTwoPiecePattern();
  const std::string svg = writeSvg(drawSheet(pattern));
  constexpr double kMargin = 10;
  for (std::size_t i = 0; i < 2; ++i) {
    const Points2 path = pathAfter(svg, "id=\"piece-" + pattern.pieces[i].id + "\"");
    const Outline& cut = pattern.pieces[i].cutLines[0];
    ASSERT_EQ(path.size(), cut.size());
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Eigen::Vector2d p = pattern.layout.placements[i].apply(cut[k].position);
      // y of a picture is down.
      EXPECT_NEAR(path[k].x(), p.x() - pattern.layout.min.x() + kMargin, 6e-4);
      EXPECT_NEAR(path[k].y(), pattern.layout.max.y() - p.y() + kMargin, 6e-4);
    }
    EXPECT_LT(signedArea(path), 0);
  }
  const Eigen::Vector2d size = pattern.layout.max - pattern.layout.min;
  std::ostringstream head;
  head << "width=\"" << size.x() + 20 << "mm\" height=\"" << size.y() + 20 << "mm\" viewBox=\"0 0 "
       << size.x() + 20 << ' ' << size.y() + 20 << '"';
  EXPECT_NE(svg.find(head.str()), std::string::npos) << svg.substr(0, 400);
  EXPECT_EQ(svg.find("scale("), std::string::npos);
}

TEST(Svg, HasALayerForEachRoleAndTheIdsOfSeams) {
  const std::string svg = writeSvg(drawSheet(test::makeTwoPiecePattern()));
  for (const char* layer : {"ell cut line", "ell sew line", "ell inner lines", "ell notches",
                            "ell grain line", "ell text", "panel cut line"})
    EXPECT_EQ(count(svg, std::string("inkscape:label=\"") + layer + '"'), 1u) << layer;
  EXPECT_EQ(count(svg, "data-curve=\"side\" data-seam=\"1\" data-mate=\"panel\""), 1u);
  EXPECT_EQ(count(svg, "data-curve=\"side\" data-seam=\"1\" data-mate=\"ell\""), 1u);
  EXPECT_EQ(count(svg, "data-notch=\"1\""), 2u);
  EXPECT_EQ(count(svg, ">1A-2A  side to panel</text>"), 1u);
}

TEST(Svg, KeepsNamesInUtf8AndEscapesThem) {
  Pattern pattern = test::makeTwoPiecePattern();
  pattern.pieces[0].name = "Ärmel <links> & \"oben\"";
  const std::string svg = writeSvg(drawSheet(pattern));
  EXPECT_NE(svg.find("inkscape:label=\"Ärmel &lt;links&gt; &amp; &quot;oben&quot;\""),
            std::string::npos);
}

TEST(Svg, IsTheSameEveryTime) {
  EXPECT_EQ(writeSvg(drawSheet(test::makeTwoPiecePattern())),
            writeSvg(drawSheet(test::makeTwoPiecePattern())));
}

}  // namespace
}  // namespace toile
