#pragma once
/// \file Masks as DICOM Segmentation objects (PS3.3 A.51).

#include "ostia/dicom/code.h"
#include "ostia/dicom/object.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::dicom {

/// What a segment is.
struct Segment {
  std::string label;        ///< "Coronary lumen"
  std::string description;  ///< may be empty
  Code category = codes::body_structure, type = codes::artery, region = codes::coronary_artery;
  std::array<double, 3> rgb{1.0, 0.0, 0.0};  ///< recommended for display, sRGB, [0, 1]
  /// Of a binary segmentation: the volume's values that are this segment. Segments may share values.
  std::vector<std::uint8_t> values;
};

struct SegmentationOptions {
  ObjectOptions object;
  std::string label = "CORONARIES";  ///< ContentLabel: capitals, digits, spaces, underscores
  std::string description = "Coronary arteries";
  std::string algorithm = "Ostia";  ///< SegmentAlgorithmName
  bool fractional = false;          ///< the volume's values are occupancies of 0 to `most`, of one segment
  std::uint8_t most = 255;
};

/// On the volume's own grid: frames of slices where a segment has voxels, slices by rising k within each
/// segment. Rows run along j and columns along i; each frame says where it lies. A frame refers to the
/// source's slice in the same plane, where there is one (half a slice's distance). Throws InvalidInput for an
/// empty volume, segments without a voxel in all, more than 65,535 rows, columns or segments, a grid whose k
/// axis does not run along the normal of its slices, and Cancelled.
DicomDataset segmentation(const SourceSeries& source, const imaging::MaskVolume& volume,
                          const std::vector<Segment>& segments, const SegmentationOptions& options = {},
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::dicom
