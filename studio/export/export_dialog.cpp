// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/export_dialog.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QThreadPool>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <atomic>

#include "app/icons.h"
#include "app/palette.h"
#include "export/preview.h"
#include "toile/core/file.h"

namespace toile::studio {

namespace {

struct Format {
  const char* name;
  const char* line;
  std::initializer_list<const char*> files;  ///< the first is looked at
  bool chosen;
};
const Format kFormats[] = {
    {QT_TRANSLATE_NOOP("ExportDialog", "PDF, true size"),
     QT_TRANSLATE_NOOP("ExportDialog", "For paper: one sheet or tiles"),
     {"pattern.pdf"},
     true},
    {QT_TRANSLATE_NOOP("ExportDialog", "DXF for cutters"),
     QT_TRANSLATE_NOOP("ExportDialog", "Layers of ASTM D6673 or AAMA"),
     {"pattern.dxf"},
     true},
    {QT_TRANSLATE_NOOP("ExportDialog", "SVG"),
     QT_TRANSLATE_NOOP("ExportDialog", "Named layers, true size"),
     {"pattern.svg"},
     true},
    {QT_TRANSLATE_NOOP("ExportDialog", "DXF for lasers and knives"),
     QT_TRANSLATE_NOOP("ExportDialog", "Cut, mark, engrave"),
     {"laser.dxf"},
     false},
    {QT_TRANSLATE_NOOP("ExportDialog", "Plotter file"),
     QT_TRANSLATE_NOOP("ExportDialog", "HP-GL"),
     {"pattern.plt"},
     false},
    {QT_TRANSLATE_NOOP("ExportDialog", "Sewing sheet"),
     QT_TRANSLATE_NOOP("ExportDialog", "Which seam goes where"),
     {"sewing.pdf", "sewing.html", "seams.json"},
     true},
    {QT_TRANSLATE_NOOP("ExportDialog", "Lengths"),
     QT_TRANSLATE_NOOP("ExportDialog", "Every seam in a table"),
     {"lengths.csv"},
     false},
    {QT_TRANSLATE_NOOP("ExportDialog", "Report"),
     QT_TRANSLATE_NOOP("ExportDialog", "Lengths, areas, findings"),
     {"preview.png", "report.html", "report.json"},
     true},
    {QT_TRANSLATE_NOOP("ExportDialog", "Pieces as OBJ"),
     QT_TRANSLATE_NOOP("ExportDialog", "On the body, with pattern coordinates"),
     {"pieces"},
     false},
    {QT_TRANSLATE_NOOP("ExportDialog", "Picture of the body"),
     QT_TRANSLATE_NOOP("ExportDialog", "As it is seen now, PNG"),
     {"body.png"},
     false}};
constexpr int kPdf = 0, kDxf = 1;

constexpr PdfPaper kPapers[] = {PdfPaper::A4OrLetter, PdfPaper::A4, PdfPaper::Letter,
                                PdfPaper::A3,         PdfPaper::A0, PdfPaper::OneSheet};
constexpr int kMostThumbnails = 120;

/// What happened; the engine's advice is for the command line.
QString adviceOff(const Error& error) {
  return QString::fromStdString(error.message).section(';', 0, 0);
}

}  // namespace

/// The files being made, for dialogs that may be gone when they are.
class ExportDialog::Job final : public Progress {
 public:
  void step(std::string_view) override {}
  [[nodiscard]] bool isCancelled() const override { return cancelled; }
  std::atomic<bool> cancelled = false;
};

ExportDialog::ExportDialog(std::shared_ptr<const Pattern> pattern, const QString& title,
                           const QImage& bodyPicture, QWidget* parent)
    : QDialog(parent), pattern_(std::move(pattern)), title_(title), bodyPicture_(bodyPicture) {
  setObjectName(QStringLiteral("exportDialog"));
  setWindowTitle(tr("Export %1").arg(title));
  resize(1196, 788);
  setMinimumSize(1000, 640);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  row->addWidget(makeFormats());
  row->addWidget(makeMiddle(), 1);
  row->addWidget(makeOptions());
  column->addLayout(row, 1);
  column->addWidget(makeFoot());
  formats_->setCurrentRow(kPdf);
  showChosen();
  makeFiles();
}

ExportDialog::~ExportDialog() {
  if (job_) job_->cancelled = true;
}

QWidget* ExportDialog::makeFormats() {
  auto* side = new QWidget;
  side->setFixedWidth(290);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(12, 12, 12, 12);
  auto* heading = new QLabel(tr("Files to write"));
  heading->setObjectName(QStringLiteral("second"));
  column->addWidget(heading);
  formats_ = new QListWidget;
  formats_->setObjectName(QStringLiteral("formats"));
  formats_->setAccessibleName(tr("Files to write"));
  formats_->setSpacing(2);
  const QStringList kept = QSettings().value(QStringLiteral("exportFormats")).toStringList();
  for (const Format& format : kFormats) {
    auto* item = new QListWidgetItem(tr(format.name) + '\n' + tr(format.line), formats_);
    item->setSizeHint({200, 44});
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    const bool chosen =
        kept.isEmpty() ? format.chosen : kept.contains(QLatin1String(*format.files.begin()));
    item->setCheckState(chosen ? Qt::Checked : Qt::Unchecked);
  }
  connect(formats_, &QListWidget::currentRowChanged, this, &ExportDialog::showFormat);
  connect(formats_, &QListWidget::itemChanged, this, &ExportDialog::showChosen);
  column->addWidget(formats_, 1);
  state_ = new QLabel;
  state_->setWordWrap(true);
  column->addWidget(state_);
  return side;
}

QWidget* ExportDialog::makeMiddle() {
  auto* middle = new QWidget;
  auto* column = new QVBoxLayout(middle);
  column->setContentsMargins(0, 8, 0, 0);
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(12, 0, 12, 0);
  pageLabel_ = new QLabel;
  pageLabel_->setObjectName(QStringLiteral("heading"));
  bar->addWidget(pageLabel_);
  const auto step = [&](const char* name, const QString& tip, int by) {
    auto* button = new QToolButton;
    button->setIcon(icon(QString::fromLatin1(name)));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    connect(button, &QToolButton::clicked, this,
            [this, by] { preview_->setPage(preview_->page() + by); });
    bar->addWidget(button);
    return button;
  };
  back_ = step("chevron-left", tr("Page before"), -1);
  on_ = step("chevron-right", tr("Next page"), 1);
  bar->addStretch();
  wholePage_ = new QPushButton(tr("Whole page"));
  trueSize_ = new QPushButton(tr("True size"));
  for (QPushButton* button : {wholePage_, trueSize_}) {
    button->setCheckable(true);
    button->setAutoExclusive(true);
    button->setAutoDefault(false);
    bar->addWidget(button);
  }
  wholePage_->setChecked(true);
  connect(trueSize_, &QPushButton::toggled, this, [this](bool on) { preview_->setTrueSize(on); });
  column->addLayout(bar);
  preview_ = new FilePreview;
  connect(preview_, &FilePreview::pagesChanged, this, &ExportDialog::showPages);
  column->addWidget(preview_, 1);
  return middle;
}

QWidget* ExportDialog::makeOptions() {
  auto* side = new QWidget;
  side->setFixedWidth(286);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(14, 12, 14, 12);
  optionsTitle_ = new QLabel;
  optionsTitle_->setObjectName(QStringLiteral("heading"));
  column->addWidget(optionsTitle_);

  pdfOptions_ = new QWidget;
  auto* pdf = new QFormLayout(pdfOptions_);
  pdf->setContentsMargins(0, 0, 0, 0);
  paper_ = new QComboBox;
  paper_->setObjectName(QStringLiteral("paper"));
  paper_->addItems({tr("A4 or Letter"), tr("A4, 210 × 297 mm"), tr("Letter"), tr("A3"), tr("A0"),
                    tr("One large sheet")});
  pdf->addRow(tr("Paper"), paper_);
  overlap_ = new QComboBox;
  overlap_->addItems({tr("None: cut and butt"), tr("10 mm"), tr("20 mm")});
  pdf->addRow(tr("Overlap"), overlap_);
  column->addWidget(pdfOptions_);

  dxfOptions_ = new QWidget;
  auto* dxf = new QFormLayout(dxfOptions_);
  dxf->setContentsMargins(0, 0, 0, 0);
  dialect_ = new QComboBox;
  dialect_->addItems({tr("ASTM, pieces alone"), tr("ASTM, for drawing programs"), tr("AAMA-292")});
  dxf->addRow(tr("Texts"), dialect_);
  inches_ = new QCheckBox(tr("In inches"));
  dxf->addRow(QString(), inches_);
  column->addWidget(dxfOptions_);
  for (QComboBox* box : {paper_, overlap_, dialect_}) {
    connect(box, &QComboBox::currentIndexChanged, this, &ExportDialog::makeFiles);
  }
  connect(inches_, &QCheckBox::toggled, this, &ExportDialog::makeFiles);

  pageMap_ = new QListWidget;
  pageMap_->setObjectName(QStringLiteral("pageMap"));
  pageMap_->setAccessibleName(tr("Pages"));
  pageMap_->setViewMode(QListView::IconMode);
  pageMap_->setMovement(QListView::Static);
  pageMap_->setResizeMode(QListView::Adjust);
  pageMap_->setIconSize({58, 82});
  pageMap_->setGridSize({78, 112});
  connect(pageMap_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0) preview_->setPage(row);
  });
  column->addSpacing(8);
  column->addWidget(pageMap_, 1);
  column->addStretch();
  return side;
}

