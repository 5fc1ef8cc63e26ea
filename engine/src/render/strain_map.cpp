// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/strain_map.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/drawing_style.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr std::array kScales = {0.05, 0.10, 0.20, 0.40};
constexpr std::array kStops = {colourOf(0x1B3B8C), colourOf(0x5B86CF), colourOf(0xB4C9E6),
                               colourOf(0xEFEBE4), colourOf(0xF3C48E), colourOf(0xDE7E2E),
                               colourOf(0x8F2E06)};
constexpr std::size_t kShades = 31;  // an odd number, so that "no strain" is one of them

/// The article's colours of area, from none to twice or no area.
constexpr std::array kErrorStops = {colourOf(0x0000FF), colourOf(0x00FFFF), colourOf(0x00FF00),
                                    colourOf(0xFFFF00), colourOf(0xFF0000)};

/// @param at 0..1
template <std::size_t N>
Colour between(const std::array<Colour, N>& stops, double at) {
  const double place = at * (N - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), N - 2);
  return mix(stops[i], stops[i + 1], place - static_cast<double>(i));
}

double valueOf(const Strain& strain, StrainMap map) {
  switch (map) {
    case StrainMap::Area:
      return strain.area;
    case StrainMap::Along:
      return strain.along;
    case StrainMap::Across:
      return strain.across;
    case StrainMap::Shear:
      return strain.shear;
    case StrainMap::AreaError:
      return std::abs(1 / (1 + strain.area) - 1);
  }
  return 0;
}

std::optional<double> limitOf(const StrainLimits& limits, StrainMap map) {
  switch (map) {
    case StrainMap::Area:
    case StrainMap::AreaError:
      break;
    case StrainMap::Along:
      return limits.along;
    case StrainMap::Across:
      return limits.across;
    case StrainMap::Shear:
      return limits.shear;
  }
  return std::nullopt;
}

std::string wirePath(const Wire& wire, const FlatPiece& flat, double unit) {
  const LineStyle style = lineStyle(wire.kind);
  std::string d;
  for (std::size_t i = 0; i < wire.vertices.size(); ++i) {
    const Vector2d& p = flat.position[wire.vertices[i]];
    d += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : " ", p.x(), -p.y());
    if (i == 0) d += 'L';
  }
  std::string dash;
  if (style.dash == Dash::Dashes) {
    dash = fmt::format(" stroke-dasharray=\"{:.2f} {:.2f}\"", kDashOn * unit * 0.7,
                       kDashOff * unit * 0.7);
  } else if (style.dash == Dash::Dots) {
    dash = fmt::format(" stroke-dasharray=\"0.01 {:.2f}\" stroke-linecap=\"round\"",
                       kDotSpacing * unit * 0.8);
  } else if (style.dash == Dash::LongShort) {
    dash = fmt::format(" stroke-dasharray=\"{0:.2f} {1:.2f} {1:.2f} {1:.2f}\"", kLongOn * unit,
                       kLongOff * unit);
  }
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
      "stroke-linejoin=\"round\"{}/>",
      d, toHex(style.colour), 0.65 * style.width * unit, dash);
}

}  // namespace

StrainField::StrainField(const Pattern& pattern, StrainMap map)
    : map_(map), strains_(measureStrains(pattern)) {
  if (map == StrainMap::AreaError) return;
  std::optional<double> greatest;
  for (std::size_t i = 0; i < strains_.size(); ++i) {
    const std::optional<double> own = strains_[i] ? limit(i) : std::nullopt;
    if (own) greatest = std::max(greatest.value_or(0), *own);
  }
  if (greatest && *greatest > 0) {
    scale_ = 2 * *greatest;
    return;
  }
  std::vector<std::pair<double, double>> sizes;  // strain, area
  double total = 0;
  for (std::size_t i = 0; i < strains_.size(); ++i) {
    if (!strains_[i]) continue;
    for (std::size_t f = 0; f < strains_[i]->faces.size(); ++f) {
      sizes.emplace_back(std::abs(value(i, FaceId(f))),
                         pattern.cut.pieces[i].mesh->area(FaceId(f)));
      total += sizes.back().second;
    }
  }
  scale_ = kScales.back();
  for (auto scale = kScales.rbegin(); scale != kScales.rend(); ++scale) {
    double held = 0;
    for (const auto& [size, area] : sizes) held += size <= *scale ? area : 0;
    if (held < 0.95 * total) break;
    scale_ = *scale;
  }
}

