#include "axis_beside_calcium.h"

#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ostia::coronary {
namespace {

constexpr int turns = 2;
constexpr double joined_mm = 4.0;      // calcium that is no farther apart is one stretch
constexpr double passage_mm = 3.0;     // from the path's own middle to the boundary's
constexpr double around_mm = 8.0;      // to either side, for the boundary: it learns the lumen's brightness
constexpr double smoothing_mm3 = 2.0;  // lets bends of 3 mm and more through, as the path's own

using Stretch = std::pair<double, double>;

std::vector<Stretch> calcified(const std::vector<double>& s, const segmentation::MinimalPath& path,
                               double fixed_mm) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (path.near_calcium[i] == 0 || s[i] < fixed_mm) continue;
    if (found.empty() || s[i] > found.back().second + joined_mm) found.emplace_back(s[i], s[i]);
    found.back().second = s[i];
  }
  return found;
}

geometry::AxisCurve curve_of(const segmentation::MinimalPath& path) {
  geometry::Centerline line;
  line.points = path.points;
  line.radius = path.radius_mm;
  geometry::complete(line);
  return geometry::AxisCurve(line);
}

/// 1 within the stretch, 0 beyond the passage, smooth between.
double share_at(const Stretch& stretch, double s_mm) {
  const double out = std::max({0.0, stretch.first - s_mm, s_mm - stretch.second});
  const double t = std::clamp(1.0 - out / passage_mm, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Radius of the disc of the same area as a ring about the middle.
double radius_at(const segmentation::LumenBoundary& found, double s_mm) {
  double sum = 0.0;
  for (int a = 0; a < found.around; ++a) {
    const double r = found.at(s_mm, 2.0 * M_PI * a / found.around);
    sum += r * r / found.around;
  }
  return std::sqrt(sum);
}

Vec3 middle_at(const segmentation::LumenBoundary& found, double s_mm) {
  const double x = std::clamp((s_mm - found.from_mm) / found.step_mm, 0.0, found.rows() - 1.0);
  const auto row = std::min(static_cast<std::size_t>(x), found.middle.size() - 2);
  const double t = x - static_cast<double>(row);
  return (1.0 - t) * found.middle[row] + t * found.middle[row + 1];
}

/// Moves the points of one stretch once.
void move_to_middle(const imaging::ImageVolume& image, const Stretch& stretch, double fixed_mm,
                    const AxesOptions& options, segmentation::MinimalPath& path,
                    const core::TaskContext& task) {
  const geometry::AxisCurve axis = curve_of(path);
  segmentation::LumenBoundaryOptions boundary;
  boundary.largest_radius_mm = options.largest_radius_mm;
  boundary.blur_sigma_mm = options.blur_sigma_mm;
  boundary.wall_hu = options.wall_hu;
  const double from = std::max(fixed_mm, stretch.first - around_mm);
  const double to = std::min(axis.length(), stretch.second + around_mm);
  const segmentation::LumenBoundary found =
      segmentation::lumen_boundary(image, axis, from, to, boundary, task.sub(0.0, 0.0));
  const std::vector<double> s = geometry::abscissas(path.points);
  const double scale = axis.length() / s.back();
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double at = s[i] * scale, share = at <= from || at >= to ? 0.0 : share_at(stretch, at);
    if (share <= 0.0) continue;
    path.points[i] = (1.0 - share) * path.points[i] + share * middle_at(found, at);
    path.radius_mm[i] = (1.0 - share) * path.radius_mm[i] + share * std::max(0.1, radius_at(found, at));
  }
}

}  // namespace

void centre_beside_calcium(const imaging::ImageVolume& image, double fixed_mm, const AxesOptions& options,
                           segmentation::MinimalPath& path, const core::TaskContext& task) {
  constexpr double shortest_mm = 2.0;
  std::vector<double> s = geometry::abscissas(path.points);
  if (s.back() < fixed_mm + shortest_mm) return;
  const std::vector<Stretch> stretches = calcified(s, path, fixed_mm);
  for (int turn = 0; turn < turns; ++turn)
    for (const Stretch& stretch : stretches) {
      task.throw_if_cancelled();
      move_to_middle(image, stretch, fixed_mm, options, path, task);
      s = geometry::abscissas(path.points);
      const std::vector<double> weights(s.size(), 1.0);
      const double step = s.back() / static_cast<double>(s.size() - 1);
      std::vector<Vec3> smooth =
          geometry::smoothing_spline(s, path.points, weights, smoothing_mm3 / step, true);
      for (std::size_t i = 0; i < s.size(); ++i) {
        const double share = share_at(stretch, s[i]);
        path.points[i] = (1.0 - share) * path.points[i] + share * smooth[i];
      }
    }
  path.length_mm = geometry::length(path.points);
}

}  // namespace ostia::coronary
