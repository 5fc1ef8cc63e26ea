// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "toile/body/body.h"

namespace toile {

std::span<const BodyMeasureInfo> bodyMeasures() {
  static constexpr std::array<BodyMeasureInfo, kBodyMeasureCount> measures{{
      {BodyMeasure::Height, "height", "height", "from the floor to the crown, upright"},
      {BodyMeasure::Head, "head", "head girth", "curve head_girth"},
      {BodyMeasure::Neck, "neck", "neck girth", "curve neck_girth"},
      {BodyMeasure::NeckBase, "neck-base", "neck base girth", "curve neck_base"},
      {BodyMeasure::ShoulderLength, "shoulder-length", "shoulder length", "curve shoulder_l"},
      {BodyMeasure::Chest, "chest", "bust girth (women), chest girth (men)", "curve bust_girth"},
      {BodyMeasure::Underbust, "underbust", "underbust girth", "curve underbust_girth"},
      {BodyMeasure::Waist, "waist", "waist girth", "curve waist_girth"},
      {BodyMeasure::HighHip, "high-hip", "top hip girth", "curve high_hip_girth"},
      {BodyMeasure::Hip, "hip", "hip girth", "curve hip_girth"},
      {BodyMeasure::Thigh, "thigh", "thigh girth", "curve thigh_girth_l"},
      {BodyMeasure::MidThigh, "mid-thigh", "mid-thigh girth", "curve midthigh_girth_l"},
      {BodyMeasure::Knee, "knee", "knee girth", "curve knee_girth_l"},
      {BodyMeasure::Calf, "calf", "calf girth", "curve calf_girth_l"},
      {BodyMeasure::Ankle, "ankle", "ankle girth", "curve ankle_girth_l"},
      {BodyMeasure::Armscye, "armscye", "armscye girth", "curve armhole_l"},
      {BodyMeasure::UpperArm, "upper-arm", "upper arm girth", "curve upperarm_girth_l"},
      {BodyMeasure::Elbow, "elbow", "elbow girth", "curve elbow_girth_l"},
      {BodyMeasure::Wrist, "wrist", "wrist girth", "curve wrist_girth_l"},
      {BodyMeasure::ArmLength, "arm-length", "arm length", "curve arm_outer_l"},
      {BodyMeasure::BackLength, "back-length", "back neck point to waist",
       "curve centre_back down to the waist"},
      {BodyMeasure::InsideLeg, "inside-leg", "inside leg height", "from the floor to the crotch"},
      {BodyMeasure::FootLength, "foot-length", "foot length", "from the heel to the toes"},
  }};
  return measures;
}

}  // namespace toile
