#pragma once
/// \file A CT image as a DICOM series that any viewer opens.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ostia::imaging {

/// What stands in the series besides voxels and geometry. Nothing of a person.
struct DicomSeriesOptions {
  std::string patient_id = "OSTIA-PHANTOM";
  std::string patient_name = "PHANTOM^OSTIA";
  std::string series_description = "Synthetic coronary CTA";
  /// The UIDs are drawn from its SHA-256 (2.25.<number>): the same text, the same UIDs. Empty: from the
  /// image.
  std::string uid_seed;
  /// From this text the UIDs of study and frame of reference are drawn, so that several series (phases of one
  /// beat) are of one study. Empty: from `uid_seed`.
  std::string study_seed{};
  std::optional<double> cardiac_phase_percent;
};

/// One CT Image Storage file a slice (`CT0001.dcm`, ...), explicit VR little endian, uncompressed, HU by
/// slope 1 and intercept -1024 (-32768 where a value is lower), with all attributes of type 1 and 2 that
/// PS3.3 A.3 asks for, marked as synthetic data (0008,001C). No date or time of the writing: the same image
/// gives the same bytes. The folder must not exist or be empty; it appears whole or not at all. Throws
/// InvalidInput (an empty image, more than 65,535 rows or columns, k axis not along the normal, texts that
/// are not plain ASCII of at most 64 characters), IoError, ResourceError, Cancelled.
void write_dicom_series(const std::filesystem::path& folder, const ImageVolume& image,
                        const DicomSeriesOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
