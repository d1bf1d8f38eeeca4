#include "ostia/pipeline/lumen_surface.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/filters.h"
#include "ostia/segmentation/segment.h"

#include <algorithm>

namespace ostia::pipeline {

std::int64_t handles_of(const geometry::TriMesh& closed) {
  if (closed.triangles.empty()) return 0;
  const std::vector<std::int32_t> part = geometry::components(closed);
  const std::int64_t parts = 1 + *std::max_element(part.begin(), part.end());
  const auto vertices = static_cast<std::int64_t>(closed.points.size());
  const auto faces = static_cast<std::int64_t>(closed.triangles.size());
  // Euler and Poincare: V - E + F = 2 parts - 2 handles, and E = 3F/2.
  return parts - (vertices - faces / 2) / 2;
}

LumenSurface lumen_surface(const imaging::FloatVolume& level_set, const std::vector<geometry::Vec3>& seeds_mm,
                           const core::TaskContext& task) {
  LumenSurface out;
  out.mesh = segmentation::surface_of(level_set, seeds_mm, {}, task);
  const std::int64_t handles = handles_of(out.mesh);
  if (handles == 0) return out;
  for (const double voxels : {0.5, 0.75, 1.0, 1.25, 1.5}) {
    const double sigma_mm = voxels * level_set.geometry.spacing.maxCoeff();
    out.mesh =
        segmentation::surface_of(imaging::gaussian_blurred(level_set, sigma_mm, task), seeds_mm, {}, task);
    if (handles_of(out.mesh) != 0) continue;
    out.warnings.push_back("the lumen's surface had " + std::to_string(handles) +
                           " small handles (noise, or a stent's struts); smoothing by " +
                           std::to_string(voxels).substr(0, 4) + " voxels took them away");
    return out;
  }
  out.warnings.push_back("the lumen's surface has " + std::to_string(handles_of(out.mesh)) +
                         " handles: branches touch each other, or the range of intensities lets it leak");
  return out;
}

}  // namespace ostia::pipeline
