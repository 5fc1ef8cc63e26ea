// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/scan/clean_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/judge.h"
#include "scan/invented.h"
#include "scan/parts.h"
#include "scan/poisson.h"
#include "scan/remesh.h"
#include "scan/stand.h"
#include "scan/units_question.h"
#include "toile/core/parallel.h"
#include "toile/mesh/mesh_check.h"

namespace toile {
namespace {

using namespace scanning;
using fitting::Target;

constexpr double kBodyEdge = 8;           // mm
constexpr double kObjectEdge = 1. / 200;  // of the diagonal
// Of the diagonal: shorter edges make more triangles than anyone can use, longer ones no shape.
constexpr double kShortestEdge = 1. / 3000;
constexpr double kLongestEdge = 1. / 20;
/// Of the edge length: the points that the surface is made from.
constexpr double kSpacing = 0.7;
/// Parts hang together over gaps of that share of the diagonal, or of what holds eight neighbours.
constexpr double kLink = 1. / 150;
constexpr double kLinkOfReach = 1.5;
/// Of the largest part: smaller ones fly about; so large ones are another thing.
constexpr double kSpeck = 0.02;
constexpr double kAnother = 0.3;
/// Of the diagonal: points farther apart do not show a hand (of a body), a shape (of an object).
constexpr double kSparseBody = 1. / 110;
constexpr double kSparseObject = 1. / 60;
/// Smaller invented places are not told one by one, mm2.
constexpr double kSmallPatch = 100;
/// A bubble of the reconstruction, of the largest part's faces.
constexpr double kBubble = 0.02;
/// A scan turned by less stands upright.
constexpr double kUpright = 5;  // degrees

Error refuse(ErrorCode code, std::string message) {
  return {code, std::move(message), {}};
}

/// Without the parts that have few faces.
Result<Mesh> withoutBubbles(const Mesh& mesh) {
  std::vector<std::uint32_t> partOf(mesh.faceCount(), 0);
  std::vector<std::size_t> size{0};
  for (std::size_t seed = 0; seed < mesh.faceCount(); ++seed) {
    if (partOf[seed] != 0) continue;
    const auto number = static_cast<std::uint32_t>(size.size());
    std::vector<FaceId> faces{FaceId(seed)};
    partOf[seed] = number;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId across = mesh.opposite(mesh.halfedge(faces[i], k));
        if (!across.isValid() || partOf[mesh.face(across).index()] != 0) continue;
        partOf[mesh.face(across).index()] = number;
        faces.push_back(mesh.face(across));
      }
    }
    size.push_back(faces.size());
  }
  if (size.size() == 2) return mesh;
  const double least = kBubble * static_cast<double>(*std::max_element(size.begin(), size.end()));
  std::vector<VertexId> renamed(mesh.vertexCount());
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    if (static_cast<double>(size[partOf[f]]) < least) continue;
    Triangle t = mesh.vertices(FaceId(f));
    for (VertexId& v : t) {
      VertexId& name = renamed[v.index()];
      if (!name.isValid()) {
        name = VertexId(positions.size());
        positions.push_back(mesh.position(v));
      }
      v = name;
    }
    triangles.push_back(t);
  }
  return makeMesh(std::move(positions), std::move(triangles));
}

class Cleaner {
 public:
  Cleaner(const Scan& scan, const CleanOptions& options, Progress* progress)
      : scan_(scan), options_(options), progress_(progress) {}

  Result<CleanedScan> run() {
    cleaned_.report.points = scan_.points.size();
    cleaned_.report.findings = scan_.findings;
    for (const auto stage : {&Cleaner::sortOut, &Cleaner::standUp, &Cleaner::checkDensity,
                             &Cleaner::makeSurface, &Cleaner::tellInvented, &Cleaner::tellShape}) {
      if (isCancelled(progress_)) {
        return refuse(ErrorCode::Cancelled, "the cleaning was cancelled");
      }
      if (const Result<void> done = (this->*stage)(); !done) return done.error();
    }
    return std::move(cleaned_);
  }

