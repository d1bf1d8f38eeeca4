#include "opening/technique.h"

#include "ostia/core/error.h"

namespace ostia::workstation {

imaging::ScanTechnique technique_of(const std::optional<session::KnownImage>& image,
                                    const core::TaskContext& task) {
  if (!image || image->series_uid.empty()) return {};
  try {
    for (const imaging::DicomSeries& series : imaging::scan_dicom(image->path, task).series)
      if (series.uid == image->series_uid) return imaging::scan_technique(series);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {  // it was read before: what is gone since says nothing
  }
  return {};
}

}  // namespace ostia::workstation
