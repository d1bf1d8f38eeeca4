#include "ostia/segmentation/outer_wall.h"

#include "boundary/boundary_fit.h"
#include "boundary/boundary_rows.h"
#include "boundary/lumen_level.h"
#include "boundary/ray_fan.h"
#include "option_range.h"
#include "outer_wall/profile.h"
#include "outer_wall/start.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace ostia::segmentation {
namespace {

using geometry::Vec3;

constexpr double most_wall_nodes = 1e7;  // of the graph, some 200 bytes each
constexpr double fan_step_mm = 0.2;      // of the rays' samples; grows with the blur
constexpr double first_core_mm = 0.4;    // the first look at the lumen's brightness
constexpr double least_lumen_mm = 0.1;
constexpr double smooth_mm = 1.0;  // of the lumen's middle, along the vessel

/// The lumen's rows with rays from its middle.
struct WallRows {
  std::vector<RayRow> row;
  std::vector<Vec2> offset;      // of the middle from the axis
  std::vector<double> lumen_mm;  // from there
  std::vector<char> sound;       // the axis lies in the lumen and in the image
};

void check(const imaging::ImageVolume& image, const geometry::AxisCurve& axis, const LumenBoundary& lumen) {
  if (image.voxels.empty()) throw InvalidInput("outer wall: the image is empty");
  const int rows = lumen.rows();
  if (rows < 2 || lumen.around < 8 || !(lumen.step_mm > 0.0) ||
      lumen.radius_mm.size() != static_cast<std::size_t>(rows) * lumen.around)
    throw InvalidInput("outer wall: the lumen's boundary needs two rows of at least 8 rays");
  if (lumen.from_mm < -1e-6 || lumen.from_mm + (rows - 1) * lumen.step_mm > axis.length() + 1e-6)
    throw InvalidInput("outer wall: the lumen's boundary reaches beyond its axis");
  for (const double radius : lumen.radius_mm)
    if (!(radius > 0.0) || !std::isfinite(radius))
      throw InvalidInput("outer wall: a radius of the lumen is not positive and finite");
}

WallRows rows_of(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                 const LumenBoundary& lumen) {
  const int n = lumen.rows(), around = lumen.around;
  std::vector<Vec2> middle(static_cast<std::size_t>(n));
  for (int r = 0; r < n; ++r)
    middle[r] = centroid_of(lumen.radius_mm.data() + static_cast<std::size_t>(r) * around, around);
  const int reach = std::max(1, static_cast<int>(std::lround(smooth_mm / lumen.step_mm)));
  WallRows rows;
  for (int r = 0; r < n; ++r) {
    Vec2 sum = Vec2::Zero();
    const int half = std::min({reach, r, n - 1 - r});
    for (int i = r - half; i <= r + half; ++i) sum += middle[i] / (2 * half + 1);
    const double s = std::min(lumen.from_mm + r * lumen.step_mm, axis.length());
    RayRow row{s, axis.point(s), axis.frame(s)};
    const bool inside = image.geometry.contains(row.centre);
    row.centre += sum.x() * geometry::radial_direction(row.frame, 0.0) +
                  sum.y() * geometry::radial_direction(row.frame, 0.5 * std::numbers::pi);
    const SeenLine seen =
        seen_from(lumen.radius_mm.data() + static_cast<std::size_t>(r) * around, around, sum, least_lumen_mm);
    rows.row.push_back(row);
    rows.offset.push_back(sum);
    rows.lumen_mm.insert(rows.lumen_mm.end(), seen.radius_mm.begin(), seen.radius_mm.end());
    rows.sound.push_back(inside && seen.inside ? 1 : 0);
  }
  return rows;
}

RadiusGrid grid_for(const WallRows& rows, int around, const OuterWallOptions& options) {
  RadiusGrid grid{0.2, options.radial_step_mm, 0};
  const double largest = *std::max_element(rows.lumen_mm.begin(), rows.lumen_mm.end());
  grid.count = 1 + static_cast<int>(
                       std::ceil((largest + options.largest_thickness_mm - grid.first_mm) / grid.step_mm));
  const double nodes = static_cast<double>(rows.row.size()) * around * grid.count;
  if (nodes <= most_wall_nodes) return grid;
  char text[200];
  std::snprintf(text, sizeof text,
                "outer wall: %.3g candidates are more than %.3g; make radial_step_mm larger or "
                "largest_thickness_mm smaller, or go by shorter stretches",
                nodes, most_wall_nodes);
  throw InvalidInput(text);
}

/// The model of the blurred wall on each ray, twice: about the start, then about what came of it.
BoundaryFit fitted(const WallScene& scene, const WallStart& start, const WallProfile& profile,
                   const RadiusGrid& grid, const core::TaskContext& task) {
  BoundaryFitOptions how;
  how.row_step_mm = scene.row_step_mm;
  BoundaryFit fit{start.radius_mm, {}};
  const RayFan& fan = scene.fan;
  for (int round = 0; round < 2; ++round) {
    std::vector<RayEnergy> energy(fit.radius_mm.size());
    core::parallel_for(static_cast<std::size_t>(fan.rows), 4, [&](std::size_t r) {
      task.throw_if_cancelled();
      for (int a = 0; a < fan.around; ++a) {
        const std::size_t n = r * fan.around + a;
        const WallRay ray{fan.ray(static_cast<int>(r), a), fan.count, scene.lumen_mm[n], scene.lumen_hu[r],
                          scene.fat_hu[r]};
        energy[n] =
            start.seen[n] ? profile.energy(ray, fit.radius_mm[n]) : profile.no_energy(ray, fit.radius_mm[n]);
      }
    });
    fit = fit_boundary(energy, grid, fan.rows, fan.around, fit.radius_mm, how, task);
    task.set_progress(0.7 + 0.3 * round);
  }
  return fit;
}

/// The wall seen from the axis again, outside the lumen everywhere.
void put_on_axis(const WallRows& rows, const BoundaryFit& fit, const LumenBoundary& lumen,
                 const OuterWallOptions& options, LumenBoundary& out) {
  const int around = lumen.around;
  for (std::size_t r = 0; r < rows.row.size(); ++r) {
    const std::size_t ring = r * around;
    const SeenLine seen = seen_from(fit.radius_mm.data() + ring, around, -rows.offset[r], least_lumen_mm);
    for (int a = 0; a < around; ++a) {
      const int nearest = static_cast<int>(std::lround(seen.index[a])) % around;
      out.radius_mm.push_back(std::max(seen.radius_mm[a], lumen.radius_mm[ring + a]));
      out.confidence.push_back(rows.sound[r] && seen.inside ? fit.confidence[ring + nearest] : 0.0F);
    }
  }
  hold_limits(out.radius_mm, lumen.rows(), around, options.largest_slope_along * lumen.step_mm,
              options.largest_slope_around * 2.0 * std::numbers::pi / around);
  for (std::size_t n = 0; n < out.radius_mm.size(); ++n)
    out.radius_mm[n] = std::max(out.radius_mm[n], lumen.radius_mm[n] + options.least_thickness_mm);
}

void add_warnings(OuterWall& out) {
  char text[200];
  if (out.seen_share < 0.5) {
    std::snprintf(text, sizeof text,
                  "fat is seen beyond the wall on %.0f %% of the rays: elsewhere the outer wall is a bridge",
                  100.0 * out.seen_share);
    out.surface.warnings.emplace_back(text);
  }
}

}  // namespace

