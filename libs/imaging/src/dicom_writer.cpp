#include "ostia/imaging/dicom_writer.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/dicom_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <vector>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr const char* ct_image_storage = "1.2.840.10008.5.1.4.1.1.2";
std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : "\\") + dicom_decimal(v);
  return text;
}

void require_text(const char* name, const std::string& value) {
  if (value.size() > 64) throw InvalidInput(std::string("DICOM: ") + name + " is longer than 64 characters");
  for (const char c : value) {
    if (c < ' ' || c > '~' || c == '\\')
      throw InvalidInput(std::string("DICOM: ") + name +
                         " holds a character that is not printable ASCII, or a backslash");
  }
}

void require_writable(const ImageVolume& image, const DicomSeriesOptions& options) {
  const Geometry& g = image.geometry;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (g.size[axis] < 1) throw InvalidInput("DICOM: the image is empty");
  }
  if (g.size[0] > 65535 || g.size[1] > 65535)
    throw InvalidInput("DICOM: the image has " + std::to_string(g.size[0]) + " columns and " +
                       std::to_string(g.size[1]) + " rows; a slice holds at most 65,535 of either");
  if (static_cast<std::int64_t>(image.voxels.size()) != g.voxels())
    throw InvalidInput("DICOM: the image has " + std::to_string(image.voxels.size()) +
                       " voxels and its grid " + std::to_string(g.voxels()));
  if (!g.origin.allFinite() || !g.direction.allFinite() || !g.spacing.allFinite() ||
      !(g.spacing.minCoeff() > 0.0))
    throw InvalidInput("DICOM: the image's geometry is not finite or its spacing not positive");
  const Vec3 normal = g.direction.col(0).cross(g.direction.col(1));
  if (!g.direction.isUnitary(1e-6) || normal.dot(g.direction.col(2)) < 1.0 - 1e-6)
    throw InvalidInput("DICOM: the image's k axis does not run along the normal of its slices; resample it");
  require_text("patient_id", options.patient_id);
  require_text("patient_name", options.patient_name);
  require_text("series_description", options.series_description);
  if (options.cardiac_phase_percent &&
      !(*options.cardiac_phase_percent >= 0.0 && *options.cardiac_phase_percent <= 100.0))
    throw InvalidInput("DICOM: cardiac_phase_percent is " + std::to_string(*options.cardiac_phase_percent) +
                       "; it must lie in [0, 100]");
}

/// What tells an image from others where no seed is given.
std::string digest_of(const ImageVolume& image) {
  const Geometry& g = image.geometry;
  std::string place;
  for (const std::int64_t n : g.size) place += std::to_string(n) + " ";
  for (int axis = 0; axis < 3; ++axis)
    place += decimals({g.spacing[axis], g.origin[axis], g.direction(0, axis), g.direction(1, axis),
                       g.direction(2, axis)}) +
             " ";
  return core::sha256(place + core::sha256({reinterpret_cast<const char*>(image.voxels.data()),
                                            image.voxels.size() * sizeof image.voxels[0]}));
}

/// The attributes of a series, and its slices one by one.
class SeriesWriter {
 public:
  SeriesWriter(const ImageVolume& image, const DicomSeriesOptions& options)
      : image_(image),
        options_(options),
        seed_(options.uid_seed.empty() ? digest_of(image) : options.uid_seed) {
    const auto lowest = *std::min_element(image.voxels.begin(), image.voxels.end());
    intercept_ = lowest < -1024 ? -32768 : -1024;
    const std::string& study = options.study_seed.empty() ? seed_ : options.study_seed;
    study_uid_ = dicom_uid(study + "/study");
    frame_uid_ = dicom_uid(study + "/frame of reference");
    series_uid_ = dicom_uid(seed_ + "/series");
  }

  std::string file(std::int64_t k) const {
    const std::string instance_uid = dicom_uid(seed_ + "/instance/" + std::to_string(k + 1));
    DicomDataset data;
    identify(data, instance_uid);
    acquisition(data);
    place(data, k);
    pixels(data, k);
    return dicom_file(data);
  }

