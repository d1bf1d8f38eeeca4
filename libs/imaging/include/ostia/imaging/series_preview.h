#pragma once
/// \file What a browser of image series shows of each: a thumbnail, and whose it is.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::imaging {

class DicomDataset;

/// Whose image it is, for what a window shows, keeps on its own machine, and writes where a person asks for
/// it each time: never in a case, a log or a message. UTF-8; what is not known is empty.
struct ShownIdentity {
  std::string patient_name{};        ///< "Doe, Jane"
  std::string patient_id{};          ///< (0010,0020)
  std::string study_date{};          ///< "2024-03-01"
  std::string series_description{};  ///< (0008,103E)
  std::int64_t slices = 0;

  /// It says of nobody: neither a name nor an identifier.
  bool anonymous() const { return patient_name.empty() && patient_id.empty(); }
  bool operator==(const ShownIdentity&) const = default;
};

/// From the header of the series' middle slice, without decoding a picture. Empty where there is none or it
/// says nothing. Throws IoError.
ShownIdentity shown_identity(const DicomSeries& series);
/// The same of one object's data set.
ShownIdentity shown_identity(const DicomDataset& data);

/// Grey values from black to white.
struct GreyWindow {
  double centre_hu = 0.0, width_hu = 1.0;  ///< width > 0
  bool from_file = false;  ///< the first pair of WindowCenter and WindowWidth (0028,1050/1051)
};

/// An 8-bit picture of a series' middle slice, rows from the top, as one looks at it: the patient's right on
/// the left, front above (for axial slices; others with their head above).
struct SeriesPreview {
  int width = 0, height = 0;         ///< the longer side is `size_px`, pixels are square in mm
  std::vector<std::uint8_t> pixels;  ///< row by row
  GreyWindow window;
  ShownIdentity shown;
};

/// One slice of a series as soon as it is decoded.
struct SeriesSlice {
  ImageVolume image;       ///< one voxel thick, in HU, in its place in the world
  std::int64_t index = 0;  ///< in `series.files`
  GreyWindow window;
};

/// Decodes the slice `index` (-1: the middle one) alone, in a child process as all foreign pixel data. A
/// tilted gantry's shear is not corrected. Throws InvalidInput (no pixels that can be read, index out of
/// range), IoError, ResourceError, Cancelled.
SeriesSlice first_slice(const DicomSeries& series, std::int64_t index = -1,
                        const core::TaskContext& task = core::no_task());

/// Throws as first_slice, and InvalidInput for a size outside [16, 2048].
SeriesPreview preview(const DicomSeries& series, int size_px = 128,
                      const core::TaskContext& task = core::no_task());

/// The same for a NRRD, MetaImage or NIfTI file, which is read whole. Window: the 1st to 99th percentile of
/// the slice. Nobody's name is in these; `slices` is filled. Throws as read_image.
SeriesPreview preview(const std::filesystem::path& image_file, int size_px = 128,
                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
