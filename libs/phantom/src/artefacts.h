#pragma once
/// \file What goes wrong in a gated acquisition: steps between blocks of slices, blur by motion, and beam
/// hardening.

#include "point_spread.h"

#include "ostia/phantom/scan.h"

#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// How much of the heart's motion a place takes part in: 1 inside the moving ball, falling smoothly to 0 over
/// its outer third; 1 everywhere where the ball has no radius.
double motion_share(const ScanOptions& options, const geometry::Vec3& point_mm);

/// Blur along a straight path in the plane of the slice.
class MotionBlur {
 public:
  explicit MotionBlur(const ScanOptions& options);
  bool none() const { return taps_.empty(); }
  /// Blurs slice k of the options' grid in place; the view begins (margin_i, margin_j) voxels before it.
  void blur(const SliceView& slice, std::int64_t margin_i, std::int64_t margin_j, std::int64_t k) const;

 private:
  struct Tap {
    int di, dj;
    float weight;
  };
  ScanOptions options_;
  std::vector<Tap> taps_;
};

/// Adds the error that beam hardening leaves in a slice.
void add_beam_hardening(const SliceView& slice, const geometry::Vec3& spacing_mm, double strength);

}  // namespace ostia::phantom
