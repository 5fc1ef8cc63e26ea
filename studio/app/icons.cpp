// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/icons.h"

#include <QHash>
#include <QPainter>
#include <QPixmap>
#include <QSvgRenderer>

#include "app/palette.h"

namespace toile::studio {

namespace {

/// What lies between <svg> and </svg>, on a grid of 20 x 20; strokes 1.5, round.
const QHash<QString, const char*>& drawings() {
  static const QHash<QString, const char*> kDrawings = {
      {"select", "<path d='M5 3l10 7.5-4.6.7 2.6 4.9-2 1-2.5-4.9L5 15.5z'/>"},
      {"pencil",
       "<path d='M4 16l.9-3.6L13.6 3.7a1.4 1.4 0 0 1 2 0l.7.7a1.4 1.4 0 0 1 0 2L7.6 15.1z"
       "M12.2 5.1l2.7 2.7'/>"},
      {"curve",
       "<path d='M3.5 16C7 16 6.500 5.500 10 5.500S13 14 16.500 14'/>"
       "<circle class='d' cx='3.500' cy='16' r='1.700'/>"
       "<circle class='d' cx='10' cy='5.500' r='1.700'/>"
       "<circle class='d' cx='16.500' cy='14' r='1.700'/>"},
      {"least-length",
       "<path d='M4 15.500L16 6'/><path stroke-dasharray='1.500 2.500' "
       "d='M4 13C4 7 9 3.500 14 4.500'/><circle class='d' cx='4' cy='15.500' r='1.700'/>"
       "<circle class='d' cx='16' cy='6' r='1.700'/>"},
      {"girth",
       "<path d='M6 2.500c1 4-1 6 0 15M14 2.500c-1 4 1 6 0 15'/>"
       "<path d='M3 10c0-2.400 14-2.400 14 0s-14 2.400-14 0z'/>"
       "<circle class='d' cx='10' cy='11.800' r='1.700'/>"},
      {"dart",
       "<path d='M3 4h3.500L10 16.500 13.500 4H17'/><path stroke-dasharray='2 2' d='M10 4v9'/>"},
      {"trim",
       "<path d='M3 14C6 8 14 8 17 14M10 3v5'/><circle class='d' cx='10' cy='9.600' r='1.700'/>"
       "<path stroke-dasharray='1.500 2.200' d='M10 12v5'/>"},
      {"split",
       "<path d='M3 15c2-5 3.500-6.500 5.500-7M11.500 12.500c2-.5 4-3 5.500-7M8 12.500L12 7'/>"},
      {"join",
       "<path d='M2.500 14c2.500 0 3.500-1 5-2.500M12.500 8.500C14 7 15 6 17.500 6'/>"
       "<circle cx='10' cy='10' r='3'/>"},
      {"extend",
       "<path d='M3 15c2-1 4-3 6-5.500'/><path stroke-dasharray='1.500 2.200' d='M10 "
       "8.500l4.500-4'/>"
       "<path d='M12 2.500c2.500 1 4 2.500 5 5'/><circle class='d' cx='9.200' cy='9.300' "
       "r='1.700'/>"},
      {"erase",
       "<path d='M8 16.500l-4-4a1.500 1.500 0 0 1 0-2L10.500 4a1.500 1.500 0 0 1 2 0l3.500 3.500"
       "a1.500 1.500 0 0 1 0 2l-7 7zM7 7.500l5.500 5.500M8 16.500h9'/>"},
      {"parallel",
       "<path d='M3 16C5 9.500 15 9.500 17 16'/>"
       "<path stroke-dasharray='2 2' d='M4.500 9.500C7.500 5 12.500 5 15.500 9.500'/>"
       "<path d='M10 10.500V3M8 5l2-2 2 2'/>"},
      {"mirror-copy",
       "<path stroke-dasharray='3 2 .5 2' d='M10 2.500v15'/>"
       "<path d='M7 5C3 7.500 3 12.500 7 15M13 5c4 2.500 4 7.500 0 10'/>"},
      {"fair",
       "<path d='M3 13C7 7 13 7 17 11'/>"
       "<path stroke-dasharray='1.500 2.200' d='M3 10c2-5 4 2 7-2s4 3 7-1'/>"},
      {"measure",
       "<path d='M3 13.500L13.500 3 17 6.500 6.500 17zM6 10.500l1.500 1.500M8.500 8l2 2M11 5.500"
       "l1.500 1.500'/>"},
      {"grain", "<path d='M10 3v14M7.500 5.500L10 3l2.500 2.500M7.500 14.500L10 17l2.500-2.500'/>"},
      {"notch", "<path d='M2.500 8H7l3 4 3-4h4.500'/>"},
      {"allowance",
       "<path d='M6 17V10a4 4 0 0 1 8 0v7'/>"
       "<path stroke-dasharray='2 2' d='M3 17V9.500a7 7 0 0 1 14 0V17'/>"},
      {"label",
       "<path d='M3 6.500A1.500 1.500 0 0 1 4.500 5h8L17 10l-4.500 5h-8A1.500 1.500 0 0 1 3 "
       "13.500z'/>"
       "<circle class='d' cx='6.500' cy='10' r='1'/>"},
      {"piece", "<path d='M4 5l3-1.500c1 2 5 2 6 0L16 5l-1 4 1 7.500H4L5 9z'/>"},
      {"body",
       "<circle cx='10' cy='4.500' r='2'/><path d='M6 9.500c2-1.500 6-1.500 8 0M6 9.500l-1 4M14 "
       "9.500"
       "l1 4M7.500 9v4L7 17.500M12.500 9v4l.5 4.500M7.500 13h5'/>"},
      {"strain", "<path d='M3.500 3v13.500H17M3.500 13C7 13 7 6 10 6s3 7 6.500 7'/>"},
      {"eye",
       "<path d='M2.500 10C5 5.500 15 5.500 17.500 10 15 14.500 5 14.500 2.500 10z'/>"
       "<circle cx='10' cy='10' r='2.200'/>"},
      {"see-through",
       "<path d='M8 8h8.500v8.500H8z'/><path stroke-dasharray='2 2' d='M12 8V3.500H3.500V12H8'/>"},
      {"fit",
       "<path d='M3 6.500V3h3.500M13.500 3H17v3.500M17 13.500V17h-3.500M6.500 17H3v-3.500'/>"
       "<circle cx='10' cy='10' r='2.200'/>"},
      {"lock", "<path d='M5 9h10v7.500H5zM7 9V6.500a3 3 0 0 1 6 0V9'/>"},
      {"unlock", "<path d='M5 9h10v7.500H5zM7 9V6a3 3 0 0 1 5.800-1'/>"},
      {"link",
       "<path d='M8.500 11.500l3-3M7.500 8.500l-2 2a2.800 2.800 0 0 0 4 4l2-2M12.500 "
       "11.500l2-2a2.800 2.800 "
       "0 0 0-4-4l-2 2'/>"},
      {"unlink",
       "<path d='M7.500 8.500l-2 2a2.800 2.800 0 0 0 4 4l2-2M12.500 11.500l2-2a2.800 2.800 0 0 "
       "0-4-4l-2 "
       "2M4 4l1.500 1.500M16 16l-1.500-1.500'/>"},
      {"snap",
       "<path d='M5 3.500v7a5 5 0 0 0 10 0v-7h-3v7a2 2 0 0 1-4 0v-7zM5 6.500h3M12 6.500h3'/>"},
      {"undo", "<path d='M7 4L3.500 7.500 7 11M3.500 7.500H12a4.500 4.500 0 0 1 0 9H8'/>"},
      {"redo", "<path d='M13 4l3.500 3.500L13 11M16.500 7.500H8a4.500 4.500 0 0 0 0 9h4'/>"},
      {"history", "<path d='M4 6.500A7 7 0 1 1 3 11M4 3v3.500h3.500M10 6v4l3 2'/>"},
      {"open", "<path d='M3 16V4.500h5l1.500 2H15V9M3 16l2.500-7H18l-2.500 7z'/>"},
      {"folder", "<path d='M3 5h5l1.500 2H17v9H3z'/>"},
      {"save", "<path d='M4 4h9.500L16 6.500V16H4zM7 4v3.500h5V4M6.500 16v-5h7v5'/>"},
      {"export", "<path d='M10 12V3M6.500 6L10 2.500 13.500 6M4 11v5.500h12V11'/>"},
      {"page", "<path d='M5 3h6.500L15 6.500V17H5zM11.500 3v3.500H15'/>"},
      {"print", "<path d='M6 7V3h8v4M6 14H3V7h14v7h-3M6 11.500h8V17H6z'/>"},
      {"picture",
       "<path d='M3 6h3.500L8 4h4l1.500 2H17v10H3z'/><circle cx='10' cy='11' r='2.800'/>"},
      {"warn", "<path d='M10 3.500L17.500 16h-15zM10 8v4M10 14v.2'/>"},
      {"info", "<circle cx='10' cy='10' r='7'/><path d='M10 9.500v4M10 6.500v.2'/>"},
      {"ok", "<circle cx='10' cy='10' r='7'/><path d='M6.800 10.200l2.300 2.300 4.300-4.600'/>"},
      {"help",
       "<circle cx='10' cy='10' r='7'/><path d='M7.800 8a2.200 2.200 0 1 1 3.200 2c-.8.4-1 .9-1 "
       "1.500"
       "M10 14v.2'/>"},
      {"plus", "<path d='M10 4v12M4 10h12'/>"},
      {"close", "<path d='M5 5l10 10M15 5L5 15'/>"},
      {"more",
       "<circle class='d' cx='5' cy='10' r='1.300'/><circle class='d' cx='10' cy='10' r='1.300'/>"
       "<circle class='d' cx='15' cy='10' r='1.300'/>"},
      {"search", "<circle cx='9' cy='9' r='5'/><path d='M12.700 12.700L17 17'/>"},
      {"settings",
       "<circle cx='10' cy='10' r='2.500'/><path d='M10 2.500v3M10 14.500v3M2.500 10h3M14.500 10"
       "h3M4.700 4.700l2.100 2.100M13.200 13.200l2.100 2.100M4.700 15.300l2.100-2.100M13.200 "
       "6.800l2.100-2.100'/>"},
      {"trash", "<path d='M3.500 6h13M8 6V3.500h4V6M5 6l.8 11h8.400L15 6M8.500 9v5M11.500 9v5'/>"},
      {"play", "<path d='M6 4l10 6-10 6z'/>"},
      {"chevron-down", "<path d='M5.500 8l4.500 4.500L14.500 8'/>"},
      {"chevron-right", "<path d='M8 5.500L12.500 10 8 14.500'/>"},
      {"chevron-left", "<path d='M12 5.500L7.500 10l4.500 4.500'/>"},
  };
  return kDrawings;
}

QPixmap drawn(const QString& name, const QColor& colour, int pixels) {
  const auto found = drawings().find(name);
  QPixmap pixmap(pixels, pixels);
  pixmap.fill(Qt::transparent);
  if (found == drawings().end()) return pixmap;
  QString svg = QStringLiteral(
                    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 20 20'><g fill='none' "
                    "stroke='%1' stroke-width='1.5' stroke-linecap='round' "
                    "stroke-linejoin='round'>%2</g></svg>")
                    .arg(colour.name(), QString::fromLatin1(*found));
  svg.replace(QLatin1String("class='d'"),
              QStringLiteral("fill='%1' stroke='none'").arg(colour.name()));
  QSvgRenderer renderer(svg.toUtf8());
  QPainter painter(&pixmap);
  renderer.render(&painter);
  return pixmap;
}

void addSizes(QIcon& icon, const QString& name, const QColor& colour, QIcon::Mode mode,
              QIcon::State state) {
  for (const int size : {16, 20, 28, 40, 56})
    icon.addPixmap(drawn(name, colour, size), mode, state);
}

}  // namespace

QIcon icon(const QString& name, const QColor& colour) {
  QIcon made;
  addSizes(made, name, colour, QIcon::Normal, QIcon::Off);
  addSizes(made, name, palette().disabled, QIcon::Disabled, QIcon::Off);
  return made;
}

QIcon icon(const QString& name) {
  return icon(name, palette().text);
}

}  // namespace toile::studio
