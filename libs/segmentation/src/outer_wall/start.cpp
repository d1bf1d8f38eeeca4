#include "outer_wall/start.h"

#include "boundary/lumen_level.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation {
namespace {

constexpr double start_variation = 0.12;  // total variation against the region's cost, both in mm
constexpr double run_mm = 0.4;            // of darkness on a ray that counts as fat
constexpr double surely_fat_hu = -20.0;   // darker than any wall
constexpr double usual_mm = 0.5;          // of a healthy wall
constexpr float forbidden = 100.0F;       // of a border within the lumen, for each candidate too far in

/// The ray without what the lumen's blur adds to it.
std::vector<double> without_lumen(const WallScene& scene, const BlurredDiscs& discs, int row, int a,
                                  double wall_hu) {
  const float* hu = scene.fan.ray(row, a);
  const double lumen = scene.lumen_mm[static_cast<std::size_t>(row) * scene.fan.around + a];
  std::vector<double> out(static_cast<std::size_t>(scene.fan.count));
  for (int i = 0; i < scene.fan.count; ++i)
    out[i] = hu[i] - (scene.lumen_hu[row] - wall_hu) * discs.at(lumen, i);
  return out;
}

/// Where the ray falls below a level for a while, beyond `from`; negative where it does not up to `to`.
double first_fall(const std::vector<double>& hu, double step_mm, double from_mm, double to_mm, double level) {
  const int n = static_cast<int>(hu.size());
  const int run = std::max(1, static_cast<int>(std::lround(run_mm / step_mm)));
  const int last = std::min(n - run - 1, static_cast<int>(to_mm / step_mm));
  for (int i = std::max(1, static_cast<int>(std::ceil(from_mm / step_mm))); i <= last; ++i) {
    double sum = 0.0;
    for (int j = 0; j <= run; ++j) sum += hu[i + j] / (run + 1);
    if (hu[i] < level && sum < level) return i * step_mm;
  }
  return -1.0;
}

/// Along the vessel, over what is positive within a reach; 0 where nothing is.
std::vector<double> medians_along(const std::vector<double>& rows, int reach) {
  std::vector<double> out(rows.size());
  const int n = static_cast<int>(rows.size());
  for (int r = 0; r < n; ++r) {
    std::vector<double> near;
    for (int i = std::max(0, r - reach); i <= std::min(n - 1, r + reach); ++i)
      if (rows[i] != 0.0) near.push_back(rows[i]);
    out[r] = median(near);
  }
  return out;
}

/// First falls of all rays, and how far out the border may be expected on each row.
struct Falls {
  std::vector<double> place_mm, expected_mm;
};

Falls falls_of(const WallScene& scene, const std::vector<std::vector<double>>& rays,
               const OuterWallOptions& options) {
  const RayFan& fan = scene.fan;
  Falls out;
  std::vector<double> row(static_cast<std::size_t>(fan.rows), 0.0);
  for (int r = 0; r < fan.rows; ++r) {
    const double level = 0.5 * (options.wall_hu + scene.fat_hu[r]);
    std::vector<double> seen;
    double mean = 0.0;
    for (int a = 0; a < fan.around; ++a) {
      const std::size_t n = static_cast<std::size_t>(r) * fan.around + a;
      const double lumen = scene.lumen_mm[n];
      const double place = first_fall(rays[n], fan.step_mm, lumen + options.least_thickness_mm,
                                      lumen + options.largest_thickness_mm, level);
      out.place_mm.push_back(place);
      if (place > 0.0) seen.push_back(place);
      mean += lumen / fan.around;
    }
    if (static_cast<int>(seen.size()) * 5 < fan.around) continue;
    const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() * 6 / 10);
    std::nth_element(seen.begin(), middle, seen.end());
    row[r] = std::max(*middle, mean + options.least_thickness_mm);
  }
  out.expected_mm = medians_along(row, std::max(1, static_cast<int>(std::lround(2.5 / scene.row_step_mm))));
  return out;
}

}  // namespace

