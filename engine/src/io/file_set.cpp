// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "toile/core/file.h"
#include "toile/io/report.h"

namespace toile {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxReportBytes = std::size_t{64} << 20U;

Error unwritable(const fs::path& path, const std::string& why) {
  return {ErrorCode::FileUnwritable,
          fmt::format("cannot write {}: {}; choose another folder with -o or make room",
                      path.string(), why),
          {}};
}

/// Folders that had to be made, so that a failed run can take them away again.
class MadeFolders {
 public:
  Result<void> make(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) {
      missing.push_back(at);
      if (at == at.parent_path()) break;
    }
    if (const Result<void> done = makeFolder(folder); !done) {
      made_.insert(made_.end(), missing.rbegin(), missing.rend());
      return done;
    }
    made_.insert(made_.end(), missing.rbegin(), missing.rend());
    return {};
  }
  void keep() { made_.clear(); }
  ~MadeFolders() {
    std::error_code ignored;  // a folder that is not empty stays
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) {
      fs::remove(*folder, ignored);
    }
  }
  MadeFolders() = default;
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

 private:
  std::vector<fs::path> made_;
};

/// A folder for unfinished files on the same disk as the target; gone at the end with its content.
class Staging {
 public:
  explicit Staging(const fs::path& folder) {
    std::string name = (folder / ".toile-unfinished-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      error_ = errno;
    } else {
      path_ = name;
    }
  }
  ~Staging() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  [[nodiscard]] int error() const { return error_; }
  [[nodiscard]] fs::path fresh() const { return path_ / "new"; }
  [[nodiscard]] fs::path earlier() const { return path_ / "earlier"; }

 private:
  fs::path path_;
  int error_ = 0;
};

std::string numbered(std::size_t i) {
  return fmt::format("{}", i);
}

}  // namespace

void FileSet::add(std::string name, std::string content) {
  files_.emplace_back(std::move(name), std::move(content));
}

Result<void> FileSet::write(const fs::path& folder,
                            const std::vector<std::string>& outdated) const {
  MadeFolders folders;
  if (const Result<void> done = folders.make(folder); !done) return done;
  for (const auto& [name, content] : files_) {
    if (const Result<void> done = folders.make((folder / name).parent_path()); !done) return done;
  }

  // The places, where links lead if there are any.
  std::vector<fs::path> targets;
  std::error_code error;
  for (const auto& [name, content] : files_) {
    fs::path target = fs::weakly_canonical(folder / name, error);
    if (error) target = folder / name;
    if (fs::is_directory(target, error)) return unwritable(folder / name, "it is a folder");
    if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
      return unwritable(folder / name, "it is a device, not a file");  // renaming would replace it
    }
    targets.push_back(std::move(target));
  }

  Staging staging(folder);
  if (staging.error() != 0) return unwritable(folder, std::strerror(staging.error()));
  fs::create_directory(staging.fresh(), error);
  if (!error) fs::create_directory(staging.earlier(), error);
  if (error) return unwritable(folder, error.message());
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const fs::path unfinished = staging.fresh() / numbered(i);
    if (const Result<void> done = writeFileWhole(unfinished, files_[i].second); !done) {
      // The message shall name the file that the user expects, not its temporary name.
      std::string message = done.error().message;
      const std::string inner = unfinished.string();
      if (const std::size_t at = message.find(inner); at != std::string::npos) {
        message.replace(at, inner.size(), (folder / files_[i].first).string());
      }
      return Error{done.error().code, message, done.error().where};
    }
  }

  // Second names for what is about to be replaced: the way back. Where the disk knows no hard
  // links there is none, and a failing rename is so unlikely here that it is accepted.
  for (std::size_t i = 0; i < files_.size(); ++i) {
    fs::create_hard_link(targets[i], staging.earlier() / numbered(i), error);
  }
  for (std::size_t i = 0; i < files_.size(); ++i) {
    fs::rename(staging.fresh() / numbered(i), targets[i], error);
    if (!error) continue;
    const Error why = unwritable(folder / files_[i].first, error.message());
    for (std::size_t k = 0; k < i; ++k) {
      const fs::path before = staging.earlier() / numbered(k);
      std::error_code ignored;
      if (fs::exists(before, ignored)) {
        fs::rename(before, targets[k], ignored);
      } else {
        fs::remove(targets[k], ignored);
      }
    }
    return why;
  }
  folders.keep();

  std::set<std::string> current;
  for (const auto& [name, content] : files_) current.insert(name);
  for (const std::string& name : outdated) {
    if (!current.contains(name)) fs::remove(folder / name, error);
  }
  return {};
}

std::vector<std::string> reportedFiles(const fs::path& report) {
  std::vector<std::string> names;
  const Result<std::string> text = readFile(report, kMaxReportBytes);
  if (!text) return names;
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("format") || json["format"] != "toile-report")
    return names;
  const auto pieces = json.find("pieces");
  if (pieces == json.end() || !pieces->is_array()) return names;
  const std::string prefix = "pieces/";
  for (const nlohmann::json& piece : *pieces) {
    if (!piece.is_object()) continue;
    const auto file = piece.find("file");
    if (file == piece.end() || !file->is_string()) continue;
    const auto name = file->get<std::string>();
    const bool isPlain = name.starts_with(prefix) && name.ends_with(".obj") &&
                         name.find('/', prefix.size()) == std::string::npos;
    if (!isPlain) continue;
    names.push_back(name);
    names.push_back(plyFileName(name));
  }
  return names;
}

}  // namespace toile