QWidget* ExportDialog::makeFoot() {
  auto* foot = new QWidget;
  auto* row = new QHBoxLayout(foot);
  row->setContentsMargins(14, 10, 14, 12);
  row->addWidget(new QLabel(tr("Folder")));
  folder_ = new QLineEdit;
  folder_->setObjectName(QStringLiteral("exportFolder"));
  folder_->setAccessibleName(tr("Folder"));
  folder_->setText(
      QSettings()
          .value(QStringLiteral("exportFolder"),
                 QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + '/' + title_)
          .toString());
  folder_->setMinimumWidth(320);
  row->addWidget(folder_);
  auto* choose = new QPushButton(tr("Choose…"));
  choose->setAutoDefault(false);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(
        this, tr("Export the pattern to a folder"), folder_->text());
    if (!folder.isEmpty()) folder_->setText(folder);
  });
  row->addWidget(choose);
  auto* note = new QLabel(tr("Files of the same name will be replaced"));
  note->setObjectName(QStringLiteral("second"));
  row->addWidget(note);
  row->addStretch();
  auto* cancel = new QPushButton(tr("Cancel"));
  cancel->setAutoDefault(false);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  row->addWidget(cancel);
  export_ = new QPushButton;
  export_->setObjectName(QStringLiteral("primary"));
  export_->setDefault(true);
  connect(export_, &QPushButton::clicked, this, [this] {
    if (exportChosen()) accept();
  });
  row->addWidget(export_);
  return foot;
}