std::vector<double> fat_levels(const WallScene& scene, double usual_hu) {
  const RayFan& fan = scene.fan;
  std::vector<double> row(static_cast<std::size_t>(fan.rows), 0.0);
  for (int r = 0; r < fan.rows; ++r) {
    std::vector<double> dark;
    int all = 0;
    for (int a = 0; a < fan.around; ++a) {
      const double from = scene.lumen_mm[static_cast<std::size_t>(r) * fan.around + a] + 1.0;
      for (int i = static_cast<int>(from / fan.step_mm); i < fan.count; ++i, ++all)
        if (fan.ray(r, a)[i] < surely_fat_hu) dark.push_back(fan.ray(r, a)[i]);
    }
    if (static_cast<int>(dark.size()) * 20 > all) row[r] = median(dark);
  }
  std::vector<double> out =
      medians_along(row, std::max(1, static_cast<int>(std::lround(5.0 / scene.row_step_mm))));
  for (double& hu : out) hu = hu == 0.0 ? usual_hu : std::clamp(hu, -200.0, -40.0);
  return out;
}

WallStart first_outer_wall(const WallScene& scene, const BlurredDiscs& discs, const RadiusGrid& grid,
                           const OuterWallOptions& options, const core::TaskContext& task) {
  const RayFan& fan = scene.fan;
  std::vector<std::vector<double>> rays(scene.lumen_mm.size());
  core::parallel_for(static_cast<std::size_t>(fan.rows), 8, [&](std::size_t r) {
    for (int a = 0; a < fan.around; ++a)
      rays[r * fan.around + a] = without_lumen(scene, discs, static_cast<int>(r), a, options.wall_hu);
  });
  const Falls falls = falls_of(scene, rays, options);
  WallStart out;
  out.seen.resize(rays.size());
  std::vector<float> cost(rays.size() * static_cast<std::size_t>(grid.count));
  for (std::size_t n = 0; n < rays.size(); ++n) {
    const std::size_t r = n / fan.around;
    const double lumen = scene.lumen_mm[n], fall = falls.place_mm[n];
    const double middle = 0.5 * (options.wall_hu + scene.fat_hu[r]);
    const double half = std::max(20.0, options.wall_hu - middle);
    const double expected = std::max(falls.expected_mm[r], lumen + usual_mm);
    const double free = 1.25 * expected + 0.3, fade = 0.5 * expected + 0.2;
    const bool seen = fall > 0.0 && fall < free + 0.5 * fade;
    out.seen[n] = seen ? 1 : 0;
    double sum = 0.0;
    for (int k = 0; k < grid.count; ++k) {
      const double rho = grid.at(k) - 0.5 * grid.step_mm,
                   most = 1.0 - 1.2 * std::clamp((rho - free) / fade, 0.0, 1.0);
      const int i = std::clamp(static_cast<int>(std::lround(rho / fan.step_mm)), 0, fan.count - 1);
      double u = std::clamp((rays[n][i] - middle) / half, -1.0, 1.0);
      if (seen && rho > fall + run_mm) u = -1.0;
      if (!seen) u = rho < lumen + 0.5 * usual_mm ? 0.5 : 0.0;
      sum -= grid.step_mm * std::min(u, most);
      float& c = cost[n * grid.count + k];
      c = static_cast<float>(sum);
      const double missing = lumen + options.least_thickness_mm - grid.at(k);
      if (missing > 1e-9) c += forbidden * static_cast<float>(std::ceil(missing / grid.step_mm));
    }
  }
  const std::vector<int> surface =
      least_cost_surface(cost, fan.rows, fan.around, grid, scene.row_step_mm,
                         {options.largest_slope_along, options.largest_slope_around}, start_variation, task);
  for (std::size_t n = 0; n < surface.size(); ++n)
    out.radius_mm.push_back(std::max(grid.at(surface[n]), scene.lumen_mm[n] + options.least_thickness_mm));
  return out;
}

}  // namespace ostia::segmentation
