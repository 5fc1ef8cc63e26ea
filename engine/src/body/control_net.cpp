// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/control_net.h"

#include "toile/core/assert.h"

namespace toile::body {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::size_t kArmRows = kFingerRow;  // that an arm adds to its opening
constexpr std::size_t kLegRows = kToeRow;

/// Inside the opening of an arm: columns 4 to 6 (or their mirror images) of four rings are its rim.
bool isInArmhole(std::size_t row, std::size_t column) {
  return (row == kLowChestRow || row == kHighChestRow) &&
         (column == kSideColumn || column == kColumns - kSideColumn);
}

struct RimPlace {
  std::size_t row, column;
};
/// The rim of the left arm's opening by spoke.
RimPlace armholeRim(std::size_t spoke) {
  static constexpr std::array<RimPlace, kArmSpokes> rim{{{kShoulderRow, 5},
                                                         {kShoulderRow, 4},
                                                         {kHighChestRow, 4},
                                                         {kLowChestRow, 4},
                                                         {kArmpitRow, 4},
                                                         {kArmpitRow, 5},
                                                         {kArmpitRow, 6},
                                                         {kLowChestRow, 6},
                                                         {kHighChestRow, 6},
                                                         {kShoulderRow, 6}}};
  return rim[spoke];
}

std::size_t mirroredColumn(std::size_t column) {
  return (kColumns - column) % kColumns;
}

}  // namespace

ControlNet::ControlNet() {
  countVertices();
  addLeftQuads();
  addCrownQuads();
  addToeQuads();
  addMirroredQuads();
}

NetVertex ControlNet::torso(std::size_t row, std::size_t column) const {
  const NetVertex vertex = torsoIndex_[row * kColumns + column % kColumns];
  TOILE_ASSERT(vertex != kNone);
  return vertex;
}

NetVertex ControlNet::crown(std::size_t across, std::size_t along) const {
  const std::size_t middle = kCrownAcross / 2;
  // On the rim: columns count from the centre front over the left side to the back.
  if (along == 0) return torso(kUpperHeadRow, (across + kColumns - middle) % kColumns);
  if (across == kCrownAcross) return torso(kUpperHeadRow, middle + along);
  if (along == kCrownAlong)
    return torso(kUpperHeadRow, middle + kCrownAlong + kCrownAcross - across);
  if (across == 0) return torso(kUpperHeadRow, kColumns - middle - along);
  return crownBegin_ + (along - 1) * (kCrownAcross - 1) + across - 1;
}

NetVertex ControlNet::arm(Side side, std::size_t row, std::size_t spoke) const {
  spoke %= kArmSpokes;
  if (row == 0) {
    const RimPlace rim = armholeRim(spoke);
    return torso(rim.row, side == Side::Left ? rim.column : mirroredColumn(rim.column));
  }
  const std::size_t begin = limbsBegin_ + (side == Side::Left ? 0 : limbVertexCount_);
  return begin + (row - 1) * kArmSpokes + spoke;
}

NetVertex ControlNet::leg(Side side, std::size_t row, std::size_t spoke) const {
  spoke %= kLegSpokes;
  if (row == 0) {
    if (spoke == kLegInner) return crotch_;
    return torso(kSplitRow, side == Side::Left ? spoke : mirroredColumn(spoke));
  }
  const std::size_t begin = limbsBegin_ + (side == Side::Left ? 0 : limbVertexCount_);
  return begin + kArmRows * kArmSpokes + (row - 1) * kLegSpokes + spoke;
}

NetVertex ControlNet::toeTip(Side side, std::size_t i) const {
  const std::size_t begin = limbsBegin_ + (side == Side::Left ? 0 : limbVertexCount_);
  return begin + kArmRows * kArmSpokes + kLegRows * kLegSpokes + i;
}

