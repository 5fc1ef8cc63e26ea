// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "toile/unfold/symmetrise.h"
#include "toile/unfold/unfold.h"

// Notation: a mark says which chain owns a mesh edge. Faces keep their numbers when the surface is
// opened, and with them the halfedges: that is how the old mesh's edges are found in the new one.
namespace toile {
namespace {

constexpr std::array kAllKinds = {WireKind::Seam,    WireKind::Opening, WireKind::Dart,
                                  WireKind::Feature, WireKind::Elastic, WireKind::Border};

struct NamedChain {
  WireKind kind = WireKind::Feature;
  std::string curve;
};

constexpr std::uint32_t kUnmarked = 0xffffffffU;
struct Mark {
  std::uint32_t chain = kUnmarked;
  double target = 0;
};

constexpr std::string_view kGroupPrefix = "wire_";

std::string idWithoutName(std::size_t chain) {
  return fmt::format("chain-{}", chain + 1);
}

Result<NamedChain> nameOf(const PolygonSoup::Chain& chain, std::size_t number) {
  if (!chain.group.starts_with(kGroupPrefix)) {
    return NamedChain{WireKind::Feature, idWithoutName(number)};
  }
  const std::string_view rest = std::string_view(chain.group).substr(kGroupPrefix.size());
  for (const WireKind kind : kAllKinds) {
    const std::string_view name = toString(kind);
    if (!rest.starts_with(name)) continue;
    if (rest.size() == name.size()) return NamedChain{kind, idWithoutName(number)};
    if (rest[name.size()] == '_' && rest.size() > name.size() + 1) {
      return NamedChain{kind, std::string(rest.substr(name.size() + 1))};
    }
  }
  return Error{ErrorCode::CurveInvalid,
               fmt::format("chain {} stands under the group \"{}\"; known are wire_seam_, "
                           "wire_opening_, wire_dart_, wire_feature_, wire_elastic_, wire_border_ "
                           "and an id",
                           number + 1, chain.group),
               {Element::curve(chain.group)}};
}

class PatchBuilder {
 public:
  PatchBuilder(const Mesh& mesh, const std::vector<PolygonSoup::Chain>& chains,
               const std::map<std::string, double>& targets)
      : old_(mesh), chains_(chains), targets_(targets), marks_(mesh.edgeCount()) {}

  Result<Piece> build(const std::string& name) {
    if (Result<void> done = readChains(); !done) return done.error();
    Result<Mesh> opened = open();
    if (!opened) return opened.error();
    piece_.id = piece_.name = name;
    piece_.mesh = std::make_shared<const Mesh>(*std::move(opened));
    piece_.sourceFace = FaceData<FaceId>(old_.faceCount());
    for (std::size_t f = 0; f < old_.faceCount(); ++f) piece_.sourceFace[FaceId(f)] = FaceId(f);
    findJunctions();
    addBoundaryWires();
    addInnerWires();
    numberParts();
    return std::move(piece_);
  }

 private:
  [[nodiscard]] EdgeId chainEdge(std::size_t chain, std::size_t i) const {
    const auto& v = chains_[chain].vertices;
    return old_.findEdge(VertexId(v[i]), VertexId(v[i + 1]));
  }
  [[nodiscard]] bool isCut(EdgeId edge) const {
    return !old_.isBorder(edge) && marks_[edge].chain != kUnmarked &&
           isBoundary(named_[marks_[edge].chain].kind);
  }

