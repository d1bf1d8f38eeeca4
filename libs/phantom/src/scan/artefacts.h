#pragma once
/// \file What goes wrong in a gated acquisition: steps between blocks of slices, motion while the tube turns,
/// beam hardening and streaks.

#include "body/organ.h"
#include "scan/point_spread.h"

#include "ostia/phantom/scan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::phantom {

/// A direction in the plane of the slices, drawn from the seed.
double drawn_angle(const ScanOptions& options, std::uint64_t stream);

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

/// What a half-scan shows of a heart that moves while the tube turns: each edge where it was when the rays
/// ran along it. In the middle of the exposure everything is where the truth has it.
class HalfScanMotion {
 public:
  explicit HalfScanMotion(const ScanOptions& options);
  bool none() const { return options_.realism.half_scan_motion_mm <= 0.0; }
  /// As MotionBlur::blur.
  void blur(const SliceView& slice, std::int64_t margin_i, std::int64_t margin_j, std::int64_t k) const;

 private:
  std::vector<float> moving_part(const SliceView& slice, std::int64_t margin_i, std::int64_t margin_j,
                                 std::int64_t k) const;

  ScanOptions options_;
  double direction_, first_angle_;  ///< of the path; of the view that the exposure begins with
};

/// Adds the error that beam hardening leaves in a slice.
void add_beam_hardening(const SliceView& slice, const geometry::Vec3& spacing_mm, double strength);

/// Streaks from views that do not agree about dense things: each view's share of them is off by a random
/// part, much the same in neighbouring views and slices.
class ViewStreaks {
 public:
  explicit ViewStreaks(const ScanOptions& options);
  bool none() const { return strength_ <= 0.0; }
  /// Adds them to slice k of the options' grid.
  void add(const SliceView& slice, std::int64_t k) const;

 private:
  geometry::Vec3 spacing_;
  double strength_;
  std::shared_ptr<const NoiseField> noise_;
};

}  // namespace ostia::phantom
