// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "toile/design/design.h"

namespace toile::cli {

/// Writes a model beside `out`: its mesh as NAME.ply and its names as NAME.model.json.
/// @return the name of the latter file
Result<std::string> writeModelBeside(const ReferenceModel& model, const std::filesystem::path& out);
/// Writes a design that is for the model of that reference; the folder is made where it misses.
Result<void> writeDesignFor(Design design, const std::string& model,
                            const std::filesystem::path& out);
/// Writes the design, and the model that it is for beside it.
Result<void> writeDesignAndModel(const Document& document, const std::filesystem::path& out);

}  // namespace toile::cli
