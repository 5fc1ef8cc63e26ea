// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/picture.h"
#include "render/render_model.h"
#include "render/render_sheet.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr int kLeastSize = 16, kMostSize = 16000;
constexpr int kMostSamples = 8;
constexpr std::size_t kMostViews = 12;
constexpr double kMostExplode = 2;
constexpr double kMostHeight = 1e5;  // mm of a close-up
// Widths of lines and sizes of type are meant for a picture of so many px; smaller pictures have
// smaller ones, down to what can be read.
constexpr double kStylePixels = 1600.0 * 1000.0;
constexpr double kLeastScale = 0.75, kLeastScaleHeight = 400;
// All in px of the style.
constexpr double kTitleRoom = 56;    // above the views
constexpr double kCaptionRoom = 46;  // below each
constexpr double kSideRoom = 20;     // beside each
constexpr double kSheetRoom = 34;    // round the pieces
constexpr double kTopRoom = 8;       // above each view
// How much more a larger view is worth than larger pieces.
constexpr double kViewsMatter = 1.2;
// Beside pieces only views that are so much wider than high stand below each other.
constexpr double kWide = 1.2;

struct NamedView {
  std::string_view name;
  double azimuth, elevation;  ///< degrees
};
constexpr std::array<NamedView, 7> kViews = {{{"front", 0, 4},
                                              {"back", 180, 4},
                                              {"left", 90, 4},
                                              {"right", -90, 4},
                                              {"three-quarter", 35, 8},
                                              {"three-quarter-back", 145, 8},
                                              {"top", 0, 90}}};

Error nothingToShow() {
  return {ErrorCode::InvalidArgument, "there is nothing to show: no view, and no pieces", {}};
}

Error noView(std::string_view word) {
  std::string names;
  for (const NamedView& view : kViews) names += fmt::format("{}, ", view.name);
  return {ErrorCode::InvalidArgument,
          fmt::format("\"{}\" is no view; there are {}and azimuth,elevation in degrees, from -360 "
                      "to 360 and -90 to 90, such as 30,10",
                      word, names),
          {}};
}

/// How the picture is divided: the views in rows, the sheet beside them.
struct Arrangement {
  PixelBox ground;
  std::vector<PixelBox> views;
  PixelBox sheet;
  double mmPerPixel = 1;  ///< of the views
};

struct Wish {
  std::size_t views = 0;
  Vector2d model = Vector2d::Ones();  ///< mm, the widest and the highest of the views
  std::optional<Vector2d> sheet;      ///< mm
  double scale = 1;
  double titleRoom = 0, topRoom = 0, captionRoom = 0;  ///< px
};

/// The rows that show the views largest in a box of that width. @return px per mm, rows
std::pair<double, int> bestRows(const Wish& wish, double width, double height) {
  const int count = static_cast<int>(wish.views);
  const bool oneRow = wish.sheet && wish.model.x() < kWide * wish.model.y();
  std::pair<double, int> best = {0, 1};
  for (int rows = 1; rows <= (oneRow ? 1 : count); ++rows) {
    const int columns = (count + rows - 1) / rows;
    const double w = width / columns - 2 * kSideRoom * wish.scale;
    const double h = (height - wish.titleRoom) / rows - wish.captionRoom - wish.topRoom;
    const double pixels = std::min(w / wish.model.x(), h / wish.model.y());
    if (pixels > best.first * 1.001) best = {pixels, rows};
  }
  return best;
}

