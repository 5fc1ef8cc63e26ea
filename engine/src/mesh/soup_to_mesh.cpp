// SPDX-License-Identifier: GPL-3.0-or-later
// From what a file says to a mesh: unit, welding, triangles, duplicates, manifoldness, orientation.
// Until makeMesh() everything keeps the file's vertex numbers, so that messages name what the user
// can find in the file.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesh/edge_sides.h"
#include "mesh/orient.h"
#include "mesh/triangulate_polygon.h"
#include "toile/mesh/mesh_file.h"

namespace toile {
namespace {

using detail::EdgeSide;

constexpr std::size_t kMaxNamed = 24;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// "3, 7, 9 and 4 more".
std::string listOf(const std::vector<std::uint32_t>& numbers) {
  constexpr std::size_t kShown = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, numbers.size()); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", numbers[i]);
  }
  if (numbers.size() > kShown) text += fmt::format(" and {} more", numbers.size() - kShown);
  return text;
}

/// "1 face" / "3 faces".
std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::vector<Element> faceElements(const std::vector<std::uint32_t>& faces) {
  std::vector<Element> where;
  for (std::size_t i = 0; i < std::min(kMaxNamed, faces.size()); ++i) {
    where.push_back(Element::face(FaceId(faces[i])));
  }
  return where;
}

std::vector<Element> vertexElements(const std::vector<std::uint32_t>& vertices) {
  std::vector<Element> where;
  for (std::size_t i = 0; i < std::min(kMaxNamed, vertices.size()); ++i) {
    where.push_back(Element::vertex(VertexId(vertices[i])));
  }
  return where;
}

class MeshBuilder {
 public:
  MeshBuilder(PolygonSoup soup, const ReadMeshOptions& options)
      : soup_(std::move(soup)), options_(options), findings_(std::move(soup_.findings)) {}

  Result<MeshFile> build() {
    if (Result<void> done = checkSoup(); !done) return done.error();
    if (Result<void> done = applyUnit(); !done) return done.error();
    weld();
    if (Result<void> done = triangulate(); !done) return done.error();
    removeDuplicates();
    if (triangles_.empty()) {
      return Error{ErrorCode::FileFormat, "no face is left that has an area to design on", {}};
    }
    std::vector<EdgeSide> sides = detail::sortedEdgeSides(triangles_, soup_.positions.size());
    if (removeFlatFacesOnCrowdedEdges(sides)) {
      sides = detail::sortedEdgeSides(triangles_, soup_.positions.size());
    }
    if (Result<void> done = checkEdges(sides); !done) return done.error();
    if (Result<void> done = orient(sides); !done) return done.error();
    if (Result<void> done = checkFans(sides); !done) return done.error();
    return finish();
  }

 private:
  void find(std::string code, std::string message, std::vector<Element> where) {
    findings_.push_back({std::move(code), std::move(message), std::move(where)});
  }

  Result<void> checkSoup() const {
    if (soup_.polygons.empty()) {
      return Error{ErrorCode::FileFormat,
                   fmt::format("there are {} points and no faces; make a surface of them first",
                               soup_.positions.size()),
                   {}};
    }
    const auto isKnown = [&](std::uint32_t v) { return v < soup_.positions.size(); };
    for (std::size_t f = 0; f < soup_.polygons.size(); ++f) {
      const std::vector<std::uint32_t>& polygon = soup_.polygons[f];
      if (!std::all_of(polygon.begin(), polygon.end(), isKnown)) {
        return Error{ErrorCode::FileFormat,
                     fmt::format("face {} names a vertex that does not exist", f),
                     {Element::face(FaceId(f))}};
      }
    }
    for (const PolygonSoup::Chain& chain : soup_.chains) {
      if (!std::all_of(chain.vertices.begin(), chain.vertices.end(), isKnown)) {
        return Error{ErrorCode::FileFormat,
                     "a line names a vertex that does not exist",
                     {Element::line(chain.line)}};
      }
    }
    return {};
  }

