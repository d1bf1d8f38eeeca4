#pragma once
/// \file Values between voxels.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::imaging {

enum class Interpolation {
  nearest,
  trilinear,
  cubic
};  ///< cubic: Catmull-Rom (Keys 1981, a = -1/2), interpolating

/// The value at a world point (LPS, mm); outside the image the border's value (clamped coordinates).
template <class T>
double sample(const Volume<T>& image, const Vec3& world_mm, Interpolation how = Interpolation::trilinear);
/// Gradient of the interpolant, per mm in world axes; exact for the interpolant (so zero for `nearest`, and
/// zero across the border where the coordinate is clamped).
template <class T>
Vec3 sample_gradient(const Volume<T>& image, const Vec3& world_mm,
                     Interpolation how = Interpolation::trilinear);
/// The image on another grid; where the input does not `contain` the point, `outside`. Integers are rounded
/// and clamped to their range. Throws InvalidInput for an empty image, Cancelled.
template <class T>
Volume<T> resampled(const Volume<T>& image, const Geometry& grid, Interpolation how, T outside,
                    const core::TaskContext& task = core::no_task());

#define OSTIA_SAMPLING(T)                                                                  \
  extern template double sample(const Volume<T>&, const Vec3&, Interpolation);             \
  extern template Vec3 sample_gradient(const Volume<T>&, const Vec3&, Interpolation);      \
  extern template Volume<T> resampled(const Volume<T>&, const Geometry&, Interpolation, T, \
                                      const core::TaskContext&);
OSTIA_SAMPLING(std::int16_t)
OSTIA_SAMPLING(std::uint8_t)
OSTIA_SAMPLING(float)
#undef OSTIA_SAMPLING

}  // namespace ostia::imaging
