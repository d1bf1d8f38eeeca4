#pragma once
/// \file Noise as it comes into a CT image: on the rays, more where they are weakened more, filtered and
/// back-projected.

#include "body/body_rays.h"

#include "ostia/core/task_context.h"
#include "ostia/phantom/scan.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// Noise of slices that know nothing of each other. Its radial spectrum is that of the stationary noise
/// (`noise_amplitude`); at the centre its expected deviation is 1.
class RayNoise {
 public:
  RayNoise(const Scene& scene, const ScanOptions& options, const core::TaskContext& task);
  /// Of slice k of the options' grid, which may lie beyond it.
  std::vector<float> slice(std::int64_t k) const;

 private:
  struct Axis {  ///< of the grid that is projected onto, along i or j
    double first_mm = 0.0, step_mm = 1.0;
    std::int64_t count = 0;
  };
  void prepare_filter(double peak_per_mm, double reach_mm);
  /// What a view shows: noise along the detector, filtered, in steps of `fine_mm_`.
  void view(int n, std::int64_t k, std::vector<float>& fine) const;
  std::vector<float> back_projected(std::int64_t k) const;

  BodyRays rays_;
  imaging::Geometry grid_;
  double strength_, mean_variance_ = 1.0, first_height_mm_ = 0.0;
  std::uint64_t seed_;
  int step_ = 1;  ///< voxels: where the noise is smooth, every second one is enough
  std::array<Axis, 2> axes_;
  int views_ = 0;
  double bin_mm_ = 1.0, fine_mm_ = 1.0;
  std::int64_t bins_ = 0, taps_ = 0;        ///< bins of the detector; taps to either side
  std::vector<std::vector<float>> filter_;  ///< [part of a bin][2 taps + 1]
};

/// A place of the options' that the noise is asked for: the heart's centre or the grid's.
geometry::Vec3 noise_centre(const ScanOptions& options);

}  // namespace ostia::phantom
