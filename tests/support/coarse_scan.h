#pragma once
/// \file Scans of the synthetic patients in voxels large enough for a unit test.

#include "ostia/phantom/phantom_case.h"

#include <cstddef>
#include <cstdint>

namespace ostia::testing {

/// The same field in cubes of `voxel_mm`, blurred by as much.
inline void make_coarse(phantom::ScanOptions& scan, double voxel_mm) {
  for (std::size_t a = 0; a < 3; ++a)
    scan.grid.size[a] = static_cast<std::int64_t>(static_cast<double>(scan.grid.size[a]) *
                                                  scan.grid.spacing[static_cast<Eigen::Index>(a)] / voxel_mm);
  scan.grid.spacing.setConstant(voxel_mm);
  scan.psf_fwhm_mm = scan.psf_fwhm_z_mm = voxel_mm;
  scan.noise_peak_per_mm = 0.0;
}

}  // namespace ostia::testing
