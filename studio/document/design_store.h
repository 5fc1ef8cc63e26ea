// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "toile/design/design.h"

namespace toile::studio {

/// A document without lines on a built-in body: "builtin:body@1?size=EU38F".
Result<Document> emptyDocument(const std::string& builtin);

/// A document without lines on a model file.
Result<Document> emptyDocumentOn(const std::filesystem::path& model, std::optional<FileUnit> unit);

/// Writes the design so that it finds its models from its new place.
/// @param from where it was read or last saved; empty for one that was not. Relative names of
/// models
///   count from there.
Result<void> saveDesign(const Document& document, const std::filesystem::path& from,
                        const std::filesystem::path& to);

}  // namespace toile::studio
