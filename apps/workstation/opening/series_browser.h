#pragma once
/// \file The series of a folder, to choose one from.

#include "ostia/imaging/dicom.h"

#include <QDialog>

class QTreeWidget;

namespace ostia::workstation {

class Jobs;

/// A line a series with a picture, whose it is, its size, and what is wrong with it.
class SeriesBrowser final : public QDialog {
  Q_OBJECT
 public:
  SeriesBrowser(const imaging::DicomFolder& folder, Jobs& jobs, QWidget* parent = nullptr);
  ~SeriesBrowser() override;

 signals:
  void chosen(const imaging::DicomSeries& series, const imaging::DicomReadOptions& options);

 private:
  void fill();
  void preview_next();
  void take();
  imaging::DicomFolder folder_;
  Jobs& jobs_;
  QTreeWidget* list_;
  std::size_t previewed_ = 0;
};

}  // namespace ostia::workstation
