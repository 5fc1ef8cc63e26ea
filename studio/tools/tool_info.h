// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <span>

#include "tools/tool.h"

namespace toile::studio {

/// How a tool is presented: in the rail, in menus and in the history.
struct ToolInfo {
  ToolId id;
  const char* name;  ///< in English; nameOf() translates
  const char* icon;
  const char* key;
  int group;  ///< a line parts the groups of the rail
};

/// The rail, top to bottom.
[[nodiscard]] std::span<const ToolInfo> allTools();
[[nodiscard]] const ToolInfo& infoOf(ToolId id);
[[nodiscard]] QString nameOf(const ToolInfo& info);

}  // namespace toile::studio
