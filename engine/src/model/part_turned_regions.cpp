// SPDX-License-Identifier: GPL-3.0-or-later
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 takes the empty edge iterators of Boost's graph for uninitialised ones.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>

#include "model/face_regions.h"

namespace toile::detail {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using Arc = Traits::edge_descriptor;
using Node = Traits::vertex_descriptor;

struct NodeData {
  boost::default_color_type color = boost::white_color;
  long distance = 0;
  Arc predecessor{};
};
struct ArcData {
  std::int64_t capacity = 0;
  std::int64_t residual = 0;
  Arc reverse{};
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, NodeData, ArcData>;

void addArcs(Graph& graph, Node a, Node b, std::int64_t there, std::int64_t back) {
  const Arc forward = boost::add_edge(a, b, graph).first;
  const Arc backward = boost::add_edge(b, a, graph).first;
  graph[forward].capacity = there;
  graph[forward].reverse = backward;
  graph[backward].capacity = back;
  graph[backward].reverse = forward;
}

/// Faces of a region with how they look, the mean of a face and its mirror image.
class TurnedRegion {
 public:
  TurnedRegion(const ReferenceModel& model, const FaceData<FaceId>& mirrored,
               std::vector<FaceId> faces)
      : model_(model), mesh_(*model.mesh), mirrored_(mirrored), faces_(std::move(faces)) {
    nodeOf_ = FaceData<std::int64_t>(mesh_.faceCount(), -1);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      nodeOf_[faces_[i]] = static_cast<std::int64_t>(i);
    isSymmetric_ = !mirrored_.empty() && std::all_of(faces_.begin(), faces_.end(), [&](FaceId f) {
      return nodeOf_[mirrored_[f]] >= 0;
    });
    for (const FaceId f : faces_) {
      area_ += mesh_.area(f);
      looks_ += mesh_.area(f) * mesh_.normal(f);
    }
  }

  [[nodiscard]] bool isTurned() const {
    constexpr double kLooksOneWay = 0.4;  // a half tube: 0.64, a half sphere: 0.5
    return looks_.norm() < kLooksOneWay * area_;
  }

  /// Whether each face looks backwards along the axis that shows most of the region.
  [[nodiscard]] std::vector<char> part() const { return part(choosePartingAxis(), 0); }

  /// Whether each face looks less far along an axis than the region does on the whole: of the axis
  /// along which its faces look most differently, or of the next one if that parts too little off.
  [[nodiscard]] std::vector<char> partAtBends() const {
    constexpr double kLeastPart = 0.06;
    std::vector<char> isBack;
    for (const Eigen::Vector3d& axis : bendingAxes()) {
      isBack = part(axis, meanLook(axis));
      double back = 0;
      for (std::size_t i = 0; i < isBack.size(); ++i)
        if (isBack[i] != 0) back += mesh_.area(faces_[i]);
      if (std::min(back, area_ - back) > kLeastPart * area_) break;
    }
    return isBack;
  }
  [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }

