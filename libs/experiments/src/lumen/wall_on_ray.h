#pragma once
/// \file The wall as it is seen along a ray.

#include "ostia/lumen/scalar_field.h"

namespace ostia::experiments {

/// A wall is looked for so far from the axis.
inline constexpr double farthest_wall_mm = 8.0;

/// How far along a ray (a unit direction) the field's first crossing outwards lies; NaN where the ray begins
/// outside or meets none within farthest_wall_mm.
double wall_on_ray(const lumen::ScalarField& wall, const geometry::Vec3& origin,
                   const geometry::Vec3& direction);

}  // namespace ostia::experiments
