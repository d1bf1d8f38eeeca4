#include "ostia/dicom/label_object.h"

#include "label_parts.h"
#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom.h"

#include <array>

namespace ostia::dicom {
namespace fs = std::filesystem;
namespace {

constexpr const char* segmentation_class = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char* structure_set_class = "1.2.840.10008.5.1.4.1.1.481.3";
constexpr std::size_t most_files_looked_at = 64;  // of a folder: one with more is a series of images

LabelObjectKind kind_of(const std::string& sop_class) {
  if (sop_class == segmentation_class) return LabelObjectKind::segmentation;
  if (sop_class == structure_set_class) return LabelObjectKind::structure_set;
  return LabelObjectKind::none;
}

ObjectOrigin origin_of(const DicomDataset& data) {
  ObjectOrigin origin{data.text(tag::frame_of_reference), data.text(tag::patient_id)};
  // A structure set names its frames of reference inside.
  if (origin.frame_of_reference.empty())
    if (const DicomDataset* frame = data.item(0x30060010))
      origin.frame_of_reference = frame->text(tag::frame_of_reference);
  return origin;
}

}  // namespace

LabelObjectKind label_object_kind(const fs::path& path) {
  try {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return LabelObjectKind::none;
    const std::string sop_class = imaging::dicom_sop_class(path);
    return kind_of(sop_class);
  } catch (const Error&) {
    return LabelObjectKind::none;
  }
}

ObjectOrigin object_origin(const fs::path& path) {
  return origin_of(imaging::require_dicom_object(path, {.pixels = false}).data);
}

std::string other_origin(const ObjectOrigin& a, const ObjectOrigin& b) {
  const auto differ = [](const std::string& x, const std::string& y) {
    return !x.empty() && !y.empty() && x != y;
  };
  if (differ(a.patient_id, b.patient_id)) return "they are of two patients (PatientID)";
  if (differ(a.frame_of_reference, b.frame_of_reference))
    return "their frames of reference (0020,0052) differ, so that their places cannot be compared";
  return {};
}

std::string other_origin(const fs::path& mask, const fs::path& image, const std::string& series_uid) {
  const std::optional<fs::path> object = label_object_in(mask);
  if (!object || !(fs::is_directory(image) || !imaging::dicom_sop_class(image).empty())) return {};
  for (const imaging::DicomSeries& series : imaging::scan_dicom(image).series) {
    if (series_uid.empty() ? !series.faults.empty() : series.uid != series_uid) continue;
    if (series.files.empty() || series.archive) return {};
    return other_origin(object_origin(*object), object_origin(series.files.front()));
  }
  return {};
}

LabelObject read_label_object(const fs::path& path, const LabelObjectOptions& options,
                              const core::TaskContext& task) {
  const imaging::DicomObject object = imaging::require_dicom_object(path);
  const LabelObjectKind kind = kind_of(object.data.text(tag::sop_class));
  if (kind == LabelObjectKind::none)
    throw InvalidInput(path.string() + ": SOPClassUID (0008,0016) is '" + object.data.text(tag::sop_class) +
                       "': neither a segmentation nor a structure set");
  LabelObject result;
  try {
    result = kind == LabelObjectKind::segmentation ? labels_of_segmentation(object, options, task)
                                                   : labels_of_structure_set(object, options, task);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
  result.origin = origin_of(object.data);
  return result;
}

std::optional<fs::path> label_object_in(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (label_object_kind(path) != LabelObjectKind::none) return path;
    return std::nullopt;
  }
  std::optional<fs::path> found;
  std::size_t looked_at = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (!entry.is_regular_file(error)) continue;
    if (++looked_at > most_files_looked_at) return std::nullopt;
    if (label_object_kind(entry.path()) == LabelObjectKind::none) {
      try {
        if (!imaging::dicom_sop_class(entry.path()).empty()) return std::nullopt;  // images: a series
      } catch (const Error&) {
      }
      continue;
    }
    if (found)
      throw InvalidInput(path.string() + " holds several segmentations or structure sets (" +
                         found->filename().string() + ", " + entry.path().filename().string() +
                         "); give the file that is meant");
    found = entry.path();
  }
  return found;
}

imaging::LoadedImage<std::uint8_t> read_labels(const fs::path& path, const core::TaskContext& task,
                                               const std::optional<imaging::Geometry>& grid) {
  const std::optional<fs::path> object = label_object_in(path);
  if (!object) return imaging::read_labels(path, task);
  LabelObjectOptions options;
  options.grid = grid;
  LabelObject read = read_label_object(*object, options, task);
  imaging::LoadedImage<std::uint8_t> image;
  image.header.format = "DICOM";
  image.header.geometry = read.volume.geometry;
  image.header.pixel_type = imaging::PixelType::uint8;
  image.header.warnings = std::move(read.warnings);
  bool renumbered = false;
  image.header.file_labels.push_back(0);
  for (const ReadSegment& segment : read.segments) {
    if (segment.value == 0) continue;
    renumbered = renumbered || segment.number != segment.value;
    image.header.file_labels.push_back(segment.number);
  }
  if (!renumbered) image.header.file_labels.clear();
  image.volume = std::move(read.volume);
  return image;
}

}  // namespace ostia::dicom
