#include "boundary/ray_fan.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <numbers>

namespace ostia::segmentation {

RayFan sample_rays(const imaging::ImageVolume& image, const std::vector<RayRow>& rows, int around, int count,
                   double step_mm, const core::TaskContext& task) {
  RayFan fan{static_cast<int>(rows.size()), around, count, step_mm, {}};
  const std::size_t per_row = static_cast<std::size_t>(around) * static_cast<std::size_t>(count);
  fan.hu.resize(rows.size() * per_row);
  core::parallel_for(rows.size(), 4, [&](std::size_t n) {
    task.throw_if_cancelled();
    float* out = fan.hu.data() + n * per_row;
    for (int a = 0; a < around; ++a) {
      const double theta = 2.0 * std::numbers::pi * a / around;
      const geometry::Vec3 direction = geometry::radial_direction(rows[n].frame, theta);
      for (int i = 0; i < count; ++i) {
        const geometry::Vec3 place = rows[n].centre + i * step_mm * direction;
        *out++ = static_cast<float>(imaging::sample(image, place, imaging::Interpolation::cubic));
      }
    }
  });
  return fan;
}

}  // namespace ostia::segmentation