 private:
  [[nodiscard]] bool isBody() const { return options_.kind == ScanKind::Body; }
  void step(std::string_view name) {
    if (progress_ != nullptr) progress_->step(name);
  }
  void find(std::string code, std::string message) {
    cleaned_.report.findings.push_back({std::move(code), std::move(message), {}});
  }

  /// Leaves out lone points and small parts; for a body also what is not on it.
  Result<void> sortOut() {
    step("scan: parts");
    if (scan_.points.size() < 100) {
      return refuse(ErrorCode::InvalidArgument,
                    fmt::format("{} has {} points; a scan needs 100 or more", scan_.name,
                                scan_.points.size()));
    }
    diagonal_ = extentWithoutSpecks(scan_.points);
    if (!(diagonal_ > 0) || !std::isfinite(diagonal_)) {
      return refuse(ErrorCode::InvalidArgument,
                    fmt::format("the points of {} all lie in one place", scan_.name));
    }
    kept_ = scan_;
    if (!scan_.triangles.empty() && !isConsistentlyOriented(scan_)) {
      find("scan-mixed-faces",
           "the faces do not agree on an outside: it was found anew from the points");
      kept_ = spreadOut(scan_);
    }
    double link = kLink * diagonal_;
    if (kept_.triangles.empty()) {
      const Crowding crowding = findCrowding(kept_.points);
      link = std::max(link, kLinkOfReach * crowding.reach);
      const std::size_t before = kept_.points.size();
      kept_ = keepPoints(kept_, [&](std::size_t i) { return crowding.isAlone[i] == 0; });
      cleaned_.report.lonePoints = before - kept_.points.size();
    }
    parts_ = findParts(kept_, link);
    return isBody() ? findBody() : keepLargeParts();
  }

  /// The points on the faces, evenly, without the faces.
  [[nodiscard]] Scan spreadOut(const Scan& scan) const {
    const std::vector<Eigen::Vector3d> up(scan.points.size(), Eigen::Vector3d::UnitZ());
    return {scan.name,
            spreadEvenly(scan, up, std::max(edge(), kShortestEdge * diagonal_)).points,
            {},
            {}};
  }

  [[nodiscard]] double edge() const {
    if (options_.edge) return options_.edge->mm();
    return isBody() ? kBodyEdge : kObjectEdge * diagonal_;
  }

  [[nodiscard]] Scan partsFrom(double leastSize) const {
    return keepPoints(kept_, [&](std::size_t i) {
      return static_cast<double>(parts_.size[parts_.ofPoint[i]]) >= leastSize;
    });
  }

  void countFlying(const std::vector<char>& isPartKept) {
    for (const char isKept : isPartKept) {
      if (isKept == 0) ++cleaned_.report.flyingParts;
    }
    for (const std::uint32_t part : parts_.ofPoint) {
      if (isPartKept[part] == 0) ++cleaned_.report.flyingPoints;
    }
    kept_ = keepPoints(kept_, [&](std::size_t i) { return isPartKept[parts_.ofPoint[i]] != 0; });
    if (cleaned_.report.flyingParts == 0) return;
    find("scan-flying-parts",
         fmt::format("{} loose parts with {} points were left out", cleaned_.report.flyingParts,
                     cleaned_.report.flyingPoints));
  }

  Result<void> keepLargeParts() {
    const double least = kSpeck * static_cast<double>(parts_.size.front());
    std::vector<char> isPartKept;
    for (const std::size_t size : parts_.size) {
      isPartKept.push_back(static_cast<double>(size) >= least ? 1 : 0);
    }
    const auto count = std::count(isPartKept.begin(), isPartKept.end(), char{1});
    countFlying(isPartKept);
    if (count > 1) {
      find("scan-parts", fmt::format("the scan is of {} separate parts; all are kept", count));
    }
    target_ = fitting::makeTarget(kept_);
    return {};
  }

