#include "ostia/segmentation/minimal_path.h"

#include "fronts/fast_marching.h"
#include "path/finish.h"
#include "path/front.h"
#include "path/target.h"
#include "range_about_seeds.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace ostia::segmentation {
namespace {

using detail::LumenLevels;
using detail::TubeSpeed;
using detail::Voxel;

constexpr double kNearMm = 25.0;  // of the tree: its lumen there is like the new vessel's
constexpr std::size_t kFewestPlaces = 40;
constexpr double kAirHu = -500.0;

void check(bool good, const char* name, double value, const char* allowed) {
  if (!good)
    throw InvalidInput(detail::worded("minimal path: %s is %g; it must be in %s", name, value, allowed));
}

[[noreturn]] void unreached(const detail::PathFront& front, const Vec3& click, const char* what,
                            const MinimalPathOptions& options) {
  const std::string text = std::string("no way from ") + detail::text(click) + " mm to " + what + ": ";
  switch (front.end) {
    case detail::PathFrontEnd::length:
      throw GeometryError(text +
                          detail::worded("the front has run %.0f mm (max_length_mm); click nearer to it, or "
                                         "set points between",
                                         options.max_length_mm));
    case detail::PathFrontEnd::voxels:
      throw GeometryError(text + detail::worded("the front has spread over %lld voxels (most_voxels) without "
                                                "following a vessel; click in the lumen of one",
                                                static_cast<long long>(options.most_voxels)));
    default:
      throw GeometryError(text + "the front has covered the image");
  }
}

}  // namespace

void validate(const MinimalPathOptions& o) {
  check(o.max_length_mm >= 1.0 && o.max_length_mm <= 1000.0, "max_length_mm", o.max_length_mm,
        "[1, 1000] mm");
  check(o.step_mm >= 0.1 && o.step_mm <= 5.0, "step_mm", o.step_mm, "[0.1, 5] mm");
  check(o.snap_voxels >= 0.0 && o.snap_voxels <= 10.0, "snap_voxels", o.snap_voxels, "[0, 10]");
  check(o.largest_radius_mm >= 0.5 && o.largest_radius_mm <= 10.0, "largest_radius_mm", o.largest_radius_mm,
        "[0.5, 10] mm");
  check(o.blur_sigma_mm >= 0.0 && o.blur_sigma_mm <= 1.5, "blur_sigma_mm", o.blur_sigma_mm, "[0, 1.5] mm");
  check(o.wall_hu >= -100.0 && o.wall_hu <= 200.0, "wall_hu", o.wall_hu, "[-100, 200] HU");
  check(o.slowest > 0.0 && o.slowest <= 0.5, "slowest", o.slowest, "(0, 0.5]");
  check(o.most_voxels >= 1000, "most_voxels", static_cast<double>(o.most_voxels), "[1000, inf)");
}

