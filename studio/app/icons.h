// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>
#include <QString>

namespace toile::studio {

/// A drawn icon by its name ("pencil", "undo", ...), in a colour of the theme; on 20 px, sharp at
/// any size. An unknown name gives an empty icon.
[[nodiscard]] QIcon icon(const QString& name);
[[nodiscard]] QIcon icon(const QString& name, const QColor& colour);

}  // namespace toile::studio
