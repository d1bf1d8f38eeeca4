#include "boundary/star_surface.h"

#include "boundary/min_cut.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::segmentation {
namespace {

constexpr float endless = 1e9F;

/// Smallest index that a neighbour may have beside index k.
int lowest_neighbour(const RadiusGrid& grid, int k, double least_radius) {
  const int by_limit = static_cast<int>(std::ceil((least_radius - grid.first_mm) / grid.step_mm - 1e-9));
  return std::max(0, std::min(by_limit, k - 1));
}

/// Arcs of one ray towards one neighbour.
void join(MinCut& graph, std::size_t ray, std::size_t other, const std::vector<int>& lowest, float variation,
          bool forth) {
  const std::size_t count = lowest.size();
  for (std::size_t k = 1; k < count; ++k) {
    const auto target = static_cast<std::size_t>(lowest[k]);
    if (forth && variation > 0.0F) graph.add_arc(ray * count + k, other * count + k, variation, variation);
    if (target > 0) graph.add_arc(ray * count + k, other * count + target, endless, 0.0F);
  }
}

/// How far out on each row the lumen may be expected: the median over its rays of the first place that is
/// not lumen any more, median again along the vessel.
std::vector<double> expected_radius(const RayFan& fan, const std::vector<float>& likeness,
                                    double row_step_mm) {
  std::vector<double> row(static_cast<std::size_t>(fan.rows));
  for (int r = 0; r < fan.rows; ++r) {
    std::vector<double> first;
    for (int a = 0; a < fan.around; ++a) {
      const float* u = likeness.data() + (fan.ray(r, a) - fan.hu.data());
      int i = 0;
      while (i + 1 < fan.count && (u[i] > 0.0F || u[i + 1] > 0.0F)) ++i;
      first.push_back(i * fan.step_mm);
    }
    row[r] = median(first);
  }
  const int reach = std::max(1, static_cast<int>(2.5 / row_step_mm));
  std::vector<double> out(row.size());
  for (int r = 0; r < fan.rows; ++r) {
    const int first = std::max(0, r - reach), last = std::min(fan.rows - 1, r + reach);
    out[r] = median(std::vector<double>(row.begin() + first, row.begin() + last + 1));
  }
  return out;
}

/// What is brighter than `bound` on a ray: where it begins.
int calcium_onset(const RayFan& fan, const float* hu, double lumen_hu, double sigma_hu, double bound_hu) {
  int over = 0;
  while (over < fan.count && hu[over] <= bound_hu) ++over;
  if (over == fan.count) return over;
  int peak = over;
  while (peak + 1 < fan.count && hu[peak + 1] >= hu[peak]) ++peak;
  int half = over;
  while (half > 0 && hu[half - 1] > 0.5 * (lumen_hu + hu[peak])) --half;
  const int dip_reach = static_cast<int>(0.45 / fan.step_mm);
  int dip = half;
  for (int i = half; i >= std::max(0, half - dip_reach); --i)
    if (hu[i] < hu[dip]) dip = i;
  return hu[dip] < lumen_hu - sigma_hu ? dip : half;
}

/// 1 like the lumen, 0 half-way to what is outside, -1 outside or behind the onset of calcium.
std::vector<float> lumen_likeness(const RayFan& fan, const LumenLevel& level, const TissueLevels& tissue,
                                  const std::vector<int>& calcium_onset) {
  std::vector<float> out(fan.hu.size());
  for (int r = 0; r < fan.rows; ++r) {
    const double lumen = level.hu[r], half = std::max(20.0, 0.5 * (lumen - tissue.outside_hu));
    for (int a = 0; a < fan.around; ++a) {
      const int onset = calcium_onset[static_cast<std::size_t>(r) * fan.around + a];
      const auto first = static_cast<std::size_t>(fan.ray(r, a) - fan.hu.data());
      for (int i = 0; i < fan.count; ++i) {
        const double u = i >= onset ? -1.0 : (fan.hu[first + i] - lumen) / half + 1.0;
        out[first + i] = static_cast<float>(std::clamp(u, -1.0, 1.0));
      }
    }
  }
  return out;
}

}  // namespace

