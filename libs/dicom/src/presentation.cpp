#include "ostia/dicom/presentation.h"

#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom_dataset.h"

#include <cmath>

namespace ostia::dicom {
namespace {

constexpr const char* presentation_classes = "1.2.840.10008.5.1.4.1.1.11.";

PresentedWindow window_of(const imaging::DicomDataset& item, const std::string& file) {
  PresentedWindow window;
  window.centre = item.decimal(0x00281050).value_or(std::nan(""));
  window.width = item.decimal(0x00281051).value_or(std::nan(""));
  if (!std::isfinite(window.centre) || !(window.width >= 1.0) || !std::isfinite(window.width))
    throw InvalidInput(file + ": WindowCenter (0028,1050) or WindowWidth (0028,1051) is missing or wrong");
  const std::vector<std::string> words = item.texts(0x00281055);
  if (!words.empty()) window.explanation = words.front();
  for (const imaging::DicomDataset& image : item.items(0x00081140))
    window.instances.push_back(image.text(tag::referenced_instance));
  return window;
}

}  // namespace

std::vector<PresentedWindow> read_presented_windows(const std::filesystem::path& path) {
  const imaging::DicomDataset data = imaging::require_dicom_object(path).data;
  if (!data.text(tag::sop_class).starts_with(presentation_classes))
    throw InvalidInput(path.string() + ": SOPClassUID (0008,0016) is no presentation state's");
  std::vector<PresentedWindow> windows;
  for (const imaging::DicomDataset& item : data.items(0x00283110))
    if (item.has(0x00281050)) windows.push_back(window_of(item, path.string()));
  if (windows.empty())
    throw InvalidInput(path.string() + ": SoftcopyVOILUTSequence (0028,3110) has no window");
  return windows;
}

}  // namespace ostia::dicom
