#pragma once
/// \file An image along a plane.

#include "ostia/core/task_context.h"
#include "ostia/imaging/sampling.h"
#include "ostia/reformat/plane.h"

#include <vector>

namespace ostia::reformat {

/// Values at the centres of a plane's pixels, rows from the top, in the image's unit (HU). Pixels outside the
/// image are NaN.
struct PlaneImage {
  Plane plane;
  std::vector<float> values;
  float operator()(int column, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(plane.width) +
                  static_cast<std::size_t>(column)];
  }
};

/// The image along a plane. Throws InvalidInput for an invalid plane or an empty image.
PlaneImage slice(const imaging::ImageVolume& image, const Plane& plane,
                 imaging::Interpolation how = imaging::Interpolation::trilinear,
                 const core::TaskContext& task = core::no_task());
PlaneImage slice(const imaging::MaskVolume& image, const Plane& plane,
                 imaging::Interpolation how = imaging::Interpolation::nearest,
                 const core::TaskContext& task = core::no_task());
PlaneImage slice(const imaging::FloatVolume& image, const Plane& plane,
                 imaging::Interpolation how = imaging::Interpolation::trilinear,
                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::reformat