std::vector<int> calcium_onsets(const RayFan& fan, const LumenLevel& level, const TissueLevels& tissue) {
  std::vector<int> out;
  for (int r = 0; r < fan.rows; ++r) {
    const double lumen = level.hu[r];
    const double bound = tissue.calcium_hu > 0.0 ? tissue.calcium_hu : lumen + 4.0 * level.sigma_hu;
    for (int a = 0; a < fan.around; ++a)
      out.push_back(calcium_onset(fan, fan.ray(r, a), lumen, level.sigma_hu, bound));
  }
  return out;
}

std::vector<float> region_cost(const RayFan& fan, const LumenLevel& level, const TissueLevels& tissue,
                               const std::vector<int>& calcium_onset, const RadiusGrid& grid,
                               double row_step_mm) {
  const std::vector<float> likeness = lumen_likeness(fan, level, tissue, calcium_onset);
  const std::vector<double> expected = expected_radius(fan, likeness, row_step_mm);
  std::vector<float> cost(static_cast<std::size_t>(fan.rows) * fan.around * grid.count);
  core::parallel_for(static_cast<std::size_t>(fan.rows), 8, [&](std::size_t r) {
    // Behind the wall there may be a chamber or a vein: beyond what the row's median lets expect, looking
    // like lumen earns less and less.
    const double free = 1.25 * expected[r] + 0.2, fade = 0.5 * expected[r] + 0.2;
    for (int a = 0; a < fan.around; ++a) {
      const float* u = likeness.data() + (fan.ray(static_cast<int>(r), a) - fan.hu.data());
      float* out = cost.data() + (r * fan.around + a) * static_cast<std::size_t>(grid.count);
      double sum = 0.0, rho = 0.0;
      const double h = 0.5 * grid.step_mm;
      for (int k = 0; k < grid.count; ++k) {
        for (; rho + 0.5 * h < grid.at(k); rho += h) {
          const double x = std::min((rho + 0.5 * h) / fan.step_mm, fan.count - 1.001);
          const int i = static_cast<int>(x);
          const double here = u[i] + (x - i) * (u[i + 1] - u[i]);
          const double most = 1.0 - 1.2 * std::clamp((rho - free) / fade, 0.0, 1.0);
          sum -= h * std::min(here, most);
        }
        out[k] = static_cast<float>(sum);
      }
    }
  });
  return cost;
}

std::vector<int> least_cost_surface(const std::vector<float>& cost, int rows, int around,
                                    const RadiusGrid& grid, double row_step_mm, const StarLimits& limits,
                                    double variation, const core::TaskContext& task) {
  const std::size_t count = static_cast<std::size_t>(grid.count);
  const std::size_t rays = static_cast<std::size_t>(rows) * static_cast<std::size_t>(around);
  std::vector<int> along(count), across(count);
  const double turn = 1.0 + limits.around * 2.0 * std::numbers::pi / around;
  for (int k = 0; k < grid.count; ++k) {
    along[k] = lowest_neighbour(grid, k, grid.at(k) - limits.along * row_step_mm);
    across[k] = lowest_neighbour(grid, k, grid.at(k) / turn);
  }
  MinCut graph(rays * count);
  graph.reserve_arcs(rays * count * 7);
  const auto weight = static_cast<float>(variation * grid.step_mm);
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const float* c = cost.data() + ray * count;
    graph.add_terminal(ray * count, endless);  // every ray has a boundary
    for (std::size_t k = 1; k < count; ++k) {
      graph.add_terminal(ray * count + k, c[k - 1] - c[k]);
      graph.add_arc(ray * count + k, ray * count + k - 1, endless, 0.0F);
    }
    const std::size_t row = ray / around, a = ray % around;
    const std::size_t next = row * around + (a + 1) % around;
    join(graph, ray, next, across, weight, true);
    join(graph, next, ray, across, weight, false);
    if (row + 1 < static_cast<std::size_t>(rows)) {
      join(graph, ray, ray + around, along, weight, true);
      join(graph, ray + around, ray, along, weight, false);
    }
  }
  graph.solve(task);
  std::vector<int> surface(rays, 0);
  for (std::size_t ray = 0; ray < rays; ++ray) {
    int k = grid.count - 1;
    while (k > 0 && !graph.on_source_side(ray * count + k)) --k;
    surface[ray] = k;
  }
  return surface;
}

}  // namespace ostia::segmentation
