#include "ostia/pipeline/mask_walls.h"

#include "mask/mask_sections.h"
#include "mask/mask_vessels.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using std::numbers::pi;

constexpr double scale_limit = 1.3;
constexpr double anywhere_mm = 1e6;
constexpr double outside_mm = 0.8;  // beyond the wall: more than a mask's roughness

std::vector<std::int64_t> object_voxels(const imaging::MaskVolume& mask) {
  std::vector<std::int64_t> voxels;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    if (mask.voxels[n] != 0) voxels.push_back(static_cast<std::int64_t>(n));
  return voxels;
}

/// Voxels of the mask and those within so many voxels of it.
std::vector<std::int64_t> voxels_about(const imaging::MaskVolume& mask, std::int64_t reach) {
  std::vector<std::uint8_t> near(mask.voxels.size(), 0);
  const auto& size = mask.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        if (mask(i, j, k) == 0) continue;
        for (std::int64_t c = std::max<std::int64_t>(0, k - reach); c <= std::min(size[2] - 1, k + reach);
             ++c)
          for (std::int64_t b = std::max<std::int64_t>(0, j - reach); b <= std::min(size[1] - 1, j + reach);
               ++b)
            for (std::int64_t a = std::max<std::int64_t>(0, i - reach); a <= std::min(size[0] - 1, i + reach);
                 ++a)
              near[static_cast<std::size_t>(mask.geometry.offset(a, b, c))] = 1;
      }
  std::vector<std::int64_t> voxels;
  for (std::size_t n = 0; n < near.size(); ++n)
    if (near[n] != 0) voxels.push_back(static_cast<std::int64_t>(n));
  return voxels;
}

/// By which all radii are to be multiplied so that the walls hold as many voxels as the mask.
double volume_scale(const std::vector<MaskVessel>& vessels, const imaging::MaskVolume& mask,
                    std::size_t object, const core::TaskContext& task) {
  const std::vector<std::int64_t> near = voxels_about(mask, 2);
  std::size_t inside = 0;
  for (const Belonging& one : all_belongings(vessels, mask.geometry, near, false, task))
    if (one.beyond_mm < 0.0) ++inside;
  if (inside == 0) return 1.0;
  return std::clamp(std::sqrt(static_cast<double>(object) / static_cast<double>(inside)), 1.0 / scale_limit,
                    scale_limit);
}

/// Parts of the mask beyond all walls, by whether their voxels touch.
std::vector<MaskOutside> outside_walls(const std::vector<MaskVessel>& vessels,
                                       const imaging::MaskVolume& mask,
                                       const std::vector<std::int64_t>& voxels,
                                       const core::TaskContext& task) {
  const imaging::Geometry& grid = mask.geometry;
  std::map<std::int64_t, double> beyond;
  const std::vector<Belonging> all = all_belongings(vessels, grid, voxels, false, task);
  for (std::size_t v = 0; v < voxels.size(); ++v)
    if (all[v].beyond_mm > outside_mm) beyond.emplace(voxels[v], all[v].beyond_mm);
  std::vector<MaskOutside> parts;
  while (!beyond.empty()) {
    MaskOutside part;
    geometry::Box3 box;
    double farthest = 0.0;
    std::vector<std::int64_t> open{beyond.begin()->first};
    const auto take = [&](std::map<std::int64_t, double>::iterator at) {
      const Vec3 place = centre_of_voxel(grid, at->first);
      box.extend(place);
      part.volume_mm3 += grid.spacing.prod();
      if (at->second > farthest) farthest = at->second, part.place = place;
      beyond.erase(at);
    };
    take(beyond.begin());
    while (!open.empty()) {
      const std::int64_t v = open.back();
      open.pop_back();
      for (std::int64_t k = -1; k <= 1; ++k)
        for (std::int64_t j = -1; j <= 1; ++j)
          for (std::int64_t i = -1; i <= 1; ++i) {
            const auto next = beyond.find(v + i + grid.size[0] * (j + grid.size[1] * k));
            if (next == beyond.end()) continue;
            open.push_back(next->first);
            take(next);
          }
    }
    part.length_mm = box.diagonal().norm();
    parts.push_back(part);
  }
  std::ranges::stable_sort(parts, std::greater<>(), &MaskOutside::volume_mm3);
  return parts;
}

}  // namespace

void validate(const MaskWallOptions& options) {
  const auto check = [](double value, double least, double most, const char* name) {
    if (!(value >= least && value <= most))
      throw InvalidInput(std::string("walls of a mask: ") + name + " is " + std::to_string(value) +
                         "; it must be in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
  };
  check(options.even_mm, 0.0, 5.0, "even_mm");
  check(options.voxel_blur, 0.0, 2.0, "voxel_blur");
  check(options.least_radius_mm, 0.05, 2.0, "least_radius_mm");
  check(options.apart_mm, 0.0, 2.0, "apart_mm");
}

MaskWalls walls_from_mask(const geometry::VesselTree& tree, const imaging::MaskVolume& lumen,
                          const MaskWallOptions& options, const core::TaskContext& task) {
  validate(options);
  const std::vector<std::int64_t> voxels = object_voxels(lumen);
  if (voxels.empty()) throw InvalidInput("walls of a mask: the mask is empty");
  if (tree.vessels.empty()) throw InvalidInput("walls of a mask: the tree has no vessels");
  imaging::FloatVolume inside;
  inside.geometry = lumen.geometry;
  for (const std::uint8_t v : lumen.voxels) inside.voxels.push_back(v != 0 ? 1.0F : 0.0F);
  inside = imaging::gaussian_blurred(inside, options.voxel_blur * lumen.geometry.spacing.maxCoeff(),
                                     task.sub(0.0, 0.1));
  std::vector<MaskVessel> vessels = mask_vessels(tree);
  std::vector<std::vector<SeenRing>> seen(vessels.size());
  core::parallel_for(vessels.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    seen[i] = seen_rings(vessels[i], inside);
  });
  task.set_progress(0.3);
  take_areas(vessels, seen, lumen, voxels, anywhere_mm, options, task);
  // Once more with walls that are about right: which vessel a voxel belongs to depends on them, and whether
  // it is a vessel's at all.
  take_areas(vessels, seen, lumen, voxels, outside_mm, options, task);
  for (std::size_t i = 0; i < vessels.size(); ++i) take_shapes(vessels[i], seen[i], options);
  task.set_progress(0.7);
  part_walls(vessels, tree, options.apart_mm, task);
  task.set_progress(0.85);
  const double scale = volume_scale(vessels, lumen, voxels.size(), task);
  for (MaskVessel& vessel : vessels)
    for (double& area : vessel.area_mm2) area *= scale * scale;
  task.set_progress(0.9);
  MaskWalls result;
  result.outside = outside_walls(vessels, lumen, voxels, task);
  for (MaskVessel& vessel : vessels) {
    const auto kept = std::make_shared<const MaskVessel>(std::move(vessel));
    result.walls.emplace_back([kept](double s_mm, double theta) { return kept->radius(s_mm, theta); });
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::pipeline
