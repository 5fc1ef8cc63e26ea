// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "toile/core/result.h"

namespace toile {

/// Files that belong together: all of them are written, or none.
class FileSet {
 public:
  /// @param name below the folder, with "/" between folders
  void add(std::string name, std::string content);

  /// Writes everything under temporary names inside the folder first; only when all of it is safely
  /// there are the files renamed to their places. On an error the folder is as it was before.
  ///
  /// @param outdated names that an earlier run wrote; those not in this set are removed.
  /// @return FileUnwritable naming the file and the reason
  Result<void> write(const std::filesystem::path& folder,
                     const std::vector<std::string>& outdated) const;

 private:
  std::vector<std::pair<std::string, std::string>> files_;
};

/// The piece files that the report of an earlier run lists; nothing when there is no such report.
/// Only plain names directly below pieces/ are given back: the report may have been edited.
std::vector<std::string> reportedFiles(const std::filesystem::path& report);

}  // namespace toile
