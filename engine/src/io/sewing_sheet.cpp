// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sewing_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "toile/core/content_hash.h"

namespace toile {

SewingSheet sewingSheet(const Pattern& pattern) {
  SewingSheet sheet;
  const Design& design = *pattern.document.design;
  const std::string style = design.order.style.empty() ? design.name : design.order.style;
  sheet.title = style.empty() ? "Pattern" : style;
  if (!design.order.size.empty()) sheet.title += ", size " + design.order.size;
  if (!design.order.customer.empty()) sheet.title += ", for " + design.order.customer;
  sheet.plan = planSewing(pattern);
  for (const PatternPiece& piece : pattern.pieces) {
    double area = 0;
    for (const Outline& loop : piece.cutLines) area += signedArea(positions(loop));
    const Points2 outer = positions(piece.cutLines.front());
    double length = 0;
    for (std::size_t i = 0; i < outer.size(); ++i)
      length += (outer[(i + 1) % outer.size()] - outer[i]).norm();
    sheet.area.push_back(area);
    sheet.length.push_back(length);
    auto found = std::find_if(sheet.fabrics.begin(), sheet.fabrics.end(),
                              [&](const FabricUse& use) { return use.name == piece.fabric; });
    if (found == sheet.fabrics.end())
      found = sheet.fabrics.insert(sheet.fabrics.end(), FabricUse{piece.fabric});
    found->pieces += piece.count;
    found->area += piece.count * area;
  }
  sheet.body = bodyViews(pattern);
  sheet.contract = lengthContract(pattern);
  sheet.inputs = inputsHash(pattern.document).hex();
  return sheet;
}

const char* describe(SewStep::Kind kind) {
  switch (kind) {
    case SewStep::Kind::Dart:
      return "close the dart";
    case SewStep::Kind::Flat:
      return "join, lying flat";
    case SewStep::Kind::Tube:
      return "close to a tube";
    case SewStep::Kind::Round:
      return "set in, in the round";
  }
  return "";
}

std::string curveName(const Pattern& pattern, const std::string& id) {
  for (const StylingCurve& curve : pattern.document.design->curves)
    if (curve.id == id && !curve.name.empty()) return curve.name;
  return id;
}

std::string describeMinutes(double minutes) {
  const int whole = static_cast<int>(std::lround(minutes));
  return whole < 60 ? fmt::format("{} min", whole)
                    : fmt::format("{} h {:02} min", whole / 60, whole % 60);
}

}  // namespace toile
