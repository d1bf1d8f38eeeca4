#pragma once
/// \file What rays through a body meet: line integrals of its attenuation.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/scene.h"

#include <vector>

namespace ostia::phantom {

/// Parallel rays in the planes of a grid's slices. A ray is known by the direction of its normal (angle from
/// the i axis, [0, pi)), by its signed distance from the centre and by the height of its plane above it, mm.
class BodyRays {
 public:
  static constexpr double water_per_mm = 0.0195;  ///< attenuation at 70 keV

  /// Looks at the scene every 5 mm within 260 mm of the centre, in planes 10 mm apart that hold the grid's
  /// slices. Throws Cancelled.
  BodyRays(const Scene& scene, const imaging::Geometry& grid, const geometry::Vec3& centre_mm,
           const core::TaskContext& task);
  /// Without unit; 0 beyond what was looked at.
  double line_integral(double angle, double distance_mm, double height_mm) const;

 private:
  double at(int plane, int angle, double bin) const;

  int first_plane_ = 0, planes_ = 1;
  std::vector<float> lines_;  ///< [plane][angle][bin]
};

}  // namespace ostia::phantom