  Result<void> readChains() {
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      Result<NamedChain> named = nameOf(chains_[c], c);
      if (!named) return named.error();
      named_.push_back(*std::move(named));
      const auto& v = chains_[c].vertices;
      if (v.size() < 2) {
        return Error{ErrorCode::CurveInvalid,
                     fmt::format("chain {} has fewer than two vertices", c + 1),
                     {Element::curve(named_[c].curve)}};
      }
      for (std::size_t i = 0; i + 1 < v.size(); ++i) {
        const bool exists = v[i] < old_.vertexCount() && v[i + 1] < old_.vertexCount() &&
                            v[i] != v[i + 1] && chainEdge(c, i).isValid();
        if (exists) continue;
        return Error{ErrorCode::CurveInvalid,
                     fmt::format("chain {} (\"{}\") steps from vertex {} to vertex {}, which no "
                                 "edge of the mesh joins; chains run along mesh edges",
                                 c + 1, named_[c].curve, v[i] + 1, v[i + 1] + 1),
                     {Element::curve(named_[c].curve)}};
      }
    }
    // A line that opens the surface counts more than a feature on the same edge.
    for (const bool opening : {true, false}) {
      for (std::size_t c = 0; c < chains_.size(); ++c) {
        if (isBoundary(named_[c].kind) != opening) continue;
        for (std::size_t i = 0; i + 1 < chains_[c].vertices.size(); ++i) {
          const EdgeId edge = chainEdge(c, i);
          if (marks_[edge].chain != kUnmarked) continue;
          const auto target = targets_.find(fmt::format("{} {}", chains_[c].group, i));
          marks_[edge].target = target != targets_.end() ? target->second : old_.length(edge);
          // A feature on the border says nothing that the border does not say, but for its target.
          if (opening || !old_.isBorder(edge)) {
            marks_[edge].chain = static_cast<std::uint32_t>(c);
          }
        }
      }
    }
    return {};
  }

  /// Gives each sector of faces between cut edges around a vertex a vertex of its own.
  Result<Mesh> open() {
    std::vector<Eigen::Vector3d> positions = old_.positions();
    std::vector<Triangle> triangles = old_.triangles();
    piece_.onModel = VertexData<SurfacePoint>(old_.vertexCount());
    for (std::size_t i = 0; i < old_.vertexCount(); ++i) {
      const VertexId v{i};
      piece_.onModel[v].at = v;
      HalfedgeId start = old_.outgoing(v);
      if (!old_.isBorder(v)) {
        const HalfedgeId first = start;
        while (!isCut(old_.edge(start))) {
          start = old_.opposite(old_.previous(start));
          if (start == first) break;
        }
        if (!isCut(old_.edge(start))) continue;
      }
      VertexId own = v;
      HalfedgeId h = start;
      do {
        triangles[old_.face(h).index()][static_cast<std::size_t>(old_.side(h))] = own;
        const HalfedgeId incoming = old_.previous(h);
        h = old_.opposite(incoming);
        if (h.isValid() && h != start && isCut(old_.edge(incoming))) {
          own = VertexId(positions.size());
          positions.push_back(old_.position(v));
          piece_.onModel.values().push_back(SurfacePoint{v});
        }
      } while (h.isValid() && h != start);
    }
    return makeMesh(std::move(positions), std::move(triangles));
  }

  /// Vertices where wires end: on the border, and where three or more inner edges meet.
  void findJunctions() {
    const Mesh& mesh = *piece_.mesh;
    VertexData<int> degree(mesh.vertexCount(), 0);
    for (std::size_t e = 0; e < old_.edgeCount(); ++e) {
      const HalfedgeId h = old_.halfedge(EdgeId(e));
      if (marks_[EdgeId(e)].chain == kUnmarked || mesh.isBorder(mesh.edge(h))) continue;
      ++degree[mesh.from(h)];
      ++degree[mesh.to(h)];
    }
    junction_ = VertexData<char>(mesh.vertexCount(), 0);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
      const VertexId v{i};
      junction_[v] = mesh.isBorder(v) ? degree[v] > 0 : degree[v] > 2;
    }
  }

  [[nodiscard]] Mark markOfBorder(HalfedgeId h) const {
    Mark mark = marks_[old_.edge(h)];
    if (mark.chain == kUnmarked && !(mark.target > 0)) mark.target = old_.length(old_.edge(h));
    return mark;
  }

