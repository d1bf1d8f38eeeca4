#pragma once
/// \file Frames sorted into series, the inside of scan_dicom.

#include "dicom_parser.h"

#include "ostia/imaging/dicom.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::imaging {

/// One frame with its place.
struct DicomSlice {
  std::shared_ptr<const DicomHeader> header;
  std::int64_t frame = 0;
  double depth_mm = 0.0;  ///< along the normal
  double shift_mm[2] = {0.0,
                        0.0};  ///< in the plane, along rows and columns, from the first slice of the series

  const DicomFrame& info() const { return header->frames[static_cast<std::size_t>(frame)]; }
  std::string name() const;  ///< the file's name in quotes, and the frame where it has several
};

struct DicomSeriesDetail {
  DicomSeries summary;
  std::vector<DicomSlice> slices;  ///< by depth
  bool sheared = false;            ///< slices shifted in their plane: tilted gantry
  std::int64_t even_slices = 0;    ///< of the even grid that replaces uneven slices
  double even_spacing_mm = 0.0;
};

struct DicomScan {
  std::vector<DicomSeriesDetail> series;  ///< largest first
  std::size_t skipped = 0;
  std::vector<std::string> damaged;  ///< files that are DICOM, but broken, and of no series found
};

DicomScan scan_dicom_slices(const std::filesystem::path& folder_or_file, const DicomReadOptions& options,
                            const core::TaskContext& task);

/// The series found before, from its own files alone. Throws InvalidInput where these have changed, IoError
/// where one is gone.
DicomSeriesDetail scan_dicom_series(const DicomSeries& series, const DicomReadOptions& options,
                                    const core::TaskContext& task);

// dicom_phases.cpp

/// Slices of one grid that lie on each other, taken apart by phase, time or acquisition.
struct DicomPhases {
  std::vector<std::vector<DicomSlice>>
      parts;                          ///< one when nothing lies on each other, or nothing takes it apart
  std::vector<std::string> labels;    ///< "phase 40 %", ...; one a part, empty for a single part
  std::vector<std::string> warnings;  ///< a phase missing, ...
};
/// `slices` have their depth. Slices closer than this lie on each other.
inline constexpr double kSameDepthMm = 0.01;
DicomPhases split_phases(std::vector<DicomSlice> slices);

// dicom_geometry.cpp

/// Sets the depth of every slice from position and orientation. False when one of them is missing or wrong.
bool set_depths(std::vector<DicomSlice>& slices);
/// Sorts the slices of one series and works out geometry, tilt, gaps; fills in what is wrong with it.
void place_slices(DicomSeriesDetail& series);

}  // namespace ostia::imaging
