// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "toile/core/content_hash.h"
#include "toile/core/units.h"
#include "toile/curve/geodesic.h"
#include "toile/curve/subdivision.h"
#include "toile/curve/view.h"
#include "toile/mesh/surface_point.h"
#include "toile/model/reference_model.h"

namespace toile {

/// Keys of a file that this version does not know, each with its JSON text; written back as read.
/// What can be drawn by the thousand (model points) has none: unknown keys there are refused.
using UnknownKeys = std::map<std::string, std::string>;

enum class CurveKind {
  Seam,     ///< cut and sewn
  Opening,  ///< cut but not sewn: a zip
  Feature,  ///< stays in one piece, keeps its length
  Elastic,  ///< a feature whose length may move within a range
  Dart,     ///< cut that ends inside a piece
  Mark,     ///< drawn on the pieces, neither cut nor kept
  Guide     ///< for other lines to hang on; nowhere in the pattern
};
[[nodiscard]] std::string_view toString(CurveKind kind);
/// Seam, Opening, Dart: the surface is opened along it.
[[nodiscard]] constexpr bool isCut(CurveKind kind) {
  return kind == CurveKind::Seam || kind == CurveKind::Opening || kind == CurveKind::Dart;
}
/// Feature, Elastic: an inner wire.
[[nodiscard]] constexpr bool isInnerWire(CurveKind kind) {
  return kind == CurveKind::Feature || kind == CurveKind::Elastic;
}
/// What the mesh is refined along: all but Mark and Guide.
[[nodiscard]] constexpr bool isWire(CurveKind kind) {
  return isCut(kind) || isInnerWire(kind);
}

/// A surface point as a design and its file hold it: by vertices and faces of the model alone, so
/// that it can be read before the model is known and does not depend on how edges are numbered.
struct ModelPoint {
  struct OnEdge {
    VertexId tail;   ///< the smaller of the two vertex indices
    VertexId head;   ///< the larger
    double t = 0.5;  ///< 0 < t < 1, from tail to head
    friend bool operator==(const OnEdge&, const OnEdge&) = default;
  };
  std::variant<VertexId, OnEdge, SurfacePoint::InFace> at;
  friend bool operator==(const ModelPoint&, const ModelPoint&) = default;
};
/// Lossless: toSurfacePoint(mesh, toModelPoint(mesh, p)) == p, bit for bit.
[[nodiscard]] ModelPoint toModelPoint(const Mesh& mesh, const SurfacePoint& point);
/// @return ModelMismatch when the mesh has no such vertex, edge or face; CurveInvalid when t or the
///   weights are out of range.
Result<SurfacePoint> toSurfacePoint(const Mesh& mesh, const ModelPoint& point);

// Places for control points that a person can write without a drawing program.

/// The landmark of that name.
struct AtLandmark {
  std::string name;
  UnknownKeys unknown{};
  friend bool operator==(const AtLandmark&, const AtLandmark&) = default;
};
/// A fraction of the length of a model curve.
struct OnModelCurve {
  std::string name;
  double fraction = 0;  ///< 0..1
  UnknownKeys unknown{};
  friend bool operator==(const OnModelCurve&, const OnModelCurve&) = default;
};
/// A fraction of the length of another styling curve of the design; circles are refused.
struct OnStylingCurve {
  std::string id;
  double fraction = 0;
  UnknownKeys unknown{};
  friend bool operator==(const OnStylingCurve&, const OnStylingCurve&) = default;
};
/// A plane, through a landmark or a point of the model, or at an offset along its normal. It means
/// the one loop of its section that passes the landmark or point; at an offset, the longest.
struct SectionPlane {
  Eigen::Vector3d normal{0, 0, 1};
  std::variant<Length, AtLandmark, ModelPoint> through = Length();
  UnknownKeys unknown{};
  friend bool operator==(const SectionPlane&, const SectionPlane&) = default;
};
/// The point of a plane section that lies farthest out in a direction from the section's centre
/// line: where the ray from the loop's centroid along `direction` leaves it.
struct OnSection {
  SectionPlane plane;
  Eigen::Vector3d direction{0, -1, 0};
  UnknownKeys unknown{};
  friend bool operator==(const OnSection&, const OnSection&) = default;
};
/// Closest surface point of a place in space, mm.
struct NearPosition {
  Eigen::Vector3d position;
  UnknownKeys unknown{};
  friend bool operator==(const NearPosition&, const NearPosition&) = default;
};

/// A place that stands by itself.
using SinglePlace =
    std::variant<ModelPoint, AtLandmark, OnModelCurve, OnStylingCurve, OnSection, NearPosition>;

/// A fraction of the shortest way on the surface between two places.
struct BetweenPlaces {
  std::array<SinglePlace, 2> ends;
  double fraction = 0.5;  ///< 0..1
  UnknownKeys unknown{};
  friend bool operator==(const BetweenPlaces&, const BetweenPlaces&) = default;
};

using Place = std::variant<ModelPoint, AtLandmark, OnModelCurve, OnStylingCurve, OnSection,
                           NearPosition, BetweenPlaces>;

/// Control points, subdivided and put on the surface by closest point.
struct SmoothWay {
  std::vector<Place> controls;
  SubdivisionRule rule = SubdivisionRule::Auto;
  std::vector<std::size_t> corners{};  ///< indices of sharp controls, ascending
  UnknownKeys unknown{};
  friend bool operator==(const SmoothWay&, const SmoothWay&) = default;
};
/// Control points on the plane of a view, subdivided there and projected.
struct ViewWay {
  View view;
  std::vector<Eigen::Vector2d> controls;
  SubdivisionRule rule = SubdivisionRule::Auto;
  std::vector<std::size_t> corners{};  ///< indices of sharp controls, ascending
  UnknownKeys unknown{};
  UnknownKeys unknownOfView{};
  friend bool operator==(const ViewWay&, const ViewWay&) = default;
};
/// A stretch of a model curve; the whole of a closed one when from = 0, to = 1.
struct AlongModelCurve {
  std::string name;
  double from = 0;
  double to = 1;
  UnknownKeys unknown{};
  friend bool operator==(const AlongModelCurve&, const AlongModelCurve&) = default;
};
/// Along mesh edges through these vertices, each joined to the next by an edge or else by a link.
struct AlongVertices {
  std::vector<VertexId> vertices;
  UnknownKeys unknown{};
  friend bool operator==(const AlongVertices&, const AlongVertices&) = default;
};
/// The whole loop of a plane section: a girth. It runs counter-clockwise seen from the tip of the
/// normal and starts at its front: where the ray from its centroid towards -y (+z if the normal is
/// nearly along y) leaves it.
struct AlongSection {
  SectionPlane plane;
  UnknownKeys unknown{};
  friend bool operator==(const AlongSection&, const AlongSection&) = default;
};
/// The shortest way through its places, without smoothing.
struct ShortestWay {
  std::vector<Place> controls;
  UnknownKeys unknown{};
  friend bool operator==(const ShortestWay&, const ShortestWay&) = default;
};

using CurveWay =
    std::variant<SmoothWay, ViewWay, AlongModelCurve, AlongVertices, AlongSection, ShortestWay>;

enum class SeamKind { Butt, Lapped, Hem };

/// How the cut line turns at the end of a side.
enum class CornerStyle {
  Mitre,     ///< both parallels prolonged until they meet
  Square,    ///< cut off square to the side, where its neighbour's allowance ends
  Mirrored,  ///< the neighbour's cut line mirrored in the sew line: lies flush when folded over
  Truncated  ///< cut across the corner, an allowance away from it
};

/// How a notch is cut or drawn.
enum class NotchKind { Slit, V, T, Castle, Check, U };

/// How one side of a curve is finished.
struct SeamSide {
  std::optional<Length> allowance;  ///< of the options otherwise
  SeamKind kind = SeamKind::Butt;
  std::optional<CornerStyle> corner;  ///< else: mirrored at a hem, that of the options elsewhere
  UnknownKeys unknown{};
  friend bool operator==(const SeamSide&, const SeamSide&) = default;
};

/// A designer's line. The way is how it was drawn; once put on the model, `dataPoints` are the
/// truth and are linked by geodesics; empty means: not yet put on the model (resolved when used).
struct StylingCurve {
  std::string id;  ///< unique in the design; [A-Za-z0-9_-]+
  std::string name;
  CurveKind kind = CurveKind::Seam;
  bool closed = false;
  CurveWay way;
  std::vector<ModelPoint> dataPoints;
  std::optional<std::string> mirrorOf;  ///< id of the curve whose mirror image this one is
  std::optional<Ratio> elasticRange;    ///< of an Elastic curve, either way
  SeamSide left;                        ///< seen from outside, walking along the curve
  SeamSide right;
  UnknownKeys unknown;
  friend bool operator==(const StylingCurve&, const StylingCurve&) = default;
};

/// By how much cloth is cut larger (> 0) or smaller than the body, in two directions on the
/// surface.
struct Ease {
  Ratio girth;   ///< across `along`: around the body
  Ratio length;  ///< along it
  /// "x", "y", "z" or the name of a model curve, whose direction at its nearest point is meant.
  std::string along = "z";
  UnknownKeys unknown{};
  [[nodiscard]] bool isNone() const { return girth == Ratio() && length == Ratio(); }
  friend bool operator==(const Ease&, const Ease&) = default;
};

/// Developable processing of a piece: of `amount` t, or as much as `maxAreaError` needs.
struct DevelopSetting {
  std::optional<Ratio> amount;  ///< 0..1
  std::optional<Ratio> maxAreaError;
  /// Least distance of the processed piece from the model; without it the piece may enter.
  std::optional<Length> gap;
  UnknownKeys unknown{};
  friend bool operator==(const DevelopSetting&, const DevelopSetting&) = default;
};

/// Which way the warp runs on a piece: the direction of an axis laid into the surface, turned
/// counter-clockwise seen from outside.
struct Grain {
  enum class Axis { X, Y, Z };
  Axis along = Axis::Z;
  Angle turn;
  UnknownKeys unknown{};
  friend bool operator==(const Grain&, const Grain&) = default;
};

enum class TwinMode {
  Identical,  ///< the mirror image of the other, to the last bit
  Mean        ///< both from the mean of the two sides of the model
};
/// What makes a piece the mirror image of another; without it each is true to its own side.
struct Twin {
  std::string of;  ///< id of the other piece's record
  TwinMode mode = TwinMode::Identical;
  UnknownKeys unknown{};
  friend bool operator==(const Twin&, const Twin&) = default;
};

/// Identity of a piece: the region in which the anchor lies.
struct PieceRecord {
  std::string id;
  std::string name;
  Place anchor;
  bool include = true;
  int count = 1;
  std::string fabric;        ///< id; empty = the first
  std::optional<Ease> ease;  ///< instead of the fabric's
  std::optional<DevelopSetting> develop;
  std::optional<Grain> grain;  ///< upright otherwise
  std::optional<Twin> twin;
  std::vector<std::string> boundary;  ///< ids of the curves around it, cyclic; empty = not noted
  UnknownKeys unknown;
  friend bool operator==(const PieceRecord&, const PieceRecord&) = default;
};

/// How pieces may be turned on a cloth when they are nested.
enum class Turns {
  OneWay,  ///< grain and nap: all pieces look the same way
  TwoWay,  ///< grain alone: also upside down
  Any      ///< neither, as on leather or foam
};

/// How much a fabric resists being strained, in shares of what cloth alike in all directions would.
struct ClothWeights {
  double along = 1, across = 1, shear = 1;  ///< 0.001..1000
  UnknownKeys unknown{};
  friend bool operator==(const ClothWeights&, const ClothWeights&) = default;
};

struct Fabric {
  std::string id;
  std::string name;
  std::string colour;                                       ///< "#rrggbb" or empty
  std::optional<Ratio> stretchAlong, stretchAcross, shear;  ///< limits
  std::optional<ClothWeights> weights;                      ///< of woven or knitted cloth
  Length thickness;
  /// Where in the cloth lengths are counted: 0 = the side on the body, 1 = the outer one.
  Ratio thicknessOffset;
  std::optional<Length> rollWidth;
  std::optional<Length> allowance;  ///< of pieces of it, instead of that of the options
  Turns turns = Turns::TwoWay;
  Ease ease;
  UnknownKeys unknown;
  friend bool operator==(const Fabric&, const Fabric&) = default;
};

struct Order {
  std::string style, size, customer;
  std::string date;  ///< ISO yyyy-mm-dd or empty
  UnknownKeys unknown;
  friend bool operator==(const Order&, const Order&) = default;
};

/// Which model a design was drawn on.
struct ModelReference {
  std::string reference;         ///< path relative to the design, or "builtin:..."
  std::optional<FileUnit> unit;  ///< of the mesh file
  std::optional<ContentHash> connectivityHash;
  UnknownKeys unknown;
  friend bool operator==(const ModelReference&, const ModelReference&) = default;
};

/// How the pieces are finished, unless a curve says otherwise.
struct FinishSettings {
  Length allowance = Length::mm(10);
  Length notchDepth = Length::mm(4);
  Length notchSpacing = Length::mm(150);   ///< about one notch per so much of seam
  std::optional<Length> hemAllowance;      ///< of sides of kind hem, instead of `allowance`
  std::optional<Length> lappedAllowance;   ///< of sides of kind lapped
  std::optional<Length> openingAllowance;  ///< along openings: where a zip goes in
  CornerStyle corner = CornerStyle::Mitre;
  NotchKind notchKind = NotchKind::Slit;
  Length notchWidth = Length::mm(4);  ///< at the edge, of kinds other than a slit
  bool halfOnFold = false;            ///< symmetric pieces are cut as halves on folded cloth
  UnknownKeys unknown;
  friend bool operator==(const FinishSettings&, const FinishSettings&) = default;
};

/// Where a hand put a piece on the sheet: moved and turned from its place on the guiding map, so
/// that it means the same on another body.
struct HandPlacement {
  std::string piece;                               ///< id
  Eigen::Vector2d move = Eigen::Vector2d::Zero();  ///< mm on the sheet, of the piece's centre
  Angle turn;                                      ///< counter-clockwise about its centre
  UnknownKeys unknown{};
  friend bool operator==(const HandPlacement&, const HandPlacement&) = default;
};

struct Design {
  std::string name;
  std::vector<ModelReference> models;  ///< the first is the one it was drawn on
  std::vector<StylingCurve> curves;
  std::vector<PieceRecord> pieces;
  std::vector<Fabric> fabrics;
  Order order;
  FinishSettings finish;
  std::vector<HandPlacement> layout;  ///< pieces that the layout leaves where a hand put them
  UnknownKeys unknown;                ///< layers, options of later versions
  friend bool operator==(const Design&, const Design&) = default;
};

/// The record of a piece by its id; null for a new piece.
[[nodiscard]] const PieceRecord* recordOf(const Design& design, const std::string& id);
/// The fabric that a piece of this record is made of; null when the design has none.
[[nodiscard]] const Fabric* fabricOf(const Design& design, const PieceRecord* record);

/// A Design with the models it is used on; a value.
struct Document {
  std::shared_ptr<const Design> design;
  std::shared_ptr<const ReferenceModel> model;  ///< the one that pieces are made for
};

/// A styling curve put on a model.
struct PlacedCurve {
  std::string id;
  CurveKind kind = CurveKind::Seam;
  std::vector<SurfacePoint> dataPoints;
  SurfacePath path;  ///< the data points linked by geodesics; on the surface everywhere
};

/// Puts every curve of the design on the model, in the design's order.
///
/// A curve with data points uses them (they mean the same place on any model of the connectivity
/// that the design was drawn on); one without is resolved from its way; `mirrorOf` without data
/// points is mirrored by the model's symmetry pairing.
/// @return NameNotFound, LeavesSilhouette, CurveInvalid naming the curve; ModelMismatch when the
/// model
///   has another connectivity than the design's and the design holds surface points.
Result<std::vector<PlacedCurve>> placeCurves(const Design& design, const ReferenceModel& model);

/// The same for some of the curves, by id, and those that they hang on; for editing, with a linker
/// of that model's mesh that is kept. The result has the order of the ids.
Result<std::vector<PlacedCurve>> placeCurves(const Design& design, const ReferenceModel& model,
                                             std::span<const std::string> ids,
                                             GeodesicLinker& linker);

/// One place on the model; `placed` are the curves that OnStylingCurve may name.
Result<SurfacePoint> resolvePlace(const Place& place, const ReferenceModel& model,
                                  const std::vector<PlacedCurve>& placed);

}  // namespace toile
