// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toile/warp/warp.h"

namespace toile::cli {

/// "waist_girth", "waist_girth:ease=25mm", "ball:y=-150mm", "ball:y=-150mm:ease=8mm",
/// "ball:through=toe_big_l/toe_little_l/30,-120,60".
struct GirthWord {
  std::string name;
  std::optional<Eigen::Vector3d> normal;  ///< of the plane, where it is no curve by name
  Length offset;
  std::array<std::string, 3> through;  ///< or the places of the body in the plane; empty: none
  std::optional<Length> ease;
};
Result<GirthWord> parseGirthWord(std::string_view text);
/// The curve of that name, or the closed line of the body in that plane: the longest, or the one
/// that comes nearest to the places in it.
Result<WarpGirth> findGirth(const ReferenceModel& body, const GirthWord& word);

/// "heel": a piece; "z<20mm,y>-60mm": what lies within.
struct RigidWord {
  std::string piece;
  struct Bound {
    Eigen::Vector3d direction;  ///< of what lies within: direction . p <= most
    Length most;
  };
  std::vector<Bound> bounds;
};
Result<RigidWord> parseRigidWord(std::string_view text);
std::vector<VertexId> verticesWithin(const Mesh& mesh, const RigidWord& word);

}  // namespace toile::cli
