// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "finish/seam_net.h"

namespace toile {

/// A notch on the sew line, before it is moved out to the cut line.
struct SewNotch {
  std::uint32_t piece = 0;  ///< index in the list of pieces in work
  Eigen::Vector2d position{0, 0};
  Eigen::Vector2d outward{0, 1};  ///< unit normal of the sew line
  double allowance = 0;           ///< of the run it stands on, mm
  std::string seam;
  int number = 0;
};

/// Chooses the notches of all pieces together.
///
/// At a smooth meeting of runs (a feature line, a zip's end, a neighbour's seam) and at the mouth
/// of darts; then along each seam about every `spacing`, measured along the sew line from its upper
/// end on the body, nearer to that end than to the other, so that a piece cannot be turned round;
/// two side by side on seams of the back. Left and right of a symmetric pattern get the same.
[[nodiscard]] std::vector<SewNotch> chooseNotches(const SeamNet& net, double spacing);

/// Places the notches of one piece on its cut line, along the sew line's normal, and makes each a
/// vertex there. A notch whose normal misses the cut line is left out with a finding.
[[nodiscard]] std::vector<Notch> placeNotches(const std::vector<SewNotch>& chosen,
                                              std::uint32_t piece, const Piece& record,
                                              const FinishSettings& finish,
                                              std::vector<Outline>& cutLines,
                                              std::vector<Finding>& findings);

}  // namespace toile
