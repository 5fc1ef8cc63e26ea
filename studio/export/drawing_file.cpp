// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/drawing_file.h"

#include <QStringList>

namespace toile::studio {

namespace {

const QColor kInks[] = {QColor("#16202E"), QColor("#A32020"), QColor("#1558D6"), QColor("#0A6650"),
                        QColor("#A34700"), QColor("#7A3FB0"), QColor("#55585E"), QColor("#8A5A00")};

QColor ink(qsizetype index) {
  return kInks[static_cast<std::size_t>(index) % std::size(kInks)];
}

/// The entity that is being read.
struct Entity {
  QString type, layer, text;
  double x = 0, y = 0, x2 = 0, y2 = 0, height = 0;
  int flags = 0;
};

}  // namespace

QRectF DrawingFile::box() const {
  QRectF box;
  for (const Stroke& stroke : strokes) box = box.united(stroke.points.boundingRect());
  return box;
}

DrawingFile readDxfStrokes(const QByteArray& text) {
  DrawingFile file;
  const QList<QByteArray> lines = text.split('\n');
  Entity entity;
  DrawingFile::Stroke polyline;
  bool isClosed = false;
  const auto colourOf = [&](const QString& layer) {
    if (!file.layers.contains(layer)) file.layers << layer;
    return ink(file.layers.indexOf(layer));
  };
  const auto finish = [&] {
    if (entity.type == QLatin1String("LINE")) {
      file.strokes.push_back(
          {QPolygonF({{entity.x, entity.y}, {entity.x2, entity.y2}}), colourOf(entity.layer)});
    } else if (entity.type == QLatin1String("POLYLINE")) {
      polyline = {{}, colourOf(entity.layer)};
      isClosed = (entity.flags & 1) != 0;
    } else if (entity.type == QLatin1String("VERTEX")) {
      polyline.points << QPointF(entity.x, entity.y);
    } else if (entity.type == QLatin1String("SEQEND")) {
      if (isClosed && !polyline.points.isEmpty()) polyline.points << polyline.points.first();
      file.strokes.push_back(polyline);
    } else if (entity.type == QLatin1String("TEXT")) {
      file.words.push_back({{entity.x, entity.y}, entity.height, entity.text});
    }
  };
  for (qsizetype i = 0; i + 1 < lines.size(); i += 2) {
    const int code = lines[i].trimmed().toInt();
    const QByteArray value = lines[i + 1].trimmed();
    switch (code) {
      case 0:
        finish();
        entity = {QString::fromLatin1(value), {}, {}};
        break;
      case 1:
        entity.text = QString::fromLatin1(value);
        break;
      case 8:
        entity.layer = QString::fromLatin1(value);
        break;
      case 10:
        entity.x = value.toDouble();
        break;
      case 20:
        entity.y = value.toDouble();
        break;
      case 11:
        entity.x2 = value.toDouble();
        break;
      case 21:
        entity.y2 = value.toDouble();
        break;
      case 40:
        entity.height = value.toDouble();
        break;
      case 70:
        entity.flags = value.toInt();
        break;
      default:
        break;
    }
  }
  return file;
}

DrawingFile readHpglStrokes(const QByteArray& text) {
  constexpr double kUnitsPerMm = 40;
  DrawingFile file;
  QColor colour = ink(0);
  QPointF at;
  for (const QByteArray& raw : text.split(';')) {
    const QByteArray command = raw.trimmed();
    const QByteArray name = command.left(2);
    if (name == "SP") colour = ink(command.mid(2).toInt() - 1 + 8);
    if (name != "PU" && name != "PD") continue;
    DrawingFile::Stroke stroke{QPolygonF({at}), colour};
    const QList<QByteArray> numbers = command.mid(2).split(',');
    for (qsizetype i = 0; i + 1 < numbers.size(); i += 2) {
      at = QPointF(numbers[i].toDouble(), numbers[i + 1].toDouble()) / kUnitsPerMm;
      stroke.points << at;
    }
    if (name == "PD" && stroke.points.size() > 1) file.strokes.push_back(stroke);
  }
  return file;
}

}  // namespace toile::studio
