// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "render/panel_colours.h"
#include "support/meshes.h"
#include "support/sample_designs.h"
#include "toile/core/parallel.h"
#include "toile/shape/builtin.h"

namespace toile::test {
namespace {

constexpr std::array<int, 3> kPaper = {0xF6, 0xF5, 0xF2};  // behind pieces and plain models

struct Decoded {
  unsigned width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;

  explicit Decoded(const Result<std::string>& bytes) {
    if (!bytes) {
      ADD_FAILURE() << bytes.error();
      return;
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes->data(), bytes->size()) == 0) {
      ADD_FAILURE() << image.message;
      return;
    }
    image.format = PNG_FORMAT_RGB;
    width = image.width;
    height = image.height;
    pixels.resize(static_cast<std::size_t>(width) * height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  }
  [[nodiscard]] bool isNear(unsigned x, unsigned y, std::array<int, 3> colour,
                            int tolerance) const {
    const auto& pixel = pixels[static_cast<std::size_t>(y) * width + x];
    bool near = true;
    for (std::size_t k = 0; k < 3; ++k) near = near && std::abs(pixel[k] - colour[k]) <= tolerance;
    return near;
  }
  /// How many pixels are within `tolerance` of the colour in every channel.
  [[nodiscard]] int count(std::array<int, 3> colour, int tolerance) const {
    int found = 0;
    for (unsigned y = 0; y < height; ++y) {
      for (unsigned x = 0; x < width; ++x) found += isNear(x, y, colour, tolerance) ? 1 : 0;
    }
    return found;
  }
  [[nodiscard]] bool isPaper(unsigned x, unsigned y) const { return isNear(x, y, kPaper, 0); }
};

/// A plain model alone: everything that is no paper is the model.
RenderOptions outlineOnly(std::vector<RenderView> views) {
  RenderOptions options;
  options.width = 300;
  options.height = 300;
  options.views = std::move(views);
  options.style = RenderStyle::Plain;
  options.lines = RenderLines::None;
  options.pieces = RenderPieces::None;
  options.captions = false;
  return options;
}

std::vector<RenderView> views(std::string_view list) {
  const Result<std::vector<RenderView>> parsed = parseViews(list);
  if (!parsed) ADD_FAILURE() << parsed.error();
  return parsed ? *parsed : std::vector<RenderView>{};
}

ReferenceModel torso() {
  Result<ReferenceModel> model = makeBuiltinModel("builtin:torso@1");
  if (!model) ADD_FAILURE() << model.error();
  return std::move(*model);
}

class Picture : public SleevePattern {};

TEST_F(Picture, PlainShowsPaperTintsAndLinesOfEachKind) {
  RenderOptions options;
  options.width = 1000;
  options.height = 600;
  options.style = RenderStyle::Plain;
  constexpr std::array<int, 3> kSeam = {0x16, 0x20, 0x2E};
  constexpr std::array<int, 3> kFeature = {0x0A, 0x66, 0x50};
  const Decoded picture(renderPattern(*pattern_, options));
  EXPECT_EQ(picture.width, 1000U);
  EXPECT_EQ(picture.height, 600U);
  EXPECT_GT(picture.count(kPaper, 0), 1000 * 600 / 10);
  // Both pieces of the sleeve: they are mirror images.
  EXPECT_GT(picture.count({0xBC, 0xC6, 0xCC}, 0), 4000) << "first tint, flat";
  EXPECT_GT(picture.count(kSeam, 8), 300);
  EXPECT_GT(picture.count(kFeature, 8), 25) << "the elbow line";

  // Without the pieces all lines left are those on the model.
  options.pieces = RenderPieces::None;
  options.captions = false;
  options.lines = RenderLines::Seams;
  const Decoded seams(renderPattern(*pattern_, options));
  EXPECT_GT(seams.count(kSeam, 8), 100);
  EXPECT_EQ(seams.count(kFeature, 8), 0);
  options.lines = RenderLines::None;
  EXPECT_EQ(Decoded(renderPattern(*pattern_, options)).count(kSeam, 8), 0);
}

TEST_F(Picture, ProductTakesTheColourOfTheFabric) {
  Pattern pattern = *pattern_;
  Design design = *pattern.document.design;
  design.fabrics.resize(1);
  const auto reds = [&](const std::string& colour) {
    design.fabrics[0].colour = colour;
    pattern.document = withDesign(pattern.document, design);
    RenderOptions options;
    options.width = 400;
    options.height = 300;
    options.pieces = RenderPieces::None;
    const Decoded picture(renderPattern(pattern, options));
    int found = 0;
    for (const auto& [r, g, b] : picture.pixels) found += r > 2 * g && r > 2 * b ? 1 : 0;
    return found;
  };
  EXPECT_GT(reds("#c01818"), 400 * 300 / 10);
  EXPECT_EQ(reds("#1840c0"), 0);
}

// A ball of radius 100 fills a close-up of 100 mm, and of one of 400 mm a quarter of the height;
// off its middle it stands aside by so much.
TEST(CloseUp, ShowsSoManyMillimetresAroundItsMiddle) {
  const ReferenceModel ball = makeReferenceModel("ball", icosphere(100, 4));
  RenderOptions options = outlineOnly(views("front"));
  const auto filled = [&](const RenderCloseUp& closeUp) {
    options.closeUp = closeUp;
    const Decoded picture(renderModel(ball, options));
    int least = 300, most = -1;
    for (int y = 0; y < 300; ++y) {
      if (picture.isPaper(150, static_cast<unsigned>(y))) continue;
      least = std::min(least, y);
      most = std::max(most, y);
    }
    return std::pair(least, most);
  };
  EXPECT_EQ(filled({{0, 0, 0}, Length::mm(100)}), std::pair(0, 299));
  const auto [top, bottom] = filled({{0, 0, 0}, Length::mm(400)});
  EXPECT_NEAR(bottom - top, 300 * 0.5 * 0.9, 15) << "rooms beside the view take a little";
  const auto [upper, lower] = filled({{0, 0, 100}, Length::mm(400)});
  EXPECT_NEAR(upper - top, 0.5 * (bottom - top), 3);
  EXPECT_NEAR(lower - bottom, 0.5 * (bottom - top), 3);
  options.closeUp = RenderCloseUp{{0, 0, 0}, Length::mm(0)};
  EXPECT_EQ(checkOptions(options).error().code, ErrorCode::InvalidArgument);
}

TEST_F(Picture, StrainColoursThePieces) {
  RenderOptions options;
  options.width = 500;
  options.height = 300;
  options.views.clear();
  options.pieces = RenderPieces::Strain;
  const Decoded cloth(renderPattern(*pattern_, {.width = 500, .height = 300, .views = {}}));
  const Decoded strain(renderPattern(*pattern_, options));
  // The end colours are those of the legend alone, the middle is that of most of the cloth.
  constexpr std::array<int, 3> kNone = {0xEF, 0xEB, 0xE4};
  EXPECT_GT(strain.count({0x8F, 0x2E, 0x06}, 4), 0);
  EXPECT_EQ(cloth.count({0x8F, 0x2E, 0x06}, 4), 0);
  EXPECT_GT(strain.count(kNone, 10), 2000);
}

TEST_F(Picture, IsTheSameForAnyNumberOfThreads) {
  RenderOptions exploded;
  exploded.explode = Ratio::percent(50);
  exploded.pieces = RenderPieces::Strain;
  exploded.views = views("three-quarter,20,-10,top");
  for (RenderOptions options : {RenderOptions{}, exploded}) {
    options.width = 500;
    options.height = 300;
    std::vector<std::string> pictures;
    for (const std::size_t threads : {1U, 2U, 5U}) {
      const ThreadLimit limit(threads);
      const Result<std::string> png = renderPattern(*pattern_, options);
      ASSERT_TRUE(png) << png.error();
      pictures.push_back(*png);
    }
    EXPECT_TRUE(pictures[0] == pictures[1]);
    EXPECT_TRUE(pictures[0] == pictures[2]);
  }
}

TEST_F(Picture, RefusesOptionsOutOfRange) {
  const RenderView upsideDown{"", Angle(), Angle::degrees(91)};
  for (const RenderOptions& options :
       {RenderOptions{.width = 15}, RenderOptions{.height = 16001}, RenderOptions{.samples = 0},
        RenderOptions{.views = std::vector<RenderView>(13, RenderView{})},
        RenderOptions{.views = {upsideDown}}, RenderOptions{.explode = Ratio::percent(-1)},
        RenderOptions{.explode = Ratio::percent(201)},
        RenderOptions{.views = {}, .pieces = RenderPieces::None}}) {
    const Result<std::string> png = renderPattern(*pattern_, options);
    ASSERT_FALSE(png);
    EXPECT_EQ(png.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(png.error().message, checkOptions(options).error().message);
  }
}

TEST_F(Picture, StopsWhenToldTo) {
  struct Stop : Progress {
    void step(std::string_view) override {}
    [[nodiscard]] bool isCancelled() const override { return true; }
  } stop;
  const Result<std::string> png = renderPattern(*pattern_, {.width = 64, .height = 64}, &stop);
  ASSERT_FALSE(png);
  EXPECT_EQ(png.error().code, ErrorCode::Cancelled);
}

TEST(ModelPicture, ASymmetricModelHasASymmetricOutline) {
  const ReferenceModel model = torso();
  const Decoded front(renderModel(model, outlineOnly(views("0,0"))));
  const Decoded left(renderModel(model, outlineOnly(views("left"))));
  const Decoded right(renderModel(model, outlineOnly(views("right"))));
  int inside = 0;
  int crooked = 0;
  int unlike = 0;
  for (unsigned y = 0; y < 300; ++y) {
    for (unsigned x = 0; x < 300; ++x) {
      inside += front.isPaper(x, y) ? 0 : 1;
      crooked += front.isPaper(x, y) != front.isPaper(299 - x, y) ? 1 : 0;
      unlike += left.isPaper(x, y) != right.isPaper(299 - x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 300 * 300 / 5);
  // Rays are floats: a pixel here and there at the outline.
  EXPECT_LE(crooked, 4);
  EXPECT_LE(unlike, 4);
  // The front is not the side.
  EXPECT_GT(std::abs(inside - static_cast<int>(left.pixels.size()) + left.count(kPaper, 0)), 2000);
}

TEST(ModelPicture, TheModelFillsTheBoxAndStaysInIt) {
  for (const char* view : {"front", "three-quarter", "top", "130,-60"}) {
    const Decoded picture(renderModel(torso(), outlineOnly(views(view))));
    unsigned low = 300;
    unsigned high = 0;
    unsigned left = 300;
    unsigned right = 0;
    for (unsigned y = 0; y < 300; ++y) {
      for (unsigned x = 0; x < 300; ++x) {
        if (picture.isPaper(x, y)) continue;
        low = std::min(low, y);
        high = std::max(high, y);
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
    EXPECT_GT(low, 0U) << view;
    EXPECT_LT(high, 299U) << view;
    EXPECT_GT(left, 0U) << view;
    EXPECT_LT(right, 299U) << view;
    EXPECT_GT(std::max(high - low, right - left), 270U) << view;
  }
}

TEST(ModelPicture, StandsOnItsShadow) {
  RenderOptions options = outlineOnly(views("front"));
  options.style = RenderStyle::Product;
  const Decoded picture(renderModel(torso(), options));
  const auto brightness = [&](unsigned x, unsigned y) {
    const auto& [r, g, b] = picture.pixels[static_cast<std::size_t>(y) * 300 + x];
    return r + g + b;
  };
  // Below the model, in its middle, the ground is darker than at the same height at the side.
  int darkest = 0;
  for (unsigned y = 270; y < 300; ++y) {
    darkest = std::max(darkest, brightness(2, y) - brightness(150, y));
  }
  EXPECT_GT(darkest, 60);
}

TEST(PanelColours, MirrorImagesShareAColourAndNeighboursDiffer) {
  const Result<Document> document = openDocument(exampleDesign("torso-vest.toile"));
  ASSERT_TRUE(document) << document.error();
  Design design = *document->design;
  for (Fabric& fabric : design.fabrics) fabric.colour.clear();
  const Result<Pattern> pattern = makePattern(withDesign(*document, design));
  ASSERT_TRUE(pattern) << pattern.error();
  const std::vector<Piece>& pieces = pattern->cut.pieces;
  const std::vector<std::size_t> classes = mirrorClasses(pattern->cut, *document->model);
  int pairs = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      const std::string& id = pieces[i].id;
      if (!id.ends_with("-l") || pieces[j].id != id.substr(0, id.size() - 1) + "r") continue;
      EXPECT_EQ(classes[i], classes[j]) << id;
      ++pairs;
    }
  }
  EXPECT_GE(pairs, 3);
  for (const RenderStyle style : {RenderStyle::Product, RenderStyle::Plain}) {
    const PanelColours colours = panelColours(*pattern, style);
    for (const SeamMates& mates : pattern->cut.mates) {
      if (classes[mates.pieceA] == classes[mates.pieceB]) {
        EXPECT_EQ(colours.onModel[mates.pieceA], colours.onModel[mates.pieceB]);
      } else {
        EXPECT_NE(colours.onModel[mates.pieceA], colours.onModel[mates.pieceB])
            << pieces[mates.pieceA].id << " and " << pieces[mates.pieceB].id;
      }
    }
  }
}

TEST(ParseViews, TakesNamesAndPairsInAnyOrder) {
  const std::vector<RenderView> list = views("back,30,-10,top,0,90");
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[0].name, "back");
  EXPECT_DOUBLE_EQ(list[0].azimuth.degrees(), 180);
  EXPECT_DOUBLE_EQ(list[1].azimuth.degrees(), 30);
  EXPECT_DOUBLE_EQ(list[1].elevation.degrees(), -10);
  EXPECT_EQ(list[2].name, "top");
  EXPECT_DOUBLE_EQ(list[3].elevation.degrees(), 90);
}

TEST(ParseViews, NamesTheWordThatIsNoView) {
  for (const auto& [text, word] : {std::pair("front,bakc", "\"bakc\""), std::pair("30", "\"30\""),
                                   std::pair("30,91", "\"30\""), std::pair("361,0", "\"361\""),
                                   std::pair("", "\"\""), std::pair("front,", "\"\"")}) {
    const Result<std::vector<RenderView>> parsed = parseViews(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(parsed.error().message, testing::HasSubstr(word));
    EXPECT_THAT(parsed.error().message, testing::HasSubstr("three-quarter"));
  }
}

}  // namespace
}  // namespace toile::test
