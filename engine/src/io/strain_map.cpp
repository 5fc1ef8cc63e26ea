// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/strain_map.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/drawing_style.h"

namespace toile {
namespace {

using Eigen::Vector2d;

constexpr std::array kScales = {0.05, 0.10, 0.20, 0.40};
constexpr std::array kStops = {colourOf(0x1B3B8C), colourOf(0x5B86CF), colourOf(0xB4C9E6),
                               colourOf(0xEFEBE4), colourOf(0xF3C48E), colourOf(0xDE7E2E),
                               colourOf(0x8F2E06)};
constexpr int kShades = 31;  // of the map; an odd number, so that "no strain" is one of them

/// Path data of all faces of one shade.
void addFace(std::string& path, const std::array<Vector2d, 3>& p) {
  path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f} {:.1f} {:.1f}z", p[0].x(), -p[0].y(), p[1].x(),
                      -p[1].y(), p[2].x(), -p[2].y());
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

double strainOf(const FaceDistortion& distortion) {
  const double ratio = distortion.areaRatio();
  return ratio > 0 ? 1 / ratio - 1 : 0;
}

double strainScale(const Pattern& pattern) {
  std::vector<std::pair<double, double>> strains;  // strain, area
  double total = 0;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    if (!pattern.flats[i]) continue;
    const Mesh& mesh = *pattern.cut.pieces[i].mesh;
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
      strains.emplace_back(std::abs(strainOf(pattern.flats[i]->distortion[FaceId(f)])),
                           mesh.area(FaceId(f)));
      total += strains.back().second;
    }
  }
  for (const double scale : kScales) {
    double held = 0;
    for (const auto& [strain, area] : strains) held += strain <= scale ? area : 0;
    if (held >= 0.95 * total) return scale;
  }
  return kScales.back();
}

Colour strainColour(double relative) {
  const double at = (std::clamp(relative, -1.0, 1.0) + 1) / 2 * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return mix(kStops[i], kStops[i + 1], at - static_cast<double>(i));
}

std::string strainMapSvg(const Piece& piece, const FlatPiece& flat, double scale) {
  Vector2d low = Vector2d::Constant(1e300);
  Vector2d high = Vector2d::Constant(-1e300);
  for (const Vector2d& p : flat.position.values()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector2d size = (high - low).cwiseMax(1e-3);
  const double unit = size.maxCoeff() / 240;  // about a px as shown
  const double margin = 4 * unit;

  std::array<std::string, kShades> shades;
  const Mesh& mesh = *piece.mesh;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const double relative = std::clamp(strainOf(flat.distortion[FaceId(f)]) / scale, -1.0, 1.0);
    const auto shade = static_cast<std::size_t>(std::lround((relative + 1) / 2 * (kShades - 1)));
    const Triangle& t = mesh.vertices(FaceId(f));
    addFace(shades[shade], {flat.position[t[0]], flat.position[t[1]], flat.position[t[2]]});
  }
  std::string svg = fmt::format(
      "<svg viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\" role=\"img\" "
      "xmlns=\"http://www.w3.org/2000/svg\">",
      low.x() - margin, -high.y() - margin, size.x() + 2 * margin, size.y() + 2 * margin);
  // A hair of stroke closes the gaps that anti-aliasing leaves between faces.
  svg += fmt::format("<g stroke-width=\"{:.2f}\" stroke-linejoin=\"round\">", 0.4 * unit);
  for (std::size_t i = 0; i < shades.size(); ++i) {
    if (shades[i].empty()) continue;
    const std::string colour =
        toHex(strainColour(2.0 * static_cast<double>(i) / (kShades - 1) - 1));
    svg += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>", colour, shades[i]);
  }
  svg += "</g>";
  for (const Wire& wire : piece.wires) svg += wirePath(wire, flat, unit);
  return svg + "</svg>";
}

std::string strainLegendSvg(double scale) {
  std::string svg =
      "<svg class=\"legend\" viewBox=\"0 0 320 34\" role=\"img\" "
      "xmlns=\"http://www.w3.org/2000/svg\">";
  for (int i = 0; i < kShades; ++i) {
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"0\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"/>",
                       320.0 * i / kShades, 320.0 / kShades + 0.3,
                       toHex(strainColour(2.0 * i / (kShades - 1) - 1)));
  }
  const int percent = static_cast<int>(std::lround(100 * scale));
  svg += fmt::format(
      "<g font-size=\"11\" fill=\"#55585e\"><text x=\"0\" y=\"28\">\u2212{0}\u202f% too much cloth"
      "</text><text x=\"160\" y=\"28\" text-anchor=\"middle\">0</text>"
      "<text x=\"320\" y=\"28\" text-anchor=\"end\">must stretch +{0}\u202f%</text></g></svg>",
      percent);
  return svg;
}

}  // namespace toile
