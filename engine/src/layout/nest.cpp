// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates: of an outline as it is given; of a shape: turned, mirrored, grown by half the gap,
// its box at the origin; of the bin: the material less its margin plus half a gap all round, so
// that grown outlines may touch its edges.
#include "toile/layout/nest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <polyclipping/clipper.hpp>

#include "layout/clearance.h"
#include "layout/nest_compact.h"
#include "layout/nest_fill.h"

namespace toile {
namespace {

using Eigen::Vector2d;
using nesting::Copy;
using nesting::RowShape;

constexpr double kGrowTolerance = 0.05;  // mm
constexpr double kFar = 1e7;             // mm, beyond every material
constexpr std::size_t kMostCopies = 5000;

Vector2d mirrored(const Vector2d& p) {
  return {-p.x(), p.y()};
}

Points2 placedOutline(const NestPart& part, const NestPlace& place) {
  Points2 out;
  for (const Vector2d& p : part.outline) out.push_back(place.apply(p));
  if (place.mirrored) std::reverse(out.begin(), out.end());
  return out;
}

/// The angle at which the outline's box is smallest.
double boxAngle(const Points2& outline) {
  double best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree < 90; ++degree) {
    const Placement turn{degree * std::numbers::pi / 180, Vector2d::Zero()};
    Points2 turned;
    for (const Vector2d& p : outline) turned.push_back(turn.apply(p));
    const Vector2d size = boxOf(turned).size();
    if (size.x() * size.y() < least) {
      least = size.x() * size.y();
      best = turn.angle;
    }
  }
  return best;
}

class Problem {
 public:
  Problem(std::span<const NestPart> parts, const NestMaterial& material, const NestOptions& options)
      : parts_(parts), material_(material), options_(options) {}