void ExportDialog::setFolder(const QString& folder) {
  folder_->setText(folder);
}

WriteOptions ExportDialog::options() const {
  constexpr double kOverlaps[] = {0, 10, 20};
  WriteOptions options;
  options.pdf.paper = kPapers[paper_->currentIndex()];
  options.pdf.overlap = kOverlaps[overlap_->currentIndex()];
  options.dxf.dialect = static_cast<DxfDialect>(dialect_->currentIndex());
  options.dxf.inches = inches_->isChecked();
  return options;
}

void ExportDialog::makeFiles() {
  if (job_) job_->cancelled = true;
  isReady_ = false;
  preview_->showWaiting();
  showChosen();
  made_ = std::make_unique<QTemporaryDir>();
  job_ = std::make_shared<Job>();
  QPointer<ExportDialog> self(this);
  QThreadPool::globalInstance()->start([self, job = job_, pattern = pattern_,
                                        folder = made_->path().toStdString(), options = options()] {
    Result<WrittenPattern> written = writePattern(*pattern, folder, job.get(), options);
    QMetaObject::invokeMethod(
        qApp,
        [self, job, written = std::move(written)] {
          if (self && self->job_ == job && !job->cancelled) self->filesMade(written);
        },
        Qt::QueuedConnection);
  });
}

void ExportDialog::filesMade(const Result<WrittenPattern>& written) {
  if (!written) {
    state_->setText(tr("The files could not be made: %1.").arg(adviceOff(written.error())));
    return;
  }
  bodyPicture_.save(made_->filePath(QStringLiteral("body.png")));
  isReady_ = true;
  const auto found = static_cast<int>(written->findings.size());
  state_->setText(found == 0 ? tr("✓ All seams match their mates. No findings.")
                             : tr("△ %n findings: they stand in the report.", nullptr, found));
  showChosen();
  showFormat();
  Q_EMIT ready();
}

