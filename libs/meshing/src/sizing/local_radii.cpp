#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/sizing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

constexpr double axis_explains_radii = 1.5;
constexpr double cone_deg = 30.0;
constexpr int rays_around = 8;
constexpr double off_the_wall = 1e-4;  // of the distance to the axis: where rays begin

/// The median length of rays into the lumen, halved; nothing where they leave it.
std::optional<double> seen_radius(const geometry::AabbTree& tree, const Vec3& point, const Vec3& inward,
                                  double start) {
  const Vec3 across = inward.unitOrthogonal(), other = inward.cross(across);
  const double tilt = cone_deg * std::numbers::pi / 180.0;
  std::array<double, rays_around + 1> lengths{};
  std::size_t count = 0;
  for (int i = 0; i <= rays_around; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / rays_around;
    const Vec3 direction = i == rays_around
                               ? inward
                               : Vec3(std::cos(tilt) * inward +
                                      std::sin(tilt) * (std::cos(angle) * across + std::sin(angle) * other));
    if (const auto hit = tree.first_hit(point + start * inward, direction)) lengths[count++] = hit->t;
  }
  if (count == 0) return std::nullopt;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(lengths.begin(), middle, lengths.begin() + static_cast<std::ptrdiff_t>(count));
  return 0.5 * *middle;
}

}  // namespace

std::vector<double> local_radii(const geometry::TriMesh& surface, const TubeFunction& tube,
                                const core::TaskContext& task) {
  std::vector<double> radii(surface.points.size());
  std::vector<TubeSize> sizes(surface.points.size());
  core::parallel_chunks(radii.size(), 1024, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      sizes[i] = tube(surface.points[i]);
      radii[i] = std::min(sizes[i].radius_mm, sizes[i].distance_mm);
    }
  });
  const auto unexplained = [&](std::size_t i) {
    return sizes[i].distance_mm > axis_explains_radii * sizes[i].radius_mm;
  };
  bool any = false;
  for (std::size_t i = 0; i < radii.size(); ++i) any = any || unexplained(i);
  if (!any) return radii;
  const geometry::AabbTree tree(surface);
  const std::vector<Vec3> normals = geometry::vertex_normals(surface);
  core::parallel_chunks(radii.size(), 256, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      if (!unexplained(i) || normals[i].isZero()) continue;
      const auto seen =
          seen_radius(tree, surface.points[i], -normals[i], off_the_wall * sizes[i].distance_mm);
      radii[i] = std::min(seen.value_or(sizes[i].distance_mm), sizes[i].distance_mm);
    }
  });
  return radii;
}

}  // namespace ostia::meshing
