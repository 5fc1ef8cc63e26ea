// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/tool.h"

#include "tools/click_tools.h"
#include "tools/curve_tool.h"
#include "tools/erase_tool.h"
#include "tools/extend_tool.h"
#include "tools/fair_tool.h"
#include "tools/measure_tool.h"
#include "tools/mirror_copy_tool.h"
#include "tools/parallel_tool.h"
#include "tools/pencil_tool.h"
#include "tools/select_tool.h"

namespace toile::studio {

bool Tool::takesPress(const PointerEvent& event, ToolHost& host) const {
  return hitBody(host, event.at).has_value();
}

std::unique_ptr<Tool> makeTool(ToolId id) {
  switch (id) {
    case ToolId::Pencil:
      return std::make_unique<PencilTool>();
    case ToolId::Curve:
      return std::make_unique<CurveTool>();
    case ToolId::LeastLength:
      return std::make_unique<LeastLengthTool>();
    case ToolId::Girth:
      return std::make_unique<GirthTool>();
    case ToolId::Dart:
      return std::make_unique<DartTool>();
    case ToolId::Trim:
      return std::make_unique<TrimTool>();
    case ToolId::Split:
      return std::make_unique<SplitTool>();
    case ToolId::Join:
      return std::make_unique<JoinTool>();
    case ToolId::Extend:
      return std::make_unique<ExtendTool>();
    case ToolId::Erase:
      return std::make_unique<EraseTool>();
    case ToolId::Parallel:
      return std::make_unique<ParallelTool>();
    case ToolId::MirrorCopy:
      return std::make_unique<MirrorCopyTool>();
    case ToolId::Fair:
      return std::make_unique<FairTool>();
    case ToolId::Measure:
      return std::make_unique<MeasureTool>();
    case ToolId::Select:
      break;
  }
  return std::make_unique<SelectTool>();
}

}  // namespace toile::studio
