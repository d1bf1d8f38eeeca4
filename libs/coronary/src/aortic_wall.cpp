#include "aortic_wall.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::coronary {
namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// Stations at equal steps, the centres and the radii smoothed along.
std::vector<AortaStation> even_stations(const Aorta& aorta, double step_mm, double length_mm) {
  constexpr double sigma_mm = 3.0;
  std::vector<double> at{0.0};
  for (std::size_t i = 1; i < aorta.stations.size(); ++i)
    at.push_back(at.back() + (aorta.stations[i].centre - aorta.stations[i - 1].centre).norm());
  std::vector<AortaStation> even;
  for (double s = 0.0; s <= std::min(length_mm, at.back()); s += step_mm) {
    // A line fitted about the place with weights: no shift at the ends.
    double w0 = 0.0, w1 = 0.0, w2 = 0.0;
    Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero();
    double r0 = 0.0, r1 = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double d = at[i] - s, w = std::exp(-0.5 * d * d / (sigma_mm * sigma_mm));
      w0 += w, w1 += w * d, w2 += w * d * d;
      p0 += w * aorta.stations[i].centre, p1 += w * d * aorta.stations[i].centre;
      r0 += w * aorta.stations[i].radius_mm, r1 += w * d * aorta.stations[i].radius_mm;
    }
    const double determinant = w0 * w2 - w1 * w1;
    AortaStation station;
    station.centre = (w2 * p0 - w1 * p1) / determinant;
    station.tangent = ((w0 * p1 - w1 * p0) / determinant).normalized();
    station.radius_mm = (w2 * r0 - w1 * r1) / determinant;
    even.push_back(station);
  }
  return even;
}

double fall_on_ray(const imaging::ImageVolume& image, const Vec3& centre, const Vec3& out, double radius_mm,
                   double level) {
  constexpr double step_mm = 0.25, stay_mm = 0.75;
  double low_from = nowhere;
  for (double r = 0.4 * radius_mm; r < 1.6 * radius_mm; r += step_mm) {
    const Vec3 at = centre + r * out;
    if (!image.geometry.contains(at)) return nowhere;
    if (imaging::sample(image, at) >= level) {
      low_from = nowhere;
      continue;
    }
    if (std::isnan(low_from)) low_from = r - 0.5 * step_mm;
    if (r - low_from > stay_mm) return low_from;
  }
  return nowhere;
}

}  // namespace

double AorticWall::angle(std::size_t a) const {
  return 2.0 * std::numbers::pi * static_cast<double>(a) / static_cast<double>(angles);
}

Vec3 AorticWall::place(std::size_t station, std::size_t a, double beyond_mm) const {
  return centres[station] +
         (radius(station, a) + beyond_mm) * geometry::radial_direction(frames[station], angle(a));
}

AorticWall aortic_wall(const imaging::ImageVolume& image, const Aorta& aorta,
                       const AorticWallOptions& options) {
  AorticWall wall;
  wall.angles = options.angles;
  const std::vector<AortaStation> stations = even_stations(aorta, wall.step_mm, options.upwards_mm);
  std::vector<Vec3> tangents;
  for (const AortaStation& station : stations) {
    wall.centres.push_back(station.centre);
    tangents.push_back(station.tangent);
  }
  wall.frames = geometry::rotation_minimising_frames(wall.centres, tangents,
                                                     geometry::initial_normal(tangents.front()));
  const double level = options.wall_hu + 0.5 * (aorta.lumen_hu - options.wall_hu);
  const std::size_t count = stations.size();
  std::vector<double> raw(count * wall.angles);
  core::parallel_for(count, 1, [&](std::size_t s) {
    for (std::size_t a = 0; a < wall.angles; ++a)
      raw[s * wall.angles + a] =
          fall_on_ray(image, wall.centres[s], geometry::radial_direction(wall.frames[s], wall.angle(a)),
                      stations[s].radius_mm, level);
  });
  wall.radius_mm.resize(raw.size());
  const auto along = static_cast<std::ptrdiff_t>(std::lround(options.window_mm / wall.step_mm));
  const auto about = static_cast<std::ptrdiff_t>(
      std::lround(options.window_rad / (2.0 * std::numbers::pi) * static_cast<double>(wall.angles)));
  core::parallel_for(count, 1, [&](std::size_t s) {
    std::vector<double> near;
    for (std::size_t a = 0; a < wall.angles; ++a) {
      near.clear();
      const auto row = static_cast<std::ptrdiff_t>(s), rows = static_cast<std::ptrdiff_t>(count);
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, row - along); i <= std::min(rows - 1, row + along);
           ++i)
        for (std::ptrdiff_t j = -about; j <= about; ++j) {
          const auto turn = static_cast<std::ptrdiff_t>(wall.angles);
          const auto b = (static_cast<std::ptrdiff_t>(a) + j + turn) % turn;
          const double value = raw[static_cast<std::size_t>(i * turn + b)];
          if (!std::isnan(value)) near.push_back(value);
        }
      double& radius = wall.radius_mm[s * wall.angles + a];
      radius = stations[s].radius_mm;
      if (near.empty()) continue;
      const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
      std::nth_element(near.begin(), middle, near.end());
      radius = *middle;
    }
  });
  return wall;
}

}  // namespace ostia::coronary
