// SPDX-License-Identifier: GPL-3.0-or-later
#include "places.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "toile/core/units.h"

namespace toile::cli {
namespace {

std::optional<Eigen::Vector3d> parsePlace(std::string_view text) {
  Eigen::Vector3d place;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const std::size_t comma = k < 2 ? text.find(',') : text.size();
    const std::optional<double> number = parseDouble(text.substr(0, comma));
    if (comma == std::string_view::npos || !number) return std::nullopt;
    place[k] = *number;
    if (k < 2) text.remove_prefix(comma + 1);
  }
  return place;
}

}  // namespace

Result<Eigen::Vector3d> findPlace(const ReferenceModel& model, const std::string& text) {
  const auto landmark = model.landmarks.find(text);
  if (landmark != model.landmarks.end()) return position(*model.mesh, landmark->second);
  if (const auto place = parsePlace(text)) return *place;
  std::string names;
  for (const auto& [name, point] : model.landmarks) names += (names.empty() ? "" : ", ") + name;
  return Error{ErrorCode::NameNotFound,
               fmt::format("\"{}\" is neither a place x,y,z in mm nor a landmark of the model; {}",
                           text, names.empty() ? "it has none" : "there are " + names),
               {}};
}

}  // namespace toile::cli