  /// The largest part should be a person; if it is not, all of them together.
  Result<void> findBody() {
    step("scan: posture");
    const auto largest = static_cast<double>(parts_.size.front());
    for (const double least : {largest, kSpeck * largest}) {
      Target target = fitting::makeTarget(partsFrom(least));
      Result<Stand> stand = findStand(target, progress_);
      if (!stand) return stand.error();
      if (!stand_ || stand->placement.score < stand_->placement.score) {
        stand_ = *std::move(stand);
        target_ = std::move(target);
      }
      if (stand_->isPerson()) break;
    }
    if (!stand_->isPerson()) {
      return refuse(
          ErrorCode::InvalidArgument,
          fmt::format("{} does not look like one whole person, standing, with arms and legs apart "
                      "(it lies {:.2f} from one; below {:.2f} is near): is it part of one, several "
                      "people, another posture or something else? --kind object takes it as it is",
                      scan_.name, stand_->placement.score, Stand::kMostScore));
    }
    const double height = stand_->height();
    if (height < kShortestPerson || height > kTallestPerson) {
      return askForUnit(scan_.name, "tall", height, FileUnit::Millimetre, /*isPerson=*/true);
    }
    // A part belongs to the body when its middle does.
    std::vector<char> isPartKept(parts_.size.size(), 0);
    std::vector<std::size_t> near(parts_.size.size(), 0), looked(parts_.size.size(), 0);
    const std::size_t step = std::max<std::size_t>(1, kept_.points.size() / 20000);
    std::vector<std::size_t> seen(parts_.size.size(), 0);
    for (std::size_t i = 0; i < kept_.points.size(); ++i) {
      const std::uint32_t part = parts_.ofPoint[i];
      if (seen[part]++ % step != 0) continue;
      ++looked[part];
      if (stand_->isNear(kept_.points[i])) ++near[part];
    }
    for (std::size_t part = 0; part < parts_.size.size(); ++part) {
      const auto size = static_cast<double>(parts_.size[part]);
      const bool isOnBody = 2 * near[part] > looked[part];
      isPartKept[part] = isOnBody && size >= kSpeck * largest ? 1 : 0;
      if (!isOnBody && size >= kAnother * largest) {
        return refuse(ErrorCode::InvalidArgument,
                      fmt::format("beside the person {} holds something else of {:.0f} % of that "
                                  "size: another person? Give one file for each",
                                  scan_.name, 100 * size / largest));
      }
    }
    countFlying(isPartKept);
    if (kept_.points.size() != target_->points.size()) target_ = fitting::makeTarget(kept_);
    return {};
  }

  /// Turns the normals outward and the points upright.
  Result<void> standUp() {
    if (isInsideOut()) {
      for (Eigen::Vector3d& n : target_->normals) n = -n;
      for (Triangle& t : kept_.triangles) std::swap(t[1], t[2]);
      if (const Result<void> done = explainInwardFaces(); !done) return done.error();
    } else if (hasBeenTurned()) {
      if (const Result<void> done = explainInwardFaces(); !done) return done.error();
    }
    if (!stand_) return {};
    cleaned_.standing.linear() = stand_->placement.similarity.rotation.transpose();
    cleaned_.standing.translation() =
        -cleaned_.standing.linear() * stand_->placement.similarity.shift;
    const double angle =
        Eigen::AngleAxisd(stand_->placement.similarity.rotation).angle() * 180 / M_PI;
    if (angle > kUpright) {
      const Eigen::Vector3d up = stand_->placement.similarity.rotation.col(2);
      Eigen::Index axis = 0;
      up.cwiseAbs().maxCoeff(&axis);
      find("scan-turned",
           fmt::format("stood upright and facing front, turned by {:.0f} degrees; in the file up "
                       "is {}{}",
                       angle, up[axis] > 0 ? "+" : "-", "xyz"[axis]));
    }
    return {};
  }

