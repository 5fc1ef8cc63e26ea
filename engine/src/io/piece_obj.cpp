// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "toile/core/units.h"
#include "toile/io/report.h"

namespace toile {
namespace {

constexpr std::size_t kLongestFileName = 80;  // bytes, of the 255 that file systems allow

std::string oneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

/// Letters, digits and what no shell or file system stumbles over; other characters become '-'.
/// Bytes of other scripts stay, cut only between characters.
std::string fileNameOf(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '.' || byte >= 0x80;
    if (result.size() >= kLongestFileName && (byte & 0xC0U) != 0x80U) break;
    if (plain && !(c == '.' && result.empty())) {
      result += c;
    } else if (!result.empty() && result.back() != '-') {
      result += '-';
    }
  }
  while (!result.empty() && result.back() == '-') result.pop_back();
  return result;
}

std::string lowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string wireGroup(const Wire& wire) {
  const std::string name = fmt::format("wire_{}_{}", toString(wire.kind), wire.curve);
  return wire.part == 0 ? name : fmt::format("{}.{}", name, wire.part + 1);
}

std::vector<std::string> pieceFileNames(const CutResult& cut) {
  std::vector<std::string> names;
  std::set<std::string> taken;  // without case: some file systems do not tell it apart
  for (const Piece& piece : cut.pieces) {
    std::string base = fileNameOf(piece.name);
    if (base.empty()) base = fileNameOf(piece.id);
    if (base.empty()) base = "piece";
    std::string name = base;
    for (int n = 2; !taken.insert(lowerCase(name)).second; ++n)
      name = fmt::format("{}-{}", base, n);
    names.push_back(name + ".obj");
  }
  return names;
}

std::string plyFileName(const std::string& objName) {
  return objName.substr(0, objName.rfind('.')) + ".ply";
}

std::string writePieceObj(const Piece& piece, const FlatPiece& flat, const PieceStrain* strain) {
  const Mesh& mesh = *piece.mesh;
  std::string out = "# toile-units: mm\n";
  out += fmt::format("# piece {} \"{}\": v on the model, vt in the plane, both mm\n",
                     oneLine(piece.id), oneLine(piece.name));
  for (const Eigen::Vector3d& p : mesh.positions()) {
    out += fmt::format("v {} {} {}\n", formatExact(p.x()), formatExact(p.y()), formatExact(p.z()));
  }
  for (const Eigen::Vector2d& p : flat.position.values()) {
    out += fmt::format("vt {} {}\n", formatExact(p.x()), formatExact(p.y()));
  }
  for (const Triangle& t : mesh.triangles()) {
    out += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", t[0].index() + 1, t[1].index() + 1,
                       t[2].index() + 1);
  }
  if (strain != nullptr) {
    for (std::size_t f = 0; f < strain->faces.size(); ++f) {
      const Strain& s = strain->faces[FaceId(f)];
      out += fmt::format("# strain {} {:.5f} {:.5f} {:.5f} {:.5f}\n", f, s.along, s.across, s.shear,
                         s.area);
    }
  }
  for (const Wire& wire : piece.wires) {
    const std::string group = wireGroup(wire);
    out += fmt::format("g {}\n", group);
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const double body =
          (mesh.position(wire.vertices[i + 1]) - mesh.position(wire.vertices[i])).norm();
      if (wire.targetLength[i] != body) {
        out += fmt::format("# target {} {} {}\n", group, i, formatExact(wire.targetLength[i]));
      }
    }
    out += 'l';
    for (const VertexId v : wire.vertices) out += fmt::format(" {}", v.index() + 1);
    out += '\n';
  }
  return out;
}

std::string writePiecePly(const Piece& piece, const FlatPiece& flat, const PieceStrain& strain) {
  const Mesh& mesh = *piece.mesh;
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\ncomment toile-units: mm\ncomment piece {} \"{}\"\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property double s\nproperty double t\n"
      "element face {}\nproperty list uchar int vertex_indices\n",
      oneLine(piece.id), oneLine(piece.name), mesh.vertexCount(), mesh.faceCount());
  for (const char* name : {"greatest", "least", "along", "across", "shear", "area"}) {
    out += fmt::format("property float {}\n", name);
  }
  out += "end_header\n";
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d& p = mesh.position(VertexId(v));
    const Eigen::Vector2d& q = flat.position[VertexId(v)];
    out += fmt::format("{} {} {} {} {}\n", formatExact(p.x()), formatExact(p.y()),
                       formatExact(p.z()), formatExact(q.x()), formatExact(q.y()));
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f) {
    const Triangle& t = mesh.vertices(FaceId(f));
    const Strain& s = strain.faces[FaceId(f)];
    out += fmt::format("3 {} {} {} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", t[0].index(),
                       t[1].index(), t[2].index(), s.greatest, s.least, s.along, s.across, s.shear,
                       s.area);
  }
  return out;
}

}  // namespace toile
