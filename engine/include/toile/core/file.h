// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "toile/core/result.h"

namespace toile {

inline constexpr std::size_t kMaxFileBytes = std::size_t{2} << 30;

/// The whole file; refuses a folder, a missing or unreadable file, and more than maxBytes.
Result<std::string> readFile(const std::filesystem::path& path,
                             std::size_t maxBytes = kMaxFileBytes);

/// Writes beside the target, flushes, then renames: the target is either the old or the whole new
/// file, also when the disk is full. Links at the target are followed; permissions of an existing
/// target are kept. @return FileUnwritable naming path and reason
Result<void> writeFileWhole(const std::filesystem::path& path, std::string_view content);

/// Makes the folder and its parents if needed. @return FileUnwritable
Result<void> makeFolder(const std::filesystem::path& path);

}  // namespace toile
