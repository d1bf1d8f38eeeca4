#pragma once
/// \file Masks grown, shrunk, taken apart and filled.

#include "ostia/imaging/volume.h"

#include <cstdint>
#include <vector>

namespace ostia::imaging {

/// Voxels within `radius_mm` (>= 0; between centres, in the grid's spacing) of a voxel of the mask; 1 inside.
/// Throws InvalidInput.
MaskVolume dilated(const MaskVolume& mask, double radius_mm);
/// Voxels of the mask that are no nearer than that to one outside of it. Beyond the image's border the mask
/// is taken to go on. Throws InvalidInput.
MaskVolume eroded(const MaskVolume& mask, double radius_mm);

/// The parts of a mask that are connected through faces.
struct Components {
  std::vector<std::uint32_t> label;  ///< of every voxel; 0 outside, parts from 1 on in scanning order
  std::vector<std::int64_t> voxels;  ///< of each part; [0] of what is outside
};
Components components(const MaskVolume& mask);

/// Fills the holes that the mask has in the grid's slices across each of its three axes (what does not reach
/// the slice's border through faces), where the image's mean over the hole is `least_mean_hu` or more. Both
/// on one grid. Throws InvalidInput.
void fill_bright_holes(MaskVolume& mask, const ImageVolume& image, double least_mean_hu);

}  // namespace ostia::imaging
