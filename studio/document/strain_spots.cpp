// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/strain_spots.h"

#include <algorithm>
#include <cmath>

namespace toile::studio {

namespace {

constexpr std::size_t kMostSpots = 9;

}  // namespace

std::vector<PlacedSpot> worstSpots(const Pattern& pattern,
                                   const std::vector<std::optional<PieceStrain>>& strains,
                                   StrainKind kind) {
  std::vector<PlacedSpot> spots;
  for (std::size_t i = 0; i < strains.size() && i < pattern.cut.pieces.size(); ++i) {
    if (!strains[i]) continue;
    const Mesh& mesh = *pattern.cut.pieces[i].mesh;
    for (const StrainSpot& spot : strains[i]->worst) {
      if (kind != StrainKind::Area && spot.kind != kind) continue;
      PlacedSpot placed{
          1, i, spot, mesh.position(spot.vertex), Eigen::Vector3d::Zero(), spot.isOverLimit()};
      for (const FaceId face : mesh.facesAround(spot.vertex)) placed.normal += mesh.normal(face);
      placed.normal.normalize();
      spots.push_back(std::move(placed));
    }
  }
  std::ranges::stable_sort(spots, [](const PlacedSpot& a, const PlacedSpot& b) {
    if (a.isOverLimit != b.isOverLimit) return a.isOverLimit;
    return std::abs(a.spot.value) > std::abs(b.spot.value);
  });
  if (spots.size() > kMostSpots) spots.resize(kMostSpots);
  for (std::size_t i = 0; i < spots.size(); ++i) spots[i].number = static_cast<int>(i) + 1;
  return spots;
}

QString percentText(double share, int decimals) {
  const QString number = QString::number(std::abs(100 * share), 'f', decimals);
  const bool isZero = number.toDouble() == 0;
  const QString sign = isZero ? QString() : QString(share < 0 ? QChar(0x2212) : QChar('+'));
  return sign + number + QChar(0x2009) + QLatin1Char('%');
}

}  // namespace toile::studio