  void append(Wire& wire, HalfedgeId h, VertexId to, double target) {
    wire.vertices.push_back(to);
    wire.bodyLength.push_back(old_.length(old_.edge(h)));
    wire.targetLength.push_back(target);
  }

  void addBoundaryWires() {
    const Mesh& mesh = *piece_.mesh;
    for (std::vector<HalfedgeId> loop : mesh.boundaryLoops()) {
      const auto splitsBefore = [&](std::size_t i) {
        const HalfedgeId h = loop[i];
        const HalfedgeId last = loop[(i + loop.size() - 1) % loop.size()];
        return junction_[mesh.from(h)] != 0 || old_.edge(h) == old_.edge(last) ||
               markOfBorder(h).chain != markOfBorder(last).chain;
      };
      std::size_t first = 0;
      while (first < loop.size() && !splitsBefore(first)) ++first;
      const bool closed = first == loop.size();
      if (!closed)
        std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Mark mark = markOfBorder(loop[i]);
        if (i == 0 || (!closed && splitsBefore(i))) {
          Wire wire;
          wire.kind = mark.chain == kUnmarked ? WireKind::Border : named_[mark.chain].kind;
          wire.curve = mark.chain == kUnmarked ? "border" : named_[mark.chain].curve;
          wire.vertices.push_back(mesh.from(loop[i]));
          piece_.wires.push_back(std::move(wire));
        }
        append(piece_.wires.back(), loop[i], mesh.to(loop[i]), mark.target);
      }
    }
  }

  void addInnerWires() {
    const Mesh& mesh = *piece_.mesh;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (isBoundary(named_[c].kind)) continue;
      struct Step {
        HalfedgeId halfedge;
        VertexId from, to;  ///< in the opened mesh
        double target;
      };
      std::vector<Step> steps;
      const auto& v = chains_[c].vertices;
      for (std::size_t i = 0; i + 1 < v.size(); ++i) {
        const EdgeId edge = chainEdge(c, i);
        if (marks_[edge].chain != c) continue;
        HalfedgeId h = old_.halfedge(edge);
        const bool forward = old_.from(h).index() == v[i];
        steps.push_back({h, forward ? mesh.from(h) : mesh.to(h),
                         forward ? mesh.to(h) : mesh.from(h), marks_[edge].target});
      }
      const auto splitsBefore = [&](std::size_t i) {
        const Step& last = steps[(i + steps.size() - 1) % steps.size()];
        return last.to != steps[i].from || junction_[steps[i].from] != 0;
      };
      std::size_t first = 0;
      while (first < steps.size() && !splitsBefore(first)) ++first;
      const bool closed = first == steps.size();
      if (!closed)
        std::rotate(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(first), steps.end());
      for (std::size_t i = 0; i < steps.size(); ++i) {
        if (i == 0 || (!closed && splitsBefore(i))) {
          Wire wire;
          wire.kind = named_[c].kind;
          wire.curve = named_[c].curve;
          wire.vertices.push_back(steps[i].from);
          piece_.wires.push_back(std::move(wire));
        }
        append(piece_.wires.back(), steps[i].halfedge, steps[i].to, steps[i].target);
      }
    }
  }

  void numberParts() {
    std::map<std::string, int> parts;
    for (Wire& wire : piece_.wires) wire.part = parts[wire.curve]++;
  }

  const Mesh& old_;
  const std::vector<PolygonSoup::Chain>& chains_;
  const std::map<std::string, double>& targets_;
  std::vector<NamedChain> named_;
  EdgeData<Mark> marks_;
  VertexData<char> junction_;
  Piece piece_;
};

/// What the targets of a curve's edges are to be multiplied by.
double elasticFactor(const FlatPiece& flat, const std::string& curve) {
  for (const ElasticLine& line : flat.elastic.lines) {
    if (line.curve == curve) return 1 + line.ratio;
  }
  return 1;
}