  [[nodiscard]] bool isInsideOut() const {
    if (stand_) return stand_->placement.scanIsInsideOut;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : target_->points) middle += p;
    middle /= static_cast<double>(target_->points.size());
    double volume = 0;
    for (std::size_t i = 0; i < target_->points.size(); ++i) {
      volume += target_->area[i] * target_->normals[i].dot(target_->points[i] - middle);
    }
    return volume < 0;
  }

  /// By the reader, of a closed surface.
  [[nodiscard]] bool hasBeenTurned() const {
    return std::any_of(scan_.findings.begin(), scan_.findings.end(),
                       [](const Finding& f) { return f.code == "turned-surface"; });
  }

  Result<void> explainInwardFaces() {
    if (kept_.triangles.empty()) return {};  // the sides of a cloud mean nothing
    switch (options_.inwardFaces) {
      case InwardFaces::Ask:
        return refuse(ErrorCode::NotOrientable,
                      fmt::format("the faces of {} look inwards: either they alone are turned, or "
                                  "the whole scan is a mirror image, left for right. Which is it? "
                                  "--inward-faces turned, or --inward-faces mirrored",
                                  scan_.name));
      case InwardFaces::Turned:
        find("scan-faces-turned", "the faces were turned outward");
        break;
      case InwardFaces::Mirrored:
        mirrorBack();
        break;
    }
    return {};
  }

  /// Across the plane between left and right of a body, across x of an object.
  void mirrorBack() {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
    Eigen::Vector3d on = Eigen::Vector3d::Zero();
    if (stand_) {
      normal = stand_->placement.similarity.rotation.col(0);
      on = stand_->placement.similarity.shift;
    }
    for (Eigen::Vector3d& p : target_->points) p -= 2 * normal.dot(p - on) * normal;
    for (Eigen::Vector3d& n : target_->normals) n -= 2 * normal.dot(n) * normal;
    for (Triangle& t : kept_.triangles) std::swap(t[1], t[2]);
    find("scan-mirrored-back", "the scan was mirrored back, left for right");
  }

  Result<void> checkDensity() {
    if (options_.edge && (options_.edge->mm() < kShortestEdge * diagonal_ ||
                          options_.edge->mm() > kLongestEdge * diagonal_)) {
      return refuse(
          ErrorCode::InvalidArgument,
          fmt::format("an edge length of {:.4g} mm is out of range for {}, which is {:.4g} "
                      "mm across: {:.4g} to {:.4g} mm",
                      options_.edge->mm(), scan_.name, diagonal_, kShortestEdge * diagonal_,
                      kLongestEdge * diagonal_));
    }
    const double area = fitting::quantile(target_->area, 0.5);
    const double most = (isBody() ? kSparseBody : kSparseObject) * diagonal_;
    cloudSpacing_ = target_->isCloud ? std::sqrt(area) : 0;
    if (cloudSpacing_ > most) {
      return refuse(ErrorCode::InvalidArgument,
                    fmt::format("the points of {} lie {:.3g} mm apart; {:.3g} mm or less is needed "
                                "to see its shape",
                                scan_.name, cloudSpacing_, most));
    }
    return {};
  }

  Result<void> makeSurface() {
    step("scan: surface");
    Scan standing{scan_.name, {}, kept_.triangles, {}};
    for (const Eigen::Vector3d& p : target_->points) {
      standing.points.push_back(cleaned_.standing * p);
    }
    for (Eigen::Vector3d& n : target_->normals) n = cleaned_.standing.linear() * n;
    points_ = spreadEvenly(standing, target_->normals, kSpacing * edge());
    points_.spacing = std::max(points_.spacing, cloudSpacing_);
    const Result<Mesh> rough = reconstruct(points_, edge(), progress_);
    if (!rough) return rough.error();
    const Result<Mesh> whole = withoutBubbles(*rough);
    if (!whole) return whole.error();
    if (isCancelled(progress_)) return {};
    step("scan: triangles");
    Result<Mesh> even = remeshEvenly(*whole, edge());
    if (!even) return even.error();
    // On the floor.
    const Eigen::Vector3d lift(0, 0, -even->boxMin().z());
    std::vector<Eigen::Vector3d> positions = even->positions();
    for (Eigen::Vector3d& p : positions) p += lift;
    for (Eigen::Vector3d& p : points_.points) p += lift;
    cleaned_.standing.pretranslate(lift);
    cleaned_.model = makeReferenceModel(scan_.name, even->withPositions(std::move(positions)));
    return {};
  }

  Result<void> tellInvented() {
    step("scan: report");
    const Mesh& mesh = *cleaned_.model.mesh;
    CleanReport& report = cleaned_.report;
    double total = 0;
    for (std::size_t f = 0; f < mesh.faceCount(); ++f) total += mesh.area(FaceId(f));
    int number = 0;
    for (const Invented& one : findInvented(mesh, points_)) {
      report.inventedArea += one.area;
      if (one.area < kSmallPatch) continue;
      report.invented.push_back({describe(one), one.centre, one.area});
      for (const SurfacePath& border : one.borders) {
        cleaned_.model.curves[fmt::format("invented {}", ++number)] = border;
      }
    }
    report.inventedShare = report.inventedArea / total;
    if (report.inventedShare > options_.mostInvented.value()) {
      return refuse(
          ErrorCode::InvalidArgument,
          fmt::format("{:.0f} % of the surface would be invented, most of it at {}: {} "
                      "is not whole",
                      100 * report.inventedShare, report.invented.front().place, scan_.name));
    }
    if (!report.invented.empty()) {
      std::string places;
      for (std::size_t i = 0; i < std::min<std::size_t>(report.invented.size(), 6); ++i) {
        places += fmt::format("{}{} ({:.0f} cm2)", i == 0 ? "" : "; ", report.invented[i].place,
                              report.invented[i].area / 100);
      }
      find("scan-invented",
           fmt::format("{:.1f} % of the surface had no scan and was invented: {}{}",
                       100 * report.inventedShare, places,
                       report.invented.size() > 6 ? "; and smaller ones" : ""));
    }
    return {};
  }

  [[nodiscard]] std::string describe(const Invented& one) const {
    if (!stand_) return nameOfDirection(one.normal);
    const Eigen::Isometry3d back = cleaned_.standing.inverse();
    return stand_->describe(back * one.centre, back.linear() * one.normal);
  }

  Result<void> tellShape() {
    const Mesh& mesh = *cleaned_.model.mesh;
    CleanReport& report = cleaned_.report;
    report.spacing = points_.spacing;
    report.edge = edge();
    report.height = mesh.boxMax().z();
    const auto parts = static_cast<std::int64_t>(mesh.componentCount());
    report.handles = static_cast<int>(parts - mesh.eulerCharacteristic() / 2);
    report.crossings = findCrossingFaces(mesh).size();
    std::vector<double> distances(points_.points.size());
    constexpr std::size_t kBlock = 1024;
    parallelFor((distances.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(distances.size(), (block + 1) * kBlock);
           ++i) {
        distances[i] = cleaned_.model.index->closestPoint(points_.points[i]).distance;
      }
    });
    report.scanToModel = fitting::summarise(distances, std::vector<double>(distances.size(), 1.0));
    if (report.handles > 0 && isBody()) {
      find("scan-handles",
           fmt::format("parts that are apart on a person are grown together (fingers, an arm and "
                       "the trunk, the thighs): {} too many ways round",
                       report.handles));
    }
    if (report.crossings > 0) {
      find("scan-crossings", fmt::format("{} pairs of faces cross", report.crossings));
    }
    return {};
  }

  const Scan& scan_;
  const CleanOptions& options_;
  Progress* progress_;
  double diagonal_ = 0;
  double cloudSpacing_ = 0;
  Scan kept_;
  Parts parts_;
  std::optional<Stand> stand_;
  std::optional<Target> target_;  ///< from sortOut() on
  OrientedPoints points_;
  CleanedScan cleaned_;
};

}  // namespace

Result<Scan> readRawScan(const std::filesystem::path& path, std::optional<FileUnit> unit,
                         ScanKind kind) {
  Result<Scan> scan = readScan(path, unit);
  if (scan || scan.error().code != ErrorCode::UnitsMissing) return scan;
  const Result<Scan> asWritten = readScan(path, FileUnit::Millimetre);
  if (!asWritten) return asWritten;
  return askForUnit(path.string(), "across", extentWithoutSpecks(asWritten->points), std::nullopt,
                    kind == ScanKind::Body);
}

Result<CleanedScan> cleanScan(const Scan& scan, const CleanOptions& options, Progress* progress) {
  return Cleaner(scan, options, progress).run();
}

}  // namespace toile
