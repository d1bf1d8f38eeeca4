#include "ostia/figure/plot.h"
#include "ostia/figure/slice_figure.h"

#include <array>
#include <cmath>
#include <optional>

namespace ostia::figure {
namespace {

constexpr double kAlongAxis = 0.9999985;  // cos of 0.1 degree

/// The world axis that a picture axis runs along, if any.
std::optional<int> world_axis(const Vec3& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) >= kAlongAxis) return axis;
  }
  return std::nullopt;
}

Ruler ruler(const reformat::Plane& plane, const Vec3& direction, int pixels, int about_ticks) {
  reformat::validate(plane);
  const auto axis = world_axis(direction);
  const double length = pixels * plane.pixel_mm;
  double start = -0.5 * length;  // value at the picture's edge, and the value's change per mm along the axis
  double sense = 1.0;
  Ruler result;
  if (axis) {
    static constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
    sense = direction[*axis] > 0.0 ? 1.0 : -1.0;
    start = plane.origin[*axis];
    result.label = std::string(kNames[static_cast<std::size_t>(*axis)]) + " (mm)";
  } else {
    result.label = "mm from the centre";
  }
  const double low = std::min(start, start + sense * length);
  const double high = low + length;
  const std::vector<double> major = nice_ticks(low, high, about_ticks);
  if (major.size() < 2) return result;
  const double step = major[1] - major[0];
  constexpr int kMinor = 5;
  const auto first = static_cast<long>(std::ceil(low / step * kMinor - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step * kMinor + 1e-9));
  for (long i = first; i <= last; ++i) {
    const double value = static_cast<double>(i) * step / kMinor;
    result.ticks.push_back({sense * (value - start) / plane.pixel_mm, value, i % kMinor == 0});
  }
  return result;
}

}  // namespace

Ruler horizontal_ruler(const reformat::Plane& plane, int about_ticks) {
  return ruler(plane, plane.u, plane.width, about_ticks);
}

Ruler vertical_ruler(const reformat::Plane& plane, int about_ticks) {
  return ruler(plane, plane.v, plane.height, about_ticks);
}

}  // namespace ostia::figure
