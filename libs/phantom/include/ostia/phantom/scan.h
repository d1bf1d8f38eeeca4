#pragma once
/// \file A CT scanner: from materials in space to an image in HU.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/scan_realism.h"
#include "ostia/phantom/scene.h"

#include <cstdint>

namespace ostia::phantom {

/// How the image is made. All deterministic; the same bytes for any number of threads. "In the plane" and
/// "along z" mean the grid's own axes i, j and k.
struct ScanOptions {
  imaging::Geometry grid;
  int supersampling = 4;  ///< pieces along a voxel's side, where it is not of one material, in [1, 8]
  /// Full width at half maximum of the finished image's line-spread function in the plane (Gaussian), in [0,
  /// 5] and at least half a voxel; nothing comes on top of it. 0: the voxel's own box alone.
  double psf_fwhm_mm = 0.7;
  double psf_fwhm_z_mm = 0.8;  ///< the same along z (slice sensitivity)
  double noise_hu = 25.0;      ///< standard deviation in the finished image, in [0, 500]
  /// Where the in-plane noise power spectrum peaks, cycles a mm, in [0, 2] and (where there is noise) at most
  /// 0.18 cycles a voxel; 0: low-pass noise, correlated as the point-spread function.
  double noise_peak_per_mm = 0.2;
  double noise_fwhm_z_mm = 0.8;  ///< of the kernel that correlates it along z, in [0, 5]
  double stair_step_mm = 0.0;    ///< lateral jump between blocks of slices (gated acquisition), in [0, 10]
  double stair_block_mm = 20.0;  ///< height of a block, in [1, 500]
  double motion_mm = 0.0;        ///< blur by motion during the exposure: length of the path, in [0, 10]
  geometry::Vec3 moving_centre = geometry::Vec3::Zero();  ///< steps and motion move what lies in this ball
  double moving_radius_mm = 0.0;                          ///< 0: they move everything
  double beam_hardening = 0.0;  ///< 0 none, 1 usual: dark streaks beside dense bone and contrast, in [0, 5]
  /// What real scans show beyond that. Of its members `acquire` obeys those of the scanner; contrast and what
  /// patients carry are drawn where a case's scene is made (`scan_case`).
  ScanRealism realism;
  std::uint64_t seed = 1;
};
void validate(const ScanOptions& options);  ///< throws InvalidInput

/// The scanner and the contrast of a gated coronary CT angiogram as it was measured
/// (docs/experiments/scans.md); nothing carried, no motion. The grid is the caller's.
ScanOptions measured_scan();

struct Scan {
  imaging::ImageVolume image;  ///< HU in [-1024, 3071]
  imaging::MaskVolume labels;  ///< Label at each voxel's centre
};
/// Partial volumes by supersampling, point-spread function, artefacts asked for, then correlated noise. Works
/// slab by slab: little more memory than the result. Throws InvalidInput, Cancelled.
Scan acquire(const Scene& scene, const ScanOptions& options, const core::TaskContext& task = core::no_task());

/// How far the moving part of a slice of the options' grid is shown from its true place (the truth is not
/// moved; the labels are): alternately half a step to either side, so that neighbouring blocks lie
/// `stair_step_mm` apart.
geometry::Vec3 stair_shift(const ScanOptions& options, std::int64_t slice);

}  // namespace ostia::phantom
