// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QImage>
#include <QTemporaryDir>
#include <memory>

#include "toile/pipeline.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QToolButton;

namespace toile::studio {

class FilePreview;

/// Chooses files of a pattern, shows each as it will be, and puts them into a folder.
///
/// All files are written to a folder of their own first, off the UI thread; what is shown is what
/// is taken. With the options as they are at the start they are those of `toile make`.
class ExportDialog final : public QDialog {
  Q_OBJECT
 public:
  /// @param bodyPicture the body as it is seen
  ExportDialog(std::shared_ptr<const Pattern> pattern, const QString& title,
               const QImage& bodyPicture, QWidget* parent);
  ~ExportDialog() override;

  void setFolder(const QString& folder);
  /// Copies the chosen files there. @return how many; nothing where it failed, and told so
  std::optional<int> exportChosen();
  [[nodiscard]] bool isReady() const { return isReady_; }

 Q_SIGNALS:
  void ready();  ///< the files are made and can be looked at

 private:
  class Job;
  QWidget* makeFormats();
  QWidget* makeMiddle();
  QWidget* makeOptions();
  QWidget* makeFoot();
  void makeFiles();
  void filesMade(const Result<WrittenPattern>& written);
  void showFormat();
  void showPages();
  void fillPageMap();
  void showChosen();
  [[nodiscard]] WriteOptions options() const;
  [[nodiscard]] QStringList filesOf(int format) const;

  std::shared_ptr<const Pattern> pattern_;
  QString title_;
  QImage bodyPicture_;
  std::unique_ptr<QTemporaryDir> made_;
  std::shared_ptr<Job> job_;
  bool isReady_ = false;

  QListWidget* formats_ = nullptr;
  FilePreview* preview_ = nullptr;
  QLabel* pageLabel_ = nullptr;
  QToolButton *back_ = nullptr, *on_ = nullptr;
  QPushButton *wholePage_ = nullptr, *trueSize_ = nullptr;
  QLabel* optionsTitle_ = nullptr;
  QWidget *pdfOptions_ = nullptr, *dxfOptions_ = nullptr;
  QComboBox *paper_ = nullptr, *overlap_ = nullptr, *dialect_ = nullptr;
  QCheckBox* inches_ = nullptr;
  QListWidget* pageMap_ = nullptr;
  QLabel* state_ = nullptr;
  QLineEdit* folder_ = nullptr;
  QPushButton* export_ = nullptr;
};

}  // namespace toile::studio
