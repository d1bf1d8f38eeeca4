#pragma once
/// \file Blurred discs, worked out once for all vessels of a scan.

#include <cstddef>
#include <memory>
#include <vector>

namespace ostia::segmentation {

/// blurred_disc(r * radius_step_mm, i * step_mm, sigma_mm).
struct DiscTable {
  double radius_step_mm = 0.0, step_mm = 0.0, sigma_mm = 0.0;
  int radii = 0, samples = 0;
  std::vector<double> share;  ///< [radius][sample]
  double at(int radius, int sample) const {
    return share[static_cast<std::size_t>(radius) * static_cast<std::size_t>(samples) +
                 static_cast<std::size_t>(sample)];
  }
};

/// One with at least so many radii and samples; the last few are kept for the next vessel. Any thread.
std::shared_ptr<const DiscTable> disc_table(double radius_step_mm, double step_mm, double sigma_mm, int radii,
                                            int samples);

}  // namespace ostia::segmentation
