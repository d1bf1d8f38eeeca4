#include "small_series.h"

#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_texts.h"
#include "ostia/imaging/dicom_writer.h"

#include <algorithm>

namespace ostia::testing {

SmallSeries small_series(const std::string& seed, int slices, const std::string& patient_id,
                         const std::string& patient_name) {
  imaging::ImageVolume image;
  image.geometry.size = {16, 12, slices};
  image.geometry.spacing = {0.5, 0.5, 0.6};
  for (int i = 0; i < 16 * 12 * slices; ++i) image.voxels.push_back(static_cast<std::int16_t>(i % 700 - 100));
  imaging::DicomSeriesOptions options;
  options.uid_seed = seed;
  options.patient_id = patient_id;
  options.patient_name = patient_name;
  SmallSeries series;
  series.folder = temporary_folder("series") / "CT";
  imaging::write_dicom_series(series.folder, image, options);
  for (const auto& entry : std::filesystem::directory_iterator(series.folder))
    series.files.push_back(entry.path());
  std::sort(series.files.begin(), series.files.end());
  for (const auto& file : series.files) {
    imaging::DicomTexts texts{{0x00080018, {}}, {0x0020000D, {}}, {0x0020000E, {}}};
    imaging::read_dicom_texts(file, texts);
    series.sop_uids.push_back(texts[0x00080018]);
    series.study_uid = texts[0x0020000D];
    series.series_uid = texts[0x0020000E];
    series.bytes.push_back(core::read_file(file));
  }
  return series;
}

std::string replaced(std::string bytes, const std::string& from, const std::string& to) {
  for (std::size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + to.size()))
    bytes.replace(at, from.size(), to);
  return bytes;
}

}  // namespace ostia::testing