std::optional<double> StrainField::limit(std::size_t piece) const {
  return strains_[piece] ? limitOf(strains_[piece]->limits, map_) : std::nullopt;
}

std::optional<double> StrainField::onlyLimit() const {
  std::optional<double> only;
  for (std::size_t i = 0; i < strains_.size(); ++i) {
    if (!strains_[i]) continue;
    const std::optional<double> own = limit(i);
    if (!own || (only && *only != *own)) return std::nullopt;
    only = own;
  }
  return only;
}

double StrainField::value(std::size_t piece, FaceId face) const {
  return strains_[piece] ? valueOf(strains_[piece]->faces[face], map_) : 0;
}

Colour StrainField::colour(double relative) const {
  if (map_ == StrainMap::AreaError) return between(kErrorStops, std::clamp(relative, 0.0, 1.0));
  return between(kStops, (std::clamp(relative, -1.0, 1.0) + 1) / 2);
}

double StrainField::least() const {
  return map_ == StrainMap::Shear || map_ == StrainMap::AreaError ? 0 : -1;
}

std::array<std::string, 2> StrainField::ends() const {
  const int percent = static_cast<int>(std::lround(100 * scale_));
  const std::string less = fmt::format("\u2212{}\u202f% too much cloth", percent);
  switch (map_) {
    case StrainMap::Area:
      return {less, fmt::format("must stretch +{}\u202f%", percent)};
    case StrainMap::Along:
      return {less, fmt::format("must stretch along the grain +{}\u202f%", percent)};
    case StrainMap::Across:
      return {less, fmt::format("must stretch across the grain +{}\u202f%", percent)};
    case StrainMap::Shear:
      return {"0", fmt::format("shear {}\u202f%", percent)};
    case StrainMap::AreaError:
      return {"0", fmt::format("area differs by {}\u202f%", percent)};
  }
  return {};
}

std::vector<std::array<Vector2d, 2>> limitLine(const StrainField& field, const Pattern& pattern,
                                               std::size_t piece) {
  std::vector<std::array<Vector2d, 2>> line;
  const std::optional<double> limit = field.limit(piece);
  if (!limit) return line;
  const Mesh& mesh = *pattern.cut.pieces[piece].mesh;
  VertexData<double> sum(mesh.vertexCount(), 0.0), weight(mesh.vertexCount(), 0.0);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const double area = mesh.area(FaceId(f));
    for (const VertexId v : mesh.vertices(FaceId(f))) {
      sum[v] += area * field.value(piece, FaceId(f));
      weight[v] += area;
    }
  }
  const auto over = [&](VertexId v) { return weight[v] > 0 ? sum[v] / weight[v] - *limit : 0.0; };
  const VertexData<Vector2d>& at = pattern.flats[piece]->position;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    std::vector<Vector2d> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = t[k], w = t[(k + 1) % 3];
      const double a = over(v), b = over(w);
      if ((a > 0) == (b > 0)) continue;
      ends.emplace_back(at[v] + a / (a - b) * (at[w] - at[v]));
    }
    if (ends.size() == 2) line.push_back({ends[0], ends[1]});
  }
  return line;
}

