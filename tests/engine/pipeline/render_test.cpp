// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "support/sample_designs.h"
#include "toile/core/parallel.h"

namespace toile::test {
namespace {

struct Decoded {
  unsigned width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;

  explicit Decoded(const std::string& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
      ADD_FAILURE() << image.message;
      return;
    }
    image.format = PNG_FORMAT_RGB;
    width = image.width;
    height = image.height;
    pixels.resize(static_cast<std::size_t>(width) * height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  }
  /// How many pixels are within `tolerance` of the colour in every channel.
  [[nodiscard]] int count(std::array<int, 3> colour, int tolerance) const {
    int found = 0;
    for (const auto& pixel : pixels) {
      bool near = true;
      for (std::size_t k = 0; k < 3; ++k)
        near = near && std::abs(pixel[k] - colour[k]) <= tolerance;
      found += near ? 1 : 0;
    }
    return found;
  }
};

class Preview : public SleevePattern {};

TEST_F(Preview, ShowsGroundSheetLinesAndTints) {
  const Result<std::string> png = renderPreview(*pattern_, {.width = 1000, .height = 600});
  ASSERT_TRUE(png) << png.error();
  const Decoded picture(*png);
  EXPECT_EQ(picture.width, 1000U);
  EXPECT_EQ(picture.height, 600U);
  EXPECT_GT(picture.count({0xEF, 0xED, 0xE9}, 0), 1000 * 600 / 10) << "sheet";
  EXPECT_GT(picture.count({0xBC, 0xC6, 0xCC}, 0), 2000) << "first tint, flat";
  EXPECT_GT(picture.count({0xD8, 0xC8, 0xB0}, 0), 2000) << "second tint, flat";
  EXPECT_GT(picture.count({0x16, 0x20, 0x2E}, 8), 300) << "seams";
  EXPECT_GT(picture.count({0x0A, 0x66, 0x50}, 8), 25) << "the elbow line";
}

TEST_F(Preview, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::string> pictures;
  for (const std::size_t threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    const Result<std::string> png = renderPreview(*pattern_, {.width = 500, .height = 300});
    ASSERT_TRUE(png) << png.error();
    pictures.push_back(*png);
  }
  EXPECT_TRUE(pictures[0] == pictures[1]);
  EXPECT_TRUE(pictures[0] == pictures[2]);
}

TEST_F(Preview, RefusesSizesOutOfRange) {
  for (const RenderOptions& options :
       {RenderOptions{.width = 15}, RenderOptions{.height = 16001}, RenderOptions{.samples = 0}}) {
    const Result<std::string> png = renderPreview(*pattern_, options);
    ASSERT_FALSE(png);
    EXPECT_EQ(png.error().code, ErrorCode::InvalidArgument);
  }
}

}  // namespace
}  // namespace toile::test