/// Units, then `v` of the surface and `vt` of the plane.
std::string objVertices(const Mesh& mesh, const FlatPiece& flat) {
  std::string out = "# toile-units: mm\n";
  const auto append = std::back_inserter(out);
  for (const Eigen::Vector3d& p : mesh.positions()) {
    fmt::format_to(append, "v {} {} {}\n", p.x(), p.y(), p.z());
  }
  for (const Eigen::Vector2d& p : flat.position.values()) {
    fmt::format_to(append, "vt {} {}\n", p.x(), p.y());
  }
  return out;
}

}  // namespace

std::string writePatchObj(const Mesh& mesh, const std::vector<PolygonSoup::Chain>& chains,
                          const std::map<std::string, double>& targets, const Piece& piece,
                          const FlatPiece& flat) {
  std::string out = objVertices(mesh, flat);
  const auto append = std::back_inserter(out);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& v = mesh.triangles()[f];
    const Triangle& vt = piece.mesh->triangles()[f];
    fmt::format_to(append, "f {}/{} {}/{} {}/{}\n", v[0].index() + 1, vt[0].index() + 1,
                   v[1].index() + 1, vt[1].index() + 1, v[2].index() + 1, vt[2].index() + 1);
  }
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const std::vector<std::uint32_t>& v = chains[c].vertices;
    const bool named = chains[c].group.starts_with(kGroupPrefix);
    const std::string group = named ? chains[c].group : "wire_feature_" + idWithoutName(c);
    fmt::format_to(append, "g {}\nl", group);
    for (const std::uint32_t vertex : v) fmt::format_to(append, " {}", vertex + 1);
    out += '\n';
    const Result<NamedChain> line = nameOf(chains[c], c);
    const double factor = line ? elasticFactor(flat, line->curve) : 1;
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      const auto given = targets.find(fmt::format("{} {}", chains[c].group, i));
      const double length = mesh.length(mesh.findEdge(VertexId(v[i]), VertexId(v[i + 1])));
      const double target = (given != targets.end() ? given->second : length) * factor;
      if (target != length) fmt::format_to(append, "# target {} {} {}\n", group, i, target);
    }
  }
  return out;
}

std::string writePatchObj(const SymmetricPiece& symmetric, const FlatPiece& flat) {
  const Piece& piece = symmetric.piece;
  const Mesh& mesh = *piece.mesh;
  std::string out = objVertices(mesh, flat);
  const auto append = std::back_inserter(out);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.triangles()[f];
    if (piece.sourceFace[FaceId(f)].index() != f) {
      fmt::format_to(append, "# source-face {} {}\n", f, piece.sourceFace[FaceId(f)].index());
    }
    fmt::format_to(append, "f {0}/{0} {1}/{1} {2}/{2}\n", t[0].index() + 1, t[1].index() + 1,
                   t[2].index() + 1);
  }
  for (const Wire& wire : piece.wires) {
    std::string group = fmt::format("{}{}_{}", kGroupPrefix, toString(wire.kind), wire.curve);
    if (wire.part > 0) group += fmt::format("-{}", wire.part);
    fmt::format_to(append, "g {}\nl", group);
    for (const VertexId v : wire.vertices) fmt::format_to(append, " {}", v.index() + 1);
    out += '\n';
    const double factor = elasticFactor(flat, wire.curve);
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const EdgeId edge = mesh.findEdge(wire.vertices[i], wire.vertices[i + 1]);
      const double target = wire.targetLength[i] * factor;
      if (target != mesh.length(edge))
        fmt::format_to(append, "# target {} {} {}\n", group, i, target);
    }
  }
  return out;
}

Result<Piece> makePiece(const std::string& name, const Mesh& mesh,
                        const std::vector<PolygonSoup::Chain>& chains,
                        const std::map<std::string, double>& targets) {
  return PatchBuilder(mesh, chains, targets).build(name);
}

}  // namespace toile
