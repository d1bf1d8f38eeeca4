#pragma once
/// \file How a CT series was taken, as its headers say: nothing of the patient.

#include "ostia/imaging/dicom.h"

#include <optional>
#include <string>

namespace ostia::imaging {

/// What is not said, or is no number, is nothing.
struct ScanTechnique {
  std::optional<double> tube_kv = {};        ///< KVP (0018,0060), kV
  std::optional<double> slice_mm = {};       ///< SliceThickness (0018,0050), mm
  std::optional<double> phase_percent = {};  ///< DicomSeries::cardiac_percent
  std::string kernel = {};                   ///< ConvolutionKernel (0018,1210)
  bool operator==(const ScanTechnique&) const = default;
};

/// From the header of the series' middle slice. Of enhanced multi-frame objects, which say it of each frame,
/// the phase alone. Throws IoError.
ScanTechnique scan_technique(const DicomSeries& series);

}  // namespace ostia::imaging
