// SPDX-License-Identifier: GPL-3.0-or-later
#include "body/chains.h"

#include "body/subdivision.h"

namespace toile::body {
namespace {

Chain refined(const std::vector<NetVertex>& corners, bool closed) {
  Chain chain;
  chain.closed = closed;
  const std::size_t edges = closed ? corners.size() : corners.size() - 1;
  for (std::size_t i = 0; i < edges; ++i) {
    const auto along = subdivision().alongEdge(corners[i], corners[(i + 1) % corners.size()]);
    chain.vertices.insert(chain.vertices.end(), along.begin(), along.end() - 1);
  }
  if (!closed) chain.vertices.push_back(corners.back());
  return chain;
}

enum class Turn { Up, Down };  ///< counting spokes or columns

/// A loop of `count` spokes from `first`.
template <typename At>
Chain loop(std::size_t count, std::size_t first, Turn turn, const At& at) {
  std::vector<NetVertex> corners;
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back(at((turn == Turn::Up ? first + i : first + count - i) % count));
  }
  return refined(corners, true);
}

Chain torsoLoop(std::size_t row, std::size_t first, Turn turn = Turn::Up) {
  return loop(kColumns, first, turn,
              [&](std::size_t column) { return controlNet().torso(row, column); });
}
Chain armLoop(std::size_t row, std::size_t first) {
  return loop(kArmSpokes, first, Turn::Down,
              [&](std::size_t spoke) { return controlNet().arm(Side::Left, row, spoke); });
}
Chain legLoop(std::size_t row, std::size_t first, Turn turn = Turn::Down) {
  return loop(kLegSpokes, first, turn,
              [&](std::size_t spoke) { return controlNet().leg(Side::Left, row, spoke); });
}

/// A column of the torso from one row down to another.
std::vector<NetVertex> columnDown(std::size_t column, std::size_t from, std::size_t to) {
  std::vector<NetVertex> corners;
  for (std::size_t row = from + 1; row-- > to;) corners.push_back(controlNet().torso(row, column));
  return corners;
}
std::vector<NetVertex> joined(std::vector<NetVertex> a, const std::vector<NetVertex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
std::vector<NetVertex> reversed(const std::vector<NetVertex>& row) {
  return {row.rbegin(), row.rend()};
}

std::map<std::string, Chain> makeChains() {
  const ControlNet& net = controlNet();
  std::map<std::string, Chain> chains;
  chains["neck_base"] = torsoLoop(kNeckBaseRow, 0);
  chains["neck_girth"] = torsoLoop(kNeckRow, kColumns - kSideColumn, Turn::Down);
  chains["head_girth"] = torsoLoop(kForeheadRow, kColumns - 3);
  chains["underbust_girth"] = torsoLoop(kUnderbustRow, kBackColumn);
  chains["bust_girth"] = torsoLoop(kBustRow, kColumns - kBustColumn);
  chains["waist_girth"] = torsoLoop(kWaistRow, kBackColumn);
  chains["high_hip_girth"] = torsoLoop(kHighHipRow, kColumns - kSideColumn);
  chains["hip_girth"] = torsoLoop(kHipRow, kBackColumn + 2);
  chains["armhole_l"] = armLoop(0, 1);
  chains["upperarm_girth_l"] = armLoop(kUpperArmRow, 1);
  chains["elbow_girth_l"] = armLoop(kElbowRow, 2);
  chains["wrist_girth_l"] = armLoop(kWristRow, 0);
  chains["thigh_girth_l"] = legLoop(kThighRow, 9, Turn::Up);
  chains["midthigh_girth_l"] = legLoop(kMidThighRow, 9, Turn::Up);
  chains["knee_girth_l"] = legLoop(kKneeRow, 0);
  chains["calf_girth_l"] = legLoop(kCalfRow, kLegInner);
  chains["ankle_girth_l"] = legLoop(kAnkleRow, kLegOuter);
  chains["ball_girth_l"] = legLoop(kBallRow, kLegInner);

  const auto toCrotch = [&](std::size_t column, std::size_t from) {
    return joined(columnDown(column, from, kSplitRow), {net.crotch()});
  };
  chains["centre_front"] = refined(toCrotch(0, kNeckBaseRow), false);
  chains["centre_back"] = refined(toCrotch(kBackColumn, kNeckBaseRow), false);
  std::vector<NetVertex> back = toCrotch(kBackColumn, kWaistRow);
  back.pop_back();
  chains["crotch_seam"] = refined(joined(toCrotch(0, kWaistRow), reversed(back)), false);
  std::vector<NetVertex> head = reversed(columnDown(kBackColumn, kUpperHeadRow, kNeckBaseRow));
  for (std::size_t i = kCrownAlong; i-- > 1;) head.push_back(net.crown(kCrownAcross / 2, i));
  chains["centre_head"] = refined(joined(head, columnDown(0, kUpperHeadRow, kNeckBaseRow)), false);
  chains["shoulder_l"] = refined(columnDown(kSideColumn, kNeckBaseRow, kShoulderRow), false);

  const auto legLine = [&](std::size_t spoke, std::size_t first) {
    std::vector<NetVertex> corners;
    for (std::size_t row = first; row <= kAnkleRow; ++row) {
      corners.push_back(net.leg(Side::Left, row, spoke));
    }
    return corners;
  };
  chains["side_l"] =
      refined(joined(columnDown(kSideColumn, kArmpitRow, kSplitRow), legLine(kLegOuter, 1)), false);
  chains["inseam_l"] = refined(legLine(kLegInner, 0), false);
  const auto armLine = [&](std::size_t spoke) {
    std::vector<NetVertex> corners;
    for (std::size_t row = 0; row <= kWristRow; ++row) {
      corners.push_back(net.arm(Side::Left, row, spoke));
    }
    return corners;
  };
  chains["arm_outer_l"] = refined(armLine(kArmOuter), false);
  chains["underarm_l"] = refined(armLine(kArmInner), false);

  const std::vector<std::size_t>& partner = subdivision().partner();
  std::map<std::string, Chain> out = chains;
  for (const auto& [name, chain] : chains) {
    if (!name.ends_with("_l")) continue;
    Chain image = chain;
    for (std::size_t& v : image.vertices) v = partner[v];
    out[name.substr(0, name.size() - 2) + "_r"] = image;
  }
  return out;
}

std::map<std::string, std::size_t> makeVertices() {
  const ControlNet& net = controlNet();
  const auto arm = [&](std::size_t row, std::size_t i) { return net.arm(Side::Left, row, i); };
  const auto leg = [&](std::size_t row, std::size_t i) { return net.leg(Side::Left, row, i); };
  const std::map<std::string, std::size_t> middle{
      {"crown", net.crown(kCrownAcross / 2, kCrownAlong / 2)},
      {"nose_tip", net.torso(kFaceRow, 0)},
      {"chin", net.torso(kChinRow, 0)},
      {"neck_front", net.torso(kNeckBaseRow, 0)},
      {"neck_back", net.torso(kNeckBaseRow, kBackColumn)},
      {"bust_front", net.torso(kBustRow, 0)},
      {"bust_back", net.torso(kBustRow, kBackColumn)},
      {"underbust_front", net.torso(kUnderbustRow, 0)},
      {"waist_front", net.torso(kWaistRow, 0)},
      {"waist_back", net.torso(kWaistRow, kBackColumn)},
      {"navel", net.torso(kAbdomenRow, 0)},
      {"hip_front", net.torso(kHipRow, 0)},
      {"hip_back", net.torso(kHipRow, kBackColumn)},
      {"crotch", net.crotch()},
  };
  const std::map<std::string, std::size_t> left{
      {"neck_side", net.torso(kNeckBaseRow, kSideColumn)},
      {"shoulder", arm(0, kArmOuter)},
      {"armpit", arm(0, kArmInner)},
      {"armpit_front", arm(0, 3)},
      {"armpit_back", arm(0, 7)},
      {"bust_point", net.torso(kBustRow, kBustColumn)},
      {"waist_side", net.torso(kWaistRow, kSideColumn)},
      {"hip_side", net.torso(kHipRow, kSideColumn)},
      {"buttock", net.torso(kHipRow, kBackColumn - 1)},
      {"gluteal_fold", leg(kThighRow, kLegBack + 1)},
      {"knee_front", leg(kKneeRow, kLegFront)},
      {"knee_back", leg(kKneeRow, kLegBack)},
      {"knee_outer", leg(kKneeRow, kLegOuter)},
      {"knee_inner", leg(kKneeRow, kLegInner)},
      {"ankle_front", leg(kAnkleRow, kLegFront)},
      {"ankle_back", leg(kAnkleRow, kLegBack)},
      {"ankle_outer", leg(kAnkleRow, kLegOuter)},
      {"ankle_inner", leg(kAnkleRow, kLegInner)},
      {"heel", leg(kAnkleRow + 2, kLegBack)},
      {"toe_big", leg(kToeRow, 0)},
      {"toe_little", leg(kToeRow, 4)},
      {"elbow_outer", arm(kElbowRow, 8)},
      {"elbow_inner", arm(kElbowRow, 2)},
      {"wrist_thumb", arm(kWristRow, 2)},
      {"wrist_little", arm(kWristRow, 7)},
      {"middle_tip",
       subdivision().alongEdge(arm(kFingerRow, kArmOuter), arm(kFingerRow, kArmInner))[2]},
  };
  std::map<std::string, std::size_t> out = middle;
  for (const auto& [name, vertex] : left) {
    out[name + "_l"] = vertex;
    out[name + "_r"] = subdivision().partner()[vertex];
  }
  return out;
}

}  // namespace

const std::map<std::string, Chain>& namedChains() {
  static const std::map<std::string, Chain> chains = makeChains();
  return chains;
}

const std::map<std::string, std::size_t>& namedVertices() {
  static const std::map<std::string, std::size_t> vertices = makeVertices();
  return vertices;
}

}  // namespace toile::body
