// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/mirror_copy_tool.h"

#include <QCoreApplication>

#include "toile/edit/symmetry.h"
#include "tools/drawing.h"

namespace toile::studio {

namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(MirrorCopyTool)
};

}  // namespace

void MirrorCopyTool::show(ToolHost& host) const {
  if (curves_.empty()) return host.dropPreview();
  const Result<Edited> made = mirrorCurves(host.document(), curves_, host.options().symmetry);
  if (made) {
    host.preview(made->document, /*withPattern=*/false);
  } else {
    host.dropPreview();
  }
}

void MirrorCopyTool::move(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  hover_ = pick ? Selection::line(pick->curve) : Selection();
}

void MirrorCopyTool::press(const PointerEvent& event, ToolHost& host) {
  const auto pick = pickLine(host, event.at, kLineCatch);
  if (!pick) return;
  if (!host.document().model->symmetry) {
    return host.tell(Words::tr("This body has no left and right to copy between."));
  }
  const auto& curves = host.document().design->curves;
  if (std::ranges::none_of(curves, [&](const auto& c) { return c.id == pick->curve; })) return;
  const bool hasTwin = std::ranges::any_of(curves, [&](const StylingCurve& c) {
    return c.mirrorOf == pick->curve || (c.id == pick->curve && c.mirrorOf);
  });
  if (hasTwin) {
    return host.tell(Words::tr("%1 has a twin already.").arg(titleOf(host, pick->curve)));
  }
  const auto known = std::ranges::find(curves_, pick->curve);
  if (known != curves_.end()) {
    curves_.erase(known);
  } else {
    curves_.push_back(pick->curve);
  }
  show(host);
}

bool MirrorCopyTool::key(ToolKey key, ToolHost& host) {
  if (curves_.empty()) return false;
  switch (key) {
    case ToolKey::Enter: {
      const QString step =
          curves_.size() == 1
              ? Words::tr("Mirror copy of %1").arg(titleOf(host, curves_.front()))
              : Words::tr("Mirror copy of %n lines", nullptr, static_cast<int>(curves_.size()));
      const Result<Edited> made = mirrorCurves(host.document(), curves_, host.options().symmetry);
      curves_.clear();
      host.dropPreview();
      if (!made) {
        host.tell(QString::fromStdString(made.error().message));
      } else {
        host.commit(step, made->document);
      }
      return true;
    }
    case ToolKey::Backspace:
      curves_.pop_back();
      show(host);
      return true;
    case ToolKey::Escape:
      curves_.clear();
      host.dropPreview();
      return true;
    default:
      return false;
  }
}

void MirrorCopyTool::leave(ToolHost& host) {
  curves_.clear();
  hover_ = {};
  host.dropPreview();
}

QString MirrorCopyTool::hint(const ToolHost& host) const {
  if (curves_.empty())
    return Words::tr("<b>Mirror copy:</b> click lines, <Enter> copies them to the other side");
  return host.options().symmetry
             ? Words::tr(
                   "<b>Mirror copy:</b> <Enter> makes linked twins · click more lines · "
                   "<Backspace> take the last back · <Esc> cancel")
             : Words::tr(
                   "<b>Mirror copy:</b> <Enter> makes free copies · click more lines · "
                   "<Backspace> take the last back · <Esc> cancel");
}

Overlay MirrorCopyTool::overlay(const ToolHost& host) const {
  Overlay overlay;
  overlay.showMiddle = true;
  overlay.hover = hover_;
  for (const std::string& id : curves_) {
    const PlacedLine* line = host.lines().find(id);
    if (line == nullptr) continue;
    overlay.lines.push_back(
        {line->points, line->normals, line->curve.kind, OverlayLine::Style::Picked});
  }
  return overlay;
}

}  // namespace toile::studio
