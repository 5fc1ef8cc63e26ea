// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace toile::body {

/// Index of a vertex of the control net.
using NetVertex = std::size_t;

enum class Side { Left, Right };

// Rings of the torso, from the crotch up to the head; each has kColumns vertices, counted from the
// centre front over the body's left side (kSideColumn) and the centre back (kBackColumn).
inline constexpr std::size_t kColumns = 20;
inline constexpr std::size_t kSideColumn = 5;
inline constexpr std::size_t kBackColumn = 10;
inline constexpr std::size_t kBustColumn = 2;  ///< through the bust point
enum TorsoRow : std::size_t {
  kSplitRow,  ///< where the legs part
  kHipRow,
  kHighHipRow,
  kAbdomenRow,
  kWaistRow,
  kUnderbustRow,
  kBustRow,
  kArmpitRow,
  kLowChestRow,
  kHighChestRow,
  kShoulderRow,
  kMidShoulderRow,
  kNeckBaseRow,
  kLowNeckRow,
  kNeckRow,
  kThroatRow,
  kChinRow,
  kFaceRow,
  kForeheadRow,
  kUpperHeadRow,
  kTorsoRows
};
// The crown closes the last ring by a grid of kCrownAcross x kCrownAlong quads.
inline constexpr std::size_t kCrownAcross = 4;
inline constexpr std::size_t kCrownAlong = 6;

// Rings of an arm. Spoke 0 is on top (outside), the next ones go over the front to the underarm (5)
// and back up. Row 0 is the rim of the opening in the torso.
inline constexpr std::size_t kArmSpokes = 10;
inline constexpr std::size_t kArmOuter = 0;
inline constexpr std::size_t kArmInner = 5;
inline constexpr std::size_t kUpperArmRow = 4;
inline constexpr std::size_t kElbowRow = 6;
inline constexpr std::size_t kWristRow = 12;
inline constexpr std::size_t kFingerRow = 16;  ///< the last ring, closed by a strip of quads

// Rings of a leg. Spokes 0 to 10 hang below the torso's columns 0 to 10, spoke 11 below the crotch.
inline constexpr std::size_t kLegSpokes = 12;
inline constexpr std::size_t kLegFront = 2;
inline constexpr std::size_t kLegOuter = 5;
inline constexpr std::size_t kLegBack = 8;
inline constexpr std::size_t kLegInner = 11;
inline constexpr std::size_t kThighRow = 1;
inline constexpr std::size_t kMidThighRow = 3;
inline constexpr std::size_t kKneeRow = 5;
inline constexpr std::size_t kCalfRow = 7;
inline constexpr std::size_t kAnkleRow = 13;
inline constexpr std::size_t kBallRow = 19;
inline constexpr std::size_t kToeRow = 21;  ///< the last ring, closed by a grid of quads
inline constexpr std::size_t kToeTips = 3;

/// Closed net of quads of the whole body, the same for every body for ever.
///
/// Vertices are counted: torso rings from below, crown, crotch, then the left arm and leg, then the
/// right ones in the same order.
class ControlNet {
 public:
  ControlNet();

  [[nodiscard]] std::size_t vertexCount() const { return vertexCount_; }
  /// Counter-clockwise seen from outside; those of the left half first, then their mirror images in
  /// the same order.
  [[nodiscard]] const std::vector<std::array<NetVertex, 4>>& quads() const { return quads_; }
  /// The mirror image of each vertex; itself on the mid-plane.
  [[nodiscard]] const std::vector<NetVertex>& partner() const { return partner_; }

  /// Precondition: the vertex exists (not inside the armholes).
  [[nodiscard]] NetVertex torso(std::size_t row, std::size_t column) const;
  /// Grid vertex of the crown; 0..kCrownAcross from right to left, 0..kCrownAlong front to back.
  [[nodiscard]] NetVertex crown(std::size_t across, std::size_t along) const;
  [[nodiscard]] NetVertex crotch() const { return crotch_; }
  [[nodiscard]] NetVertex arm(Side side, std::size_t row, std::size_t spoke) const;
  [[nodiscard]] NetVertex leg(Side side, std::size_t row, std::size_t spoke) const;
  /// The three inner vertices of the tip of a foot, from the inner to the outer side.
  [[nodiscard]] NetVertex toeTip(Side side, std::size_t i) const;

 private:
  void countVertices();
  void addLeftQuads();
  void addCrownQuads();
  void addToeQuads();
  void addMirroredQuads();

  std::size_t vertexCount_ = 0;
  std::vector<std::size_t> torsoIndex_;
  std::size_t crownBegin_ = 0;
  NetVertex crotch_ = 0;
  std::size_t limbsBegin_ = 0;
  std::size_t limbVertexCount_ = 0;  ///< of one arm and one leg
  std::vector<std::array<NetVertex, 4>> quads_;
  std::vector<NetVertex> partner_;
};

/// The one net.
const ControlNet& controlNet();

}  // namespace toile::body
