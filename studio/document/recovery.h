// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDateTime>
#include <QLockFile>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>

#include "toile/design/design.h"

namespace toile::studio {

/// Work that a program left behind when it did not end as it should.
struct LeftWork {
  std::filesystem::path backup;
  std::filesystem::path original;  ///< where it was saved last; empty if never
  QDateTime written;
};

/// Where the copies of all programs of this user are.
[[nodiscard]] std::filesystem::path recoveryFolder();

/// Keeps a copy of the work in a folder of its own, for after a crash or a power cut. Each running
/// program has a file there, and a lock that tells the living from the dead.
class Recovery {
 public:
  /// @param folder made if needed; where it cannot be, nothing is kept
  explicit Recovery(const std::filesystem::path& folder);
  ~Recovery();  ///< removes the copy: the program ended as it should

  /// Writes the document unless it is the one written last.
  /// @param origin from where relative names of its models count
  Result<void> keep(const Document& document, const std::filesystem::path& origin,
                    const std::filesystem::path& original);
  void forget();
  [[nodiscard]] QDateTime lastWritten() const { return lastWritten_; }

  /// The newest work of a program that is gone.
  [[nodiscard]] std::optional<LeftWork> findLeftWork() const;
  static void discard(const LeftWork& work);

 private:
  std::filesystem::path folder_, file_;
  std::unique_ptr<QLockFile> lock_;
  std::shared_ptr<const Design> last_;
  QDateTime lastWritten_;
};

}  // namespace toile::studio
