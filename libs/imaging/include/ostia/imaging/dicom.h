#pragma once
/// \file CT series from folders of DICOM files.

#include "ostia/core/task_context.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::imaging {

class UnpackedArchive;

/// One series found in a folder: files that belong to one image, sorted by position. Nothing of the patient's
/// identity but for what is shown on the terminal (`description`).
struct DicomSeries {
  std::string uid;                    ///< SeriesInstanceUID, with "#2", ... where it had to be split
  std::string modality, description;  ///< for the terminal and the window alone: never saved
  std::string transfer_syntax;
  std::string phase;  ///< "cardiac phase 40 %" where a series had to be split by it
  /// Another number for another patient, not saying whom; 0: not known. Good within one process.
  std::uint64_t patient_number = 0;
  std::uint64_t study_number = 0;  ///< the same for studies (StudyInstanceUID)
  std::optional<double>
      cardiac_percent;  ///< NominalPercentageOfCardiacPhase, where all slices have one value
  std::vector<std::filesystem::path> files;  ///< one a slice, by position along the normal
  std::vector<std::int64_t> frames;          ///< of the slice in its file, from 0
  bool whole_files = true;                   ///< its files hold no frame of another series
  Geometry geometry;                         ///< before the repair of gaps and tilt
  double gantry_tilt_deg = 0.0;              ///< shear between slice direction and normal
  std::vector<std::string> warnings;         ///< missing slices, uneven spacing, tilt, ...
  std::vector<std::string>
      faults;  ///< why it cannot be read (no position, no pixel spacing, duplicates); empty if it can
  bool lacks_orientation = false;  ///< its only fault: needs consent to be read as axial slices
  bool uneven = false;  ///< a slice missing or distances off by more than 0.2 mm: needs consent to resample
  /// Where the files were unpacked from a zip: they vanish with the last copy of this.
  std::shared_ptr<const UnpackedArchive> archive;
};

/// All series below a folder (or the one that a file belongs to), largest first. Files that are not DICOM
/// images are counted in `skipped`. Only headers are read, by our own bounded parser. Files of two patients,
/// or of two studies, are never one series, even where they share its UID.
struct DicomFolder {
  std::vector<DicomSeries> series;
  std::size_t skipped = 0;
  std::vector<std::string>
      damaged;  ///< files that are DICOM but broken, and of no series found: what is wrong with each
};
/// How many patients the series are of, as far as they say; those that do not say are none.
std::size_t patients_in(const std::vector<DicomSeries>& series);

/// A zip archive (by its first bytes) is unpacked safely first (imaging/archive.h). Throws IoError where
/// nothing can be read, InvalidInput for a single file that is no DICOM image or is damaged, and what
/// unpack_archive throws.
DicomFolder scan_dicom(const std::filesystem::path& folder_or_file,
                       const core::TaskContext& task = core::no_task());

/// How the series is known in everything that is saved: the SHA-256 of a folder with its files alone
/// (core::sha256_of_files), so that neither their names nor other series beside it matter. Of a part of
/// multi-frame files, the numbers of its frames go into each file's digest. Reads the files whole. Throws
/// IoError (missing, unreadable), InvalidInput (a series without files), Cancelled.
std::string series_digest(const DicomSeries& series, const core::TaskContext& task = core::no_task());

struct DicomReadOptions {
  std::string series_uid;        ///< empty: the only one, or InvalidInput listing them
  bool resample_uneven = false;  ///< the user's consent to interpolate over missing or uneven slices
  std::optional<double> pixel_spacing_mm;  ///< given by the user where the files have none
  std::optional<double>
      slice_spacing_mm;  ///< given by the user where the files have no position: stacked by instance number
  /// The user's consent where the files do not say how the patient lies: axial slices of one on the back.
  /// What is wrong of it is set right by imaging::given_axes.
  bool assume_axial = false;
};

/// The image in HU on a right-handed orthonormal grid: rescaled slice by slice, tilt corrected by resampling,
/// voxels decoded in a child process. From a folder, a file of the series, or a zip archive. `chosen` is
/// called once with the series, before its voxels are read. Throws InvalidInput naming the file and the
/// attribute.
LoadedImage<std::int16_t> read_dicom(const std::filesystem::path& folder_or_file,
                                     const DicomReadOptions& options = {},
                                     const core::TaskContext& task = core::no_task(),
                                     const std::function<void(const DicomSeries&)>& chosen = {});

/// The same for a series that scan_dicom found, from its own files alone: quick where a folder holds many.
/// Throws also IoError where a file is gone.
LoadedImage<std::int16_t> read_dicom_series(const DicomSeries& series, const DicomReadOptions& options = {},
                                            const core::TaskContext& task = core::no_task());

/// The child's side: decodes the listed files' pixel data into one raw file of stored values. For apps/worker
/// alone. Returns an exit code; what went wrong, and with which file, is on stderr.
int decode_dicom_files(const std::filesystem::path& list_file, const std::filesystem::path& output_file);

}  // namespace ostia::imaging
