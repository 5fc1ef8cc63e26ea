// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/recent_designs.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

namespace toile::studio {

namespace {

constexpr int kMost = 12;
constexpr QSize kPicture(336, 230);

QString key() {
  return QStringLiteral("recent");
}

QString pictureFile(const QString& file) {
  const QByteArray name = QCryptographicHash::hash(file.toUtf8(), QCryptographicHash::Sha1).toHex();
  return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) +
         QStringLiteral("/pictures/") + QString::fromLatin1(name) + QStringLiteral(".png");
}

}  // namespace

QStringList RecentDesigns::all() {
  QStringList files = QSettings().value(key()).toStringList();
  files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
  return files;
}

void RecentDesigns::add(const QString& file, const QImage& picture) {
  const QString path = QFileInfo(file).absoluteFilePath();
  QStringList files = QSettings().value(key()).toStringList();
  files.removeAll(path);
  files.prepend(path);
  for (; files.size() > kMost; files.removeLast()) QFile::remove(pictureFile(files.last()));
  QSettings().setValue(key(), files);
  if (picture.isNull()) return;
  QDir().mkpath(QFileInfo(pictureFile(path)).path());
  picture.scaled(kPicture, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation)
      .save(pictureFile(path));
}

void RecentDesigns::remove(const QString& file) {
  QStringList files = QSettings().value(key()).toStringList();
  files.removeAll(file);
  QSettings().setValue(key(), files);
  QFile::remove(pictureFile(file));
}

QImage RecentDesigns::pictureOf(const QString& file) {
  return QImage(pictureFile(file));
}

}  // namespace toile::studio
