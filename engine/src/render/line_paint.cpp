// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/line_paint.h"

#include <cmath>

namespace toile {
namespace {

using Eigen::Vector3f;

// All in px of the line styles: `d` away from the line, `s` along it.

/// Falls from 1 on the line to 0 away from it.
float bell(float d, float width) {
  return std::exp(-(d / width) * (d / width));
}

bool isOn(float s, float on, float off) {
  return std::fmod(s, on + off) < on;
}

constexpr float kStitch = 3.4F, kStitchGap = 1.8F, kThread = 0.42F;

/// A row of stitches at that distance from the line.
void stitch(Painted& at, const ClothPaint& cloth, float d, float s, float row) {
  const float off = std::abs(d - row);
  if (off < kThread && isOn(s, kStitch, kStitchGap)) {
    at.colour = cloth.thread;
  } else {
    at.shade *= 1 - 0.22F * bell(off, 0.9F);  // the thread presses the cloth in
  }
}

void paintSeam(Painted& at, const ClothPaint& cloth, float d, float s) {
  at.shade *= (1 - 0.20F * bell(d, 4.2F)) * (1 - 0.62F * bell(d, 0.75F));
  stitch(at, cloth, d, s, 2.3F);
  at.fine = d < 4;
}

void paintHem(Painted& at, const ClothPaint& cloth, float d, float s) {
  at.shade *= (1 - 0.12F * bell(d, 2.0F)) * (1 - 0.55F * bell(d, 0.6F));
  stitch(at, cloth, d, s, 3.2F);
  at.fine = d < 5;
}

void paintDart(Painted& at, float d) {
  at.shade *= (1 - 0.2F * bell(d, 3.0F)) * (1 - 0.62F * bell(d, 0.7F));
  at.fine = d < 3;
}

constexpr float kTapeEdge = 3.3F;

void paintZip(Painted& at, const ClothPaint& cloth, const SurfaceLines::Pass& zip, float unit) {
  const SurfaceLine& line = *zip.line;
  const float d = zip.across / unit;
  const float s = zip.along / unit;
  const float fromTop = (line.length - zip.along) / unit;
  static const Vector3f kTape = linearOf(colourOf(0x1B1E22));
  static const Vector3f kMetal = linearOf(colourOf(0xB9BDC2));
  static const Vector3f kSlider = linearOf(colourOf(0xD9DCDF));
  constexpr float kTeeth = 1.15F, kPitch = 2.6F;
  at.fine = d < 7;
  if (line.endsAtTop && fromTop < 8.5F && d < (fromTop < 5.5F ? 2.1F : 0.9F)) {
    at.colour = kSlider;
    at.shade = d > 1.6F ? 0.75F : 1.0F;
    return;
  }
  if (d < kTeeth) {
    // Teeth from both sides mesh: those of one side stand in the gaps of the other.
    const float tooth = std::fmod(s + (line.turned ? kPitch / 2 : 0), kPitch);
    at.colour = tooth < 1.5F ? kMetal : kTape;
    return;
  }
  if (d < kTapeEdge) {
    at.colour = kTape;
    at.shade *= 1 - 0.3F * bell(kTapeEdge - d, 0.5F);
    return;
  }
  at.shade *= 1 - 0.4F * bell(d - kTapeEdge, 0.9F);
  stitch(at, cloth, d, s, 4.9F);
}

bool isInked(const LineStyle& style, float along, float across) {
  switch (style.dash) {
    case Dash::Solid:
      return true;
    case Dash::Dashes:
      return isOn(along, kDashOn, kDashOff);
    case Dash::Dots:
      return std::hypot(std::remainder(along, kDotSpacing), across) <= style.width / 2;
    case Dash::LongShort: {
      const double at = std::fmod(along, kLongOn + 3 * kLongOff);
      return at < kLongOn || (at >= kLongOn + kLongOff && at < kLongOn + 2 * kLongOff);
    }
  }
  return true;
}

/// @return whether the line's ink is here
bool inkPlain(Painted& at, const SurfaceLines::Pass& pass, float unit) {
  if (pass.line == nullptr) return false;
  const LineStyle& style = pass.line->plain;
  const float d = pass.across / unit;
  const auto half = static_cast<float>(style.width / 2);
  at.fine = at.fine || d < half + 2.5F;
  if (d > half || !isInked(style, pass.along / unit, d)) {
    // A pale rim helps the line on dark shades.
    if (d < half + 1) {
      at.ink = Vector3f::Ones();
      at.inked = 0.45F;
    }
    return false;
  }
  at.ink = displayOf(style.colour);
  at.inked = 1;
  return true;
}

}  // namespace

ClothPaint makeCloth(Colour colour) {
  const bool dark = lightness(colour) < 0.55;
  const Colour thread =
      dark ? mix(colour, colourOf(0xFFFFFF), 0.62) : mix(colour, colourOf(0x1E2227), 0.50);
  return {linearOf(colour), linearOf(thread)};
}

Painted paintProduct(const SurfaceLines::Near& near, const ClothPaint& cloth, float unit) {
  Painted at;
  at.colour = cloth.colour;
  if (near.inside.line != nullptr) {
    const float d = near.inside.across / unit;
    const float s = near.inside.along / unit;
    const LineRole role = near.inside.line->role;
    const bool on = role == LineRole::Elastic ? isOn(s, 1.2F, 2.0F) : isOn(s, 5.0F, 3.2F);
    const float half = role == LineRole::Mark ? 0.35F : 0.5F;
    if (d < half && on) at.colour = 0.75F * cloth.colour + 0.25F * cloth.thread;
    at.fine = d < 2;
  }
  const bool wasFine = at.fine;
  const SurfaceLines::Pass& zip = near.zip;
  const SurfaceLines::Pass& border = near.border;
  // The tape lies over the seams that end at it.
  if (zip.line != nullptr &&
      (border.line == nullptr || zip.across < border.across || zip.across < kTapeEdge * unit)) {
    paintZip(at, cloth, zip, unit);
  } else if (border.line != nullptr) {
    const float d = border.across / unit;
    const float s = border.along / unit;
    switch (border.line->role) {
      case LineRole::Seam:
        paintSeam(at, cloth, d, s);
        break;
      case LineRole::Hem:
        paintHem(at, cloth, d, s);
        break;
      case LineRole::Dart:
        paintDart(at, d);
        break;
      case LineRole::Zip:
      case LineRole::Feature:
      case LineRole::Elastic:
      case LineRole::Mark:
        break;
    }
  }
  at.fine = at.fine || wasFine;
  return at;
}

Painted paintPlain(const SurfaceLines::Near& near, const ClothPaint& cloth, float unit) {
  Painted at;
  at.colour = cloth.colour;
  if (inkPlain(at, near.border, unit) || inkPlain(at, near.zip, unit)) return at;
  inkPlain(at, near.inside, unit);
  return at;
}

}  // namespace toile
