// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/io/hpgl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "io/machine_lines.h"

namespace toile {
namespace {

constexpr double kUnitsPerMm = 40;
constexpr double kMostVersion1Mm = 32767 / kUnitsPerMm;
constexpr double kMostMm = 50000;
constexpr std::size_t kLongestLine = 200;

struct Position {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

class Writer {
 public:
  Writer(const SheetDrawing& sheet, const HpglOptions& options)
      : sheet_(sheet), options_(options) {}

  std::string write() {
    const Eigen::Vector2d size = sheet_.max - sheet_.min;
    text_ = "IN;\n";
    if (options_.version2)
      text_ += fmt::format("PS{},{};\n", units(isTurned() ? size.y() : size.x()),
                           units(isTurned() ? size.x() : size.y()));
    text_ += "PA;\n";
    for (const MachineLine& line : machineLines(sheet_.around)) draw(line);
    for (const PieceDrawing& piece : sheet_.pieces)
      for (const MachineLine& line : machineLines(piece)) draw(line);
    text_ += "PU;\nSP0;\n";
    if (options_.version2) text_ += "PG;\n";
    return std::move(text_);
  }

 private:
  static std::int64_t units(double mm) { return std::llround(mm * kUnitsPerMm); }

  /// The longer side of the sheet (of a marker its length) is the plotter's X; turned, not
  /// mirrored.
  [[nodiscard]] Position toPlotter(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d size = sheet_.max - sheet_.min;
    Eigen::Vector2d q = p - sheet_.min;
    if (isTurned()) q = {q.y(), size.x() - q.x()};
    if (options_.originInMiddle)
      q -= 0.5 * (isTurned() ? Eigen::Vector2d(size.y(), size.x()) : size);
    return {units(q.x()), units(q.y())};
  }
  [[nodiscard]] bool isTurned() const {
    const Eigen::Vector2d size = sheet_.max - sheet_.min;
    return !sheet_.isMarker && size.y() > size.x();
  }

  [[nodiscard]] int penOf(MachineTask task) const {
    switch (task) {
      case MachineTask::Engrave:
        return options_.textPen;
      case MachineTask::Mark:
        return options_.drawPen;
      case MachineTask::Cut:
        return options_.cutPen;
    }
    return options_.drawPen;
  }

  void draw(const MachineLine& line) {
    std::vector<Position> way;
    for (const Eigen::Vector2d& p : line.points) {
      const Position q = toPlotter(p);
      if (way.empty() || way.back() != q) way.push_back(q);
    }
    if (line.closed && way.size() > 2) {
      if (way.back() != way.front()) way.push_back(way.front());
      if (line.task == MachineTask::Cut && options_.overcut > 0) addOvercut(line, way);
    }
    if (way.size() < 2) return;
    if (const int pen = penOf(line.task); pen != pen_) {
      text_ += fmt::format("PU;SP{};\n", pen);
      pen_ = pen;
    }
    text_ += fmt::format("PU{},{};\n", way[0].x, way[0].y);
    std::string command;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const std::string next = fmt::format("{},{}", way[i].x, way[i].y);
      if (command.size() + next.size() + 2 > kLongestLine) {
        text_ += command + ";\n";
        command.clear();
      }
      command += (command.empty() ? "PD" : ",") + next;
    }
    text_ += command + ";\n";
  }

  void addOvercut(const MachineLine& line, std::vector<Position>& way) const {
    double left = options_.overcut;
    for (std::size_t i = 0; i + 1 < line.points.size() && left > 0; ++i) {
      const Eigen::Vector2d d = line.points[i + 1] - line.points[i];
      const double length = d.norm();
      if (length <= 0) continue;
      way.push_back(toPlotter(line.points[i] + std::min(1.0, left / length) * d));
      left -= length;
    }
  }

  const SheetDrawing& sheet_;
  HpglOptions options_;
  std::string text_;
  int pen_ = 0;
};

}  // namespace

Result<std::string> writeHpgl(const SheetDrawing& sheet, const HpglOptions& options) {
  for (const int pen : {options.drawPen, options.cutPen, options.textPen})
    if (pen < 1 || pen > 8)
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("a plotter has pens 1 to 8, and {} is none", pen),
                   {}};
  if (!(options.overcut >= 0 && options.overcut <= 20))
    return Error{ErrorCode::InvalidArgument,
                 fmt::format("an overcut of {} mm; give 0 to 20 mm", options.overcut),
                 {}};
  const Eigen::Vector2d size = sheet.max - sheet.min;
  const double most = options.version2 ? kMostMm : kMostVersion1Mm;
  if (size.maxCoeff() > most)
    return Error{ErrorCode::Unsupported,
                 fmt::format("the sheet is {:.0f} x {:.0f} mm and {} holds at most {:.0f} mm{}",
                             size.x(), size.y(), options.version2 ? "a plot" : "HP-GL/1", most,
                             options.version2 ? "" : "; use HP-GL/2"),
                 {}};
  return Writer(sheet, options).write();
}

}  // namespace toile
