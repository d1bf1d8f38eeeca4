#include "ostia/imaging/scan_technique.h"

#include "dicom_attributes.h"
#include "dicom_shown.h"

#include "ostia/imaging/dicom_texts.h"

namespace ostia::imaging {
namespace {

constexpr std::uint32_t technique_set = dicom_tag(0x0008, 0x0005), technique_kv = dicom_tag(0x0018, 0x0060),
                        technique_slice = dicom_tag(0x0018, 0x0050),
                        technique_kernel = dicom_tag(0x0018, 0x1210);

/// A positive decimal string, up to what any scanner has.
std::optional<double> positive(const std::string& text, double largest) {
  const std::optional<double> value = parse_decimal(text);
  return value && *value > 0.0 && *value <= largest ? value : std::nullopt;
}

}  // namespace

ScanTechnique scan_technique(const DicomSeries& series) {
  ScanTechnique technique;
  technique.phase_percent = series.cardiac_percent;
  if (series.files.empty()) return technique;
  DicomTexts texts{{technique_set, {}}, {technique_kv, {}}, {technique_slice, {}}, {technique_kernel, {}}};
  if (!read_dicom_texts(series.files[series.files.size() / 2], texts)) return technique;
  technique.tube_kv = positive(texts[technique_kv], 1000.0);
  technique.slice_mm = positive(texts[technique_slice], 100.0);
  technique.kernel = shown_text(texts[technique_kernel], texts[technique_set]);
  return technique;
}

}  // namespace ostia::imaging