  Result<void> applyUnit() {
    if (soup_.unit && options_.unit && *soup_.unit != *options_.unit) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("the file says that its unit is {0}, --units says {1}; leave out "
                               "--units {1}, or correct the file's toile-units comment",
                               toString(*soup_.unit), toString(*options_.unit)),
                   {}};
    }
    const std::optional<FileUnit> unit = soup_.unit ? soup_.unit : options_.unit;
    if (!unit) {
      return Error{ErrorCode::UnitsMissing,
                   "the file does not say its unit of length; add --units mm (or cm, m, in)",
                   {}};
    }
    const double scale = millimetresPer(*unit);
    for (std::size_t v = 0; v < soup_.positions.size(); ++v) {
      if (scale != 1) soup_.positions[v] *= scale;
      if (!soup_.positions[v].allFinite()) {
        return Error{ErrorCode::FileFormat,
                     fmt::format("vertex {} has a coordinate that is not a finite number of "
                                 "millimetres",
                                 v),
                     {Element::vertex(VertexId(v))}};
      }
    }
    return {};
  }

  /// No two faces share a vertex, though there are several.
  bool isSoupOfFaces() const {
    std::vector<bool> isUsed(soup_.positions.size(), false);
    for (const std::vector<std::uint32_t>& polygon : soup_.polygons) {
      for (const std::uint32_t v : polygon) {
        if (isUsed[v]) return false;
        isUsed[v] = true;
      }
    }
    return soup_.polygons.size() > 1;
  }

  /// Equal positions become the one with the smallest number.
  void weld() {
    const bool isWanted =
        options_.weldAll || (options_.weld && (soup_.repeatsPositions || isSoupOfFaces()));
    if (!isWanted) return;
    const std::vector<Eigen::Vector3d>& positions = soup_.positions;
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t v) {
      return std::tie(positions[v].x(), positions[v].y(), positions[v].z());
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    std::vector<std::uint32_t> representative(positions.size());
    std::size_t joined = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool isSame = i > 0 && key(order[i]) == key(order[i - 1]);
      representative[order[i]] = isSame ? representative[order[i - 1]] : order[i];
      joined += isSame ? 1 : 0;
    }
    if (joined == 0) return;
    for (std::vector<std::uint32_t>& polygon : soup_.polygons) {
      for (std::uint32_t& v : polygon) v = representative[v];
    }
    for (PolygonSoup::Chain& chain : soup_.chains) {
      for (std::uint32_t& v : chain.vertices) v = representative[v];
    }
    isWelded_ = true;
    if (!soup_.repeatsPositions) {
      find("welded",
           fmt::format("{} at the place of another were joined with it",
                       counted(joined, "vertex", "vertices")),
           {});
    }
  }

  Result<void> triangulate() {
    triangles_.reserve(soup_.polygons.size());
    faceOfTriangle_.reserve(soup_.polygons.size());
    std::vector<std::uint32_t> degenerate;
    std::vector<std::uint32_t> crossing;
    std::vector<std::uint32_t> corners;
    std::vector<Eigen::Vector3d> points;
    for (std::uint32_t f = 0; f < soup_.polygons.size(); ++f) {
      corners.clear();
      for (const std::uint32_t v : soup_.polygons[f]) {
        if (corners.empty() || corners.back() != v) corners.push_back(v);
      }
      while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
      if (corners.size() != soup_.polygons[f].size() || corners.size() < 3) degenerate.push_back(f);
      if (corners.size() < 3) continue;
      if (corners.size() == 3) {
        addTriangle(corners[0], corners[1], corners[2], f);
        continue;
      }
      if (corners.size() > detail::kMaxPolygonCorners) {
        return Error{ErrorCode::FileFormat,
                     fmt::format("face {} has {} corners; triangulate it in the program it comes "
                                 "from (at most {} are read)",
                                 f, corners.size(), detail::kMaxPolygonCorners),
                     {Element::face(FaceId(f))}};
      }
      points.clear();
      for (const std::uint32_t v : corners) points.push_back(soup_.positions[v]);
      const detail::PolygonTriangles cut = detail::triangulatePolygon(points);
      if (!cut.isSimple) crossing.push_back(f);
      for (const auto& [a, b, c] : cut.corners) addTriangle(corners[a], corners[b], corners[c], f);
    }
    if (!degenerate.empty()) {
      find("degenerate-face",
           fmt::format("{} that named a vertex twice: removed, or their repeated corners (face {})",
                       counted(degenerate.size(), "face", "faces"), listOf(degenerate)),
           faceElements(degenerate));
    }
    if (!crossing.empty()) {
      find("polygon-not-simple",
           fmt::format("{} with a crossing outline or without area; look at their triangles "
                       "(face {})",
                       counted(crossing.size(), "face", "faces"), listOf(crossing)),
           faceElements(crossing));
    }
    return {};
  }

  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t face) {
    if (a == b || b == c || c == a) return;  // of a keyhole polygon; nothing is lost
    triangles_.push_back({VertexId(a), VertexId(b), VertexId(c)});
    faceOfTriangle_.push_back(face);
  }

  /// Faces on the same three vertices, however oriented: the first stays.
  void removeDuplicates() {
    struct Key {
      std::array<VertexId, 3> vertices;
      std::uint32_t triangle;
    };
    // Bucketed by the smallest vertex, as the sides of edges are.
    std::vector<Key> keys(triangles_.size());
    std::vector<std::size_t> begin(soup_.positions.size() + 1, 0);
    const auto smallest = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}).index(); };
    for (const Triangle& t : triangles_) ++begin[smallest(t) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      Key key{triangles_[i], i};
      std::sort(key.vertices.begin(), key.vertices.end());
      keys[next[smallest(triangles_[i])]++] = key;
    }
    std::vector<std::uint32_t> removed;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
      const auto first = keys.begin() + static_cast<std::ptrdiff_t>(begin[v]);
      const auto last = keys.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
      std::sort(first, last, [](const Key& a, const Key& b) {
        return std::tie(a.vertices, a.triangle) < std::tie(b.vertices, b.triangle);
      });
      for (auto key = first; key != last; ++key) {
        if (key != first && key->vertices == (key - 1)->vertices) removed.push_back(key->triangle);
      }
    }
    if (removed.empty()) return;
    std::sort(removed.begin(), removed.end());
    const std::vector<std::uint32_t> faces = removeTriangles(removed);
    find("duplicate-face",
         fmt::format("{} on the same vertices as an earlier one removed (face {})",
                     counted(removed.size(), "face", "faces"), listOf(faces)),
         faceElements(faces));
  }

  /// Takes the triangles out, given ascending, and returns the file's faces that they were.
  std::vector<std::uint32_t> removeTriangles(const std::vector<std::uint32_t>& removed) {
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t i : removed) faces.push_back(faceOfTriangle_[i]);
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (std::binary_search(removed.begin(), removed.end(), i)) continue;
      triangles_[kept] = triangles_[i];
      faceOfTriangle_[kept++] = faceOfTriangle_[i];
    }
    triangles_.resize(kept);
    faceOfTriangle_.resize(kept);
    return faces;
  }

  /// A face whose corners lie on one line is harmless, but as third face at an edge it is only in
  /// the way. Says whether one was removed.
  bool removeFlatFacesOnCrowdedEdges(const std::vector<EdgeSide>& sides) {
    std::vector<std::uint32_t> removed;
    detail::forEachEdge(sides, [&](std::span<const EdgeSide> edge) {
      if (edge.size() <= 2) return;
      for (const EdgeSide& side : edge) {
        if (isFlat(side.face())) removed.push_back(side.face());
      }
    });
    if (removed.empty()) return false;
    std::sort(removed.begin(), removed.end());
    removed.erase(std::unique(removed.begin(), removed.end()), removed.end());
    const std::vector<std::uint32_t> faces = removeTriangles(removed);
    find("face-without-area",
         fmt::format("{} whose corners lie on one line removed from edges that have two others "
                     "(face {})",
                     counted(faces.size(), "face", "faces"), listOf(faces)),
         faceElements(faces));
    return true;
  }

  bool isFlat(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    const Eigen::Vector3d& origin = soup_.positions[a.index()];
    const Eigen::Vector3d u = soup_.positions[b.index()] - origin;
    const Eigen::Vector3d v = soup_.positions[c.index()] - origin;
    return u.cross(v).isZero(0);
  }

  Result<void> checkEdges(const std::vector<EdgeSide>& sides) const {
    std::vector<std::uint32_t> ends;
    std::vector<std::uint32_t> facesOfFirst;
    detail::forEachEdge(sides, [&](std::span<const EdgeSide> edge) {
      if (edge.size() <= 2) return;
      if (ends.empty()) {
        for (const EdgeSide& side : edge) facesOfFirst.push_back(faceOfTriangle_[side.face()]);
      }
      ends.push_back(edge[0].tail);
      ends.push_back(edge[0].head);
    });
    if (ends.empty()) return {};
    const std::size_t count = ends.size() / 2;
    return Error{
        ErrorCode::NotManifold,
        fmt::format("{} with more than two faces, {} vertices {} and {} (faces {}); "
                    "remove what sticks out or lies inside there, or separate the parts",
                    counted(count, "edge", "edges"), count == 1 ? "between" : "the first between",
                    ends[0], ends[1], listOf(facesOfFirst)),
        vertexElements(ends)};
  }

  Result<void> orient(const std::vector<EdgeSide>& sides) {
    const detail::Orientation done = detail::orientConsistently(soup_.positions, triangles_, sides);
    if (!done.contradictions.empty()) {
      std::vector<std::uint32_t> ends;
      for (const auto& [a, b] : done.contradictions) {
        ends.push_back(a);
        ends.push_back(b);
      }
      return Error{
          ErrorCode::NotOrientable,
          fmt::format("the surface has no outside, as a Moebius strip has none; going "
                      "round it the sides meet wrongly at {}, the first between vertices "
                      "{} and {}; cut it open there",
                      counted(done.contradictions.size(), "edge", "edges"), ends[0], ends[1]),
          vertexElements(ends)};
    }
    if (!done.turned.empty()) {
      find("turned-faces",
           fmt::format("{} turned over, for they faced the other way than their neighbours "
                       "(face {})",
                       counted(done.turned.size(), "face", "faces"), listOf(done.turned)),
           faceElements(done.turned));
    }
    if (!done.turnedOut.empty()) {
      find("turned-surface",
           fmt::format("the surface was inside out and has been turned ({}, at face {})",
                       counted(done.turnedOut.size(), "part", "parts"), listOf(done.turnedOut)),
           faceElements(done.turnedOut));
    }
    if (!done.cavities.empty()) {
      find("hollow",
           fmt::format("{} inside another face inward and were left so (at face {})",
                       counted(done.cavities.size(), "closed part", "closed parts"),
                       listOf(done.cavities)),
           faceElements(done.cavities));
    }
    if (done.firstFaceOfComponent.size() > 1) {
      find("components",
           fmt::format("the model has {} separate parts (at face {})",
                       done.firstFaceOfComponent.size(), listOf(done.firstFaceOfComponent)),
           faceElements(done.firstFaceOfComponent));
    }
    return {};
  }

  /// Vertices where parts touch that share no edge there. Union-find over the corners.
  Result<void> checkFans(const std::vector<EdgeSide>& sides) const {
    std::vector<std::uint32_t> parent(3 * triangles_.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto rootOf = [&](std::uint32_t corner) {
      while (parent[corner] != corner) {
        parent[corner] = parent[parent[corner]];
        corner = parent[corner];
      }
      return corner;
    };
    // Corner of the side's face at a vertex of the side.
    const auto cornerAt = [&](const EdgeSide& side, std::uint32_t vertex) {
      const Triangle& t = triangles_[side.face()];
      const std::uint32_t k = t[0].index() == vertex ? 0 : t[1].index() == vertex ? 1 : 2;
      return 3 * side.face() + k;
    };
    detail::forEachEdge(sides, [&](std::span<const EdgeSide> edge) {
      if (edge.size() != 2) return;
      for (const std::uint32_t v : {edge[0].tail, edge[0].head}) {
        parent[rootOf(cornerAt(edge[0], v))] = rootOf(cornerAt(edge[1], v));
      }
    });
    std::vector<std::uint32_t> fanOf(soup_.positions.size(), kNone);
    std::vector<std::uint32_t> pinched;
    for (std::uint32_t c = 0; c < parent.size(); ++c) {
      std::uint32_t& fan = fanOf[triangles_[c / 3][c % 3].index()];
      if (fan == kNone) fan = rootOf(c);
      if (fan != rootOf(c)) pinched.push_back(triangles_[c / 3][c % 3].index());
    }
    if (pinched.empty()) return {};
    std::sort(pinched.begin(), pinched.end());
    pinched.erase(std::unique(pinched.begin(), pinched.end()), pinched.end());
    return Error{ErrorCode::NotManifold,
                 fmt::format("{} where parts touch only in a point (vertex {}); separate the parts "
                             "there, or join them along an edge",
                             counted(pinched.size(), "vertex", "vertices"), listOf(pinched)),
                 vertexElements(pinched)};
  }

  Result<MeshFile> finish() {
    std::vector<std::uint32_t> newOfOld(soup_.positions.size(), kNone);
    for (const Triangle& t : triangles_) {
      for (const VertexId v : t) newOfOld[v.index()] = 0;
    }
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(soup_.positions.size());
    for (std::uint32_t v = 0; v < newOfOld.size(); ++v) {
      if (newOfOld[v] == kNone) continue;
      newOfOld[v] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(soup_.positions[v]);
    }
    const std::size_t dropped = soup_.positions.size() - positions.size();
    if (dropped > 0 && !isWelded_) {
      std::vector<std::uint32_t> unused;
      for (std::uint32_t v = 0; v < newOfOld.size(); ++v) {
        if (newOfOld[v] == kNone) unused.push_back(v);
      }
      find("unused-vertices",
           fmt::format("{} without a face removed (vertex {})",
                       counted(dropped, "vertex", "vertices"), listOf(unused)),
           vertexElements(unused));
    }
    for (Triangle& t : triangles_) {
      for (VertexId& v : t) v = VertexId(newOfOld[v.index()]);
    }
    Result<Mesh> mesh = makeMesh(std::move(positions), std::move(triangles_));
    if (!mesh) return mesh.error();
    MeshFile file{std::move(*mesh), {}, std::move(soup_.targets), {}};
    takeChains(newOfOld, file);
    noteFlatFaces(file.mesh);
    noteSize(file.mesh);
    file.findings = std::move(findings_);
    return file;
  }

  void takeChains(const std::vector<std::uint32_t>& newOfOld, MeshFile& file) {
    for (PolygonSoup::Chain& chain : soup_.chains) {
      PolygonSoup::Chain taken{chain.group, {}, chain.line};
      bool isOnSurface = true;
      for (const std::uint32_t v : chain.vertices) {
        const std::uint32_t made = newOfOld[v];
        isOnSurface = isOnSurface && made != kNone;
        if (taken.vertices.empty() || taken.vertices.back() != made) taken.vertices.push_back(made);
      }
      if (isOnSurface && taken.vertices.size() > 1) {
        file.chains.push_back(std::move(taken));
        continue;
      }
      find("line-off-surface",
           fmt::format("the line chain in line {} leads through vertices without faces; left out",
                       chain.line),
           {Element::line(chain.line)});
    }
  }

  void noteFlatFaces(const Mesh& mesh) {
    std::vector<std::uint32_t> flat;
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
      if (!(mesh.area(FaceId(f)) > 0)) flat.push_back(f);
    }
    if (flat.empty()) return;
    find("face-without-area",
         fmt::format("{} whose corners lie on one line (face {})",
                     counted(flat.size(), "face", "faces"), listOf(flat)),
         faceElements(flat));
  }

  /// Things that patterns are made for are between a doll's hat and a sail.
  void noteSize(const Mesh& mesh) {
    constexpr double kSmallest = 10.0;
    constexpr double kLargest = 20'000.0;
    const double size = (mesh.boxMax() - mesh.boxMin()).maxCoeff();
    if (size >= kSmallest && size <= kLargest) return;
    const FileUnit used = *(soup_.unit ? soup_.unit : options_.unit);
    std::string hint;
    // The usual mistakes, the likeliest first.
    for (const FileUnit unit :
         {FileUnit::Metre, FileUnit::Millimetre, FileUnit::Centimetre, FileUnit::Inch}) {
      const double other = size / millimetresPer(used) * millimetresPer(unit);
      if (other < 50 || other > 5'000) continue;
      hint = fmt::format("; in {} it would be {:.4g} mm: try --units {}", toString(unit), other,
                         toString(unit));
      break;
    }
    find("unit-hint",
         fmt::format("taken in {} the model is {:.4g} mm large{}", toString(used), size, hint), {});
  }

  PolygonSoup soup_;
  const ReadMeshOptions& options_;
  std::vector<Finding> findings_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> faceOfTriangle_;
  bool isWelded_ = false;
};

}  // namespace

Result<MeshFile> makeMeshFromSoup(PolygonSoup soup, const ReadMeshOptions& options) {
  return MeshBuilder(std::move(soup), options).build();
}

}  // namespace toile
