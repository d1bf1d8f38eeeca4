#pragma once
/// \file The reconstruction's kernel in the plane beyond one Gaussian: undershoot of a sharp kernel, wide
/// tails.

#include "scan/point_spread.h"

#include "ostia/phantom/scan.h"

#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// A sum of Gaussians whose line-spread function has the width that was asked for. The first one is painted
/// (`PointSpread`), the others are blurs of what it shows.
class PlaneKernel {
 public:
  /// Throws InvalidInput where tails are narrower than 1.5 times the width, or undershoot or tails are asked
  /// of the voxel's own box.
  explicit PlaneKernel(const ScanOptions& options);
  bool none() const { return lobes_.empty(); }
  double base_fwhm_mm() const { return base_fwhm_mm_; }
  std::int64_t reach(int axis) const;  ///< voxels, 0 or 1: of what is added to the first Gaussian
  void apply(const SliceView& slice) const;

 private:
  struct Lobe {
    double weight, sigma_mm;  ///< of the blur that comes on top of the first Gaussian
  };
  double base_fwhm_mm_, base_weight_ = 1.0;
  geometry::Vec3 spacing_;
  std::vector<Lobe> lobes_;
};

}  // namespace ostia::phantom
