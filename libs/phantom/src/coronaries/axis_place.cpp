#include "coronaries/axis_place.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::phantom {

AxisPlace place_at(const geometry::Centerline& axis, double s_mm) {
  if (axis.size() < 2 || axis.frames.size() != axis.size() || axis.abscissa.size() != axis.size())
    throw InvalidInput("the axis of a vessel needs two points, abscissas and frames");
  const double s = std::clamp(s_mm, 0.0, axis.abscissa.back());
  const auto after = std::upper_bound(axis.abscissa.begin(), axis.abscissa.end(), s);
  const auto i =
      std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - axis.abscissa.begin())),
               axis.size() - 1) -
      1;
  const double t = (s - axis.abscissa[i]) / (axis.abscissa[i + 1] - axis.abscissa[i]);
  AxisPlace place;
  place.point = (1.0 - t) * axis.points[i] + t * axis.points[i + 1];
  place.frame = geometry::interpolated(axis.frames[i], axis.frames[i + 1], t);
  place.radius_mm = (1.0 - t) * axis.radius[i] + t * axis.radius[i + 1];
  return place;
}

}  // namespace ostia::phantom
