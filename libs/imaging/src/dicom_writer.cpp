#include "ostia/imaging/dicom_writer.h"

#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr const char* ct_image_storage = "1.2.840.10008.5.1.4.1.1.2";
/// Of Ostia's writer; drawn once at random as a UUID.
constexpr const char* implementation_uid = "2.25.204386196052518563977463528091842307761";

/// A data set in the making; elements must come in the order of their tags.
class DataSet {
 public:
  void text(std::uint16_t group, std::uint16_t element, const char* vr, std::string value) {
    if (value.size() % 2 != 0) value.push_back(std::strcmp(vr, "UI") == 0 ? '\0' : ' ');
    head(group, element, vr, value.size());
    bytes_ += value;
  }
  void u16(std::uint16_t group, std::uint16_t element, std::uint16_t value) {
    head(group, element, "US", 2);
    number(value, 2);
  }
  void u32(std::uint16_t group, std::uint16_t element, std::uint32_t value) {
    head(group, element, "UL", 4);
    number(value, 4);
  }
  void f64(std::uint16_t group, std::uint16_t element, double value) {
    head(group, element, "FD", 8);
    number(std::bit_cast<std::uint64_t>(value), 8);
  }
  /// OB or OW.
  void binary(std::uint16_t group, std::uint16_t element, const char* vr, std::string_view value) {
    head(group, element, vr, 0);
    bytes_.resize(bytes_.size() - 2);
    bytes_.append(2, '\0');
    number(value.size(), 4);
    bytes_ += value;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void head(std::uint16_t group, std::uint16_t element, const char* vr, std::size_t length) {
    number(group, 2);
    number(element, 2);
    bytes_ += vr;
    number(length, 2);
  }
  void number(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
  std::string bytes_;
};

/// A decimal string: the most precise that 16 characters hold.
std::string decimal(double value) {
  if (value == 0.0) return "0";
  for (int digits = 17; digits > 0; --digits) {
    std::string text = core::significant_text(value, digits);
    if (text.size() <= 16) return text;
  }
  throw InvalidInput("DICOM: the number " + std::to_string(value) + " does not fit a decimal string");
}

std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : "\\") + decimal(v);
  return text;
}