 private:
  /// SOP common, study, series, equipment and patient.
  void identify(DicomDataset& d, const std::string& instance_uid) const {
    d.set_text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
    d.set_text(0x00080016, "UI", ct_image_storage);
    d.set_text(0x00080018, "UI", instance_uid);
    d.set_text(0x0008001C, "CS", "YES");  // synthetic data
    d.set_text(0x00080020, "DA", "");     // study date
    d.set_text(0x00080030, "TM", "");     // study time
    d.set_text(0x00080050, "SH", "");     // accession number
    d.set_text(0x00080060, "CS", "CT");
    d.set_text(0x00080070, "LO", "Ostia");
    d.set_text(0x00080090, "PN", "");  // referring physician
    d.set_text(0x0008103E, "LO", options_.series_description);
    d.set_text(0x00100010, "PN", options_.patient_name);
    d.set_text(0x00100020, "LO", options_.patient_id);
    d.set_text(0x00100030, "DA", "");  // birth date
    d.set_text(0x00100040, "CS", "");  // sex
  }
  void acquisition(DicomDataset& d) const {
    d.set_text(0x00180010, "LO", "SYNTHETIC");  // contrast agent
    d.set_text(0x00180015, "CS", "HEART");
    d.set_text(0x00180050, "DS", dicom_decimal(image_.geometry.spacing.z()));
    d.set_text(0x00180060, "DS", "");  // kVp
    d.set_text(0x00185100, "CS", "HFS");
  }
  /// Study, series and instance, frame of reference, image plane.
  void place(DicomDataset& d, std::int64_t k) const {
    const Geometry& g = image_.geometry;
    const Vec3 corner = g.world(Vec3(0.0, 0.0, static_cast<double>(k)));
    const Vec3 row = g.direction.col(0), column = g.direction.col(1);
    d.set_text(0x0020000D, "UI", study_uid_);
    d.set_text(0x0020000E, "UI", series_uid_);
    d.set_text(0x00200010, "SH", "1");
    d.set_text(0x00200011, "IS", "1");
    d.set_text(0x00200012, "IS", "1");
    d.set_text(0x00200013, "IS", std::to_string(k + 1));
    d.set_text(0x00200032, "DS", decimals({corner.x(), corner.y(), corner.z()}));
    d.set_text(0x00200037, "DS", decimals({row.x(), row.y(), row.z(), column.x(), column.y(), column.z()}));
    d.set_text(0x00200052, "UI", frame_uid_);
    d.set_text(0x00201040, "LO", "");  // position reference indicator
    if (options_.cardiac_phase_percent) d.set_f64(0x00209241, *options_.cardiac_phase_percent);
  }
  void pixels(DicomDataset& d, std::int64_t k) const {
    const Geometry& g = image_.geometry;
    d.set_u16(0x00280002, {1});
    d.set_text(0x00280004, "CS", "MONOCHROME2");
    d.set_u16(0x00280010, {static_cast<std::uint16_t>(g.size[1])});
    d.set_u16(0x00280011, {static_cast<std::uint16_t>(g.size[0])});
    d.set_text(0x00280030, "DS", decimals({g.spacing.y(), g.spacing.x()}));  // between rows, between columns
    d.set_u16(0x00280100, {16});
    d.set_u16(0x00280101, {16});
    d.set_u16(0x00280102, {15});
    d.set_u16(0x00280103, {0});
    d.set_text(0x00281050, "DS", "200");  // window as usual for coronary CTA
    d.set_text(0x00281051, "DS", "800");
    d.set_text(0x00281052, "DS", std::to_string(intercept_));
    d.set_text(0x00281053, "DS", "1");
    d.set_text(0x00281054, "LO", "HU");
    const auto first = image_.voxels.begin() + g.offset(0, 0, k);
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(2 * g.size[0] * g.size[1]));
    for (auto v = first; v != first + g.size[0] * g.size[1]; ++v) {
      const int stored = *v - intercept_;
      bytes.push_back(static_cast<char>(stored & 0xff));
      bytes.push_back(static_cast<char>(stored >> 8 & 0xff));
    }
    d.set_bytes(0x7FE00010, "OW", std::move(bytes));
  }

  const ImageVolume& image_;
  DicomSeriesOptions options_;
  std::string seed_, study_uid_, frame_uid_, series_uid_;
  int intercept_ = -1024;
};

std::string slice_name(std::int64_t k, std::int64_t count) {
  std::string number = std::to_string(k + 1);
  const std::size_t width = std::max<std::size_t>(4, std::to_string(count).size());
  return "CT" + std::string(width - number.size(), '0') + number + ".dcm";
}

}  // namespace

void write_dicom_series(const fs::path& folder, const ImageVolume& image, const DicomSeriesOptions& options,
                        const core::TaskContext& task) {
  require_writable(image, options);
  task.throw_if_cancelled();
  std::error_code error;
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error))
    throw IoError("cannot write a DICOM series to " + folder.string() + ": the folder is not empty");
  const SeriesWriter writer(image, options);
  core::StagedFolder staged(folder);
  const std::int64_t slices = image.geometry.size[2];
  for (std::int64_t k = 0; k < slices; ++k) {
    task.throw_if_cancelled();
    core::write_file(staged.temporary() / slice_name(k, slices), writer.file(k));
    task.set_progress(static_cast<double>(k + 1) / static_cast<double>(slices));
  }
  staged.commit();
}

}  // namespace ostia::imaging