Arrangement divide(const RenderOptions& options, const Wish& wish) {
  // The widths are shared so that views and pieces are both large.
  double share = wish.sheet ? 0 : 1;
  if (wish.sheet && wish.views > 0) {
    double most = -1;
    for (int percent = 25; percent <= 75; ++percent) {
      const double part = percent / 100.0;
      const double views = bestRows(wish, part * options.width, options.height).first;
      const double room = 2 * kSheetRoom * wish.scale;
      const double pieces = std::min(((1 - part) * options.width - room) / wish.sheet->x(),
                                     (options.height - room) / wish.sheet->y());
      const double worth = std::pow(std::max(views, 0.0), kViewsMatter) * std::max(pieces, 0.0);
      if (worth > most) {
        most = worth;
        share = part;
      }
    }
  }
  const int groundWidth =
      wish.views == 0 ? 0 : static_cast<int>(std::lround(share * options.width));
  Arrangement result;
  result.ground = {0, 0, groundWidth, options.height};
  result.sheet = {groundWidth, 0, options.width - groundWidth, options.height};
  if (wish.views == 0) return result;

  const std::pair<double, int> best = bestRows(wish, groundWidth, options.height);
  const double pixels = best.first;
  const int rows = best.second;
  result.mmPerPixel = 1 / std::max(pixels, 1e-9);
  const int count = static_cast<int>(wish.views);
  const int columns = (count + rows - 1) / rows;
  for (int i = 0; i < count; ++i) {
    // Whole pixels without gaps; a last row that is not full stands in the middle.
    const int row = i / columns;
    const int inRow = std::min(columns, count - row * columns);
    const int column = i - row * columns;
    const int left = groundWidth * column / inRow;
    // The title takes its room from the first row alone.
    const auto edge = [&](int r) {
      const double under = wish.titleRoom + (options.height - wish.titleRoom) * r / rows;
      return r == 0 ? 0 : static_cast<int>(std::lround(under));
    };
    result.views.push_back(
        {left, edge(row), groundWidth * (column + 1) / inRow - left, edge(row + 1) - edge(row)});
  }
  return result;
}

/// The height that a picture needs to show as much at its width.
int neededHeight(const Arrangement& parts, const Wish& wish) {
  double needed = wish.sheet ? sheetHeight(parts.sheet.width, *wish.sheet, wish.scale) : 0;
  if (!parts.views.empty()) {
    // Rows are alike; those that are not full begin farther to the right.
    const auto rows = std::ranges::count(parts.views, 0, &PixelBox::x);
    const double row = wish.topRoom + wish.model.y() / parts.mmPerPixel + wish.captionRoom;
    needed = std::max(needed, wish.titleRoom + static_cast<double>(rows) * row);
  }
  return std::max(kLeastSize, static_cast<int>(std::ceil(needed)));
}

/// How large a px of the line styles is on the model, mm: as drawn for a large view, in large
/// pictures of large things not larger than real stitches, and never too fine to be seen.
double lineUnit(const RenderOptions& options, const Wish& wish, double mmPerPixel) {
  constexpr double kViewHeight = 640;   // px of the style: smaller views have finer lines
  constexpr double kRealStitch = 1.35;  // mm: rows 6 mm apart, stitches of 5 mm
  const double height = wish.model.y() / mmPerPixel / wish.scale;
  const double drawn = mmPerPixel * wish.scale * std::clamp(height / kViewHeight, 0.5, 1.25);
  if (options.style == RenderStyle::Plain) return drawn;
  return std::min(drawn, std::max(kRealStitch, 0.8 * mmPerPixel));
}

/// @param pattern null for a model alone
Result<std::string> render(const std::string& title, const Pattern* pattern,
                           const ReferenceModel& model, RenderOptions options, Progress* progress) {
  if (const Result<void> fine = checkOptions(options); !fine) return fine.error();
  Wish wish;
  wish.scale = std::max(std::sqrt(1.0 * options.width * options.height / kStylePixels),
                        kLeastScale * std::min(1.0, options.height / kLeastScaleHeight));
  wish.views = options.views.size();
  wish.titleRoom = options.captions ? kTitleRoom * wish.scale : 0;
  wish.topRoom = kTopRoom * wish.scale;
  wish.captionRoom = (options.captions ? kCaptionRoom : 2 * kSideRoom) * wish.scale;
  if (pattern != nullptr && !pattern->pieces.empty() && options.pieces != RenderPieces::None) {
    wish.sheet = (pattern->layout.max - pattern->layout.min).cwiseMax(1e-6);
  }
  if (options.views.empty() && !wish.sheet) return nothingToShow();

  std::optional<ModelRenderer> renderer;
  if (!options.views.empty()) {
    renderer.emplace(pattern != nullptr ? makeScene(*pattern, options) : makeScene(model, options),
                     options.style, options.closeUp,
                     options.style == RenderStyle::Product && options.explode.value() == 0);
    wish.model = Vector2d::Zero();
    for (const RenderView& view : options.views) {
      wish.model = wish.model.cwiseMax(renderer->size(view));
    }
  }
  Arrangement parts = divide(options, wish);
  if (options.trim && neededHeight(parts, wish) < options.height) {
    options.height = neededHeight(parts, wish);
    parts = divide(options, wish);
  }
  Picture picture(options.width, options.height);
  if (wish.sheet) paintSheet(picture, parts.sheet, *pattern, options, wish.scale);
  if (renderer) {
    renderer->setScale({parts.mmPerPixel, lineUnit(options, wish, parts.mmPerPixel)});
  }
  for (std::size_t i = 0; i < options.views.size(); ++i) {
    const PixelBox& box = parts.views[i];
    const bool first = box.y == 0;
    const auto shift = static_cast<int>(
        std::lround(((first ? wish.titleRoom : 0) + wish.topRoom - wish.captionRoom) / 2));
    renderer->draw(picture, {box, parts.ground, options.samples, shift}, options.views[i],
                   progress);
    if (isCancelled(progress)) {
      return Error{ErrorCode::Cancelled, "stopped before the picture was drawn", {}};
    }
    if (!options.captions) continue;
    const double half = renderer->size(options.views[i]).y() / parts.mmPerPixel / 2;
    drawCaption(picture, {.text = options.views[i].name,
                          .x = box.x + box.width / 2.0,
                          .y = std::min(box.y + box.height / 2.0 + shift + half + 36 * wish.scale,
                                        box.y + box.height - 8 * wish.scale),
                          .size = 12 * wish.scale,
                          .bold = false,
                          .centred = true});
  }
  if (options.captions) {
    drawCaption(picture, {.text = title,
                          .x = 24 * wish.scale,
                          .y = 38 * wish.scale,
                          .size = 18 * wish.scale,
                          .bold = true,
                          .centred = false});
  }
  return encodePng(picture);
}

}  // namespace