/// 2.25.N of the first 128 bits of a text's SHA-256, marked as a UUID of a scheme of one's own (RFC 9562,
/// version 8).
std::string uid_of(const std::string& text) {
  std::string hex = core::sha256(text).substr(0, 32);
  hex[12] = '8';
  hex[16] = "89ab"[static_cast<std::size_t>(std::stoi(hex.substr(16, 1), nullptr, 16)) % 4];
  std::string digits;  // most significant last
  for (const char c : hex) {
    int carry = c <= '9' ? c - '0' : c - 'a' + 10;
    for (char& d : digits) {
      carry += 16 * (d - '0');
      d = static_cast<char>('0' + carry % 10);
      carry /= 10;
    }
    for (; carry > 0; carry /= 10) digits.push_back(static_cast<char>('0' + carry % 10));
  }
  return "2.25." + std::string(digits.rbegin(), digits.rend());
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
    study_uid_ = uid_of(study + "/study");
    frame_uid_ = uid_of(study + "/frame of reference");
    series_uid_ = uid_of(seed_ + "/series");
  }

  std::string file(std::int64_t k) const {
    const std::string instance_uid = uid_of(seed_ + "/instance/" + std::to_string(k + 1));
    DataSet meta;
    meta.binary(0x0002, 0x0001, "OB", std::string_view("\0\1", 2));
    meta.text(0x0002, 0x0002, "UI", ct_image_storage);
    meta.text(0x0002, 0x0003, "UI", instance_uid);
    meta.text(0x0002, 0x0010, "UI", explicit_little_endian);
    meta.text(0x0002, 0x0012, "UI", implementation_uid);
    DataSet length;
    length.u32(0x0002, 0x0000, static_cast<std::uint32_t>(meta.bytes().size()));
    DataSet data;
    identify(data, instance_uid);
    acquisition(data);
    place(data, k);
    pixels(data, k);
    return std::string(128, '\0') + "DICM" + length.bytes() + meta.bytes() + data.bytes();
  }

 private:
  /// SOP common, study, series, equipment and patient.
  void identify(DataSet& d, const std::string& instance_uid) const {
    d.text(0x0008, 0x0008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
    d.text(0x0008, 0x0016, "UI", ct_image_storage);
    d.text(0x0008, 0x0018, "UI", instance_uid);
    d.text(0x0008, 0x001C, "CS", "YES");  // synthetic data
    d.text(0x0008, 0x0020, "DA", "");     // study date
    d.text(0x0008, 0x0030, "TM", "");     // study time
    d.text(0x0008, 0x0050, "SH", "");     // accession number
    d.text(0x0008, 0x0060, "CS", "CT");
    d.text(0x0008, 0x0070, "LO", "Ostia");
    d.text(0x0008, 0x0090, "PN", "");  // referring physician
    d.text(0x0008, 0x103E, "LO", options_.series_description);
    d.text(0x0010, 0x0010, "PN", options_.patient_name);
    d.text(0x0010, 0x0020, "LO", options_.patient_id);
    d.text(0x0010, 0x0030, "DA", "");  // birth date
    d.text(0x0010, 0x0040, "CS", "");  // sex
  }
  void acquisition(DataSet& d) const {
    d.text(0x0018, 0x0010, "LO", "SYNTHETIC");  // contrast agent
    d.text(0x0018, 0x0015, "CS", "HEART");
    d.text(0x0018, 0x0050, "DS", decimal(image_.geometry.spacing.z()));
    d.text(0x0018, 0x0060, "DS", "");  // kVp
    d.text(0x0018, 0x5100, "CS", "HFS");
  }
  /// Study, series and instance, frame of reference, image plane.
  void place(DataSet& d, std::int64_t k) const {
    const Geometry& g = image_.geometry;
    const Vec3 corner = g.world(Vec3(0.0, 0.0, static_cast<double>(k)));
    const Vec3 row = g.direction.col(0), column = g.direction.col(1);
    d.text(0x0020, 0x000D, "UI", study_uid_);
    d.text(0x0020, 0x000E, "UI", series_uid_);
    d.text(0x0020, 0x0010, "SH", "1");
    d.text(0x0020, 0x0011, "IS", "1");
    d.text(0x0020, 0x0012, "IS", "1");
    d.text(0x0020, 0x0013, "IS", std::to_string(k + 1));
    d.text(0x0020, 0x0032, "DS", decimals({corner.x(), corner.y(), corner.z()}));
    d.text(0x0020, 0x0037, "DS", decimals({row.x(), row.y(), row.z(), column.x(), column.y(), column.z()}));
    d.text(0x0020, 0x0052, "UI", frame_uid_);
    d.text(0x0020, 0x1040, "LO", "");  // position reference indicator
    if (options_.cardiac_phase_percent) d.f64(0x0020, 0x9241, *options_.cardiac_phase_percent);
  }
  void pixels(DataSet& d, std::int64_t k) const {
    const Geometry& g = image_.geometry;
    d.u16(0x0028, 0x0002, 1);
    d.text(0x0028, 0x0004, "CS", "MONOCHROME2");
    d.u16(0x0028, 0x0010, static_cast<std::uint16_t>(g.size[1]));
    d.u16(0x0028, 0x0011, static_cast<std::uint16_t>(g.size[0]));
    d.text(0x0028, 0x0030, "DS", decimals({g.spacing.y(), g.spacing.x()}));  // between rows, between columns
    d.u16(0x0028, 0x0100, 16);
    d.u16(0x0028, 0x0101, 16);
    d.u16(0x0028, 0x0102, 15);
    d.u16(0x0028, 0x0103, 0);
    d.text(0x0028, 0x1050, "DS", "200");  // window as usual for coronary CTA
    d.text(0x0028, 0x1051, "DS", "800");
    d.text(0x0028, 0x1052, "DS", std::to_string(intercept_));
    d.text(0x0028, 0x1053, "DS", "1");
    d.text(0x0028, 0x1054, "LO", "HU");
    const auto first = image_.voxels.begin() + g.offset(0, 0, k);
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(2 * g.size[0] * g.size[1]));
    for (auto v = first; v != first + g.size[0] * g.size[1]; ++v) {
      const int stored = *v - intercept_;
      bytes.push_back(static_cast<char>(stored & 0xff));
      bytes.push_back(static_cast<char>(stored >> 8 & 0xff));
    }
    d.binary(0x7FE0, 0x0010, "OW", bytes);
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
