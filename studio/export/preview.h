// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPixmap>
#include <QScrollArea>
#include <filesystem>
#include <memory>
#include <optional>

#include "export/drawing_file.h"

class QLabel;

namespace Poppler {
class Document;
}

namespace toile::studio {

/// Shows a file as its reader will see it: the pages of a PDF, the strokes of a cutting file, a
/// drawing, a picture, or the words of a table.
class FilePreview final : public QScrollArea {
  Q_OBJECT
 public:
  explicit FilePreview(QWidget* parent = nullptr);
  ~FilePreview() override;

  void show(const QString& file);
  void showWaiting();
  [[nodiscard]] int pageCount() const { return pages_; }
  [[nodiscard]] int page() const { return page_; }  ///< from 0
  void setPage(int page);
  /// As large as on paper, for this screen; otherwise as large as there is room.
  void setTrueSize(bool on);
  [[nodiscard]] QPixmap thumbnail(int page, int width) const;

 Q_SIGNALS:
  void pagesChanged();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void redraw();
  [[nodiscard]] QPixmap picture(const QSize& room) const;

  QString file_;
  std::unique_ptr<Poppler::Document> pdf_;
  std::optional<DrawingFile> drawing_;
  QPixmap image_;
  QString words_;
  QLabel* label_;
  int pages_ = 0, page_ = 0;
  bool isTrueSize_ = false;
};

}  // namespace toile::studio
