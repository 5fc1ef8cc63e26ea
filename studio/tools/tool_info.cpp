// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/tool_info.h"

#include <QCoreApplication>

namespace toile::studio {

namespace {

constexpr ToolInfo kTools[] = {
    {ToolId::Select, QT_TRANSLATE_NOOP("Tools", "Select"), "select", "V", 0},
    {ToolId::Pencil, QT_TRANSLATE_NOOP("Tools", "Pencil"), "pencil", "P", 1},
    {ToolId::Curve, QT_TRANSLATE_NOOP("Tools", "Curve"), "curve", "C", 1},
    {ToolId::LeastLength, QT_TRANSLATE_NOOP("Tools", "Least length"), "least-length", "L", 1},
    {ToolId::Girth, QT_TRANSLATE_NOOP("Tools", "Girth"), "girth", "G", 1},
    {ToolId::Dart, QT_TRANSLATE_NOOP("Tools", "Dart"), "dart", "D", 1},
    {ToolId::Trim, QT_TRANSLATE_NOOP("Tools", "Trim"), "trim", "T", 2},
    {ToolId::Split, QT_TRANSLATE_NOOP("Tools", "Split"), "split", "B", 2},
    {ToolId::Join, QT_TRANSLATE_NOOP("Tools", "Join"), "join", "J", 2},
    {ToolId::Extend, QT_TRANSLATE_NOOP("Tools", "Extend"), "extend", "N", 2},
    {ToolId::Erase, QT_TRANSLATE_NOOP("Tools", "Erase"), "erase", "E", 2},
    {ToolId::Parallel, QT_TRANSLATE_NOOP("Tools", "Parallel"), "parallel", "O", 2},
    {ToolId::MirrorCopy, QT_TRANSLATE_NOOP("Tools", "Mirror copy"), "mirror-copy", "M", 2},
    {ToolId::Fair, QT_TRANSLATE_NOOP("Tools", "Fair"), "fair", "R", 2},
    {ToolId::Measure, QT_TRANSLATE_NOOP("Tools", "Measure"), "measure", "U", 3},
};

}  // namespace

std::span<const ToolInfo> allTools() {
  return kTools;
}

const ToolInfo& infoOf(ToolId id) {
  for (const ToolInfo& info : kTools) {
    if (info.id == id) return info;
  }
  return kTools[0];
}

QString nameOf(const ToolInfo& info) {
  return QCoreApplication::translate("Tools", info.name);
}

}  // namespace toile::studio
