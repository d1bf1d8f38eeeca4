#include "lumen/wall_on_ray.h"

#include "ostia/geometry/zero_crossing.h"

#include <limits>

namespace ostia::experiments {

double wall_on_ray(const lumen::ScalarField& wall, const geometry::Vec3& origin,
                   const geometry::Vec3& direction) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN(), step = 0.2;
  if (wall.value(origin) >= 0.0) return nowhere;
  for (double rho = step; rho <= farthest_wall_mm; rho += step) {
    if (wall.value(origin + rho * direction) < 0.0) continue;
    const double t = geometry::zero_crossing(
        [&](double u) { return wall.value(origin + (rho - step + u * step) * direction); },
        {.value = 1e-4, .bracket = 1e-4, .most_iterations = 30});
    return rho - step + t * step;
  }
  return nowhere;
}

}  // namespace ostia::experiments
