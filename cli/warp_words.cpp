// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "toile/core/nearest_name.h"

namespace toile::cli {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<Eigen::Vector3d> axis(std::string_view name) {
  if (name == "x") return Eigen::Vector3d::UnitX();
  if (name == "y") return Eigen::Vector3d::UnitY();
  if (name == "z") return Eigen::Vector3d::UnitZ();
  return std::nullopt;
}

Error notUnderstood(std::string_view what, std::string_view example) {
  return {ErrorCode::InvalidArgument,
          fmt::format("\"{}\" is not understood; write for example {}", what, example),
          {}};
}

}  // namespace

Result<GirthWord> parseGirthWord(std::string_view text) {
  constexpr std::string_view kExample = "waist_girth, waist_girth:ease=25mm or ball:y=-150mm";
  GirthWord word;
  const std::vector<std::string_view> parts = split(text, ':');
  word.name = parts.front();
  if (word.name.empty()) return notUnderstood(text, kExample);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t mark = parts[i].find('=');
    if (mark == std::string_view::npos) return notUnderstood(parts[i], kExample);
    const std::string_view key = parts[i].substr(0, mark);
    const Result<Length> value = parseLength(parts[i].substr(mark + 1));
    if (!value) return value.error();
    if (key == "ease") {
      word.ease = *value;
    } else if (const auto normal = axis(key); normal && !word.normal) {
      word.normal = normal;
      word.offset = *value;
    } else {
      return notUnderstood(parts[i], kExample);
    }
  }
  return word;
}

Result<WarpGirth> findGirth(const ReferenceModel& body, const GirthWord& word) {
  if (word.normal) {
    for (SurfacePath& path : body.index->planeSection(*word.normal, word.offset.mm())) {
      if (path.closed) return WarpGirth{word.name, std::move(path), word.ease};
    }
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("girth \"{}\": the plane does not go round {}", word.name, body.name),
                 {Element::curve(word.name)}};
  }
  const auto found = body.curves.find(word.name);
  if (found != body.curves.end()) return WarpGirth{word.name, found->second, word.ease};
  std::vector<std::string> names;
  for (const auto& [name, path] : body.curves) names.push_back(name);
  return Error{
      ErrorCode::NameNotFound,
      fmt::format("{} has no curve \"{}\"{}; or give a plane, such as {}:z=900mm", body.name,
                  word.name, names.empty() ? "" : suggestion(word.name, names), word.name),
      {Element::curve(word.name)}};
}

Result<RigidWord> parseRigidWord(std::string_view text) {
  constexpr std::string_view kExample = "z<20mm or z<20mm,y>-60mm";
  RigidWord word;
  if (text.find_first_of("<>") == std::string_view::npos) {
    if (text.empty()) return notUnderstood(text, kExample);
    word.piece = text;
    return word;
  }
  for (const std::string_view part : split(text, ',')) {
    const std::size_t mark = part.find_first_of("<>");
    const auto direction = axis(part.substr(0, mark));
    if (mark == std::string_view::npos || !direction) return notUnderstood(part, kExample);
    const Result<Length> value = parseLength(part.substr(mark + 1));
    if (!value) return value.error();
    const double side = part[mark] == '<' ? 1 : -1;
    word.bounds.push_back({side * *direction, Length::mm(side * value->mm())});
  }
  return word;
}

std::vector<VertexId> verticesWithin(const Mesh& mesh, const RigidWord& word) {
  std::vector<VertexId> vertices;
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d& p = mesh.position(VertexId(v));
    const bool isWithin = std::all_of(word.bounds.begin(), word.bounds.end(), [&](const auto& b) {
      return b.direction.dot(p) <= b.most.mm();
    });
    if (isWithin) vertices.emplace_back(v);
  }
  return vertices;
}

}  // namespace toile::cli
