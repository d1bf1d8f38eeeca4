#include "opening/technique.h"

#include "ostia/core/error.h"

namespace ostia::workstation {

std::optional<imaging::DicomSeries> series_of_image(const session::KnownImage& image,
                                                    const core::TaskContext& task) {
  if (image.series_uid.empty()) return std::nullopt;
  for (const imaging::DicomSeries& series : imaging::scan_dicom(image.path, task).series)
    if (series.uid == image.series_uid) return series;
  return std::nullopt;
}

imaging::ScanTechnique technique_of(const std::optional<session::KnownImage>& image,
                                    const core::TaskContext& task) {
  if (!image) return {};
  try {
    if (const auto series = series_of_image(*image, task)) return imaging::scan_technique(*series);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {  // it was read before: what is gone since says nothing
  }
  return {};
}

}  // namespace ostia::workstation
