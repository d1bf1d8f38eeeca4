#pragma once
/// \file An image sampled on rays across an axis.

#include "ostia/core/task_context.h"
#include "ostia/geometry/frame.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::segmentation {

/// A plane across the vessel from whose centre rays go out.
struct RayRow {
  double s_mm = 0.0;
  geometry::Vec3 centre = geometry::Vec3::Zero();
  geometry::Frame frame;
};

/// HU at rho = i step, i = 0 ... count - 1, ray by ray, row by row.
struct RayFan {
  int rows = 0, around = 0, count = 0;
  double step_mm = 0.0;
  std::vector<float> hu;
  const float* ray(int row, int a) const {
    return hu.data() + (static_cast<std::size_t>(row) * around + a) * static_cast<std::size_t>(count);
  }
};

/// Cubic interpolation: trilinear would widen the point spread by a tenth.
RayFan sample_rays(const imaging::ImageVolume& image, const std::vector<RayRow>& rows, int around, int count,
                   double step_mm, const core::TaskContext& task);

}  // namespace ostia::segmentation
