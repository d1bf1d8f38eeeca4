#pragma once
/// \file The attributes of a DICOM file that an image needs, by a bounded parser of our own.
///
/// Part 10 files with or without preamble and meta information; implicit and explicit VR, little and big
/// endian, deflated. Of the patient's identity nothing is kept but numbers that differ where persons do.
/// PS3.5 (data structures and encoding), PS3.3 C.7.6.16 (functional groups).

#include "dicom_source.h"

#include "ostia/geometry/vec.h"
#include "ostia/imaging/dicom_texts.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::imaging {

/// What may differ from frame to frame.
struct DicomFrame {
  std::optional<geometry::Vec3> position;            ///< ImagePositionPatient, mm
  std::optional<std::array<double, 6>> orientation;  ///< ImageOrientationPatient: row, then column direction
  std::optional<std::array<double, 2>> pixel_spacing;  ///< mm, between rows, then between columns
  std::optional<double> slope, intercept;              ///< to HU
  std::optional<double> window_centre, window_width;   ///< in HU, the first pair; unset where either is wrong
  std::optional<double> temporal_position;             ///< TemporalPositionIdentifier or -Index
  std::optional<double> trigger_time_ms;               ///< TriggerTime or NominalCardiacTriggerDelayTime
  std::optional<double> cardiac_percent;               ///< NominalPercentageOfCardiacPhase

  /// Fills what is not set here from `other`.
  void complete(const DicomFrame& other);
};

/// Numbers that tell whether two files are of one patient and study, and not of whom; 0: the file does not
/// say. Good within one process alone.
struct DicomWhose {
  std::uint64_t patient_id = 0, patient_name = 0, study = 0;
};

struct DicomFragment {
  std::uint64_t offset = 0;
  std::uint32_t length = 0;
};

struct DicomHeader {
  std::filesystem::path path;
  std::string sop_class, sop_instance, series_uid, modality, description, image_type, photometric;
  std::string transfer_syntax;  ///< of the pixel data
  int rows = 0, columns = 0, samples = 1;
  std::int64_t frame_count = 1;
  int bits_allocated = 0, bits_stored = 0, high_bit = -1;
  bool is_signed = false;
  bool has_modality_lut = false;
  std::optional<double> instance_number, acquisition_number, acquisition_time, content_time, gantry_tilt_deg;
  DicomWhose whose;
  std::vector<DicomFrame> frames;  ///< one a frame, completed by what is common to all

  bool has_pixels = false;
  bool encapsulated = false;
  bool big_endian = false;
  std::uint64_t pixel_offset = 0, pixel_length = 0;  ///< native: as declared
  std::uint64_t pixel_available = 0;                 ///< native: what the file holds of it
  std::vector<DicomFragment> fragments;              ///< encapsulated: without the offset table
  std::vector<std::uint32_t> offset_table;

  /// Why the file cannot be trusted (cut short, an element beyond the end, a number that is none); empty when
  /// it can.
  std::string damage;
  bool is_image() const { return has_pixels || (rows > 0 && columns > 0); }
};

/// A parsed file, and the bytes that its offsets refer to (the inflated data set where it was deflated).
struct DicomFile {
  DicomSource source;
  DicomHeader header;
};

/// Nothing when it is not DICOM. A file that is DICOM but damaged is returned with what was read before the
/// damage. Throws IoError when it cannot be read.
std::optional<DicomFile> parse_dicom(const std::filesystem::path& path);
std::optional<DicomFile> parse_dicom(DicomSource source);

/// One number of a decimal string: spaces around it, '.' as the decimal point whatever the locale; nothing
/// for anything else
/// ("0,5", "", "nan").
std::optional<double> parse_decimal(std::string_view text);

}  // namespace ostia::imaging