QStringList ExportDialog::filesOf(int format) const {
  QStringList files;
  for (const char* name : kFormats[format].files) {
    const QString file = QString::fromLatin1(name);
    if (!QFileInfo(made_->filePath(file)).isDir()) {
      files << file;
      continue;
    }
    for (const QString& piece : QDir(made_->filePath(file)).entryList(QDir::Files, QDir::Name)) {
      files << file + '/' + piece;
    }
  }
  return files;
}

void ExportDialog::showFormat() {
  const int row = std::max(0, formats_->currentRow());
  optionsTitle_->setText(tr(kFormats[row].name));
  pdfOptions_->setVisible(row == kPdf);
  dxfOptions_->setVisible(row == kDxf);
  if (!isReady_) return;
  const QStringList files = filesOf(row);
  if (!files.isEmpty()) preview_->show(made_->filePath(files.front()));
  fillPageMap();
}

void ExportDialog::showPages() {
  const int pages = preview_->pageCount();
  pageLabel_->setText(pages > 0 ? tr("Page %1 of %2").arg(preview_->page() + 1).arg(pages)
                                : QString());
  back_->setVisible(pages > 1);
  on_->setVisible(pages > 1);
  back_->setEnabled(preview_->page() > 0);
  on_->setEnabled(preview_->page() + 1 < pages);
  wholePage_->setVisible(pages > 0);
  trueSize_->setVisible(pages > 0);
  const QSignalBlocker blocker(pageMap_);
  if (pageMap_->count() > preview_->page()) pageMap_->setCurrentRow(preview_->page());
}

void ExportDialog::fillPageMap() {
  pageMap_->clear();
  const int pages = std::min(preview_->pageCount(), kMostThumbnails);
  pageMap_->setVisible(pages > 1);
  if (pages < 2) return;
  for (int i = 0; i < pages; ++i) new QListWidgetItem(QString::number(i + 1), pageMap_);
  // One at a time, so that the window stays alive; a newer list ends the older one's work.
  auto* timer = new QTimer(pageMap_->item(0)->listWidget());
  connect(timer, &QTimer::timeout, this, [this, timer, i = 0, job = job_]() mutable {
    if (job != job_ || i >= pageMap_->count() || i >= preview_->pageCount()) {
      return timer->deleteLater();
    }
    pageMap_->item(i)->setIcon(preview_->thumbnail(i, pageMap_->iconSize().width()));
    ++i;
  });
  timer->start(0);
}

void ExportDialog::showChosen() {
  int files = 0;
  for (int i = 0; i < formats_->count(); ++i) {
    if (formats_->item(i)->checkState() != Qt::Checked) continue;
    files += isReady_ ? static_cast<int>(filesOf(i).size()) : 1;
  }
  if (export_ == nullptr) return;
  export_->setEnabled(isReady_ && files > 0);
  export_->setText(isReady_ ? tr("Export %n files", nullptr, files) : tr("Export"));
  export_->setToolTip(isReady_ ? files > 0 ? QString() : tr("Tick a file to write")
                               : tr("The files are being made"));
}

std::optional<int> ExportDialog::exportChosen() {
  if (!isReady_ || folder_->text().isEmpty()) return std::nullopt;
  QStringList kept;
  int count = 0;
  for (int i = 0; i < formats_->count(); ++i) {
    if (formats_->item(i)->checkState() != Qt::Checked) continue;
    kept << QLatin1String(*kFormats[i].files.begin());
    for (const QString& name : filesOf(i)) {
      const std::filesystem::path to = (folder_->text() + '/' + name).toStdString();
      Result<void> done = makeFolder(to.parent_path());
      const Result<std::string> content = readFile(made_->filePath(name).toStdString());
      if (done && !content) done = content.error();
      if (done) done = writeFileWhole(to, *content);
      if (!done) {
        QMessageBox::warning(this, tr("Export"),
                             tr("Not exported: %1. %n files are written, the others of the folder "
                                "are as they were.",
                                nullptr, count)
                                 .arg(adviceOff(done.error())));
        return std::nullopt;
      }
      ++count;
    }
  }
  QSettings().setValue(QStringLiteral("exportFormats"), kept);
  QSettings().setValue(QStringLiteral("exportFolder"), folder_->text());
  return count;
}

}  // namespace toile::studio