void validate(const OuterWallOptions& o) {
  const auto require = [](const char* name, double value, double low, double high, const char* range) {
    detail::require_range("outer wall", name, value, low, high, range);
  };
  require("radial_step_mm", o.radial_step_mm, 0.02, 0.5, "[0.02, 0.5] mm");
  require("least_thickness_mm", o.least_thickness_mm, 0.0, 1.0, "[0, 1] mm");
  require("largest_thickness_mm", o.largest_thickness_mm, 0.5, 6.0, "[0.5, 6] mm");
  require("blur_sigma_mm", o.blur_sigma_mm, 0.0, 1.5, "[0, 1.5] mm");
  require("wall_hu", o.wall_hu, -20.0, 200.0, "[-20, 200] HU");
  require("fat_hu", o.fat_hu, -200.0, -40.0, "[-200, -40] HU");
  require("largest_slope_along", o.largest_slope_along, 0.05, 10.0, "[0.05, 10]");
  require("largest_slope_around", o.largest_slope_around, 0.05, 10.0, "[0.05, 10]");
}

OuterWall outer_wall(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                     const LumenBoundary& lumen, const OuterWallOptions& options,
                     const core::TaskContext& task) {
  validate(options);
  check(image, axis, lumen);
  task.set_stage("outer wall");
  task.throw_if_cancelled();
  const WallRows rows = rows_of(image, axis, lumen);
  const RadiusGrid grid = grid_for(rows, lumen.around, options);
  const double blur = std::max(0.05, options.blur_sigma_mm), coarser = std::max(1.0, blur / 0.3);
  const double step = fan_step_mm * coarser, reach = grid.at(grid.count) + 2.5 * coarser;
  WallScene scene;
  scene.row_step_mm = lumen.step_mm;
  scene.lumen_mm = rows.lumen_mm;
  scene.fan = sample_rays(image, rows.row, lumen.around, static_cast<int>(reach / step) + 1, step, task);
  const LumenLevel level = lumen_level(scene.fan, scene.lumen_mm, {blur, options.wall_hu}, lumen.step_mm,
                                       lumen_level(scene.fan, first_core_mm, lumen.step_mm));
  scene.lumen_hu = level.hu;
  scene.fat_hu = fat_levels(scene, options.fat_hu);
  task.set_progress(0.2);
  const BlurredDiscs discs(grid.at(grid.count), reach, step, blur);
  WallStart start = first_outer_wall(scene, discs, grid, options, task);
  for (std::size_t n = 0; n < start.seen.size(); ++n)
    if (!rows.sound[n / lumen.around]) start.seen[n] = 0;
  task.set_progress(0.5);
  const RadiusGrid fine{grid.first_mm, 0.05 * coarser,
                        1 + static_cast<int>((grid.at(grid.count) - grid.first_mm) / (0.05 * coarser))};
  const WallProfile profile({blur, level.sigma_hu, options.wall_hu, options.least_thickness_mm, step, fine});
  const BoundaryFit fit = fitted(scene, start, profile, fine, task);

  OuterWall out;
  out.surface.from_mm = lumen.from_mm;
  out.surface.step_mm = lumen.step_mm;
  out.surface.around = lumen.around;
  out.surface.lumen_hu = level.typical_hu;
  out.surface.lumen_sigma_hu = level.sigma_hu;
  out.lumen_hu = scene.lumen_hu;
  out.fat_hu = scene.fat_hu;
  put_on_axis(rows, fit, lumen, options, out.surface);
  out.seen_share = static_cast<double>(std::count(start.seen.begin(), start.seen.end(), char{1})) /
                   static_cast<double>(start.seen.size());
  add_warnings(out);
  return out;
}

}  // namespace ostia::segmentation
