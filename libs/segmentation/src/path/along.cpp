#include "fronts/fast_marching.h"
#include "path/finish.h"
#include "path/front.h"
#include "path/target.h"
#include "range_about_seeds.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/segmentation/minimal_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::segmentation {
namespace {

using detail::LumenLevels;
using detail::TubeSpeed;
using detail::Voxel;
using detail::worded;

constexpr double kAirAlongHu = -500.0;
constexpr double kStationMm = 1.0;
constexpr std::size_t kSurroundings = 6;  // places about which tissue is looked at
constexpr double kShortestMm = 1.0;

void check_line(const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                const PathAlongOptions& options) {
  validate(options);
  if (rough.size() < 2)
    throw InvalidInput("a way along a line needs a line of two points or more, this one has " +
                       std::to_string(rough.size()));
  for (std::size_t i = 0; i < rough.size(); ++i)
    detail::require_inside(image, rough[i], "point " + std::to_string(i + 1) + " of the line,");
  const double length = geometry::length(rough);
  const double free = length - options.fixed_start_mm - options.fixed_end_mm;
  if (!(free >= kShortestMm)) {
    throw InvalidInput(
        worded("a way along a line of %.1f mm of which %.1f mm are fixed; leave %.0f mm or more free", length,
               options.fixed_start_mm + options.fixed_end_mm, kShortestMm));
  }
}

/// The brighter half of the places tells what lumen is: the line may cut corners.
LumenLevels levels_along(const imaging::ImageVolume& image, const std::vector<Vec3>& rough) {
  const std::vector<Vec3> places = geometry::resample(rough, kStationMm);
  TubeSpeed looking(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<detail::BrightVoxel> bright;
  for (const Vec3& place : places) bright.push_back(detail::brightest_about(looking, place));
  std::stable_sort(bright.begin(), bright.end(),
                   [](const detail::BrightVoxel& a, const detail::BrightVoxel& b) { return a.hu > b.hu; });
  if (bright.front().hu < kAirAlongHu)
    throw InvalidInput("the line lies in air: draw it along the contrast-filled lumen");
  std::vector<Vec3> lumen, around;
  for (std::size_t i = 0; i < (bright.size() + 1) / 2; ++i) lumen.push_back(bright[i].place);
  const std::size_t each = std::max<std::size_t>(1, places.size() / kSurroundings);
  for (std::size_t i = each / 2; i < places.size(); i += each) around.push_back(places[i]);
  return detail::levels_from(image, lumen, around);
}

/// Voxels within a distance of a line.
detail::BlockGrid<std::uint8_t> corridor_about(const imaging::Geometry& grid, const std::vector<Vec3>& line,
                                               double radius_mm) {
  detail::BlockGrid<std::uint8_t> marks(grid.size, 0);
  const Vec3 reach = Vec3::Constant(radius_mm).cwiseQuotient(grid.spacing);
  for (const Vec3& point : geometry::resample(line, 0.5 * radius_mm)) {
    const Vec3 at = grid.index(point);
    Voxel low{}, high{};
    for (int d = 0; d < 3; ++d) {
      const auto a = static_cast<std::size_t>(d);
      const auto last = static_cast<double>(grid.size[a] - 1);
      low[a] = static_cast<std::int32_t>(std::max(0.0, std::ceil(at[d] - reach[d])));
      high[a] = static_cast<std::int32_t>(std::min(last, std::floor(at[d] + reach[d])));
    }
    for (std::int32_t k = low[2]; k <= high[2]; ++k)
      for (std::int32_t j = low[1]; j <= high[1]; ++j)
        for (std::int32_t i = low[0]; i <= high[0]; ++i)
          if ((Vec3(i, j, k) - at).cwiseProduct(grid.spacing).norm() <= radius_mm) marks.at({i, j, k}) = 1;
  }
  return marks;
}

/// Points of a line up to an abscissa, and from there on.
std::pair<std::vector<Vec3>, std::vector<Vec3>> cut_at(const std::vector<Vec3>& line, double s_mm) {
  const geometry::PolylineLocation at = geometry::at_abscissa(line, s_mm);
  const auto middle = line.begin() + static_cast<std::ptrdiff_t>(at.segment) + 1;
  std::pair<std::vector<Vec3>, std::vector<Vec3>> parts{{line.begin(), middle}, {at.point}};
  parts.first.push_back(at.point);
  parts.second.insert(parts.second.end(), middle, line.end());
  return parts;
}

/// The cheapest way within the corridor in place of the line's free part.
std::vector<Vec3> sought_way(MinimalPath& path, TubeSpeed& speed, const std::vector<Vec3>& rough,
                             const PathAlongOptions& options, const core::TaskContext& task) {
  const imaging::Geometry& grid = speed.image().geometry;
  const double length = geometry::length(rough);
  const auto [before, rest] = cut_at(rough, options.fixed_start_mm);
  const auto [free, after] = cut_at(rest, length - options.fixed_start_mm - options.fixed_end_mm);
  const double snap = std::min(options.path.snap_voxels, options.corridor_mm / grid.spacing.maxCoeff());
  const Vec3 start =
      options.fixed_start_mm > 0.0 ? free.front() : detail::snapped(speed, free.front(), snap, path.warnings);
  const Vec3 end =
      options.fixed_end_mm > 0.0 ? free.back() : detail::snapped(speed, free.back(), snap, path.warnings);
  const Voxel goal = detail::nearest_voxel(grid, start);
  if (goal == detail::nearest_voxel(grid, end))
    throw InvalidInput("the line begins and ends in one place, " + detail::text(start) +
                       " mm: give it two ends");
  const detail::BlockGrid<std::uint8_t> corridor = corridor_about(grid, free, options.corridor_mm);
  detail::PathFrontStop stop;
  stop.target = [&](const Voxel& v) { return v == goal; };
  stop.within = [&](const Voxel& v) { return corridor.get(v) != 0 || v == goal; };
  stop.max_length_mm = std::numeric_limits<double>::infinity();  // the corridor ends it
  stop.most_voxels = std::numeric_limits<std::int64_t>::max();
  const detail::PathFront front = detail::run_front(speed, end, stop, task);
  path.visited = front.visited;
  if (front.end != detail::PathFrontEnd::target)
    throw GeometryError("no way along the line from " + detail::text(start) + " to " + detail::text(end) +
                        " mm: it is thinner than the voxels; widen the corridor");
  std::vector<Vec3> way = detail::trace_back(grid, front, end);
  way.front() = start;
  if (options.fixed_start_mm > 0.0) way.insert(way.begin(), before.begin(), before.end() - 1);
  if (options.fixed_end_mm > 0.0) way.insert(way.end(), after.begin() + 1, after.end());
  return way;
}

/// The line as it is, or the way that was found near it; levels and speed go with it.
struct Followed {
  TubeSpeed speed;
  std::vector<Vec3> way;
};
Followed followed(MinimalPath& path, const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                  const PathAlongOptions& options, const core::TaskContext& task) {
  const LumenLevels levels = levels_along(image, rough);
  path.lumen_hu = levels.lumen_hu;
  path.background_hu = levels.background_hu;
  Followed result{TubeSpeed(image, levels, options.path.slowest), rough};
  if (options.corridor_mm > 0.0)
    result.way = sought_way(path, result.speed, rough, options, task.sub(0.1, 0.8));
  task.throw_if_cancelled();
  return result;
}

}  // namespace

void validate(const PathAlongOptions& o) {
  validate(o.path);
  const auto check = [](bool good, const char* name, double value, const char* allowed) {
    if (!good)
      throw InvalidInput(worded("way along a line: %s is %g; it must be in %s", name, value, allowed));
  };
  check(o.corridor_mm >= 0.0 && o.corridor_mm <= 10.0, "corridor_mm", o.corridor_mm, "[0, 10] mm");
  check(o.fixed_start_mm >= 0.0 && o.fixed_start_mm <= 1000.0, "fixed_start_mm", o.fixed_start_mm,
        "[0, 1000] mm");
  check(o.fixed_end_mm >= 0.0 && o.fixed_end_mm <= 1000.0, "fixed_end_mm", o.fixed_end_mm, "[0, 1000] mm");
}

MinimalPath path_along(const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                       const PathAlongOptions& options, const core::TaskContext& task) {
  check_line(image, rough, options);
  task.set_stage("finding the way along a line");
  task.throw_if_cancelled();
  MinimalPath path;
  Followed found = followed(path, image, rough, options, task);
  detail::finish(path, found.speed, found.way, {options.fixed_start_mm, options.fixed_end_mm}, options.path);
  task.set_progress(1.0);
  return path;
}

MinimalPath path_along_to_tree(const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                               const geometry::VesselTree& tree, const PathAlongOptions& options,
                               const core::TaskContext& task) {
  PathAlongOptions free = options;
  free.fixed_start_mm = 0.0;
  check_line(image, rough, free);
  task.set_stage("finding the way along a line");
  task.throw_if_cancelled();
  const detail::PathTarget target(image, tree, rough.front(), 1.5 * geometry::length(rough) + 10.0);
  MinimalPath path;
  Followed found = followed(path, image, rough, free, task);
  const imaging::Geometry& grid = image.geometry;
  const std::vector<Vec3> way = geometry::resample(found.way, 0.5 * grid.spacing.minCoeff());
  const auto in_tree = [&](const Vec3& p) { return target.hit(detail::nearest_voxel(grid, p)); };
  auto inside = std::find_if(way.begin(), way.end(), in_tree);
  if (inside == way.end())
    throw GeometryError("the line from " + detail::text(rough.front()) +
                        " mm does not come from the tree: begin it in the lumen of a vessel");
  while (inside + 1 != way.end() && in_tree(*(inside + 1))) ++inside;
  detail::join_and_finish(path, found.speed, target, detail::nearest_voxel(grid, *inside),
                          {inside, way.end()}, options.fixed_end_mm, options.path,
                          "the end of the line, " + detail::text(rough.back()) + " mm,");
  task.set_progress(1.0);
  return path;
}

}  // namespace ostia::segmentation
