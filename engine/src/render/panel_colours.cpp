// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/panel_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace toile {
namespace {

constexpr std::array<Colour, 6> kCloth = {colourOf(0x2C3E50), colourOf(0x3E7F88),
                                          colourOf(0x93AAB4), colourOf(0xC9714F),
                                          colourOf(0xD8C6A2), colourOf(0x6D5F7A)};
constexpr std::array<Colour, 6> kTints = {colourOf(0xBCC6CC), colourOf(0xD8C8B0),
                                          colourOf(0xC6D2BE), colourOf(0xD9C3C9),
                                          colourOf(0xC9C4DC), colourOf(0xD3D0C8)};

/// Cloth on the sheet: so pale that lines and labels read, yet of its hue.
Colour pale(Colour cloth) {
  constexpr double kPaleness = 0.60;
  constexpr double kChroma = 1.7;
  const Colour mixed = mix(cloth, {255, 255, 255}, kPaleness);
  const double grey = 255 * lightness(mixed);
  const auto channel = [grey](std::uint8_t c) {
    return static_cast<std::uint8_t>(
        std::lround(std::clamp(grey + kChroma * (c - grey), 0.0, 255.0)));
  };
  return {channel(mixed.r), channel(mixed.g), channel(mixed.b)};
}

double areaOf(const Piece& piece) {
  double sum = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) sum += piece.mesh->area(FaceId(f));
  return sum;
}

/// Index in the palette per piece: greedy colouring of the mirror classes, the largest first.
std::vector<std::size_t> shades(const Pattern& pattern, std::size_t paletteSize) {
  const CutResult& cut = pattern.cut;
  const std::vector<std::size_t> classOf = mirrorClasses(cut, *pattern.document.model);
  std::map<std::size_t, double> area;
  std::map<std::size_t, std::set<std::size_t>> neighbours;
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (cut.pieces[i].include) area[classOf[i]] += areaOf(cut.pieces[i]);
  }
  for (const SeamMates& mates : cut.mates) {
    neighbours[classOf[mates.pieceA]].insert(classOf[mates.pieceB]);
    neighbours[classOf[mates.pieceB]].insert(classOf[mates.pieceA]);
  }
  std::vector<std::size_t> order;
  for (const auto& [each, size] : area) order.push_back(each);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });

  std::map<std::size_t, std::size_t> shade;
  for (const std::size_t each : order) {
    std::vector<std::size_t> clashes(paletteSize, 0);
    for (const std::size_t other : neighbours[each]) {
      const auto found = shade.find(other);
      if (found != shade.end()) ++clashes[found->second];
    }
    shade[each] = static_cast<std::size_t>(std::ranges::min_element(clashes) - clashes.begin());
  }
  std::vector<std::size_t> result(cut.pieces.size(), 0);
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (cut.pieces[i].include) result[i] = shade[classOf[i]];
  }
  return result;
}

std::optional<Colour> fabricColour(const Design& design, const Piece& piece) {
  std::string id;
  for (const int record : piece.recordIndices) {
    if (id.empty()) id = design.pieces[static_cast<std::size_t>(record)].fabric;
  }
  for (const Fabric& fabric : design.fabrics) {
    if (id.empty() || fabric.id == id) return parseColour(fabric.colour);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::size_t> mirrorClasses(const CutResult& cut, const ReferenceModel& model) {
  const std::size_t count = cut.pieces.size();
  std::vector<std::size_t> classes(count);
  std::iota(classes.begin(), classes.end(), std::size_t{0});
  if (!model.symmetry || model.symmetry->partner.empty()) return classes;

  // The vertices inside of pieces say whose mirror image they are.
  constexpr std::size_t kNobody = ~std::size_t{0};
  std::vector<std::size_t> owner(model.mesh->vertexCount(), kNobody);
  std::vector<char> shared(owner.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (const SurfacePoint& point : cut.pieces[i].onModel.values()) {
      const VertexId* v = std::get_if<VertexId>(&point.at);
      if (v == nullptr) continue;
      std::size_t& who = owner[v->index()];
      if (who != kNobody && who != i) shared[v->index()] = 1;
      who = i;
    }
  }
  std::vector<std::map<std::size_t, std::size_t>> votes(count);
  for (std::size_t v = 0; v < owner.size(); ++v) {
    const std::size_t other = model.symmetry->partner[VertexId(v)].index();
    if (shared[v] != 0 || shared[other] != 0 || owner[v] == kNobody || owner[other] == kNobody) {
      continue;
    }
    ++votes[owner[v]][owner[other]];
  }
  const auto favourite = [&votes](std::size_t piece) {
    std::size_t all = 0;
    std::size_t best = kNobody;
    for (const auto& [other, n] : votes[piece]) {
      all += n;
      if (best == kNobody || n > votes[piece].at(best)) best = other;
    }
    return best != kNobody && 2 * votes[piece].at(best) > all ? best : piece;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t other = favourite(i);
    if (other < i && favourite(other) == i) classes[i] = other;
  }
  return classes;
}

PanelColours panelColours(const Pattern& pattern, RenderStyle style) {
  const bool product = style == RenderStyle::Product;
  const auto& palette = product ? kCloth : kTints;
  const std::vector<std::size_t> shade = shades(pattern, palette.size());
  PanelColours colours;
  for (std::size_t i = 0; i < pattern.cut.pieces.size(); ++i) {
    const Piece& piece = pattern.cut.pieces[i];
    Colour colour = palette[shade[i]];
    if (product) colour = fabricColour(*pattern.document.design, piece).value_or(colour);
    colours.onModel.push_back(piece.include ? colour : kMannequin);
    colours.flat.push_back(product ? pale(colour) : colour);
  }
  return colours;
}

}  // namespace toile
