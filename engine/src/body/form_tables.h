// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "toile/body/body.h"

// The form of the body as numbers: rings in thousandths of its height. y is to the back, z counts
// from the floor.
namespace toile::body {

/// A level ring of the trunk.
struct TrunkRing {
  double z;
  double width;                    ///< half of it
  double widestY;                  ///< y of the widest place
  double front, back;              ///< y
  double squareFront, squareBack;  ///< exponent of the superellipse, 2 = ellipse
  double frontGroove, backGroove;  ///< how far the centre line lies in
};

// Split, hip, high hip, abdomen, waist, underbust, bust, armpit.
inline constexpr std::array<TrunkRing, 8> kFemaleTrunk{{
    {478, 113, -27, -79, 46, 2.4, 2.4, 22, 20},
    {526, 105.5, -16, -77, 58, 2.2, 2.5, 1, 11},
    {576, 91.5, -22, -85, 33, 2.2, 2.4, 0, 3},
    {612, 82, -22, -86, 18, 2.2, 2.3, 0, 2},
    {646, 74.5, -28, -85, 11, 2.2, 2.3, 0, 3},
    {686, 78, -32, -86, 16, 2.4, 2.5, 1, 5},
    {728, 88, -28, -84, 25, 2.5, 2.6, 0, 6},
    {754, 92, -22, -78, 29, 2.4, 2.6, 0, 6},
}};
inline constexpr std::array<TrunkRing, 8> kMaleTrunk{{
    {478, 104, -22, -68, 46, 2.4, 2.4, 14, 20},
    {526, 96.5, -18, -72, 57, 2.3, 2.5, 0, 11},
    {576, 86, -22, -77, 43, 2.3, 2.5, 0, 3},
    {612, 82, -24, -77, 34, 2.3, 2.4, 0, 2},
    {646, 79, -26, -76, 32, 2.4, 2.4, 0, 3},
    {686, 85, -24, -78, 42, 2.5, 2.5, 1, 5},
    {728, 96, -18, -79, 46, 2.6, 2.6, 3, 6},
    {754, 103, -14, -74, 48, 2.6, 2.6, 2, 6},
}};

struct LegRing {
  double z, inner, outer, front, back;
};
// Thigh (1) to ankle (13).
inline constexpr std::array<LegRing, 13> kFemaleLeg{{
    {448, 8, 115, -82, 24},
    {408, 16, 115, -83, 14},
    {363, 29, 110, -79, 9},
    {318, 42, 108, -71, 3},
    {280, 50, 115, -62, 4},
    {248, 57, 122, -50, 15},
    {212, 62, 128, -46, 22.5},
    {176, 68, 128, -42, 22.5},
    {143, 76, 125, -38.5, 17},
    {115, 83, 122, -34.5, 11},
    {91, 87, 119.5, -32.5, 7.5},
    {71, 88, 119, -33, 6},
    {53, 88, 120, -38.5, 8},
}};
inline constexpr std::array<LegRing, 13> kMaleLeg{{
    {448, 9, 113, -68, 36},
    {408, 19, 115, -67, 28},
    {363, 34, 113, -60, 23},
    {318, 47, 113, -51, 20},
    {280, 58, 121, -43, 26},
    {248, 63.5, 128, -37, 33},
    {212, 66, 134, -32.5, 37},
    {176, 71.5, 134, -29.5, 32.5},
    {143, 81, 132, -27.5, 26.5},
    {115, 89.5, 130, -26, 22.5},
    {91, 95, 129, -27, 21},
    {71, 98, 129, -29, 20.5},
    {53, 96, 130, -35.5, 23},
}};

struct FootRing {
  double topY, topZ, bottomY, bottomZ, inner, outer;  ///< inner and outer: half widths
};
// Rings 14 to 21, y from the ankle's middle.
inline constexpr std::array<FootRing, 8> kFoot{{
    {-31, 47, 26, 30, 15.5, 15.5},
    {-40, 43.5, 27, 12, 17, 17},
    {-48, 40, 14, 1.5, 18.5, 18.5},
    {-58, 35.5, -8, 0.5, 19.5, 20},
    {-70, 31, -32, 1.5, 20.5, 22},
    {-86, 25, -60, 0.5, 24, 24.5},
    {-100, 19, -86, 0, 25.5, 26.5},
    {-114, 13, -108, 1.5, 22, 23},
}};
inline constexpr double kToeTipY = -120.5;

struct ArmRing {
  double step;                       ///< along the arm's middle from the ring before
  double outer, inner, front, back;  ///< radii
};
// Rings 1 to 16; 6 is the elbow, 12 the wrist.
inline constexpr std::array<ArmRing, 16> kFemaleArm{{
    {17, 32, 32, 33, 33},
    {21, 29.5, 29.5, 30.5, 30.5},
    {26, 27, 26.5, 27, 27.5},
    {30, 25.5, 24, 25, 25.5},
    {30, 24.2, 23.2, 24.2, 24.7},
    {28, 22.6, 22, 23, 23.5},
    {26, 22.4, 21.4, 22.8, 22.8},
    {24, 21, 19.8, 21.2, 21.2},
    {22, 18, 17, 18.5, 18.5},
    {20, 15.5, 14.7, 16, 16},
    {18, 12.5, 12.2, 14, 14},
    {16, 10.8, 10.8, 13.2, 13},
    {16, 11.5, 11.5, 17.5, 15},
    {20, 11, 11, 24, 18.5},
    {23, 9.8, 9.8, 23, 18.5},
    {20, 8.5, 8.5, 19, 16},
}};

/// How the girths of a child of about five differ from an adult's of the same height: logs.
inline double childOffset(BodyMeasure measure) {
  switch (measure) {
    case BodyMeasure::Head:
      return 0.33;
    case BodyMeasure::Neck:
      return 0.13;
    case BodyMeasure::NeckBase:
      return 0.06;
    case BodyMeasure::ShoulderLength:
      return -0.05;
    case BodyMeasure::Underbust:
      return 0.16;
    case BodyMeasure::Waist:
      return 0.21;
    case BodyMeasure::HighHip:
      return 0.05;
    case BodyMeasure::Hip:
    case BodyMeasure::Thigh:
      return -0.05;
    case BodyMeasure::Knee:
    case BodyMeasure::Elbow:
      return 0.05;
    case BodyMeasure::Ankle:
      return 0.1;
    case BodyMeasure::Wrist:
      return 0.15;
    default:
      return 0;
  }
}

}  // namespace toile::body
