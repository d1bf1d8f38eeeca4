#pragma once
/// \file The noise of a CT image: normal, with the power spectrum of filtered back-projection; the same
/// everywhere, or what the rays through the body make of it.

#include "scan/point_spread.h"
#include "scan/ray_noise.h"

#include "ostia/core/task_context.h"
#include "ostia/phantom/scan.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace ostia::phantom {

/// The noise's amplitude in the plane at a frequency in units of the peak's.
double noise_amplitude(double frequency_over_peak);

/// Noise of an image, slice by slice in ascending order. Its expected deviation is exactly `noise_hu`, from
/// the kernels' norms.
class ScanNoise {
 public:
  ScanNoise(const Scene& scene, const ScanOptions& options, const core::TaskContext& task);
  /// Makes ready for slices [first, last); forgets what lies before.
  void prepare(std::int64_t first, std::int64_t last, const core::TaskContext& task);
  /// Adds to a slice of the options' grid that was made ready.
  void add(const SliceView& slice, std::int64_t k) const;

 private:
  /// In the plane: the sum of `amount` times a separable kernel.
  struct Lobe {
    double amount = 1.0;
    std::vector<double> x, y;  ///< weights at 0, 1, ... voxels, of unit sum
  };
  std::vector<float> filtered(std::int64_t k) const;

  ScanOptions options_;
  std::optional<RayNoise> rays_;  // instead of the lobes
  std::vector<Lobe> lobes_;
  std::vector<double> z_;
  std::int64_t margin_x_ = 0, margin_y_ = 0;
  double scale_ = 0.0;
  std::map<std::int64_t, std::vector<float>> ready_;
};

}  // namespace ostia::phantom