Result<std::vector<RenderView>> parseViews(std::string_view list) {
  std::vector<std::string_view> words;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    words.push_back(list.substr(from, comma - from));
    from = comma + 1;
  }
  std::vector<RenderView> views;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto named = std::ranges::find(kViews, words[i], &NamedView::name);
    if (named != kViews.end()) {
      views.push_back({std::string(named->name), Angle::degrees(named->azimuth),
                       Angle::degrees(named->elevation)});
      continue;
    }
    const std::optional<double> azimuth = parseDouble(words[i]);
    const std::optional<double> elevation =
        azimuth && i + 1 < words.size() ? parseDouble(words[i + 1]) : std::nullopt;
    if (!elevation || !(std::abs(*azimuth) <= 360) || !(std::abs(*elevation) <= 90)) {
      return noView(words[i]);
    }
    views.push_back({fmt::format("{:g}\u00b0, {:g}\u00b0", *azimuth, *elevation),
                     Angle::degrees(*azimuth), Angle::degrees(*elevation)});
    ++i;
  }
  return views;
}

Result<void> checkOptions(const RenderOptions& options) {
  if (std::min(options.width, options.height) < kLeastSize ||
      std::max(options.width, options.height) > kMostSize || options.samples < 1 ||
      options.samples > kMostSamples) {
    return Error{
        ErrorCode::InvalidArgument,
        fmt::format("a picture of {} x {} px with {} samples cannot be made; sides go from "
                    "{} to {} px, samples from 1 to {}",
                    options.width, options.height, options.samples, kLeastSize, kMostSize,
                    kMostSamples),
        {}};
  }
  if (options.views.size() > kMostViews) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("{} views do not fit into a picture; at most {} do",
                             options.views.size(), kMostViews),
                 {}};
  }
  for (const RenderView& view : options.views) {
    if (std::abs(view.elevation.degrees()) <= 90 && std::isfinite(view.azimuth.degrees())) continue;
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("view \"{}\": the elevation goes from -90 to 90 degrees", view.name),
                 {}};
  }
  if (!(options.explode.value() >= 0 && options.explode.value() <= kMostExplode)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("pieces explode by 0 to {:.0f} %, not by {:g} %", 100 * kMostExplode,
                             options.explode.percent()),
                 {}};
  }
  if (options.closeUp &&
      !(options.closeUp->middle.allFinite() && options.closeUp->height.mm() > 0 &&
        options.closeUp->height.mm() <= kMostHeight)) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("a close-up shows more than 0 and at most {:.0f} mm, not {:g} mm",
                             kMostHeight, options.closeUp->height.mm()),
                 {}};
  }
  if (options.views.empty() && options.pieces == RenderPieces::None) return nothingToShow();
  return {};
}

Result<std::string> renderPattern(const Pattern& pattern, const RenderOptions& options,
                                  Progress* progress) {
  return render(pattern.document.design->name, &pattern, *pattern.document.model, options,
                progress);
}

Result<std::string> renderModel(const ReferenceModel& model, const RenderOptions& options,
                                Progress* progress) {
  return render(model.name, nullptr, model, options, progress);
}

}  // namespace toile
