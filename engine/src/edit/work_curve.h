// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "toile/curve/geodesic.h"

namespace toile::detail {

/// A curve on the surface while it is edited: data points, the links between them, and which data
/// points are control points.
struct WorkCurve {
  std::vector<SurfacePoint> data;
  std::vector<SurfacePath> links;  ///< data.size() - 1, or data.size() when closed
  std::vector<bool> isControl;     ///< per data point
  std::vector<bool> isCorner;      ///< per data point: a sharp control
  bool closed = false;

  [[nodiscard]] std::size_t linkCount() const { return links.size(); }
  [[nodiscard]] const SurfacePoint& from(std::size_t link) const { return data[link]; }
  [[nodiscard]] const SurfacePoint& to(std::size_t link) const {
    return data[(link + 1) % data.size()];
  }
  void push(const SurfacePoint& point, bool control, bool corner = false);
};

/// Data points closer to their neighbour are the same, mm.
inline constexpr double kSameDataPoint = 1e-6;

/// Links what is not linked yet, or no longer between its data points. Precondition: neighbours
/// differ.
Result<void> linkAll(GeodesicLinker& linker, WorkCurve& curve);
/// Drops data points that lie on their neighbour (a control point rather than another stays), and
/// links. CurveInvalid when fewer than 2 (closed: 3) are left.
Result<WorkCurve> makeWorkCurve(GeodesicLinker& linker, const Mesh& mesh,
                                std::span<const SurfacePoint> points, bool closed);

[[nodiscard]] SurfacePath pathOf(const WorkCurve& curve);
/// mm from the start to every data point; the length at the end (also of an open curve, again).
[[nodiscard]] std::vector<double> arcsOf(const Mesh& mesh, const WorkCurve& curve);
[[nodiscard]] SurfacePoint pointAtArc(const Mesh& mesh, const WorkCurve& curve,
                                      const std::vector<double>& arcs, double arc);
/// Makes the place at an arc length a data point, unless one lies there; the path stays.
/// @return its index.
std::size_t insertData(const Mesh& mesh, WorkCurve& curve, double arc);
/// Puts a data point a rounding aside, where it is another curve's to the last bit; the way stays.
/// Where it becomes its neighbour's too, one data point is left.
/// @return false, and nothing changed, where the new point lies in none of the old one's faces.
[[nodiscard]] bool nudgeData(const Mesh& mesh, WorkCurve& curve, std::size_t index,
                             const SurfacePoint& point);
/// The same, with new links to the point where that is needed.
Result<void> replaceData(GeodesicLinker& linker, const Mesh& mesh, WorkCurve& curve,
                         std::size_t index, const SurfacePoint& point);
/// A part of a locally shortest link need not be the link between its own ends, where a way on the
/// other side of a limb is shorter. Adds data points until linking anew gives the same curve, so
/// that a stored curve is the one that was edited; links are then what they will be, bit for bit.
/// Short links differ by rounding only, and are left as they are unless all are asked for.
enum class Links { Long, All };
void settle(GeodesicLinker& linker, const Mesh& mesh, WorkCurve& curve, Links links = Links::Long);
/// The closed curve begun at another data point.
void rotate(WorkCurve& curve, std::size_t start);
void reverse(WorkCurve& curve);
/// The open curve from one data point to another; on a closed curve it may run over the start.
[[nodiscard]] WorkCurve partOf(const WorkCurve& curve, std::size_t from, std::size_t to);
/// The second after the first, which ends where it begins.
void append(WorkCurve& first, const WorkCurve& second);

}  // namespace toile::detail
