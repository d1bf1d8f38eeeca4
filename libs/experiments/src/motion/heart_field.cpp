#include "motion/heart_field.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

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

}  // namespace

void scan_heart_field(phantom::CasePlan& plan, double voxel_mm, double slice_mm, double least_voxels) {
  constexpr double highest_peak = 0.17;  // cycles a voxel
  phantom::ScanOptions& scan = plan.options.scan;
  scan.grid = heart_field(plan, voxel_mm, slice_mm);
  scan.supersampling = 3;
  scan.psf_fwhm_mm = std::max(scan.psf_fwhm_mm, least_voxels * voxel_mm);
  scan.psf_fwhm_z_mm = std::max(scan.psf_fwhm_z_mm, 0.5 * slice_mm);
  scan.noise_peak_per_mm = std::min(scan.noise_peak_per_mm, highest_peak / voxel_mm);
}

phantom::CasePlan plan_on_heart_field(const phantom::CaseOptions& patient, double voxel_mm) {
  constexpr double slice_share = 0.6;
  // At least half a voxel with the narrower core that kernels with tails and undershoot have.
  constexpr double least_voxels = 0.7;
  phantom::CasePlan plan = phantom::plan_case(patient);
  scan_heart_field(plan, voxel_mm, std::max(voxel_mm, slice_share * plan.options.scan.psf_fwhm_z_mm),
                   least_voxels);
  return plan;
}

}  // namespace ostia::experiments
