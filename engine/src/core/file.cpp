// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace toile {

namespace {

std::string reason(int error) {
  return std::strerror(error);
}

/// Closes the descriptor at the end of its life.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  /// 0 or the error number; a full disk may show only here.
  int close() {
    const int status = ::close(fd_);
    fd_ = -1;
    return status == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

int writeAll(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(fd) == 0 || errno == EINVAL ? 0 : errno;
}

Error unwritable(const std::filesystem::path& path, const std::string& why) {
  return {
      ErrorCode::FileUnwritable,
      "cannot write " + path.string() + ": " + why + "; choose another folder with -o or make room",
      {}};
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    const int error = errno;
    if (error == ENOENT || error == ENOTDIR) {
      return Error{ErrorCode::FileNotFound,
                   "there is no file " + path.string() + "; check the name and the folder",
                   {}};
    }
    return Error{
        ErrorCode::FileUnreadable, "cannot read " + path.string() + ": " + reason(error), {}};
  }
  struct stat status {};
  if (::fstat(file.get(), &status) == 0 && S_ISDIR(status.st_mode)) {
    return Error{ErrorCode::FileUnreadable, path.string() + " is a folder, not a file", {}};
  }
  std::string content;
  if (status.st_size > 0) {
    content.reserve(std::min(static_cast<std::size_t>(status.st_size), maxBytes));
  }
  std::string chunk(std::size_t{1} << 18, '\0');
  while (true) {
    const ssize_t count = ::read(file.get(), chunk.data(), chunk.size());
    if (count == 0) return content;
    if (count < 0) {
      if (errno == EINTR) continue;
      return Error{
          ErrorCode::FileUnreadable, "cannot read " + path.string() + ": " + reason(errno), {}};
    }
    if (content.size() + static_cast<std::size_t>(count) > maxBytes) {
      return Error{ErrorCode::FileFormat,
                   path.string() + " is larger than " + std::to_string(maxBytes >> 20U) +
                       " MB, the most that is read",
                   {}};
    }
    content.append(chunk.data(), static_cast<std::size_t>(count));
  }
}

Result<void> writeFileWhole(const std::filesystem::path& path, std::string_view content) {
  std::error_code linkError;
  std::filesystem::path target = std::filesystem::weakly_canonical(path, linkError);
  if (linkError) target = path;
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return unwritable(path, "it is a folder");
  if (exists && !S_ISREG(status.st_mode)) {
    // A device or a pipe cannot be renamed over; it is written as it is.
    Descriptor file(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) return unwritable(path, reason(errno));
    if (const int error = writeAll(file.get(), content)) return unwritable(path, reason(error));
    if (const int error = file.close()) return unwritable(path, reason(error));
    return {};
  }
  std::string temporary = target.string() + ".XXXXXX";
  Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) return unwritable(path, reason(errno));
  // mkostemp gives 0600; a new file gets what the user's mask allows.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = exists ? status.st_mode & 07777U : 0666U & ~mask;
  int error = ::fchmod(file.get(), mode) == 0 ? 0 : errno;
  if (error == 0) error = writeAll(file.get(), content);
  if (const int closing = file.close(); error == 0) error = closing;
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    return unwritable(path, reason(error));
  }
  return {};
}

Result<void> makeFolder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) {
    return Error{ErrorCode::FileUnwritable,
                 "cannot make the folder " + path.string() + ": " + error.message() +
                     "; choose another one with -o",
                 {}};
  }
  return {};
}

}  // namespace toile
