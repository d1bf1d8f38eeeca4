#include "opening/series_browser.h"

#include "shell/hanging.h"
#include "shell/identity.h"
#include "shell/jobs.h"
#include "shell/quantities.h"
#include "views/raster_image.h"

#include "ostia/imaging/series_preview.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

enum SeriesColumn { picture_column, series_column, slices_column, voxel_column, notes_column, columns };
constexpr int thumbnail_px = 96;

QString notes_of(const imaging::DicomSeries& series) {
  QStringList notes;
  for (const std::string& fault : series.faults) notes << QString::fromStdString(fault);
  for (const std::string& warning : series.warnings) notes << QString::fromStdString(warning);
  return notes.join(QStringLiteral("\n"));
}

}  // namespace

SeriesBrowser::SeriesBrowser(const imaging::DicomFolder& folder, Jobs& jobs, QWidget* parent)
    : QDialog(parent), folder_(folder), jobs_(jobs), list_(new QTreeWidget(this)) {
  setObjectName("series");
  setWindowTitle(tr("Series in this folder"));
  resize_within(*this, QSize(900, 520));
  list_->setAccessibleName(tr("Series"));
  list_->setColumnCount(columns);
  list_->setHeaderLabels({QString(), tr("Series"), tr("Slices"), tr("Voxel, mm"), tr("Notes")});
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(notes_column, QHeaderView::Stretch);
  list_->setIconSize({thumbnail_px, thumbnail_px});
  list_->setRootIsDecorated(false);
  list_->setWordWrap(true);
  fill();
  auto* layout = new QVBoxLayout(this);
  if (imaging::patients_in(folder_.series) > 1) {
    auto* several = new QLabel(
        tr("Images of several patients lie in this folder. Each series is of one of them: look at its name."),
        this);
    several->setObjectName("several_patients");
    several->setWordWrap(true);
    layout->addWidget(several);
  }
  layout->addWidget(list_);
  QStringList left_out;
  if (!folder_.damaged.empty())
    left_out << tr("%n damaged file(s)", nullptr, static_cast<int>(folder_.damaged.size()));
  if (folder_.skipped > 0)
    left_out << tr("%n file(s) that are no images", nullptr, static_cast<int>(folder_.skipped));
  if (!left_out.isEmpty()) layout->addWidget(new QLabel(tr("Left out: %1").arg(left_out.join(", ")), this));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel, this);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &SeriesBrowser::take);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(list_, &QTreeWidget::itemDoubleClicked, this, &SeriesBrowser::take);
  auto* open = buttons->button(QDialogButtonBox::Open);
  open->setEnabled(list_->currentItem() != nullptr);
  connect(list_, &QTreeWidget::currentItemChanged, open,
          [open](const QTreeWidgetItem* item) { open->setEnabled(item != nullptr); });
  preview_next();
}

SeriesBrowser::~SeriesBrowser() {
  jobs_.cancel("preview");
}

void SeriesBrowser::fill() {
  for (const imaging::DicomSeries& series : folder_.series) {
    auto* item = new QTreeWidgetItem(list_);
    const std::string name = series.description.empty() ? series.modality : series.description;
    item->setText(series_column,
                  QString::fromStdString(name + (series.phase.empty() ? "" : "\n" + series.phase)));
    item->setText(slices_column, QString::number(series.files.size()));
    const geometry::Vec3& voxel = series.geometry.spacing;
    item->setText(voxel_column, QStringLiteral("%1 x %2 x %3")
                                    .arg(quantity::calibre(voxel.x()), quantity::calibre(voxel.y()),
                                         quantity::calibre(voxel.z())));
    item->setText(notes_column, notes_of(series));
    item->setToolTip(notes_column, notes_of(series));
    item->setSizeHint(picture_column, {thumbnail_px + 8, thumbnail_px + 6});
    if (!series.faults.empty() && !series.lacks_orientation)
      item->setFlags(Qt::ItemIsEnabled);
    else if (!list_->currentItem() && series.faults.empty())
      list_->setCurrentItem(item);
  }
}

void SeriesBrowser::preview_next() {
  while (previewed_ < folder_.series.size() && !folder_.series[previewed_].faults.empty()) ++previewed_;
  if (previewed_ >= folder_.series.size()) return;
  const int row = static_cast<int>(previewed_);
  const imaging::DicomSeries series = folder_.series[previewed_++];
  const QPointer<SeriesBrowser> self(this);
  jobs_.run(
      "preview", tr("Pictures of the series"),
      [series](const core::TaskContext& task) {
        return std::any(imaging::preview(series, thumbnail_px, task));
      },
      [self, row](const std::any& result) {
        if (!self) return;
        const auto& made = std::any_cast<const imaging::SeriesPreview&>(result);
        QTreeWidgetItem* item = self->list_->topLevelItem(row);
        item->setIcon(picture_column, QIcon(QPixmap::fromImage(preview_image(made))));
        const QString whose =
            identity_parts({made.shown.patient_name, made.shown.patient_id, made.shown.study_date, {}})
                .join(QStringLiteral("  \u00b7  "));
        if (!whose.isEmpty()) item->setText(series_column, whose + "\n" + item->text(series_column));
        self->preview_next();
      },
      [self](const QString&) {
        if (self) self->preview_next();
      });
}

void SeriesBrowser::take() {
  const int row = list_->indexOfTopLevelItem(list_->currentItem());
  if (row < 0) return;
  const imaging::DicomSeries series = folder_.series[static_cast<std::size_t>(row)];
  if (!series.faults.empty() && !series.lacks_orientation) return;
  imaging::DicomReadOptions options;
  if (series.lacks_orientation) {
    const auto answer = QMessageBox::question(
        this, tr("Orientation unknown"),
        tr("The files of this series do not say how the patient lies. It can be read as axial slices, and "
           "you set its orientation by the pictures then. Go on?"));
    if (answer != QMessageBox::Yes) return;
    options.assume_axial = true;
  }
  if (series.uneven) {
    const auto answer = QMessageBox::question(
        this, tr("Uneven slices"),
        tr("Slices are missing or unevenly spaced in this series. What lies between them can be "
           "interpolated; lumina there are not measured but guessed. Go on?"));
    if (answer != QMessageBox::Yes) return;
    options.resample_uneven = true;
  }
  accept();
  emit chosen(series, options);
}

}  // namespace ostia::workstation