 private:
  [[nodiscard]] std::vector<char> part(const Eigen::Vector3d& axis, double level) const {
    // Border is worth as much as a strip of this width that looks the wrong way.
    const double width = 0.02 * std::sqrt(area_);
    const double unit = 1e9 / (area_ + 1);
    const auto whole = [&](double x) { return static_cast<std::int64_t>(std::llround(unit * x)); };
    Graph graph(faces_.size() + 2);
    const Node source = faces_.size();
    const Node sink = faces_.size() + 1;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      // Exactly sidewards counts as front, as on the sheet.
      const double looks = (level + 1e-6) * areaOf(faces_[i]) - lookOf(faces_[i], axis);
      if (looks > 0) addArcs(graph, source, i, whole(looks), 0);
      if (looks < 0) addArcs(graph, i, sink, whole(-looks), 0);
      for (int side = 0; side < 3; ++side) {
        const HalfedgeId h = mesh_.halfedge(faces_[i], side);
        const HalfedgeId twin = mesh_.opposite(h);
        if (!twin.isValid() || nodeOf_[mesh_.face(twin)] <= static_cast<std::int64_t>(i)) continue;
        const std::int64_t cost = whole(width * lengthOf(h));
        addArcs(graph, i, static_cast<Node>(nodeOf_[mesh_.face(twin)]), cost, cost);
      }
    }
    boost::boykov_kolmogorov_max_flow(
        graph, boost::get(&ArcData::capacity, graph), boost::get(&ArcData::residual, graph),
        boost::get(&ArcData::reverse, graph), boost::get(&NodeData::predecessor, graph),
        boost::get(&NodeData::color, graph), boost::get(&NodeData::distance, graph),
        boost::get(boost::vertex_index, graph), source, sink);
    // What the source still reaches is the least of all minimum cuts: there is but one such.
    std::vector<char> isBack(faces_.size(), 0);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      isBack[i] = graph[i].color == boost::black_color ? 0 : 1;
    return isBack;
  }
  [[nodiscard]] Eigen::Vector3d choosePartingAxis() const {
    constexpr double kFrontFirst = 0.8;  // front and back, unless another way shows much more
    const std::array<Eigen::Vector3d, 3> axes{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(),
                                              Eigen::Vector3d::UnitZ()};
    std::array<double, 3> shown{};
    for (std::size_t a = 0; a < 3; ++a) {
      if (isSymmetric_ && std::abs(axes[a].dot(model_.symmetry->normal)) > 0.5) continue;
      for (const FaceId f : faces_) shown[a] += std::abs(lookOf(f, axes[a]));
    }
    const std::size_t most =
        static_cast<std::size_t>(std::max_element(shown.begin(), shown.end()) - shown.begin());
    return shown[0] >= kFrontFirst * shown[most] ? axes[0] : axes[most];
  }
  /// Those along which the faces look most differently first.
  [[nodiscard]] std::vector<Eigen::Vector3d> bendingAxes() const {
    std::vector<std::pair<double, Eigen::Vector3d>> axes;
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 0, 0)}) {
      if (isSymmetric_ && std::abs(axis.dot(model_.symmetry->normal)) > 0.5) continue;
      const double mean = meanLook(axis);
      double differs = 0;
      for (const FaceId f : faces_) differs += std::abs(lookOf(f, axis) - mean * areaOf(f));
      axes.emplace_back(differs, axis);
    }
    std::stable_sort(axes.begin(), axes.end(),
                     [](const auto& a, const auto& b) { return a.first > 1.001 * b.first; });
    std::vector<Eigen::Vector3d> sorted;
    for (const auto& [differs, axis] : axes) sorted.push_back(axis);
    return sorted;
  }
  [[nodiscard]] double meanLook(const Eigen::Vector3d& axis) const {
    double sum = 0;
    for (const FaceId f : faces_) sum += lookOf(f, axis);
    return sum / area_;
  }
  [[nodiscard]] double areaOf(FaceId f) const {
    return isSymmetric_ ? 0.5 * (mesh_.area(f) + mesh_.area(mirrored_[f])) : mesh_.area(f);
  }
  [[nodiscard]] double lookOf(FaceId f, const Eigen::Vector3d& axis) const {
    const double own = mesh_.area(f) * mesh_.normal(f).dot(axis);
    if (!isSymmetric_) return own;
    return 0.5 * (own + mesh_.area(mirrored_[f]) * mesh_.normal(mirrored_[f]).dot(axis));
  }
  [[nodiscard]] double lengthOf(HalfedgeId h) const {
    const double own = mesh_.length(mesh_.edge(h));
    if (!isSymmetric_) return own;
    const VertexData<VertexId>& partner = model_.symmetry->partner;
    return 0.5 * (own + mesh_.length(mesh_.findEdge(partner[mesh_.from(h)], partner[mesh_.to(h)])));
  }

  const ReferenceModel& model_;
  const Mesh& mesh_;
  const FaceData<FaceId>& mirrored_;
  std::vector<FaceId> faces_;
  FaceData<std::int64_t> nodeOf_;
  bool isSymmetric_ = false;
  double area_ = 0;
  Eigen::Vector3d looks_ = Eigen::Vector3d::Zero();
};

}  // namespace

namespace {

std::vector<std::vector<FaceId>> facesOfRegions(const FaceRegions& regions) {
  std::vector<std::vector<FaceId>> faces;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    faces.resize(std::max<std::size_t>(faces.size(), regions[FaceId(i)] + 1));
    faces[regions[FaceId(i)]].push_back(FaceId(i));
  }
  return faces;
}
constexpr double kLeastShare = 0.01;

}  // namespace

FaceRegions partTurnedRegions(const ReferenceModel& model, const FaceRegions& regions,
                              const FaceData<FaceId>& mirrored) {
  std::vector<std::vector<FaceId>> faces = facesOfRegions(regions);
  FaceRegions out(regions.size());
  for (std::size_t r = 0; r < faces.size(); ++r) {
    for (const FaceId f : faces[r]) out[f] = static_cast<std::uint32_t>(2 * r);
    const TurnedRegion region(model, mirrored, std::move(faces[r]));
    if (!region.isTurned()) continue;
    const std::vector<char> isBack = region.part();
    for (std::size_t i = 0; i < isBack.size(); ++i)
      if (isBack[i] != 0) ++out[region.faces()[i]];
  }
  return tidyRegions(*model.mesh, out, kLeastShare);
}

FaceRegions partRegions(const ReferenceModel& model, const FaceRegions& regions,
                        const std::vector<char>& isChosen, const FaceData<FaceId>& mirrored) {
  std::vector<std::vector<FaceId>> faces = facesOfRegions(regions);
  FaceRegions out(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) out[FaceId(i)] = 2 * regions[FaceId(i)];
  std::vector<char> isDone(faces.size(), 0);
  for (std::size_t r = 0; r < faces.size(); ++r) {
    if (isChosen[r] == 0 || isDone[r] != 0 || faces[r].empty()) continue;
    const TurnedRegion region(model, mirrored, std::move(faces[r]));
    const std::vector<char> isBack = region.partAtBends();
    for (std::size_t i = 0; i < isBack.size(); ++i) {
      const FaceId f = region.faces()[i];
      if (isBack[i] != 0) ++out[f];
      if (mirrored.empty() || regions[mirrored[f]] == r) continue;
      // Its mirror image is parted alike.
      if (isBack[i] != 0) ++out[mirrored[f]];
      isDone[regions[mirrored[f]]] = 1;
    }
  }
  return tidyRegions(*model.mesh, out, kLeastShare);
}

}  // namespace toile::detail
