// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sewing_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "toile/core/content_hash.h"

namespace toile {
namespace {

constexpr double kThumbnailSteps = 300;  // points nearer than this part of the model's height go

/// A line seen from in front (-y) or from behind; only its parts on faces that look at the eye
/// where `all` is false.
class Viewer {
 public:
  Viewer(const Pattern& pattern, bool fromBehind) : pattern_(pattern), sign_(fromBehind ? -1 : 1) {}

  BodyView view() {
    BodyView view;
    Points2 all;
    for (const std::uint32_t index : pattern_.pieceIndex)
      for (const Eigen::Vector3d& p : pattern_.cut.pieces[index].mesh->positions())
        all.push_back(project(p));
    view.box = boxOf(all);
    step_ = view.box.size().maxCoeff() / kThumbnailSteps;
    for (const std::uint32_t index : pattern_.pieceIndex) {
      const Piece& piece = pattern_.cut.pieces[index];
      view.lines.push_back(seenLines(piece));
      view.outlines.push_back(loops(piece));
    }
    return view;
  }

 private:
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {sign_ * p.x(), p.z()};
  }

  void add(Points2& line, const Eigen::Vector2d& p) const {
    if (line.empty() || (line.back() - p).norm() >= step_) line.push_back(p);
  }

  [[nodiscard]] std::vector<Points2> seenLines(const Piece& piece) const {
    std::vector<Points2> lines;
    for (const Wire& wire : piece.wires) {
      if (!isBoundary(wire.kind)) continue;
      bool isOpen = false;
      for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
        const EdgeId edge = piece.mesh->findEdge(wire.vertices[i], wire.vertices[i + 1]);
        const bool isSeen =
            edge.isValid() &&
            sign_ * piece.mesh->normal(piece.mesh->face(piece.mesh->halfedge(edge))).y() < 0;
        if (isSeen && !isOpen) lines.emplace_back();
        isOpen = isSeen;
        if (!isSeen) continue;
        add(lines.back(), project(piece.mesh->position(wire.vertices[i])));
        if (i + 2 == wire.vertices.size())
          lines.back().push_back(project(piece.mesh->position(wire.vertices[i + 1])));
      }
    }
    std::erase_if(lines, [](const Points2& line) { return line.size() < 2; });
    return lines;
  }

  [[nodiscard]] std::vector<Points2> loops(const Piece& piece) const {
    std::vector<Points2> loops;
    VertexId next;
    for (const Wire& wire : piece.wires) {
      if (!isBoundary(wire.kind)) continue;
      if (loops.empty() || wire.vertices.front() != next) loops.emplace_back();
      for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i)
        add(loops.back(), project(piece.mesh->position(wire.vertices[i])));
      next = wire.vertices.back();
    }
    return loops;
  }

  const Pattern& pattern_;
  double sign_;
  double step_ = 1;
};

bool facesBack(const Piece& piece) {
  double sum = 0;
  for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f)
    sum += piece.mesh->area(FaceId(f)) * piece.mesh->normal(FaceId(f)).y();
  return sum > 0;
}

}  // namespace

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
  for (const std::uint32_t index : pattern.pieceIndex)
    sheet.isBehind.push_back(facesBack(pattern.cut.pieces[index]) ? 1 : 0);
  sheet.front = Viewer(pattern, false).view();
  sheet.back = Viewer(pattern, true).view();
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
