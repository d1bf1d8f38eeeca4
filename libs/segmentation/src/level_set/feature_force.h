#pragma once
/// \file Where a level set is pulled: features sampled between voxels.

#include "level_set/spline_derivatives.h"

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/level_set.h"

namespace ostia::segmentation::detail {

/// A feature at a point and its gradient, 1/mm along the image's axes.
struct Sample {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};

/// A feature that pulls. Points are voxel indices of the level set's grid.
class FeatureForce {
 public:
  FeatureForce() = default;
  FeatureForce(const FeatureForce&) = delete;
  FeatureForce& operator=(const FeatureForce&) = delete;
  virtual ~FeatureForce() = default;
  /// `normal`: the surface's, outward, along the image's axes.
  virtual Sample at(const Vec3& index, const Vec3& normal) const = 0;
};

/// A feature given on the grid: the quadratic B-spline with the voxels as coefficients, smooth enough for the
/// place where its gradient turns to be defined between voxels.
class GridFeatureForce : public FeatureForce {
 public:
  GridFeatureForce(const imaging::FloatVolume& feature, double offset_voxels)
      : feature_(feature), offset_(offset_voxels) {}
  Sample at(const Vec3& index, const Vec3& normal) const override;

 private:
  const imaging::FloatVolume& feature_;
  double offset_;
};

/// log(1 + |grad I|^2/k^2)/2 of the image's cubic B-spline, differentiated exactly: grad = H g / (k^2 +
/// |g|^2).
class EdgeFeatureForce : public FeatureForce {
 public:
  EdgeFeatureForce(const imaging::ImageVolume& image, const imaging::Geometry& grid, const EdgeFeature& edge);
  Sample at(const Vec3& index, const Vec3& normal) const override;

 private:
  /// P^2 and half its gradient by one-sided differences.
  Sample upwind_at(const Vec3& index, const Vec3& normal) const;

  const imaging::ImageVolume& image_;
  Vec3 first_;  ///< index in the image of the grid's first voxel
  EdgeFeature edge_;
  std::int16_t brightest_;
};

/// What |grad I| pulls too far inwards on a curved wall, as a multiple of the gradient to be added to half
/// the gradient of |grad I|^2. `blur`: EdgeFeature::blur.
double curvature_correction(const Derivatives& d, const Vec3& blur);

}  // namespace ostia::segmentation::detail
