// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/recovery.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>

#include "document/design_store.h"
#include "toile/core/file.h"

namespace toile::studio {

namespace {

std::filesystem::path beside(const std::filesystem::path& file, const char* ending) {
  std::filesystem::path path = file;
  return path.replace_extension(ending);
}

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace

std::filesystem::path recoveryFolder() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
  return std::filesystem::path(data.toStdString()) / "recovery";
}

Recovery::Recovery(const std::filesystem::path& folder) : folder_(folder) {
  if (!makeFolder(folder)) return;
  const std::string name = std::to_string(QCoreApplication::applicationPid()) + "-" +
                           std::to_string(QDateTime::currentMSecsSinceEpoch());
  file_ = folder / (name + ".toile");
  lock_ = std::make_unique<QLockFile>(text(beside(file_, ".lock")));
  lock_->setStaleLockTime(0);  // held for as long as the program runs
  lock_->tryLock(0);
}

Recovery::~Recovery() {
  forget();
}

void Recovery::forget() {
  if (file_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  std::filesystem::remove(beside(file_, ".origin"), ignored);
  last_.reset();
}

Result<void> Recovery::keep(const Document& document, const std::filesystem::path& origin,
                            const std::filesystem::path& original) {
  if (file_.empty() || document.design == last_) return {};
  if (const auto done = writeFileWhole(beside(file_, ".origin"), original.string()); !done) {
    return done;
  }
  const Result<void> done = saveDesign(document, origin, file_);
  if (!done) return done;
  last_ = document.design;
  lastWritten_ = QDateTime::currentDateTime();
  return {};
}

std::optional<LeftWork> Recovery::findLeftWork() const {
  const QFileInfoList files =
      QDir(text(folder_)).entryInfoList({QStringLiteral("*.toile")}, QDir::Files, QDir::Time);
  for (const QFileInfo& info : files) {
    const std::filesystem::path file = info.filePath().toStdString();
    if (file == file_) continue;
    QLockFile lock(text(beside(file, ".lock")));
    lock.setStaleLockTime(0);
    if (!lock.tryLock(0)) continue;  // its program lives
    const Result<std::string> original = readFile(beside(file, ".origin"));
    return LeftWork{file, original ? *original : std::string(), info.lastModified()};
  }
  return std::nullopt;
}

void Recovery::discard(const LeftWork& work) {
  std::error_code ignored;
  std::filesystem::remove(work.backup, ignored);
  std::filesystem::remove(beside(work.backup, ".origin"), ignored);
}

}  // namespace toile::studio