std::vector<StrainShade> strainShades(const StrainField& field, const Pattern& pattern,
                                      std::size_t piece,
                                      const std::function<Vector2d(const Vector2d&)>& place) {
  std::array<std::string, kShades> paths;
  const Mesh& mesh = *pattern.cut.pieces[piece].mesh;
  const FlatPiece& flat = *pattern.flats[piece];
  const double least = field.least();
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const double relative = std::clamp(field.value(piece, FaceId(f)) / field.scale(), least, 1.0);
    const auto shade =
        static_cast<std::size_t>(std::lround((relative - least) / (1 - least) * (kShades - 1)));
    std::string& path = paths[shade];
    const Triangle& t = mesh.vertices(FaceId(f));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d p = place(flat.position[t[k]]);
      path += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : k == 1 ? "L" : " ", p.x(), p.y());
    }
    path += 'z';
  }
  std::vector<StrainShade> shades;
  for (std::size_t i = 0; i < kShades; ++i) {
    if (paths[i].empty()) continue;
    const double relative = least + (1 - least) * static_cast<double>(i) / (kShades - 1);
    shades.push_back({field.colour(relative), std::move(paths[i])});
  }
  return shades;
}

std::string strainMapSvg(const StrainField& field, const Pattern& pattern, std::size_t index) {
  const Piece& piece = pattern.cut.pieces[index];
  const FlatPiece& flat = *pattern.flats[index];
  Vector2d low = Vector2d::Constant(1e300);
  Vector2d high = Vector2d::Constant(-1e300);
  for (const Vector2d& p : flat.position.values()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector2d size = (high - low).cwiseMax(1e-3);
  const double unit = size.maxCoeff() / 240;  // about a px as shown
  const double margin = 4 * unit;

  std::string svg = fmt::format(
      "<svg viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\" role=\"img\" "
      "xmlns=\"http://www.w3.org/2000/svg\">",
      low.x() - margin, -high.y() - margin, size.x() + 2 * margin, size.y() + 2 * margin);
  // A hair of stroke closes the gaps that anti-aliasing leaves between faces.
  svg += fmt::format("<g stroke-width=\"{:.2f}\" stroke-linejoin=\"round\">", 0.4 * unit);
  for (const StrainShade& shade : strainShades(
           field, pattern, index, [](const Vector2d& p) { return Vector2d(p.x(), -p.y()); })) {
    svg += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>", toHex(shade.colour),
                       shade.path);
  }
  svg += "</g>";
  std::string limit;
  for (const auto& [a, b] : limitLine(field, pattern, index)) {
    limit += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", a.x(), -a.y(), b.x(), -b.y());
  }
  if (!limit.empty()) {
    svg += fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"#16202e\" stroke-width=\"{:.2f}\" "
        "stroke-linecap=\"round\"/>",
        limit, unit);
  }
  for (const Wire& wire : piece.wires) svg += wirePath(wire, flat, unit);
  return svg + "</svg>";
}

std::string strainLegendSvg(const StrainField& field) {
  constexpr double kWidth = 320;
  std::string svg =
      "<svg class=\"legend\" width=\"320\" height=\"34\" viewBox=\"0 0 320 34\" role=\"img\" "
      "xmlns=\"http://www.w3.org/2000/svg\">";
  const double least = field.least();
  for (std::size_t i = 0; i < kShades; ++i) {
    const double at = static_cast<double>(i);
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"0\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"/>",
                       kWidth * at / kShades, kWidth / kShades + 0.3,
                       toHex(field.colour(least + (1 - least) * at / (kShades - 1))));
  }
  const std::array<std::string, 2> ends = field.ends();
  svg += "<g font-size=\"11\" fill=\"#55585e\">";
  svg += fmt::format("<text x=\"0\" y=\"28\">{}</text>", ends[0]);
  if (least < 0) svg += "<text x=\"160\" y=\"28\" text-anchor=\"middle\">0</text>";
  svg += fmt::format("<text x=\"320\" y=\"28\" text-anchor=\"end\">{}</text></g></svg>", ends[1]);
  return svg;
}

}  // namespace toile
