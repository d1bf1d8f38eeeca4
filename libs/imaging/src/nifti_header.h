#pragma once
/// \file The header of a NIfTI-1 file with its voxels in the same file.

#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>

namespace ostia::imaging {

struct NiftiType {
  std::int16_t code = 2, bits = 8;  ///< 2, 8: unsigned char; 4, 16: short; 16, 32: float
};
inline constexpr std::int64_t most_nifti_voxels = 32767;  ///< along an axis

/// 352 bytes, little-endian; both transforms lead to right-anterior-superior axes in mm. Lengths and places
/// are single precision: 10 micrometres half a metre away.
std::string nifti_header(const Geometry& grid, NiftiType type);

}  // namespace ostia::imaging