  Result<Nesting> solve(Progress* progress) {
    if (const Result<void> fine = check(); !fine) return fine.error();
    makeShapes();
    if (const Result<void> fine = makeBin(); !fine) return fine.error();
    if (const Result<void> fine = checkFit(); !fine) return fine.error();
    const nesting::Filler filler(shapes_, copies_, bin_);
    const auto tell = [&](double length) {
      if (options_.onBetter) options_.onBetter(std::max(0.0, length - options_.gap));
    };
    const int rounds =
        options_.effort <= 0
            ? 0
            : static_cast<int>(std::min(1e6, 250.0 * std::pow(2.0, options_.effort) /
                                                 static_cast<double>(copies_.size())));
    const std::optional<nesting::Fill> fill = searchFill(filler, rounds, tell, progress);
    if (isCancelled(progress))
      return Error{ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
    if (!fill)
      return Error{ErrorCode::InvalidArgument,
                   material_.hide.empty()
                       ? "the pieces do not fit on the material"
                       : "the pieces do not all fit on the hide; lay some on another one",
                   {}};
    return take(*fill);
  }

 private:
  Result<void> check() const {
    const auto fail = [](std::string what) {
      return Error{ErrorCode::InvalidArgument, std::move(what), {}};
    };
    const auto isSize = [](double mm) { return mm > 0 && mm <= 1e6; };
    if (!isSize(material_.width) || (material_.length && !isSize(*material_.length)))
      return fail("width and length of a material are more than 0 mm and at most 1 km");
    if (!(options_.gap >= 0 && options_.gap <= 1000 && options_.margin >= 0 &&
          options_.margin <= 1000))
      return fail("gap and margin are 0 to 1000 mm");
    if (options_.effort < 0 || options_.effort > kMostEffort)
      return fail(fmt::format("the effort is 0 to {}", kMostEffort));
    std::size_t copies = 0;
    for (const NestPart& part : parts_) {
      if (part.count < 0 || part.mirrored < 0) return fail("a number of copies is negative");
      copies += static_cast<std::size_t>(part.count) + static_cast<std::size_t>(part.mirrored);
      const bool isFinite = std::all_of(part.outline.begin(), part.outline.end(),
                                        [](const Vector2d& p) { return p.allFinite(); });
      if (part.outline.size() < 3 || !isFinite || !(signedArea(part.outline) > 0))
        return fail(fmt::format(
            "piece \"{}\" has no outline that can be cut (a closed line, counter-clockwise)",
            part.name));
      if (const auto crossing = findSelfCrossing(part.outline))
        return fail(fmt::format("the outline of piece \"{}\" crosses itself at ({:.1f}, {:.1f}) mm",
                                part.name, crossing->x(), crossing->y()));
    }
    if (copies == 0) return fail("there is nothing to nest");
    if (copies > kMostCopies)
      return fail(
          fmt::format("{} copies are more than one marker takes ({})", copies, kMostCopies));
    return {};
  }

  [[nodiscard]] std::vector<double> turnsOf(const NestPart& part) const {
    const double along = -part.grain;
    if (part.onFold || part.turns == Turns::OneWay) return {along};
    if (part.turns == Turns::TwoWay) return {along, along + std::numbers::pi};
    std::vector<double> turns;
    const double upright = boxAngle(part.outline);
    for (int k = 0; k < 8; ++k) turns.push_back(upright + k * std::numbers::pi / 4);
    return turns;
  }

  void makeShapes() {
    std::vector<double> areas;
    for (const NestPart& part : parts_) areas.push_back(signedArea(part.outline));
    std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2),
                     areas.end());
    bin_.rowHeight = std::clamp(std::sqrt(areas[areas.size() / 2]) / 40, 2.0, 8.0);
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
      const NestPart& part = parts_[p];
      for (const bool isMirrored : {false, true}) {
        const int count = isMirrored ? part.mirrored : part.count;
        if (count == 0) continue;
        Copy copy;
        copy.kind = 2 * p + (isMirrored ? 1 : 0);
        copy.onFold = part.onFold;
        // A copy turned over has its grain turned over.
        NestPart turned = part;
        if (isMirrored) {
          turned.grain = std::numbers::pi - part.grain;
          for (Vector2d& q : turned.outline) q = mirrored(q);
          std::reverse(turned.outline.begin(), turned.outline.end());
        }
        for (const double angle : turnsOf(turned)) {
          copy.shapes.push_back(static_cast<std::uint32_t>(shapes_.size()));
          addShape(turned.outline, angle, part.onFold);
        }
        copies_.insert(copies_.end(), static_cast<std::size_t>(count), copy);
        places_.insert(places_.end(), static_cast<std::size_t>(count),
                       NestPlace{p, isMirrored, 0, {}});
      }
    }
  }

  void addShape(const Points2& outline, double angle, bool onFold) {
    const Placement turn{angle, Vector2d::Zero()};
    Points2 turned;
    for (const Vector2d& p : outline) turned.push_back(turn.apply(p));
    Points2 grownBy = grown(turned, 0.5 * options_.gap, kGrowTolerance);
    // Nothing lies beyond the fold: half a gap there to the last bit brings the edge onto it.
    if (onFold)
      for (Vector2d& p : grownBy)
        p.y() = std::max(p.y(), boxOf(turned).min.y() - 0.5 * options_.gap);
    shapes_.push_back(nesting::makeRowShape(grownBy, bin_.rowHeight));
    angles_.push_back(angle);
    grown_.push_back(std::move(grownBy));
  }

  Result<void> makeBin() {
    const double inset = options_.margin - 0.5 * options_.gap;
    // A fold has no margin: the halves lie on it.
    isFolded_ =
        std::any_of(parts_.begin(), parts_.end(), [](const NestPart& part) { return part.onFold; });
    origin_ = {inset, isFolded_ ? -0.5 * options_.gap : inset};
    Vector2d size(material_.length.value_or(kFar), material_.width);
    if (!material_.hide.empty()) {
      if (material_.hide.size() < 3 || !(signedArea(material_.hide) > 0))
        return Error{ErrorCode::InvalidArgument,
                     "the hide has no outline (a closed line, counter-clockwise)",
                     {}};
      size = boxOf(material_.hide).max;
    }
    bin_.height = size.y() - inset - origin_.y();
    if (material_.length || !material_.hide.empty()) bin_.length = size.x() - 2 * inset;
    constexpr std::uint32_t kMostSheets = 1000;  // more than anybody lays
    if (material_.length && material_.hide.empty()) bin_.mostSheets = kMostSheets;
    if (material_.hide.empty() && material_.faults.empty()) return {};
    // What may not be covered, as rows of the bin.
    const int count = static_cast<int>(std::ceil(bin_.height / bin_.rowHeight)) + 1;
    std::vector<Points2> polygons;
    for (const Points2& fault : material_.faults) {
      if (fault.size() < 3) continue;
      polygons.push_back(fault);
      if (signedArea(fault) < 0) std::reverse(polygons.back().begin(), polygons.back().end());
      for (Vector2d& p : polygons.back()) p -= origin_;
      faults_.push_back(polygons.back());
    }
    if (!material_.hide.empty()) addOutsideOfHide(inset, polygons);
    const nesting::Rows blocked = nesting::coveringRows(polygons, bin_.rowHeight, count);
    for (const RowShape& shape : shapes_)
      bin_.blocked.push_back(nesting::noFitRows(blocked, shape.rows));
    return {};
  }

  /// The plane round the hide, cut into two polygons at its leftmost and rightmost points.
  void addOutsideOfHide(double inset, std::vector<Points2>& polygons) const {
    constexpr double kSteps = 1e4;
    ClipperLib::Path hide;
    for (const Vector2d& p : material_.hide)
      hide.emplace_back(std::llround((p.x() - origin_.x()) * kSteps),
                        std::llround((p.y() - origin_.y()) * kSteps));
    ClipperLib::ClipperOffset offset(2, kGrowTolerance * kSteps);
    offset.AddPath(hide, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths inner;
    offset.Execute(inner, -inset * kSteps);
    const auto far = static_cast<ClipperLib::cInt>(2e6 * kSteps);
    const ClipperLib::cInt middle = hide.front().X;
    for (const bool left : {true, false}) {
      const ClipperLib::Path half{{left ? -far : middle, -far},
                                  {left ? middle : far, -far},
                                  {left ? middle : far, far},
                                  {left ? -far : middle, far}};
      ClipperLib::Clipper clipper;
      clipper.AddPath(half, ClipperLib::ptSubject, true);
      clipper.AddPaths(inner, ClipperLib::ptClip, true);
      ClipperLib::Paths outside;
      clipper.Execute(ClipperLib::ctDifference, outside);
      for (const ClipperLib::Path& path : outside) {
        Points2 polygon;
        for (const ClipperLib::IntPoint& p : path)
          polygon.emplace_back(static_cast<double>(p.X) / kSteps,
                               static_cast<double>(p.Y) / kSteps);
        polygons.push_back(std::move(polygon));
      }
    }
  }

  Result<void> checkFit() const {
    for (std::size_t c = 0; c < copies_.size(); ++c) {
      const std::vector<std::uint32_t>& shapes = copies_[c].shapes;
      const bool fits = std::any_of(shapes.begin(), shapes.end(), [&](std::uint32_t s) {
        return shapes_[s].height <= bin_.height + 1e-9 &&
               (!bin_.length || shapes_[s].width <= *bin_.length + 1e-9);
      });
      if (fits) continue;
      double least = shapes_[shapes.front()].height;
      for (const std::uint32_t s : shapes) least = std::min(least, shapes_[s].height);
      const std::string& name = parts_[places_[c].part].name;
      if (least > bin_.height)
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("piece \"{}\" is {:.0f} mm wide across the grain and the "
                                 "material has {:.0f} mm for it; take wider material, or part "
                                 "the piece by a seam",
                                 name, least - options_.gap, bin_.height - options_.gap),
                     {}};
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("piece \"{}\" is longer than the material ({:.0f} mm)", name,
                               *bin_.length - options_.gap),
                   {}};
    }
    return {};
  }

  Result<Nesting> take(const nesting::Fill& fill) {
    Nesting nesting;
    nesting.places = places_;
    std::vector<std::vector<std::uint32_t>> onSheet(1);
    std::vector<Points2> outline(copies_.size());
    for (std::size_t i = 0; i < fill.order.size(); ++i) {
      const std::uint32_t copy = fill.order[i];
      const nesting::Placed& at = fill.places[i];
      const Vector2d corner = boxOf(grown_[at.shape]).min;
      const Vector2d shift = Vector2d(at.x, at.row * bin_.rowHeight) - corner;
      nesting.places[copy].sheet = at.sheet;
      nesting.places[copy].placement = {angles_[at.shape], shift};
      outline[copy] = grown_[at.shape];
      for (Vector2d& p : outline[copy]) p += shift;
      onSheet.resize(std::max<std::size_t>(onSheet.size(), at.sheet + 1));
      onSheet[at.sheet].push_back(copy);
    }
    if (material_.hide.empty()) {
      for (std::vector<std::uint32_t>& sheet : onSheet) {
        std::sort(sheet.begin(), sheet.end());
        std::vector<nesting::Lying> lying;
        for (const std::uint32_t copy : sheet)
          lying.push_back({outline[copy], copies_[copy].onFold});
        const std::vector<Vector2d> moved = nesting::compact(std::move(lying), faults_);
        for (std::size_t i = 0; i < sheet.size(); ++i)
          nesting.places[sheet[i]].placement.offset += moved[i];
      }
    }
    for (NestPlace& place : nesting.places) place.placement.offset += origin_;
    nesting.sheets = static_cast<std::uint32_t>(onSheet.size());
    return measure(std::move(nesting), onSheet);
  }

  /// The promise, on the true lines; and the figures.
  Result<Nesting> measure(Nesting nesting,
                          const std::vector<std::vector<std::uint32_t>>& onSheet) const {
    constexpr double kRoundingMm = 1e-3;
    std::vector<Points2> cut;
    std::vector<Box2> box;
    for (const NestPlace& place : nesting.places) {
      cut.push_back(placedOutline(parts_[place.part], place));
      box.push_back(boxOf(cut.back()));
      nesting.area += signedArea(cut.back());
    }
    const auto broken = [&](std::uint32_t copy) {
      return Error{ErrorCode::NotConverged,
                   fmt::format("piece \"{}\" does not keep its distance in the marker; please "
                               "report it",
                               parts_[nesting.places[copy].part].name),
                   {}};
    };
    for (const std::vector<std::uint32_t>& sheet : onSheet) {
      for (std::size_t i = 0; i < sheet.size(); ++i) {
        const std::uint32_t a = sheet[i];
        const double low = isFolded_ ? 0 : options_.margin;
        if (box[a].min.x() < options_.margin - kRoundingMm || box[a].min.y() < low - kRoundingMm ||
            box[a].max.y() > size().y() - options_.margin + kRoundingMm ||
            box[a].max.x() > size().x() - options_.margin + kRoundingMm)
          return broken(a);
        for (std::size_t j = 0; j < i; ++j) {
          const std::uint32_t b = sheet[j];
          if ((box[a].min - box[b].max).maxCoeff() > options_.gap ||
              (box[b].min - box[a].max).maxCoeff() > options_.gap)
            continue;
          const double distance = distanceBetween(cut[a], cut[b]);
          if (distance < options_.gap - kRoundingMm) return broken(a);
        }
        for (const Points2& fault : material_.faults)
          if (fault.size() >= 3 && distanceBetween(cut[a], fault) <= 0) return broken(a);
        if (!material_.hide.empty() &&
            !std::all_of(cut[a].begin(), cut[a].end(),
                         [&](const Vector2d& p) { return isInside({material_.hide}, p); }))
          return broken(a);
      }
    }
    for (const std::uint32_t copy : onSheet.back())
      nesting.length = std::max(nesting.length, box[copy].max.x() + options_.margin);
    const double full = (nesting.sheets - 1) * material_.length.value_or(0) * material_.width;
    const double material = material_.hide.empty() ? full + nesting.length * material_.width
                                                   : signedArea(material_.hide);
    nesting.utilisation = nesting.area / material;
    nesting.bound = nesting.area / material_.width;
    return nesting;
  }
  [[nodiscard]] Vector2d size() const {
    if (!material_.hide.empty()) return boxOf(material_.hide).max;
    return {material_.length.value_or(kFar), material_.width};
  }

  std::span<const NestPart> parts_;
  const NestMaterial& material_;
  const NestOptions& options_;
  std::vector<RowShape> shapes_;
  std::vector<double> angles_;
  std::vector<Points2> grown_;
  std::vector<Copy> copies_;
  std::vector<NestPlace> places_;
  nesting::Bin bin_;
  Vector2d origin_ = Vector2d::Zero();
  bool isFolded_ = false;
  std::vector<Points2> faults_;
};

}  // namespace

Vector2d NestPlace::apply(const Vector2d& p) const {
  return placement.apply(mirrored ? toile::mirrored(p) : p);
}

Result<Nesting> nest(std::span<const NestPart> parts, const NestMaterial& material,
                     const NestOptions& options, Progress* progress) {
  return Problem(parts, material, options).solve(progress);
}

}  // namespace toile
