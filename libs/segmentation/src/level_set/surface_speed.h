#pragma once
/// \file What moves a level set at one voxel ([Antiga] eq. 1).

#include "level_set/feature_force.h"
#include "level_set/sparse_field.h"

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/level_set.h"

#include <array>
#include <vector>

namespace ostia::segmentation::detail {

/// The right-hand side of eq. 1 in the time unit in which a ridge one voxel wide is reached in a few steps:
/// lengths are scaled by h = the least spacing, so that w2 and w3 mean the same whatever the voxel's size.
class SurfaceSpeed {
 public:
  SurfaceSpeed(const imaging::Geometry& grid, const FeatureForce& feature,
               const FeatureForce* inflation_speed, const LevelSetOptions& options);

  /// Shortens (below 1) or restores the time step.
  void damp(double factor) { step_ *= factor; }

  /// Change of phi, mm, in one step at voxel n of the field's active layer.
  double change(const SparseField& field, std::int64_t n) const;

 private:
  struct Local;
  struct EndZone {
    Vec3 point;  ///< mm along the image's axes, from its first voxel
    Vec3 axis;
    double radius;
    double reach;
    bool hold_beyond;
  };
  struct Bend;
  Local differentiate(const SparseField& field, std::int64_t n) const;
  Bend bend(const SparseField& field, std::int64_t n, const Local& local) const;
  double curvature(const SparseField& field, std::int64_t n, const Local& local) const;
  const EndZone* zone_at(const Vec3& index, bool& beyond) const;

  const FeatureForce& feature_;
  const FeatureForce* inflation_speed_;
  LevelSetOptions options_;
  std::array<std::int64_t, 3> size_;
  Vec3 spacing_;
  double h_ = 1.0;
  double step_ = 0.4;
  std::vector<EndZone> zones_;
};

}  // namespace ostia::segmentation::detail
