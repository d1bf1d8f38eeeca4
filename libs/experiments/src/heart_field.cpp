#include "heart_field.h"

#include <cmath>

namespace ostia::experiments {

imaging::Geometry heart_field(const phantom::CasePlan& plan, double voxel_mm, double slice_mm) {
  using geometry::Vec3;
  constexpr double about_heart_mm = 15.0, aorta_above_mm = 45.0;
  geometry::Box3 box;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels)
    for (const Vec3& point : vessel.axis.points) box.extend(point);
  const phantom::AorticRoot& root = plan.heart.root;
  const auto in_world = [&](const Vec3& own) { return plan.warp ? plan.warp->to_world(own) : own; };
  const Vec3 annulus = in_world(root.annulus);
  box.extend(Vec3(annulus - Vec3::Constant(root.sinus_radius_mm)));
  box.extend(Vec3(annulus + Vec3::Constant(root.sinus_radius_mm)));
  box.extend(in_world(root.annulus + aorta_above_mm * root.axis));
  imaging::Geometry grid;
  grid.spacing = {voxel_mm, voxel_mm, slice_mm};
  const Vec3 lower = box.min() - Vec3(about_heart_mm, about_heart_mm, 5.0);
  const Vec3 size = box.max() + Vec3(about_heart_mm, about_heart_mm, 0.0) - lower;
  for (int a = 0; a < 3; ++a)
    grid.size[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(std::ceil(size[a] / grid.spacing[a]));
  grid.origin = lower;
  return grid;
}

}  // namespace ostia::experiments
