// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "toile/model/guiding_map.h"

namespace toile::detail {

using Json = nlohmann::json;

/// FileFormat with the byte where the text stops being JSON.
Result<Json> parseJson(std::string_view text, const std::string& file);

/// The object under "curves" / "landmarks" of `json`; `file` is for messages.
Result<std::map<std::string, SurfacePath>> readCurves(const Mesh& mesh, const Json& json,
                                                      const std::string& file);
Result<std::map<std::string, SurfacePoint>> readLandmarks(const Mesh& mesh, const Json& json,
                                                          const std::string& file);
/// The object under "guidingMap" of `json`.
Result<GuidingMap> readGuidingMap(const ReferenceModel& model, const Json& json,
                                  const std::string& file);

}  // namespace toile::detail
