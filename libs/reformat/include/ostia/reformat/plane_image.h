#pragma once
/// \file An image along a plane.

#include "ostia/core/task_context.h"
#include "ostia/imaging/sampling.h"
#include "ostia/reformat/plane.h"
#include "ostia/reformat/slab.h"

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
/// The image in a layer about a plane: the mean, maximum or minimum over the middles of equal layers no
/// thicker than half the image's finest spacing, in all `slab_mm` thick, half on either side of the plane;
/// layers outside the image do not count. Throws InvalidInput as `slice` does, and for a slab not in (0, 100]
/// mm.
PlaneImage slab_slice(const imaging::ImageVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      imaging::Interpolation how = imaging::Interpolation::trilinear,
                      const core::TaskContext& task = core::no_task());
PlaneImage slab_slice(const imaging::FloatVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      imaging::Interpolation how = imaging::Interpolation::trilinear,
                      const core::TaskContext& task = core::no_task());

/// The same seen coarsely, for a picture that moves: every second pixel each way of layers twice as thick, an
/// eighth of the work, and linear between. Shows what slab_slice does but for details of a pixel. Throws as
/// it does.
PlaneImage slab_draft(const imaging::ImageVolume& image, const Plane& plane, Slab slab, double slab_mm,
                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::reformat
