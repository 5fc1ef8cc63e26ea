// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/preview.h"

#include <poppler-qt6.h>

#include <QFile>
#include <QLabel>
#include <QPainter>
#include <QResizeEvent>
#include <QSvgRenderer>
#include <algorithm>
#include <cmath>

#include "app/palette.h"

namespace toile::studio {

namespace {

constexpr double kPointsPerInch = 72;
constexpr int kMargin = 24;
constexpr int kMostWords = 20000;

QByteArray contentOf(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

QPixmap drawn(const DrawingFile& drawing, const QSize& room, double ratio) {
  QPixmap pixmap(room * ratio);
  pixmap.setDevicePixelRatio(ratio);
  pixmap.fill(Qt::white);
  const QRectF box = drawing.box();
  if (box.isEmpty()) return pixmap;
  const double scale = std::min((room.width() - 2.0 * kMargin) / box.width(),
                                (room.height() - 2.0 * kMargin) / box.height());
  QTransform toRoom;
  toRoom.translate(0.5 * room.width(), 0.5 * room.height());
  toRoom.scale(scale, -scale);
  toRoom.translate(-box.center().x(), -box.center().y());
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& stroke : drawing.strokes) {
    painter.setPen(QPen(stroke.colour, 1));
    painter.drawPolyline(toRoom.map(stroke.points));
  }
  QFont font = painter.font();
  for (const auto& word : drawing.words) {
    const double size = word.height * scale;
    if (size < 4) continue;  // too small to be read
    font.setPixelSize(static_cast<int>(std::lround(size)));
    painter.setFont(font);
    painter.setPen(QColor("#55585E"));
    painter.drawText(toRoom.map(word.place), word.text);
  }
  return pixmap;
}

}  // namespace

FilePreview::FilePreview(QWidget* parent) : QScrollArea(parent), label_(new QLabel) {
  setObjectName(QStringLiteral("filePreview"));
  setAccessibleName(tr("Preview"));
  setAlignment(Qt::AlignCenter);
  setWidgetResizable(true);
  label_->setAlignment(Qt::AlignCenter);
  label_->setMargin(8);
  setWidget(label_);
}

FilePreview::~FilePreview() = default;

void FilePreview::showWaiting() {
  file_.clear();
  pdf_.reset();
  drawing_.reset();
  image_ = {};
  words_ = tr("The files are being made…");
  pages_ = page_ = 0;
  redraw();
  Q_EMIT pagesChanged();
}

void FilePreview::show(const QString& file) {
  const int before = file == file_ ? page_ : 0;
  showWaiting();
  file_ = file;
  words_.clear();
  if (file.endsWith(QStringLiteral(".pdf"))) {
    pdf_ = Poppler::Document::load(file);
    if (pdf_) {
      pdf_->setRenderHint(Poppler::Document::Antialiasing);
      pdf_->setRenderHint(Poppler::Document::TextAntialiasing);
      pages_ = pdf_->numPages();
      page_ = std::clamp(before, 0, std::max(0, pages_ - 1));
    }
  } else if (file.endsWith(QStringLiteral(".dxf"))) {
    drawing_ = readDxfStrokes(contentOf(file));
  } else if (file.endsWith(QStringLiteral(".plt"))) {
    drawing_ = readHpglStrokes(contentOf(file));
  } else if (file.endsWith(QStringLiteral(".png"))) {
    image_ = QPixmap(file);
  } else if (!file.endsWith(QStringLiteral(".svg"))) {
    words_ = QString::fromUtf8(contentOf(file).left(kMostWords));
  }
  redraw();
  Q_EMIT pagesChanged();
}

void FilePreview::setPage(int page) {
  page_ = std::clamp(page, 0, std::max(0, pages_ - 1));
  redraw();
  Q_EMIT pagesChanged();
}

void FilePreview::setTrueSize(bool on) {
  isTrueSize_ = on;
  redraw();
}

QPixmap FilePreview::thumbnail(int page, int width) const {
  if (!pdf_) return {};
  const auto sheet = pdf_->page(page);
  if (!sheet) return {};
  const double dpi = kPointsPerInch * width / sheet->pageSizeF().width();
  return QPixmap::fromImage(sheet->renderToImage(dpi, dpi));
}

QPixmap FilePreview::picture(const QSize& room) const {
  const double ratio = devicePixelRatioF();
  if (pdf_) {
    const auto sheet = pdf_->page(page_);
    if (!sheet) return {};
    const QSizeF points = sheet->pageSizeF();
    const double fit =
        kPointsPerInch * std::min(room.width() / points.width(), room.height() / points.height());
    const double dpi = isTrueSize_ ? physicalDpiX() : fit;
    QPixmap page = QPixmap::fromImage(sheet->renderToImage(dpi * ratio, dpi * ratio));
    page.setDevicePixelRatio(ratio);
    return page;
  }
  if (drawing_) return drawn(*drawing_, room, ratio);
  if (file_.endsWith(QStringLiteral(".svg"))) {
    QSvgRenderer svg(file_);
    const QSize size = svg.defaultSize().scaled(room, Qt::KeepAspectRatio);
    QPixmap pixmap(size * ratio);
    pixmap.setDevicePixelRatio(ratio);
    pixmap.fill(Qt::white);
    QPainter painter(&pixmap);
    svg.render(&painter, QRectF(QPointF(), QSizeF(size)));
    return pixmap;
  }
  if (!image_.isNull()) {
    return image_.scaled(room, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  }
  return {};
}

void FilePreview::redraw() {
  if (!words_.isEmpty() || file_.isEmpty()) {
    QFont font = this->font();
    if (!file_.isEmpty()) font.setFamily(QStringLiteral("monospace"));
    label_->setFont(font);
    label_->setAlignment(file_.isEmpty() ? Qt::AlignCenter : Qt::AlignLeft | Qt::AlignTop);
    label_->setTextFormat(Qt::PlainText);
    label_->setText(words_);
    return;
  }
  label_->setAlignment(Qt::AlignCenter);
  label_->setPixmap(picture((viewport()->size() - QSize(20, 20)).expandedTo({50, 50})));
}

void FilePreview::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  redraw();
}

}  // namespace toile::studio
