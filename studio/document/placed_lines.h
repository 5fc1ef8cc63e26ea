// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "toile/design/design.h"

namespace toile::studio {

/// A line of the design as it lies on the body.
struct PlacedLine {
  StylingCurve curve;
  SurfacePath path;
  std::vector<Eigen::Vector3d> points;   ///< of the path; a closed one ends where it begins
  std::vector<Eigen::Vector3d> normals;  ///< of the surface, per point
  std::vector<double> arc;               ///< mm from the start, per point
  std::uint64_t version = 0;             ///< another number, another shape

  [[nodiscard]] double length() const { return arc.empty() ? 0 : arc.back(); }
  /// The name, or the id where it has none.
  [[nodiscard]] const std::string& title() const {
    return curve.name.empty() ? curve.id : curve.name;
  }
};

/// All lines of a document, kept up to date: only what changed is placed again.
class PlacedLines {
 public:
  /// @return what could not be placed; those lines are left out, the others are shown.
  std::vector<Error> update(const Document& document);

  [[nodiscard]] const std::vector<std::shared_ptr<const PlacedLine>>& all() const { return lines_; }
  [[nodiscard]] const PlacedLine* find(const std::string& id) const;
  [[nodiscard]] const Document& document() const { return document_; }

 private:
  Document document_;
  std::shared_ptr<GeodesicLinker> linker_;
  std::vector<std::shared_ptr<const PlacedLine>> lines_;
  std::uint64_t lastVersion_ = 0;
};

/// Makes a path drawable.
[[nodiscard]] PlacedLine makePlacedLine(const Mesh& mesh, StylingCurve curve, SurfacePath path);
/// A place on a line: the segment and how far along it.
[[nodiscard]] SurfacePoint pointOnSegment(const Mesh& mesh, const SurfacePath& path,
                                          std::size_t segment, double t);

}  // namespace toile::studio
