#pragma once
/// \file The smooth map between a patient's heart and the phantom's own.

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::phantom {

using geometry::Mat3;
using geometry::Vec3;

/// Pairs of places that belong together: in the world, and in the phantom's own heart and chest.
struct WarpLandmarks {
  std::vector<Vec3> world, own;
  void add(const Vec3& in_world, const Vec3& in_own);
};

/// A map of space onto itself, twice continuously differentiable: a thin-plate spline through landmarks
/// (Bookstein 1989), sampled on a lattice of 6 mm whose displacements are the coefficients of a cubic
/// B-spline (Rueckert et al. 1999). The identity from about 200 mm from the middle on. Where it would fold,
/// or come near to it, the lattice is smoothed until its Jacobian is at least 0.25 on a grid of 3 mm.
/// Immutable; asked from many threads.
class HeartWarp {
 public:
  /// Throws as geometry::ThinPlateSpline does, and InvalidInput where smoothing does not help.
  explicit HeartWarp(const WarpLandmarks& landmarks);
  Vec3 to_own(const Vec3& world) const;
  Vec3 to_world(const Vec3& own) const;    ///< the inverse, to 1e-6 mm
  Mat3 gradient(const Vec3& world) const;  ///< of `to_own`
  double least_jacobian() const { return least_; }
  double largest_jacobian() const { return largest_; }
  double longest_mm() const { return longest_; }  ///< the longest way that a place within the chest is moved
  int smoothings() const { return smoothings_; }  ///< rounds that were needed; 0: none

 private:
  std::size_t at(int i, int j, int k) const;
  void smooth();
  void measure();
  Vec3 origin_ = Vec3::Zero();
  std::array<int, 3> count_{};
  std::vector<Vec3> displacement_;
  double least_ = 1.0, largest_ = 1.0, longest_ = 0.0;
  int smoothings_ = 0;
};

}  // namespace ostia::phantom
