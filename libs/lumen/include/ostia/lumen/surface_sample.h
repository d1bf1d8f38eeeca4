#pragma once
/// \file Places on a vessel's wall: what an implicit surface interpolates and what an edit replaces.

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/vec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::lumen {

using geometry::Vec3;

/// Where a sample comes from. Samples of the cap close the surface beyond a vessel's ends.
enum class SampleOrigin : std::uint8_t { start = 0, cap = 1, edit = 2 };

/// A place on the wall with the outward direction there. Ids are unique in a model and never used again.
struct SurfaceSample {
  std::int64_t id = 0;
  Vec3 position = Vec3::Zero();  ///< mm, LPS
  Vec3 normal = Vec3::UnitX();   ///< unit, out of the lumen
  double s_mm = 0.0;             ///< abscissa of its foot on the vessel's axis, chosen when it was made
  SampleOrigin origin = SampleOrigin::start;
};

/// By abscissa, then by id: the order in which a vessel's samples are stored and solved.
bool canonical_order(const SurfaceSample& a, const SurfaceSample& b);

}  // namespace ostia::lumen