MinimalPath path_to_tree(const imaging::ImageVolume& image, const Vec3& click,
                         const geometry::VesselTree& tree, const MinimalPathOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  detail::require_inside(image, click, "the click");
  task.set_stage("finding the way to the tree");
  const detail::PathTarget target(image, tree, click, options.max_length_mm);
  if (target.empty()) {
    throw InvalidInput(detail::worded("the tree has no axis inside the image within %.0f mm of the click ",
                                      options.max_length_mm) +
                       detail::text(click) + " mm: draw a first vessel by its two ends");
  }
  const auto refuse_inside = [&](const Vec3& place) {
    const std::optional<std::int32_t> vessel = target.vessel_around(place);
    if (!vessel) return;
    const auto named = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                    [&](const geometry::Vessel& v) { return v.id == *vessel; });
    throw InvalidInput("the click " + detail::text(click) + " mm lies inside vessel '" + named->name +
                       "', which is in the tree already: click the distal end of one that is not");
  };
  refuse_inside(click);

  MinimalPath path;
  const LumenLevels tree_levels = detail::calcium_above(
      detail::levels_from(image, target.axis_points_near(click, kNearMm, kFewestPlaces), {click}), image,
      target.axis_points_near(click, std::numeric_limits<double>::infinity(), 1));
  TubeSpeed plain(image, tree_levels, options.slowest);
  const Vec3 end = detail::snapped(plain, click, options.snap_voxels, path.warnings);
  refuse_inside(end);
  const LumenLevels levels =
      detail::dimmed(tree_levels, plain.smooth(detail::nearest_voxel(image.geometry, end)));
  TubeSpeed speed(image, levels, options.slowest);
  path.lumen_hu = levels.lumen_hu;
  path.background_hu = levels.background_hu;

  detail::PathFrontStop stop;
  stop.target = [&](const Voxel& v) { return target.hit(v); };
  stop.max_length_mm = options.max_length_mm;
  stop.most_voxels = options.most_voxels;
  const detail::PathFront front = detail::run_front(speed, end, stop, task.sub(0.0, 0.9));
  path.visited = front.visited;
  if (front.end != detail::PathFrontEnd::target) unreached(front, click, "the tree", options);

  const std::vector<Vec3> way = detail::trace_back(image.geometry, front, end);
  detail::join_and_finish(path, speed, target, front.reached, way, 0.0, options,
                          "the click " + detail::text(click) + " mm");
  task.set_progress(1.0);
  return path;
}

MinimalPath path_between(const imaging::ImageVolume& image, const Vec3& from, const Vec3& to,
                         const MinimalPathOptions& options, const core::TaskContext& task) {
  validate(options);
  detail::require_inside(image, from, "the click");
  detail::require_inside(image, to, "the click");
  task.set_stage("finding the way between two points");
  MinimalPath path;
  // The brighter end tells the lumen's intensity: the other may be thin, or beside it.
  TubeSpeed looking(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<Vec3> brightest;
  double most = -1e9;
  for (const Vec3& click : {from, to}) {
    const detail::BrightVoxel bright = detail::brightest_about(looking, click);
    if (bright.hu <= most) continue;
    most = bright.hu;
    brightest = {bright.place};
  }
  const imaging::Geometry& g = image.geometry;
  if (most < kAirHu) {
    throw InvalidInput("both ends of the way, " + detail::text(from) + " and " + detail::text(to) +
                       " mm, lie in air: click in the contrast-filled lumen");
  }
  const LumenLevels bright = detail::levels_from(image, brightest, {from, to});
  TubeSpeed plain(image, bright, options.slowest);
  const Vec3 start = detail::snapped(plain, from, options.snap_voxels, path.warnings);
  const Vec3 end = detail::snapped(plain, to, options.snap_voxels, path.warnings);
  const double dimmer =
      std::min(plain.smooth(detail::nearest_voxel(g, start)), plain.smooth(detail::nearest_voxel(g, end)));
  const LumenLevels levels = detail::dimmed(bright, dimmer);
  TubeSpeed speed(image, levels, options.slowest);
  path.lumen_hu = levels.lumen_hu;
  path.background_hu = levels.background_hu;

  const Voxel goal = detail::nearest_voxel(g, start);
  if (goal == detail::nearest_voxel(g, end)) {
    throw InvalidInput("the two ends of the way, " + detail::text(from) + " and " + detail::text(to) +
                       " mm, are one place: click them further apart");
  }
  detail::PathFrontStop stop;
  stop.target = [&](const Voxel& v) { return v == goal; };
  stop.max_length_mm = options.max_length_mm;
  stop.most_voxels = options.most_voxels;
  const detail::PathFront front = detail::run_front(speed, end, stop, task.sub(0.0, 0.9));
  path.visited = front.visited;
  if (front.end != detail::PathFrontEnd::target)
    unreached(front, to, (detail::text(from) + " mm").c_str(), options);
  std::vector<Vec3> way = detail::trace_back(g, front, end);
  way.front() = start;
  detail::finish(path, speed, way, {}, options);
  task.set_progress(1.0);
  return path;
}

}  // namespace ostia::segmentation
