// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>

namespace toile::studio {

/// The designs that were worked on last, with a small picture each; kept in the settings.
class RecentDesigns {
 public:
  [[nodiscard]] static QStringList all();  ///< newest first; those that are gone are left out
  static void add(const QString& file, const QImage& picture);
  static void remove(const QString& file);
  [[nodiscard]] static QImage pictureOf(const QString& file);  ///< null if there is none
};

}  // namespace toile::studio
