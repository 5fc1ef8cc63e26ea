// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "io/dxf_text.h"
#include "io/machine_lines.h"
#include "toile/io/dxf.h"

namespace toile {
namespace {

struct LaserLayer {
  MachineTask task;
  const char* name;
  int colour;  ///< of the index of AutoCAD
};
constexpr std::array<LaserLayer, 3> kLayers{{{MachineTask::Engrave, "ENGRAVE", 3},
                                             {MachineTask::Mark, "MARK", 5},
                                             {MachineTask::Cut, "CUT", 1}}};

}  // namespace

std::string writeLaserDxf(const SheetDrawing& sheet) {
  DxfText out;
  out.section("HEADER");
  out.group(9, "$ACADVER");
  out.group(1, "AC1009");
  out.group(9, "$INSUNITS");
  out.group(70, 4);
  out.endSection();
  out.section("TABLES");
  out.group(0, "TABLE");
  out.group(2, "LAYER");
  out.group(70, static_cast<int>(kLayers.size()));
  for (const LaserLayer& layer : kLayers) {
    out.group(0, "LAYER");
    out.group(2, layer.name);
    out.group(70, 0);
    out.group(62, layer.colour);
    out.group(6, "CONTINUOUS");
  }
  out.group(0, "ENDTAB");
  out.endSection();
  out.section("ENTITIES");
  std::vector<std::vector<MachineLine>> pieces;
  for (const PieceDrawing& piece : sheet.pieces) pieces.push_back(machineLines(piece));
  // All that is engraved, then all marks, then the cuts: what is cut may move.
  for (const LaserLayer& layer : kLayers)
    for (const std::vector<MachineLine>& lines : pieces)
      for (const MachineLine& line : lines) {
        if (line.task != layer.task) continue;
        std::vector<DxfPoint> points;
        for (const Eigen::Vector2d& p : line.points) points.push_back(toDxf(p - sheet.min));
        out.polyline(layer.name, points, line.closed, layer.colour);
      }
  out.endSection();
  out.group(0, "EOF");
  return out.str();
}

}  // namespace toile