void ControlNet::countVertices() {
  torsoIndex_.assign(kTorsoRows * kColumns, kNone);
  std::size_t next = 0;
  for (std::size_t row = 0; row < kTorsoRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      if (!isInArmhole(row, column)) torsoIndex_[row * kColumns + column] = next++;
    }
  }
  crownBegin_ = next;
  next += (kCrownAcross - 1) * (kCrownAlong - 1);
  crotch_ = next++;
  limbsBegin_ = next;
  limbVertexCount_ = kArmRows * kArmSpokes + kLegRows * kLegSpokes + kToeTips;
  vertexCount_ = next + 2 * limbVertexCount_;

  partner_.resize(vertexCount_);
  for (std::size_t row = 0; row < kTorsoRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      if (isInArmhole(row, column)) continue;
      partner_[torso(row, column)] = torso(row, mirroredColumn(column));
    }
  }
  for (std::size_t along = 1; along < kCrownAlong; ++along) {
    for (std::size_t across = 1; across < kCrownAcross; ++across) {
      partner_[crown(across, along)] = crown(kCrownAcross - across, along);
    }
  }
  partner_[crotch_] = crotch_;
  for (std::size_t i = 0; i < limbVertexCount_; ++i) {
    partner_[limbsBegin_ + i] = limbsBegin_ + limbVertexCount_ + i;
    partner_[limbsBegin_ + limbVertexCount_ + i] = limbsBegin_ + i;
  }
}

void ControlNet::addLeftQuads() {
  for (std::size_t row = 0; row + 1 < kTorsoRows; ++row) {
    for (std::size_t column = 0; column < kBackColumn; ++column) {
      const bool isOpen = row >= kArmpitRow && row < kShoulderRow &&
                          (column == kSideColumn - 1 || column == kSideColumn);
      if (isOpen) continue;
      quads_.push_back({torso(row, column), torso(row, column + 1), torso(row + 1, column + 1),
                        torso(row + 1, column)});
    }
  }
  for (std::size_t row = 0; row < kArmRows; ++row) {
    for (std::size_t i = 0; i < kArmSpokes; ++i) {
      quads_.push_back({arm(Side::Left, row, i), arm(Side::Left, row, i + 1),
                        arm(Side::Left, row + 1, i + 1), arm(Side::Left, row + 1, i)});
    }
  }
  // The mitten's end is a strip: spokes 8, 9, 0, 1, 2 on top over 7, 6, 5, 4, 3 below.
  for (std::size_t i = 0; i < 4; ++i) {
    quads_.push_back({arm(Side::Left, kFingerRow, 8 + i), arm(Side::Left, kFingerRow, 9 + i),
                      arm(Side::Left, kFingerRow, 6 - i), arm(Side::Left, kFingerRow, 7 - i)});
  }
  for (std::size_t row = 0; row < kLegRows; ++row) {
    for (std::size_t i = 0; i < kLegSpokes; ++i) {
      quads_.push_back({leg(Side::Left, row + 1, i), leg(Side::Left, row + 1, i + 1),
                        leg(Side::Left, row, i + 1), leg(Side::Left, row, i)});
    }
  }
}

void ControlNet::addCrownQuads() {
  for (std::size_t along = 0; along < kCrownAlong; ++along) {
    for (std::size_t across = kCrownAcross / 2; across < kCrownAcross; ++across) {
      quads_.push_back({crown(across, along), crown(across + 1, along),
                        crown(across + 1, along + 1), crown(across, along + 1)});
    }
  }
}

void ControlNet::addToeQuads() {
  // Grid of 4 x 2 quads seen from in front, toes towards the viewer: from the inner side (spoke 11)
  // to the outer one (spoke 5); spokes 0 to 4 on top, 10 to 6 on the sole.
  const auto at = [&](std::size_t across, std::size_t up) -> NetVertex {
    if (up == 2) return leg(Side::Left, kToeRow, across);
    if (up == 0) return leg(Side::Left, kToeRow, 10 - across);
    if (across == 0) return leg(Side::Left, kToeRow, kLegInner);
    if (across == 4) return leg(Side::Left, kToeRow, kLegOuter);
    return toeTip(Side::Left, across - 1);
  };
  for (std::size_t up = 0; up < 2; ++up) {
    for (std::size_t across = 0; across < 4; ++across) {
      quads_.push_back(
          {at(across, up), at(across + 1, up), at(across + 1, up + 1), at(across, up + 1)});
    }
  }
}

void ControlNet::addMirroredQuads() {
  const std::size_t count = quads_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<NetVertex, 4> quad = quads_[i];
    quads_.push_back({partner_[quad[1]], partner_[quad[0]], partner_[quad[3]], partner_[quad[2]]});
  }
}

const ControlNet& controlNet() {
  static const ControlNet net;
  return net;
}

}  // namespace toile::body
