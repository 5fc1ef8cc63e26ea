// SPDX-License-Identifier: GPL-3.0-or-later
#include "warp_words.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "places.h"
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

/// Sine of the angle between three places from which on they span a plane.
constexpr double kLeastTurn = 0.02;

Error notUnderstood(std::string_view what, std::string_view example) {
  return {ErrorCode::InvalidArgument,
          fmt::format("\"{}\" is not understood; write for example {}", what, example),
          {}};
}

Error noSection(const ReferenceModel& body, const GirthWord& word) {
  return {ErrorCode::InvalidArgument,
          fmt::format("girth \"{}\": the plane does not go round {}", word.name, body.name),
          {Element::curve(word.name)}};
}

}  // namespace

Result<GirthWord> parseGirthWord(std::string_view text) {
  constexpr std::string_view kExample =
      "waist_girth, waist_girth:ease=25mm, ball:y=-150mm or "
      "ball:through=toe_big_l/toe_little_l/30,-120,60";
  GirthWord word;
  const std::vector<std::string_view> parts = split(text, ':');
  word.name = parts.front();
  if (word.name.empty()) return notUnderstood(text, kExample);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t mark = parts[i].find('=');
    if (mark == std::string_view::npos) return notUnderstood(parts[i], kExample);
    const std::string_view key = parts[i].substr(0, mark);
    if (key == "through") {
      const std::vector<std::string_view> places = split(parts[i].substr(mark + 1), '/');
      if (places.size() != word.through.size() || word.normal) {
        return notUnderstood(parts[i], kExample);
      }
      std::copy(places.begin(), places.end(), word.through.begin());
      continue;
    }
    const Result<Length> value = parseLength(parts[i].substr(mark + 1));
    if (!value) return value.error();
    if (key == "ease") {
      word.ease = *value;
    } else if (const auto normal = axis(key); normal && !word.normal && word.through[0].empty()) {
      word.normal = normal;
      word.offset = *value;
    } else {
      return notUnderstood(parts[i], kExample);
    }
  }
  return word;
}

namespace {

/// The closed line through a plane that three places of the body span, nearest to them.
Result<WarpGirth> girthThrough(const ReferenceModel& body, const GirthWord& word) {
  std::array<Eigen::Vector3d, 3> places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Result<Eigen::Vector3d> place = findPlace(body, word.through[i]);
    if (!place) return place.error().during(fmt::format("girth \"{}\"", word.name));
    places[i] = *place;
  }
  const Eigen::Vector3d a = places[1] - places[0], b = places[2] - places[0];
  const Eigen::Vector3d cross = a.cross(b);
  if (!(cross.norm() > kLeastTurn * a.norm() * b.norm())) {
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("girth \"{}\": its three places lie in one line", word.name),
                 {Element::curve(word.name)}};
  }
  std::optional<WarpGirth> best;
  double least = 0;
  const Eigen::Vector3d normal = cross.normalized();
  for (SurfacePath& path : body.index->planeSection(normal, normal.dot(places[0]))) {
    if (!path.closed) continue;
    double away = 0;
    for (const Eigen::Vector3d& place : places) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const SurfacePoint& p : path.points) {
        nearest = std::min(nearest, (position(*body.mesh, p) - place).norm());
      }
      away += nearest;
    }
    if (best && away >= least) continue;
    least = away;
    best = WarpGirth{word.name, std::move(path), word.ease};
  }
  if (best) return *std::move(best);
  return noSection(body, word);
}

}  // namespace

Result<WarpGirth> findGirth(const ReferenceModel& body, const GirthWord& word) {
  if (!word.through[0].empty()) return girthThrough(body, word);
  if (word.normal) {
    for (SurfacePath& path : body.index->planeSection(*word.normal, word.offset.mm())) {
      if (path.closed) return WarpGirth{word.name, std::move(path), word.ease};
    }
    return noSection(body, word);
  }
  const auto found = body.curves.find(word.name);
  if (found != body.curves.end()) return WarpGirth{word.name, found->second, word.ease};
  std::vector<std::string> girths;
  std::string list;
  for (const auto& [name, path] : body.curves) {
    if (!path.closed) continue;
    girths.push_back(name);
    list += (list.empty() ? "; its girths: " : ", ") + name;
  }
  const std::string near = nearestName(word.name, girths);
  return Error{
      ErrorCode::NameNotFound,
      fmt::format("{} has no curve \"{}\"{}{}; or give a plane, such as {}:z=900mm", body.name,
                  word.name, near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near), list,
                  word.name),
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
