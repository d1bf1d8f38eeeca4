#pragma once
/// \file What iterative reconstruction leaves of the noise: blotches where the image is flat, more at edges.

#include "scan/point_spread.h"

#include "ostia/phantom/scan.h"

#include <array>
#include <vector>

namespace ostia::phantom {

class IterativeNoise {
 public:
  explicit IterativeNoise(const ScanOptions& options);
  bool none() const { return share_ <= 0.0f; }
  /// Adds noise, `width` values a row, to a slice that has none.
  void add(const SliceView& slice, std::vector<float> noise) const;

 private:
  geometry::Vec3 spacing_;
  float share_, scale_ = 1.0f;
  std::array<double, 2> sigma_voxels_{};  ///< of the blur that makes blotches
};

}  // namespace ostia::phantom
