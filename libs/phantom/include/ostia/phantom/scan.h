#pragma once
/// \file A CT scanner: from materials in space to an image in HU.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/scene.h"

#include <cstdint>

namespace ostia::phantom {

/// How the image is made. All deterministic; the same bytes for any number of threads.
struct ScanOptions {
  imaging::Geometry grid;
  int supersampling = 4;       ///< a voxel's side, where it is not of one material, in [1, 8]
  double psf_fwhm_mm = 0.6;    ///< in the slice's plane, Gaussian, in [0, 5]
  double psf_fwhm_z_mm = 0.7;  ///< along z (slice sensitivity)
  double noise_hu = 25.0;      ///< standard deviation in the finished image, in [0, 500]
  double noise_peak_per_mm =
      0.25;  ///< where the in-plane noise power spectrum peaks, cycles a mm; 0: low-pass noise
  double noise_fwhm_z_mm = 0.7;  ///< correlation along z
  double stair_step_mm =
      0.0;  ///< lateral jump between blocks of slices (steps of a gated acquisition), 0: none
  double stair_block_mm = 20.0;  ///< height of a block
  double motion_mm = 0.0;        ///< blur by residual motion during the exposure: length of the path, 0: none
  double beam_hardening = 0.0;   ///< 0 none, 1 usual: dark streaks beside dense bone and contrast
  std::uint64_t seed = 1;
};
void validate(const ScanOptions& options);  ///< throws InvalidInput

struct Scan {
  imaging::ImageVolume image;  ///< HU in [-1024, 3071]
  imaging::MaskVolume labels;  ///< Label at each voxel's centre
};
/// Partial volumes by supersampling, point-spread function, artefacts asked for, then correlated noise.
Scan acquire(const Scene& scene, const ScanOptions& options, const core::TaskContext& task = core::no_task());

}  // namespace ostia::phantom
