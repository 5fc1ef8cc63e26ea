// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/colour.h"
#include "toile/layout/pattern.h"
#include "toile/render/render.h"

namespace toile {

/// The strain of a pattern as one kind of map shows it.
class StrainField {
 public:
  StrainField(const Pattern& pattern, StrainMap map);

  /// The end of the colour scale: twice the greatest limit that a fabric has, otherwise the least
  /// of 5, 10, 20, 40 % that holds 95 % of the area; 100 % for AreaError.
  [[nodiscard]] double scale() const { return scale_; }
  /// The limit that a piece's fabric has for what the map shows.
  [[nodiscard]] std::optional<double> limit(std::size_t piece) const;
  /// Of all fabrics; nothing where there are several.
  [[nodiscard]] std::optional<double> onlyLimit() const;
  [[nodiscard]] double value(std::size_t piece, FaceId face) const;
  /// For -1..1 of the scale; beyond it the end colours.
  [[nodiscard]] Colour colour(double relative) const;
  [[nodiscard]] Colour colour(std::size_t piece, FaceId face) const {
    return colour(value(piece, face) / scale_);
  }
  /// What stands at the ends of the colours, the lower and the upper one.
  [[nodiscard]] std::array<std::string, 2> ends() const;
  /// Where the colours begin: -1, or 0 for what has no sign.
  [[nodiscard]] double least() const;

 private:
  StrainMap map_;
  std::vector<std::optional<PieceStrain>> strains_;
  double scale_ = 1;
};

/// Where a piece's strain passes the limit of its fabric: segments in its plane, on which the means
/// of the faces round each vertex, linear within faces, are the limit.
[[nodiscard]] std::vector<std::array<Eigen::Vector2d, 2>> limitLine(const StrainField& field,
                                                                    const Pattern& pattern,
                                                                    std::size_t piece);

/// Path data of all faces of one colour, in a plane whose y points down.
struct StrainShade {
  Colour colour;
  std::string path;
};
/// The faces of a flat piece by colour. @param place where a point of the plane is drawn
[[nodiscard]] std::vector<StrainShade> strainShades(
    const StrainField& field, const Pattern& pattern, std::size_t piece,
    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& place);

/// An <svg> of one flat piece: strain in colours, wires as lines, y up turned into y down.
[[nodiscard]] std::string strainMapSvg(const StrainField& field, const Pattern& pattern,
                                       std::size_t piece);

/// An <svg> bar that explains the colours.
[[nodiscard]] std::string strainLegendSvg(const StrainField& field);

}  // namespace toile
